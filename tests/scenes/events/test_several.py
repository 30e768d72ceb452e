"""Several arcades play one event: each its own matches, all of them one table; breaks; scores as they happen."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from pigaming_app.events import event_files
from pigaming_app.events.changes.live import LiveMatch, LiveMatches
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Paused, Recorded, Reseated, Resumed, Summoned
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.board.event_page import event_now
from pigaming_app.scenes.events.feature import LiveScores
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, LOOK, NextMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.scene import Pop
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.ui.input.events import Button, InputEvent
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import an_event, played, result_of, running, saved

ROOT = Path(__file__).resolve().parents[3]
LONG = 180.0  # s


def two_arcades(arcade: Arcade, **more) -> tuple[NextMatch, NextMatch]:
    """The pages of two arcades on one file."""
    run = running(an_event(**more))
    pages = []
    for name in ("left", "right"):
        page = NextMatch(arcade.context, RunningEvent(run.path, run.event, arcade=name))
        page.on_enter()
        pages.append(page)
    return pages[0], pages[1]


def test_each_arcade_has_a_match_of_its_own(arcade: Arcade) -> None:
    left, right = two_arcades(arcade, form=Format.ROUND_ROBIN, count=5)
    assert left.fixture
    assert right.fixture
    assert not {*left.fixture.entrants} & {*right.fixture.entrants}
    assert saved(left.running).calls == {left.fixture.number: "left", right.fixture.number: "right"}


def test_one_that_comes_back_goes_on_with_its_match_and_one_that_leaves_gives_it_to_others(arcade: Arcade) -> None:
    left, right = two_arcades(arcade)
    again = NextMatch(arcade.context, RunningEvent(left.running.path, saved(left.running), arcade="left"))
    again.on_enter()
    assert again.fixture == left.fixture
    again.update(INPUT_LOCKOUT + 0.1)
    assert again.handle(InputEvent(Button.BACK, KEYS[0])) == Pop()
    assert [*saved(left.running).calls.values()] == ["right"]
    assert right.fixture


def test_without_a_free_match_an_arcade_waits_and_goes_on_by_itself(arcade: Arcade) -> None:
    left, right = two_arcades(arcade, count=3)
    assert left.fixture
    assert right.fixture is None
    page = arcade.open(right)
    arcade.wait(INPUT_LOCKOUT + 0.1, draw=True)
    for button in (Button.FIRE, Button.X, Button.Y, Button.START, Button.DOWN):
        arcade.press(button)
        assert arcade.shown(NextMatch) is page
    fixture = left.fixture
    left.running.change(lambda event: event.record(result_of(fixture)))
    arcade.wait(LOOK + 0.2, draw=True)
    assert page.fixture
    assert page.fixture.number != fixture.number


def test_a_break_holds_every_match_until_it_ends(arcade: Arcade) -> None:
    run = running(an_event())
    page = arcade.open(NextMatch(arcade.context, run))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    event_files.update(run.path, lambda event: event.after(Paused("until 11:30")))
    arcade.wait(LOOK + 0.2, draw=True)
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device=device)
    arcade.wait(ALL_READY + 1.0, draw=True)
    arcade.press(Button.START)
    assert arcade.shown(NextMatch) is page
    event_files.update(run.path, lambda event: event.after(Resumed()))
    arcade.wait(LOOK + ALL_READY + 0.5)
    assert arcade.shown(MatchScene)


def test_a_break_holds_matches_of_ais_too(arcade: Arcade) -> None:
    run = running(an_event(brains="level1").after(Paused()))
    page = arcade.open(NextMatch(arcade.context, run, show=True))
    arcade.wait(12.0)
    arcade.press(Button.Y)
    arcade.wait(0.5)
    assert page.quick is None
    assert arcade.shown(NextMatch) is page


def test_a_change_at_the_desk_is_on_the_page_and_in_the_table_within_two_seconds(arcade: Arcade) -> None:
    run = running(an_event())
    page = arcade.open(NextMatch(arcade.context, run))
    assert page.fixture
    turned = tuple(reversed(page.fixture.entrants))
    event_files.update(run.path, lambda event: event.after(Reseated(1, turned)))
    arcade.wait(LOOK + 0.2)
    assert page.fixture.entrants == turned
    table = arcade.open(TablePage(arcade.context, run))
    before = table.overview.rows
    event_files.update(run.path, lambda event: played(event, 2))
    arcade.wait(LOOK + 0.2)
    assert table.overview.rows != before
    assert [row.name for row in table.overview.rows] == [row.entrant for row in saved(run).standings]


def test_a_match_that_is_called_elsewhere_is_not_the_next_one_here(arcade: Arcade) -> None:
    run = running(an_event())
    run.change(lambda event: event.after(Summoned(1, "Mat 2")))
    assert [one.number for one in run.queue] == [2]
    now = event_now(arcade.context, [NextMatch(arcade.context, run)])
    assert now
    assert [one.number for one in now.coming] == [2]


def test_the_score_of_the_running_match_is_beside_the_file(arcade: Arcade) -> None:
    run = running(an_event())
    run.arcade = "left"
    service = LiveScores(arcade.context)
    page = arcade.open(NextMatch(arcade.context, run))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    service.update(1.0, arcade.stack)
    reader = LiveMatches(run.path)
    assert [(one.arcade, one.match) for one in reader.now()] == [("left", 0)]
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device=device)
    fixture = page.fixture
    arcade.wait(ALL_READY + 0.2)
    scene = arcade.shown(MatchScene)
    service.update(1.0, arcade.stack)
    (live,) = reader.now()
    assert fixture
    assert live == LiveMatch("left", fixture.number, dict.fromkeys(fixture.entrants, "0"), live.clock, 2)
    assert scene.match
    assert ":" in live.clock
    service.close()
    assert reader.now() == ()
    assert [one.path for one in event_files.saved_events(run.path.parent)] == [run.path], "no event of its own"


@contextmanager
def playing(path: Path, name: str) -> Iterator["subprocess.Popen[bytes]"]:
    """An arcade in a process of its own, which plays the matches of AIs by itself."""
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "event", "run", str(path), "--arcade", name]
    home = {"PIGAMING_HOME": str(path.parent / name)}
    with subprocess.Popen(command, env={**os.environ, **home}, stderr=subprocess.DEVNULL) as process:
        try:
            yield process
        finally:
            process.kill()


@pytest.mark.long
@pytest.mark.again  # with screens; without them it is in tests/jobs/events/test_desk.py
@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
def test_two_arcades_of_which_one_is_killed_play_every_match_once(tmp_path: Path) -> None:
    entrants = tuple(Entrant(name, "random") for name in "ABCD")
    path = tmp_path / "cup.json"
    event_files.save(
        path, Event(EventSpec("Cup", Format.ROUND_ROBIN, ("pitanks",), entrants, minutes={"pitanks": 0.05}))
    )

    def until(reached) -> Event:
        end = time.monotonic() + LONG
        while True:
            event, problems = event_files.load(path)
            assert event
            assert not problems
            if reached(event):
                return event
            assert time.monotonic() < end, event.journal
            time.sleep(0.1)

    with playing(path, "right"):
        with playing(path, "left") as left:
            until(lambda event: {*event.calls.values()} == {"left", "right"})
            left.send_signal(signal.SIGKILL)
            left.wait()
        held = until(lambda event: True).calls
        with playing(path, "left"):
            event = until(lambda event: event.over)
    results = [entry.outcome.fixture for entry in event.journal if isinstance(entry, Recorded)]
    assert sorted(results) == [1, 2, 3, 4, 5, 6]
    assert "left" in held.values()
    by = [entry.arcade for entry in event.journal if isinstance(entry, Summoned)]
    assert {*by} == {"left", "right"}
