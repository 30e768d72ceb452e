"""Events survive on disk: every kind of damage is one sentence, and no kill loses a result."""

import json
import os
from dataclasses import replace

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import delete, load, parse, path_of, save, saved_events, to_text, update
from pigaming_app.events.spec import Advance, Entrant, EventSpec, Format
from tests.events.examples import best_seed_wins, level, new_event, played


def test_an_event_is_read_as_it_was_written(tmp_path):
    entrants = (Entrant("Ana", "level1", "Red"), Entrant("Zoë"), Entrant("C", "/a b/mine.npz"))
    spec = EventSpec(
        "Open – day", Format.KNOCKOUT, ("pitanks", "race"), entrants, 3, 4,
        {"race": ("kidney",), "pitanks": ("islands", "classic")}, {"pitanks": 1.5},
        {"pitanks": "party"}, 9, Advance.QUARTER,
    )  # fmt: skip
    event = played(Event(spec), lambda one: replace(level(one), scores={one.entrants[0]: 2.5}, note="short"), 1)
    save(tmp_path / "a.json", event)
    assert load(tmp_path / "a.json") == (event, [])
    assert saved_events(tmp_path)[0].event == event


@pytest.mark.parametrize(
    "change",
    [
        lambda plain: plain | {"format": 2},
        lambda plain: plain | {"journal": [7]},
        lambda plain: plain | {"journal": [{"entry": "result", "outcome": {"fixture": 1, "places": [["P1"]]}}]},
        lambda plain: plain | {"journal": [{"entry": "result", "outcome": {"fixture": True, "places": []}}]},
        lambda plain: plain | {"journal": [{"entry": "result", "outcome": {"fixture": 1, "places": [7]}}]},
        lambda plain: plain | {"journal": [{"entry": "postponement", "fixture": 1e300}]},
        lambda plain: plain | {"journal": [{"entry": "late", "entrant": {"name": "A\n"}}]},
        lambda plain: plain | {"spec": {}},
        lambda plain: plain | {"spec": plain["spec"] | {"format": "duel"}},
        lambda plain: plain | {"spec": plain["spec"] | {"rounds": "3"}},
        lambda plain: plain | {"spec": plain["spec"] | {"rounds": 1e30}},
        lambda plain: plain | {"spec": plain["spec"] | {"minutes": [1]}},
        lambda plain: plain | {"spec": plain["spec"] | {"minutes": {"pitanks": "x"}}},
        lambda plain: plain | {"spec": plain["spec"] | {"entrants": [1, 2, 3]}},
        lambda plain: plain | {"spec": plain["spec"] | {"games": []}},
        lambda plain: [],
    ],
)
def test_what_is_no_event_is_refused_with_one_line(change):
    plain = json.loads(to_text(new_event(Format.SWISS, 4)))
    with pytest.raises(ValueError, match=r"\w") as refused:
        parse(json.dumps(change(plain)))
    assert "\n" not in str(refused.value)


def test_a_change_is_made_to_what_is_in_the_file(tmp_path):
    file = tmp_path / "a.json"
    event = new_event(Format.ROUND_ROBIN, 4)
    save(file, event)
    one, two, *_ = event.open
    first = update(file, lambda saved: saved.record(best_seed_wins(one)), event)
    second = update(file, lambda saved: saved.record(best_seed_wins(two)), event)  # another process has read less
    assert (len(first.outcomes), len(second.outcomes)) == (1, 2)
    with pytest.raises(ValueError, match=r"^match 1 has been played$"):
        update(file, lambda saved: saved.record(best_seed_wins(one)))
    with pytest.raises(ValueError, match="no such event"):
        update(tmp_path / "b.json", lambda saved: saved)


def test_what_is_known_takes_the_place_of_a_file_that_is_gone_or_damaged(tmp_path):
    file = tmp_path / "a.json"
    event = new_event(Format.ROUND_ROBIN, 4)
    known = event.record(best_seed_wins(event.open[0]))
    save(file, event)
    later = update(file, lambda saved: saved.record(best_seed_wins(saved.open[0])), known)
    assert [len(one.outcomes) for one in (later, load(file)[0]) if one] == [2, 2]
    for content in ("{", None):
        delete(file)
        if content:
            file.write_text(content)
        assert update(file, lambda saved: saved.postpone(6), later) == load(file)[0] == later.postpone(6)
    save(file, new_event(Format.SWISS, 4))
    with pytest.raises(ValueError, match="another event"):
        update(file, lambda saved: saved, later)


def test_a_deleted_event_leaves_no_backup_and_a_new_title_keeps_the_results(tmp_path):
    file = tmp_path / "a.json"
    event = new_event(Format.SWISS, 4)
    save(file, event)
    other = update(file, lambda saved: saved.renamed("Another"), event)
    assert (other.spec.title, other.journal) == ("Another", event.journal)
    assert update(file, lambda saved: saved.record(best_seed_wins(saved.open[0])), event).spec.title == "Another"
    with pytest.raises(ValueError, match="1 to 60"):
        update(file, lambda saved: saved.renamed(""))
    delete(file)
    assert [*tmp_path.iterdir()] == []


def test_a_new_event_never_has_the_name_of_another(tmp_path):
    assert path_of("Open Day!", tmp_path).name == "open-day.json"
    save(path_of("Open Day!", tmp_path), new_event(Format.SWISS, 4))
    assert path_of("Open day", tmp_path).name == "open-day-2.json"
    assert path_of("日本", tmp_path).name == "event.json"


def test_a_folder_lists_unreadable_files_too(tmp_path):
    (tmp_path / "b.json").write_text("{")
    save(tmp_path / "a.json", new_event(Format.SWISS, 4))
    assert {listed.path.name: listed.event is not None for listed in saved_events(tmp_path)} == {
        "a.json": True, "b.json": False
    }  # fmt: skip
    assert (tmp_path / "b.json").read_text() == "{"


def test_of_many_events_only_those_that_were_changed_last_are_read(tmp_path):
    for number in range(5):
        save(tmp_path / f"{number}.json", new_event(Format.SWISS, 4))
        os.utime(tmp_path / f"{number}.json", (number, number))
    assert [listed.path.stem for listed in saved_events(tmp_path, 3)] == ["4", "3", "2"]
