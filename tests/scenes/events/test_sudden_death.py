"""A tied knock-out match on the screen: the same people at once play an extra match, which the file keeps."""

from dataclasses import replace

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Format
from pigaming_app.scenes.events.manage.corrections import Correction, ResultsList
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.events.podium_page import EventPodiumPage
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.input.events import Button
from tests.events.examples import level
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import an_event, result_of, running, saved

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

SEED = 2


def begun(arcade: Arcade, run: RunningEvent) -> MatchScene:
    """The first match, with two people on the keyboard."""
    arcade.open(NextMatch(arcade.context, run))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device)
    arcade.wait(ALL_READY + 0.2)
    return arcade.shown(MatchScene)


def end_level(arcade: Arcade, scene: MatchScene) -> None:
    """End a match without any point; the winner's moment is skipped."""
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not scene.opening.countdown.locked)
    scene.match.state.rules.ticks = scene.match.state.tick + 1
    arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    arcade.wait(1.2)
    arcade.press(Button.FIRE)


def test_a_tie_leads_to_an_extra_match_of_the_same_people_that_the_next_point_ends(arcade: Arcade) -> None:
    run, words = running(an_event(Format.KNOCKOUT)), arcade.context.words
    scene = begun(arcade, run)
    names = run.event.fixtures[0].entrants
    end_level(arcade, scene)
    page = arcade.shown(NextMatch)
    assert (page.message, page.seats.claims) == (words("events.tied"), dict(enumerate(KEYS[:2])))
    assert (saved(run).outcomes, len(saved(run).played[1])) == ({}, 1)
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    extra = arcade.shown(MatchScene)
    assert (extra.setup.sudden_death, extra.names, extra.devices[:2]) == (True, names, KEYS[:2])
    extra.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not extra.opening.countdown.locked)
    arcade.wait(1.0)
    assert not extra.match.over
    extra.match.state.robots[1].score = 1
    arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    assert arcade.shown(WinnersMoment).name == words("results.name_wins", name=names[1])
    assert saved(run).outcomes[1].places == ((names[1],), (names[0],))
    arcade.wait(1.2)
    arcade.press(Button.FIRE)
    assert arcade.shown(NextMatch).fixture == run.event.fixtures[1]


def test_an_extra_match_that_is_left_or_killed_is_played_again(arcade: Arcade) -> None:
    run = running(an_event(Format.KNOCKOUT))
    end_level(arcade, begun(arcade, run))
    arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    again = NextMatch(arcade.context, RunningEvent(run.path, saved(run)))  # as after a kill: only the file is left
    assert (again.fixture, again.seats.claims) == (run.event.open[0], {})
    assert again.fixture
    assert again.fixture.extra == 1
    arcade.shown(MatchScene).stop()
    arcade.until(lambda: isinstance(arcade.stack.top, NextMatch))
    page = arcade.shown(NextMatch)
    assert (page.fixture, page.message) == (again.fixture, arcade.context.words("events.unplayed"))


def test_lots_are_announced_even_after_the_last_match(arcade: Arcade) -> None:
    """The final is level four times; the seed is one with which the unbeaten draws the better lot."""
    event = Event(replace(an_event(Format.KNOCKOUT, 3).spec, seed=SEED))
    while event.open[0].stage != "final":
        event = event.record(result_of(event.open[0]))
    unbeaten, number = event.standings[0].entrant, event.open[0].number
    for _ in range(3):
        event = event.record(level(event.open[0]))
    run, words = running(event), arcade.context.words
    end_level(arcade, begun(arcade, run))
    assert run.event.outcomes[number].places[0] == (unbeaten,)
    assert run.event.over
    assert arcade.shown(NextMatch).message == words("events.lots", name=unbeaten)
    arcade.until(lambda: isinstance(arcade.stack.top, EventPodiumPage), 5.0)


def test_a_tie_is_corrected_while_its_extra_match_is_open(arcade: Arcade) -> None:
    event = an_event(Format.KNOCKOUT)
    run = running(event.record(level(event.open[0])))
    arcade.open(ResultsList(arcade.context, run))
    arcade.press(Button.FIRE)
    page = arcade.shown(Correction)
    assert set(page.places.values()) == {1}
    arcade.press(Button.RIGHT)
    arcade.press(Button.START)
    arcade.shown(ResultsList)
    assert saved(run).outcomes[1].places == ((page.names[1],), (page.names[0],))
    assert saved(run).open[0].number == 2
