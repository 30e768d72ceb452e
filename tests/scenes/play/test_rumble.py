"""Rumbling pads in a match, felt on virtual pads with motors."""

import pytest

from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.views.factory import view as factory
from pigaming_app.scenes.views.pitanks import view as pitanks
from pigaming_app.scenes.views.race import view as race
from pigaming_app.scenes.views.rumble import BEST, DELIVERED, FINISH, LAP, TAKEN, rumbles
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.ui.input.virtual_pad import VirtualPad

QUIET = (0, 0)
Played = tuple[MatchScene, VirtualPad, VirtualPad]


@pytest.fixture
def played(arcade: Arcade) -> Played:
    """A running match of two pads and one keyboard."""
    (one, first), (two, second) = arcade.plug(), arcade.plug(plain=True)
    match = MatchScene(arcade.context, setup("human human human off", 1.0), [first, second, KEYS[0]])
    match.opening.countdown.seconds_left = 0.05
    arcade.open(match)
    arcade.until(lambda: not match.opening.countdown.locked)
    return match, one, two


def hit(arcade: Arcade, match: MatchScene, scorer: int, victim: int) -> None:
    """One robot hits another within the next tick."""
    match.match.state.tanks[scorer].hits += 1
    match.match.state.tanks[victim].taken += 1
    arcade.frame()


def test_both_feel_a_hit_and_who_takes_it_feels_it_more(arcade: Arcade, played: Played) -> None:
    match, one, two = played
    hit(arcade, match, 0, 1)
    assert sum(two.rumbles[0]) > sum(one.rumbles[0]) > 0
    arcade.frame()
    assert len(one.rumbles) == 1
    hit(arcade, match, 2, 0)
    assert one.rumbles[-1] == two.rumbles[0], "and the player with keys notices nothing"


def test_a_pause_and_a_pulled_pad_stop_the_motors(arcade: Arcade, played: Played) -> None:
    match, one, two = played
    hit(arcade, match, 2, 0)
    arcade.press(Button.START, device=KEYS[0])
    arcade.shown(Pause)
    assert one.rumbles[-1] == QUIET
    arcade.press(Button.BACK, device=KEYS[0])
    arcade.wait(2.0)
    hit(arcade, match, 2, 0)
    assert one.rumbles[-1] != QUIET
    two.unplug()
    arcade.wait(0.1)
    arcade.shown(Reconnect)
    assert one.rumbles[-1] == QUIET
    match.drivers.rumble(1, TAKEN)


def test_the_motors_stand_still_after_the_match(arcade: Arcade, played: Played) -> None:
    match, one, _ = played
    hit(arcade, match, 1, 0)
    match.stop()
    arcade.until(lambda: arcade.stack.top is not match)
    assert one.rumbles[-1] == QUIET


def test_nothing_rumbles_if_the_option_is_off(arcade: Arcade, played: Played) -> None:
    match, one, two = played
    arcade.context.settings.rumble = False
    hit(arcade, match, 0, 1)
    assert [*one.rumbles, *two.rumbles] == []


def test_the_strongest_of_several_events_is_felt() -> None:
    events = [("line", 1), ("lap", 1), ("best", 1), ("finish", 1), ("lap", 0), ("best", 2)]
    assert rumbles(race.RUMBLES, events) == {0: LAP, 1: FINISH, 2: BEST}
    assert rumbles(factory.RUMBLES, [("delivered", 3), ("delivered", None), ("thaw", 2)]) == {3: DELIVERED}


def test_no_rumble_outlasts_the_picture_after_the_match() -> None:
    for table in (pitanks.RUMBLES, factory.RUMBLES, race.RUMBLES):
        for rumble in table.values():
            assert 0.0 < rumble.seconds <= 0.5
            assert 0.0 < max(rumble.strong, rumble.weak) <= 1.0
