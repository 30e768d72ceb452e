"""Settings survive power cuts, broken files and full disks; an invalid entry is reported and affects no other."""

import errno
import os
import tomllib
from dataclasses import replace
from datetime import time

import pytest
import tomli_w

from pigaming_app.storage import safe_files as keeping
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import FILE, Choice, Settings, folders


def test_without_a_file_there_are_defaults_and_no_messages(tmp_path):
    assert Settings.load(tmp_path / "new") == (Settings(), [])


def test_saved_settings_are_loaded_again(tmp_path):
    changed = Settings(language="pt", music=0, shake=False, attract_seconds=90.0)
    changed.choice("race").goal = 5
    changed.choice("pitanks").arena = "islands"
    changed.save(tmp_path / "new")
    assert Settings.load(tmp_path / "new") == (changed, [])


def test_the_version_before_stays_beside_it(tmp_path):
    Settings(music=1).save(tmp_path)
    Settings(music=2).save(tmp_path)
    assert tomllib.loads((tmp_path / f"{FILE}.bak").read_text())["music"] == 1


def test_a_broken_file_is_set_aside_and_reported_once(tmp_path):
    (tmp_path / FILE).write_text("language = \n")
    settings, problems = Settings.load(tmp_path)
    (aside,) = tmp_path.glob(f"{FILE}.broken-*")
    assert settings == Settings()
    assert aside.read_text() == "language = \n"
    assert len(problems) == 1
    assert all(part in problems[0] for part in (str(tmp_path / FILE), "line 1", aside.name))
    assert Settings.load(tmp_path) == (Settings(), [])


def test_the_one_before_serves_when_the_last_is_broken(tmp_path):
    Settings(language="pt").save(tmp_path)
    Settings(language="pt").save(tmp_path)
    (tmp_path / FILE).write_bytes(b"\xff\x00")
    settings, problems = Settings.load(tmp_path)
    assert settings.language == "pt"
    assert "it is not text in UTF-8" in problems[0]
    assert problems[0].endswith("the previous version was restored.")
    assert Settings.load(tmp_path) == (settings, [])


def test_notepad_may_have_edited_it(tmp_path):
    (tmp_path / FILE).write_bytes(b"\xef\xbb\xbfmusic = 3\r\n")
    assert Settings.load(tmp_path) == (Settings(music=3), [])


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("music = 11", "music = 11: expected a whole number <= 10; 6 is used"),
        ("music = 3.5", "music = 3.5: expected a whole number, got a number; 6 is used"),
        ("music = true", "music = True: expected a whole number, got true or false; 6 is used"),
        ('language = "it"', "language = 'it': expected one of en, pt, es, fr, de; 'en' is used"),
        ("language = []", "language = []: expected a text, got a list; 'en' is used"),
        ("shake = 1", "shake = 1: expected true or false, got a whole number; True is used"),
        ("attract_seconds = nan", "attract_seconds = nan: expected a number >= 5.0; 60.0 is used"),
        ("games = 3", "games is not a table; it is ignored"),
        ("[games.race]\ngoal = -1", "games.race.goal = -1: expected a whole number >= 0; 0 is used"),
        ("[games.race]\narena = 3", "games.race.arena = 3: expected a text, got a whole number; '' is used"),
        ("[games.race]\nwheels = 3", "games.race.wheels is not a setting; it is ignored"),
        ("[games]\nrace = 3", "race is not a table; it is ignored"),
        ("[music]", "music = {}: expected a whole number, got a table; 6 is used"),
        ("loudness = 3", "loudness is not a setting; it is ignored"),
    ],
)
def test_an_invalid_line_is_reported_and_affects_no_other(tmp_path, line, reason):
    (tmp_path / FILE).write_text(f"sounds = 1\n{line}\n")
    settings, problems = Settings.load(tmp_path)
    assert settings == replace(Settings(), sounds=1, games=settings.games)
    assert all(choice == Choice() for choice in settings.games.values())
    assert problems == [f"{tmp_path / FILE}: {reason}."]


def test_a_whole_number_will_do_for_seconds(tmp_path):
    (tmp_path / FILE).write_text("attract_seconds = 30\n")
    seconds = Settings.load(tmp_path)[0].attract_seconds
    assert (seconds, type(seconds)) == (30.0, float)


@pytest.mark.parametrize(
    ("number", "reason"),
    [(errno.ENOSPC, "the disk is full"), (errno.EROFS, "no permission"), (errno.EIO, os.strerror(errno.EIO))],
)
def test_where_nothing_can_be_written_the_old_file_is_intact(tmp_path, monkeypatch, number, reason):
    Settings(music=1).save(tmp_path)
    Settings(music=2).save(tmp_path)

    def refuse(_file):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(keeping.os, "fsync", refuse)
    with pytest.raises(NotSaved, match=f"^.*{FILE} was not saved: {reason}.$"):
        Settings(music=3).save(tmp_path)
    assert Settings.load(tmp_path) == (Settings(music=2), [])
    assert sorted(path.name for path in tmp_path.iterdir()) == [f".{FILE}.lock", FILE, f"{FILE}.bak"]


