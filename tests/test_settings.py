"""Settings survive pulled plugs, broken files and full disks."""

import pytest

from pigaming_app.keeping import NotSaved
from pigaming_app.scores import Scores
from pigaming_app.settings import Settings, folders


def test_what_is_saved_comes_back(tmp_path):
    settings, said = Settings.load(tmp_path)
    assert said == []
    settings.language, settings.music = "pt", 3
    settings.save(tmp_path)
    again, said = Settings.load(tmp_path)
    assert (again.language, again.music, said) == ("pt", 3, [])


def test_a_broken_file_is_kept_aside_and_said_once(tmp_path):
    (tmp_path / "settings.toml").write_text("language = [[[")
    settings, said = Settings.load(tmp_path)
    assert settings == Settings()
    assert len(said) == 1
    assert any("broken" in path.name for path in tmp_path.iterdir())
    assert Settings.load(tmp_path)[1] == []


def test_the_one_before_serves_when_the_last_is_broken(tmp_path):
    settings = Settings(language="pt")
    settings.save(tmp_path)
    settings.save(tmp_path)
    (tmp_path / "settings.toml").write_bytes(b"\xff\x00")
    assert Settings.load(tmp_path)[0].language == "pt"


def test_a_wrong_value_costs_only_itself(tmp_path):
    (tmp_path / "settings.toml").write_text('music = 99\nlanguage = "pt"\nwhatever = 1\n')
    settings, said = Settings.load(tmp_path)
    assert settings.music == Settings().music
    assert settings.language == "pt"
    assert len(said) == 2


def test_a_folder_that_cannot_be_written_is_said_and_harms_nothing(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("in the way")
    with pytest.raises(NotSaved):
        Settings().save(blocked)
    assert blocked.read_text() == "in the way"


def test_one_variable_moves_all_folders(tmp_path, monkeypatch):
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    where = folders()
    assert all(tmp_path in folder.parents for folder in (where.config, where.data, where.cache))


def test_scores_come_back_best_first(tmp_path):
    scores = Scores()
    scores.add("pitanks", "classic", "ANA", 3)
    scores.add("pitanks", "classic", "BEA", 7)
    scores.save(tmp_path)
    again, said = Scores.load(tmp_path)
    assert said == []
    assert [(row.initials, row.score) for row in again.best("pitanks", "classic")] == [("BEA", 7), ("ANA", 3)]
    again.reset()
    assert again.best("pitanks", "classic") == []
