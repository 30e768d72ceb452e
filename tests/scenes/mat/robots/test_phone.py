"""A phone drives a robot on the emulated arena: silent, its robot stands still; back again, it drives on."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import dist

import pytest

from pigaming_app.ai.game_ai import TURN
from pigaming_app.hardware.emulator.firmware import DEADMAN
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.scenes.mat.robots.match_scene import RealMatch
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.phone_messages import BITS, Touches
from pigaming_app.ui.input.phone_pads import Phones
from tests.scenes.arcade import Arcade
from tests.scenes.mat.robots.test_real_match import FPS, opened

pytest.importorskip("cv2")
pytest.importorskip("aiohttp")
pytestmark = pytest.mark.long
CIRCLE = Touches(0.9, -0.5)  # of about 50 px, which fits between the walls and the robot's start
RELEASE = 0.6  # s of silence after which the stick counts as released: docs/phones.md
REACTION = 0.1  # s from a decision of the arcade until the motors are off: a tick, the radio, the firmware
COASTING = 0.4  # s until a robot without drive stands
STANDSTILL, DRIVING = 4.0, 50.0  # px/s


@dataclass
class Player:
    """A match of one emulated robot, driven by the phone with this number."""

    arcade: Arcade
    mat: EmulatedSession
    match: RealMatch
    phones: Phones
    number: int

    def play(self, seconds: float, touches: Touches | None) -> None:
        """Advance; the phone sends these touches in every frame, or nothing."""
        for _ in range(round(seconds * FPS)):
            if touches:
                self.phones.receive(self.number, touches)
            self.arcade.frame(1 / FPS)

    def speed(self, touches: Touches | None) -> float:
        """The robot's speed over the next 0.2 s, px/s."""
        before = self.mat.arena.poses()[0]
        self.play(0.2, touches)
        return dist(before[:2], self.mat.arena.poses()[0][:2]) / 0.2

    def tap(self, button: Button) -> None:
        self.play(0.1, Touches(buttons=BITS[button]))
        self.play(0.1, Touches())

    def circle(self) -> float:
        """Drive in a circle; returns the speed, px/s."""
        self.play(0.8, CIRCLE)
        return self.speed(CIRCLE)

    @property
    def driven_at(self) -> float:
        """The time at which the robot's motors last ran, s."""
        return self.mat.arena.last_driven[0]


@pytest.fixture
def player(arcade: Arcade, mat: EmulatedSession, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    """A robot that drives, by a phone that steers."""
    arcade.context.settings.pad_driving = TURN
    phones = arcade.context.controls.phones
    monkeypatch.setattr(phones, "clock", mat.arena.clock)
    number = phones.connect()
    arcade.frame()
    match = opened(arcade, "pitanks", "human off off off", 2.0, (0,), devices=[Device("phone", number)])
    player = Player(arcade, mat, match, phones, number)
    player.play(1.0, Touches())  # the camera finds the robot
    player.tap(Button.START)
    player.play(5.0, Touches())
    assert match.match.seconds > 0.0
    assert player.circle() > DRIVING
    yield player
    phones.disconnect(number)
    arcade.frame()


def test_a_stuck_page_releases_the_stick_and_its_robot_drives_again(player: Player) -> None:
    silent_since = player.mat.arena.clock()
    player.play(RELEASE - 0.1, None)
    assert player.speed(None) > STANDSTILL, "the last touches count until then"
    player.play(REACTION + COASTING, None)
    assert RELEASE - REACTION < player.driven_at - silent_since <= RELEASE + REACTION
    assert player.speed(None) < STANDSTILL
    assert player.arcade.shown(RealMatch) is player.match
    assert player.circle() > DRIVING


def test_without_wifi_the_robot_stops_before_the_server_gives_the_phone_up(player: Player) -> None:
    from pigaming_app.ui.input.phones.connection import SILENT_SECONDS

    silent_since = player.mat.arena.clock()
    player.play(SILENT_SECONDS, None)
    assert player.driven_at - silent_since <= RELEASE + REACTION
    player.phones.disconnect(player.number)  # as its connection does then
    player.play(0.1, None)
    player.arcade.shown(Reconnect)
    drives_after_its_return(player)


def test_the_robot_of_an_unplugged_phone_stops_at_once_and_the_match_waits(player: Player) -> None:
    unplugged_at, ticks = player.mat.arena.clock(), player.match.match.state.tick
    player.phones.disconnect(player.number)
    player.play(REACTION + COASTING, None)
    assert player.driven_at - unplugged_at <= REACTION
    assert player.speed(None) < STANDSTILL
    player.arcade.shown(Reconnect)
    assert player.match.match.state.tick == ticks
    drives_after_its_return(player)


def test_the_deadman_stops_the_robot_when_the_arcade_itself_hangs(player: Player) -> None:
    """The phone keeps sending; nobody reads it."""
    hung_at = player.mat.arena.clock()
    for _ in range(round((DEADMAN + REACTION + COASTING) * FPS)):
        player.phones.receive(player.number, CIRCLE)
        player.mat.arena.advance(1 / FPS)
    last_command = player.mat.arena.firmwares[0].last_packet
    assert 0.0 <= last_command - hung_at < 0.05, "one that was still on the radio"
    assert player.driven_at - last_command <= DEADMAN
    before = player.mat.arena.poses()[0]
    player.mat.arena.advance(0.2)
    assert dist(before[:2], player.mat.arena.poses()[0][:2]) / 0.2 < STANDSTILL


def drives_after_its_return(player: Player) -> None:
    """The phone comes back with its number and asks for its seat; the countdown is locked."""
    player.phones.connect(player.number)
    player.play(1.2, Touches())
    stopped_at = player.driven_at
    player.tap(Button.FIRE)
    assert player.arcade.shown(RealMatch) is player.match
    assert player.driven_at == stopped_at
    player.play(2.0, Touches())
    assert player.circle() > DRIVING
