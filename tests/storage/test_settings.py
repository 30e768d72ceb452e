"""Settings survive power cuts, broken files and full disks; an invalid entry is reported and affects no other."""

from dataclasses import replace
from datetime import time

import pytest

from pigaming_app.storage.settings import FILE, MAX_GAMES, MAX_MESSAGES, MAX_NAME, Choice, Settings, folders


def test_without_a_file_there_are_defaults_and_no_messages(tmp_path):
    assert Settings.load(tmp_path / "new") == (Settings(), [])


def test_saved_settings_are_loaded_again(tmp_path):
    changed = Settings(language="pt", music=0, shake=False, attract_seconds=90.0, mat=True, real=[3, 1], camera=2)
    changed.radios, changed.port, changed.radio = [2, 1, 3, 4], "/dev/ttyUSB1", "stock"
    changed.choice("race").goal = 5
    changed.choice("pitanks").arena = "islands"
    changed.save(tmp_path / "new")
    assert Settings.load(tmp_path / "new") == (changed, [])


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("music = 11", "music = 11: expected a whole number <= 10; 8 is used"),
        ("music = 3.5", "music = 3.5: expected a whole number, got a number; 8 is used"),
        ("music = true", "music = True: expected a whole number, got true or false; 8 is used"),
        ('language = "it"', "language = 'it': expected one of en, pt, es, fr, de; 'en' is used"),
        ("language = []", "language = []: expected a text, got a list; 'en' is used"),
        ("shake = 1", "shake = 1: expected true or false, got a whole number; True is used"),
        ("attract_seconds = nan", "attract_seconds = nan: expected a number >= 5.0; 60.0 is used"),
        ("games = 3", "games is not a table; it is ignored"),
        ("[games.race]\ngoal = -1", "games.race.goal = -1: expected a whole number >= 0; 0 is used"),
        ("[games.race]\narena = 3", "games.race.arena = 3: expected a text, got a whole number; '' is used"),
        ("[games.race]\nwheels = 3", "games.race.wheels is not a setting; it is ignored"),
        ("[games]\nrace = 3", "race is not a table; it is ignored"),
        ("[music]", "music = {}: expected a whole number, got a table; 8 is used"),
        ("loudness = 3", "loudness is not a setting; it is ignored"),
        ("real = [1, 5]", "real = [1, 5]: [1]: expected a whole number <= 4; [] is used"),
        ("real = [2, 2]", "real = [2, 2]: not different numbers; [] is used"),
        ("real = 3", "real = 3: expected a list, got a whole number; [] is used"),
        ("radios = [1, 2]", "radios = [1, 2]: expected a list of length >= 4; [1, 2, 3, 4] is used"),
        ("baud = 7", "baud = 7: expected a whole number >= 1200; 57600 is used"),
        ("radio = 2", "radio = 2: expected a text, got a whole number; 'api2' is used"),
        ("mat = 1", "mat = 1: expected true or false, got a whole number; False is used"),
        ("quiet_from = 900", "quiet_from = 900: expected a text, got a whole number; '00:00' is used"),
        *(
            (f"quiet_from = {at!r}", f"quiet_from = {at!r}: not a time such as 22:30; '00:00' is used")
            for at in ("24:00", "9:00", "12:60", "noon", "")
        ),
        ('quiet_from = "09:00\\n"', r"quiet_from = '09:00\n': not a time such as 22:30; '00:00' is used"),
    ],
)
def test_an_invalid_line_is_reported_and_affects_no_other(tmp_path, line, reason):
    (tmp_path / FILE).write_text(f"sounds = 1\n{line}\n")
    settings, problems = Settings.load(tmp_path)
    assert settings == replace(Settings(), sounds=1, games=settings.games)
    assert all(choice == Choice() for choice in settings.games.values())
    assert problems == [f"{tmp_path / FILE}: {reason}."]


@pytest.mark.parametrize(
    "line",
    [
        f"music = {'9' * 400}",
        f"music = 0x{'f' * 5000}",
        f"attract_seconds = {'9' * 400}",
        "attract_seconds = inf",
        "attract_seconds = -1e308",
        "corners = [true, true, true, true, true, true, true, true]",
        f"corners = [{','.join('1' * 5000)}]",
        *(f"corners = {odd}" for odd in ('"none"', [1, 2], [0.5] * 8, [99999] * 8)),
        *(f"controls = {odd}" for odd in ('"5"', "{a = {}}", "{keys1 = 5}", "{keys1 = {fire = -1}}")),
        "controls = {keys1 = {fire = true}}",
        "real = [true]",
        'port = "a\\u0000b"',
        'port = "a\\nb"',
        f'port = "{"x" * 5000}"',
        '"" = 1',
        '"a.b\\nc" = 1',
        f'"{"k" * 5000}" = 1',
        "music = 0001-01-01T00:00:00Z",
        'games = ""',
        f'[games."{"g" * (MAX_NAME + 1)}"]\ngoal = 3',
        '[games."a\\nb"]\nvolume = 3',
        "[music]\na = 1",
        "[[games.race]]\ngoal = 3",
    ],
)
def test_an_odd_line_is_reported_in_one_line_and_affects_no_other(tmp_path, line):
    (tmp_path / FILE).write_text(f"sounds = 1\n{line}\n")
    settings, (problem,) = Settings.load(tmp_path)
    assert settings == replace(Settings(), sounds=1, games=settings.games)
    assert "\n" not in problem
    assert len(problem) < 400
    settings.save(tmp_path)
    assert Settings.load(tmp_path) == (settings, [])


def test_thousands_of_odd_lines_are_summed_up(tmp_path):
    lines = [f"key{i} = {i}" for i in range(3000)] + [f"[games.game{i}]\ngoal = 3" for i in range(3000)]
    (tmp_path / FILE).write_text("sounds = 1\n" + "\n".join(lines))
    settings, problems = Settings.load(tmp_path)
    assert settings.sounds == 1
    assert len(settings.games) == MAX_GAMES
    assert len(problems) == MAX_MESSAGES + 1
    assert problems[-1].endswith(f"{6000 - MAX_GAMES - MAX_MESSAGES} more lines are wrong; they are ignored.")


def test_a_whole_number_will_do_for_seconds(tmp_path):
    (tmp_path / FILE).write_text("attract_seconds = 30\n")
    seconds = Settings.load(tmp_path)[0].attract_seconds
    assert (seconds, type(seconds)) == (30.0, float)


def test_one_variable_moves_all_folders(home):
    where = folders()
    assert {where.config.parent, where.data.parent, where.cache.parent} == {home}


def test_without_it_they_are_the_platforms_own(monkeypatch):
    monkeypatch.delenv("PIGAMING_HOME")
    where = folders()
    assert len({where.config, where.cache}) == 2
    assert all("pigaming" in str(folder) for folder in (where.config, where.data, where.cache))


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
