"""The awards between a match of an event, or of the Ladder, and the page that follows it."""

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.board.event_page import event_now
from pigaming_app.scenes.events.next_page import ALL_READY, INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.awards.moment import LENGTH, AwardsMoment
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.events.drawn import running

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")
NAMES = ("ANA", "BEA", "EVA")


def begun(arcade: Arcade, brain: str = "") -> None:
    """The first match of three entrants."""
    entrants = tuple(Entrant(name, brain) if brain else Entrant(name) for name in NAMES)
    run = running(Event(EventSpec("Cup", Format.ROUND_ROBIN, ("pitanks",), entrants)))
    arcade.open(NextMatch(arcade.context, run, show=bool(brain)))
    arcade.wait(INPUT_LOCKOUT + 0.1)
    for device in KEYS[:2]:
        arcade.press(Button.FIRE, device=device)
    arcade.wait(ALL_READY + 0.2)


def awards(arcade: Arcade) -> AwardsMoment:
    """That of a match with this result."""
    begun(arcade)
    arcade.finish(5, 1)
    return arcade.reach(AwardsMoment, 5.0)


def test_people_of_an_event_get_awards_by_their_names_and_then_the_next_match(arcade: Arcade) -> None:
    moment = awards(arcade)
    assert sorted(moment.page.awards) == [0, 1]
    assert set(moment.page.ended.names) < set(NAMES)
    assert moment.page.praises.keys() == {1}
    waited = arcade.until(lambda: isinstance(arcade.stack.top, NextMatch))
    assert waited == pytest.approx(LENGTH, abs=0.5)


def test_a_press_skips_them_once_they_are_all_there(arcade: Arcade) -> None:
    moment = awards(arcade)
    arcade.press(Button.FIRE, Button.BACK, Button.START)
    assert arcade.stack.top is moment
    arcade.wait(moment.page.ready_at + 0.1)
    arcade.press(Button.FIRE, device=KEYS[3])
    assert arcade.stack.top is moment, "a device without a seat"
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.shown(NextMatch)


def test_the_second_screen_follows_the_event_meanwhile(arcade: Arcade) -> None:
    begun(arcade)
    arcade.finish(5, 1)
    for scene in (WinnersMoment, AwardsMoment):
        arcade.reach(scene, 5.0)
        now = event_now(arcade.context, arcade.stack.scenes)
        assert now
        assert len(now.running.event.outcomes) == 1


def test_a_match_that_was_ended_by_hand_has_none(arcade: Arcade) -> None:
    begun(arcade)
    arcade.shown(MatchScene).stop()
    arcade.until(lambda: not isinstance(arcade.stack.top, MatchScene))
    arcade.shown(NextMatch)
