"""Several instances share a folder: each writes only the settings that it has changed."""

import subprocess
import sys
from pathlib import Path

from hypothesis import given
from hypothesis import settings as runs
from hypothesis import strategies as st

from pigaming_app.storage.settings import Choice, Settings

ROOT = Path(__file__).parents[2]
MUSIC = """
import sys
from pathlib import Path
from pigaming_app.storage.settings import Settings
folder, name = Path(sys.argv[1]), sys.argv[2]
settings, _ = Settings.load(folder)
for value in [*range(9), int(sys.argv[3])]:
    setattr(settings, name, value)
    settings.choice("race").goal = 7
    settings.choice(name).minutes = value
    settings.save(folder)
"""


def test_changes_of_two_instances_are_merged(tmp_path, caplog):
    Settings().save(tmp_path)
    one, other = Settings.load(tmp_path)[0], Settings.load(tmp_path)[0]
    one.language, one.choice("race").goal = "pt", 5
    other.music, other.choice("race").arena = 2, "kidney"
    one.save(tmp_path)
    other.save(tmp_path)
    kept, problems = Settings.load(tmp_path)
    assert not problems
    assert (kept.language, kept.music, kept.choice("race")) == ("pt", 2, Choice("kidney", goal=5))
    expected = "settings of another copy of the arcade kept: language, games.race.goal."
    assert [record.message for record in caplog.records] == [expected]
    assert (other.language, one.music) == ("en", 8), "a copy goes on as it was set"


def test_looking_at_a_game_changes_nothing_that_another_copy_chose(tmp_path):
    one, other = Settings.load(tmp_path)[0], Settings.load(tmp_path)[0]
    one.choice("race").arena = "kidney"
    one.save(tmp_path)
    other.choice("race")
    other.save(tmp_path)
    assert Settings.load(tmp_path)[0].choice("race").arena == "kidney"


def test_the_later_of_two_choices_wins_and_is_logged(tmp_path, caplog):
    one, other = Settings.load(tmp_path)[0], Settings.load(tmp_path)[0]
    one.music, other.music = 1, 2
    one.save(tmp_path)
    other.save(tmp_path)
    one.save(tmp_path)
    assert Settings.load(tmp_path)[0].music == 2
    replaced, kept = (record.message for record in caplog.records)
    assert replaced == "settings of another copy of the arcade replaced: music."
    assert kept == "settings of another copy of the arcade kept: music."


@runs(max_examples=15, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 2), st.sampled_from(("music", "sounds", "goal", "save")), st.integers(0, 9))))
def test_copies_in_any_order_keep_the_last_saved_choice_of_every_setting(tmp_path_factory, story):
    folder = tmp_path_factory.mktemp("shared")
    copies = [Settings.load(folder)[0] for _ in range(3)]
    there = {"music": 8, "sounds": 10, "goal": 0}
    known = [dict(there) for _ in copies]  # as each instance last loaded or saved it
    mine = [dict(there) for _ in copies]
    for copy, name, value in [*story, *((copy, "save", 0) for copy in range(3))]:
        settings = copies[copy]
        if name == "save":
            settings.save(folder)
            there |= {key: now for key, now in mine[copy].items() if now != known[copy][key]}
            known[copy] = dict(mine[copy])
        else:
            mine[copy][name] = value
            setattr(settings.choice("race") if name == "goal" else settings, name, value)
    kept = Settings.load(folder)[0]
    assert {"music": kept.music, "sounds": kept.sounds, "goal": kept.choice("race").goal} == there


def test_parallel_processes_keep_the_choices_of_all(tmp_path):
    wanted = {"music": 3, "sounds": 5, "display": 7}
    copies = [
        subprocess.Popen([sys.executable, "-c", MUSIC, str(tmp_path), name, str(value)], cwd=ROOT)
        for name, value in wanted.items()
    ]
    assert [copy.wait() for copy in copies] == [0, 0, 0]
    kept, problems = Settings.load(tmp_path)
    assert not problems
    assert {name: getattr(kept, name) for name in wanted} == wanted
    assert {name: kept.choice(name).minutes for name in wanted} == wanted
    assert kept.choice("race").goal == 7
