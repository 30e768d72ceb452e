"""A match of an event with real robots on the emulated arena."""

from dataclasses import replace

import pytest

from pigaming_app.events.event import Event
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.events.next_page import INPUT_LOCKOUT, NextMatch
from pigaming_app.scenes.mat.before_match import UnavailablePage
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade
from tests.scenes.events.drawn import an_event, running, saved
from tests.scenes.mat.robots.test_real_match import started, until


@pytest.fixture
def page(arcade: Arcade) -> NextMatch:
    """The first match of an event of AIs, whose first two seats are real."""
    event = an_event(brains="level1")
    arcade.context.settings.real = [1, 2]
    page = NextMatch(
        arcade.context, running(Event(replace(event.spec, minutes={"pitanks": 0.05}, variants={"pitanks": "pickups"})))
    )
    arcade.open(page)
    arcade.wait(INPUT_LOCKOUT + 0.1)
    return page


@pytest.mark.long
def test_the_seats_chosen_for_real_robots_are_real_and_the_result_counts(arcade: Arcade, page: NextMatch) -> None:
    arcade.press(Button.FIRE)
    match = arcade.stack.top
    assert isinstance(match, RealMatch)
    assert match.real == {0, 1}
    started(arcade, match)
    until(arcade, NextMatch, 20.0)
    assert len(saved(page.running).outcomes) == 1


def test_without_robots_the_reason_is_shown_and_simulated_robots_play(
    arcade: Arcade, mat: EmulatedSession, page: NextMatch, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing() -> None:
        raise RobotsUnavailable(OperatorMessage("no_camera", number=3))

    monkeypatch.setattr(mat, "open", missing)
    arcade.press(Button.FIRE)
    arcade.shown(UnavailablePage)
    arcade.press(Button.FIRE)
    match = arcade.shown(MatchScene)
    match.stop()
    until(arcade, NextMatch)
    assert arcade.shown(NextMatch).message == arcade.context.words("events.unplayed")
    assert saved(page.running).outcomes == {}