def test_a_plug_pulled_before_the_last_step_leaves_the_old_file(tmp_path, monkeypatch):
    Settings(music=1).save(tmp_path)
    moves = []

    def pulled(source, target):
        moves.append(target)
        if len(moves) == 2:  # the first is the .bak
            raise KeyboardInterrupt
        os.rename(source, target)

    monkeypatch.setattr(keeping.os, "replace", pulled)
    with pytest.raises(KeyboardInterrupt):
        Settings(music=3).save(tmp_path)
    assert Settings.load(tmp_path) == (Settings(music=1), [])


def test_a_file_in_place_of_the_folder_is_reported_and_unchanged(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(NotSaved):
        Settings().save(tmp_path / "file")
    assert (tmp_path / "file").read_text() == "in the way"


def test_a_folder_in_place_of_the_file_is_put_aside(tmp_path):
    (tmp_path / FILE).mkdir()
    assert len(Settings.load(tmp_path)[1]) == 1
    Settings(music=3).save(tmp_path)
    assert Settings.load(tmp_path) == (Settings(music=3), [])


def test_one_variable_moves_all_folders(home):
    where = folders()
    assert {where.config.parent, where.data.parent, where.cache.parent} == {home}


def test_without_it_they_are_the_platforms_own(monkeypatch):
    monkeypatch.delenv("PIGAMING_HOME")
    where = folders()
    assert len({where.config, where.cache}) == 2
    assert all("pigaming" in str(folder) for folder in (where.config, where.data, where.cache))


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("real = [1, 5]", "[1]: expected a whole number <= 4"),
        ("real = [2, 2]", "not different numbers"),
        ("real = 3", "expected a list"),
        ("radios = [1, 2]", "expected a list of length >= 4"),
        ("baud = 7", "expected a whole number >= 1200"),
        ('radio = "morse"', "expected one of api2, "),
        ("mat = 1", "expected true or false"),
    ],
)
def test_invalid_camera_and_radio_settings_are_reported(tmp_path, line, reason):
    (tmp_path / FILE).write_text(line + "\n")
    settings, problems = Settings.load(tmp_path)
    assert settings == Settings()
    assert len(problems) == 1
    assert reason in problems[0]


def test_the_robots_and_their_radios_are_kept(tmp_path):
    chosen = Settings(mat=True, real=[3, 1], radios=[2, 1, 3, 4], port="/dev/ttyUSB1", radio="stock", camera=2)
    chosen.save(tmp_path)
    assert Settings.load(tmp_path) == (chosen, [])


def test_choosing_an_invalid_value_raises_the_reason_and_changes_nothing():
    settings = Settings()
    with pytest.raises(ValueError, match="baud = 7: expected a whole number >= 1200"):
        settings.choose("baud", 7)
    settings.choose("baud", 115200)
    assert settings == Settings(baud=115200)


@pytest.mark.parametrize(
    ("begin", "end", "quiet", "loud"),
    [
        ("22:00", "07:30", "22:00 23:59 00:00 07:29", "21:59 07:30 12:00"),
        ("09:00", "10:00", "09:00 09:59", "08:59 10:00 00:00"),
        ("23:30", "00:00", "23:30 23:59", "23:29 00:00 12:00"),
        ("00:00", "00:00", "", "00:00 12:00 23:59"),
        ("12:00", "12:00", "", "00:00 12:00 23:59"),
    ],
)
def test_quiet_hours_may_pass_midnight(begin, end, quiet, loud):
    settings = Settings(quiet_from=begin, quiet_until=end)
    assert all(settings.quiet(time.fromisoformat(at)) for at in quiet.split())
    assert not any(settings.quiet(time.fromisoformat(at)) for at in loud.split())


def test_the_cap_limits_both_volumes():
    assert Settings(music=9, sounds=4, volume_cap=6).loudness == (6, 4)
    assert Settings(music=9, sounds=4).loudness == (9, 4)


@pytest.mark.parametrize("value", ["24:00", "9:00", "12:60", "noon", "", 900, "09:00\n"])
def test_a_time_that_is_none_is_ignored(tmp_path, value):
    (tmp_path / FILE).write_text(tomli_w.dumps({"quiet_from": value}))
    settings, problems = Settings.load(tmp_path)
    assert settings == Settings()
    assert len(problems) == 1
    assert problems[0].startswith(f"{tmp_path / FILE}: quiet_from = ")
