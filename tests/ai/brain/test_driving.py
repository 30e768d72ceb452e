"""Driving styles: pointing where to go reaches the direction, without overshoot, on simulated and on real robots."""

import math
import random
from collections import deque
from types import SimpleNamespace

import pytest

from pigaming_app.ai.brain.driving import pointed
from pigaming_app.ai.brain.kind import HumanPlayer
from pigaming_app.ai.game_ai import POINT, TURN
from pigaming_app.ai.registry import AIS
from pigaming_app.games.registry import games
from pigaming_app.sim.action import STEPS, quantise
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.robot import GAIN, integrate
from pigaming_app.sim.world import HZ, RADIUS, Robot
from pigaming_app.ui.input.events import StickState
from tests.matches import match_of

SPEED, TURN_RATE = 260.0, 3.0
TURNS = [math.radians(degrees) for degrees in range(-170, 181, 25)]
MESSY = 0.5  # degrees, noise of a camera pose


class Drive:
    """A robot at the origin, heading along +x, whose player holds the stick at `angle` rad.

    `late`: age of the pose in ticks; `noise`: of its heading, degrees.
    """

    def __init__(self, angle: float, ticks: int, late: int = 0, noise: float = 0.0, reach: float = 1.0) -> None:
        self.angle, self.robot = angle, Robot()
        self.robot.gain = GAIN
        x, y = math.cos(angle), math.sin(angle)
        x, y = x / max(abs(x), abs(y)), y / max(abs(x), abs(y))  # as sticks are read: (1, 1) in the corner
        rng, seen = random.Random(1), deque([(0.0, 0.0)] * (late + 1), maxlen=late + 1)
        self.left: list[float] = []  # rad left to turn, after each tick
        self.way: list[tuple[float, float]] = []
        for _ in range(ticks):
            heading, angular = seen[0]
            heading += math.radians(rng.gauss(0.0, noise))
            linear, turn = pointed(reach * x, reach * y, heading, angular, TURN_RATE)
            self.robot.requested_linear = quantise(linear) * SPEED
            self.robot.requested_angular = quantise(turn) * TURN_RATE
            integrate(self.robot)
            seen.append((self.robot.heading, self.robot.angular))
            self.left.append(turn_to(angle - self.robot.heading))
            self.way.append((self.robot.x, self.robot.y))

    @property
    def ahead(self) -> list[float]:
        """px moved in the direction of the stick, after each tick."""
        return [x * math.cos(self.angle) + y * math.sin(self.angle) for x, y in self.way]

    @property
    def overshoot(self) -> float:
        """Degrees by which the robot turned too far."""
        side = math.copysign(1.0, self.left[5])
        return math.degrees(max(0.0, *(-side * left for left in self.left if abs(left) < 2.0)))


@pytest.mark.parametrize("angle", TURNS)
def test_the_robot_turns_the_short_way_to_the_stick_and_stops_turning_there(angle: float) -> None:
    drive = Drive(angle, 3 * HZ)
    assert drive.overshoot < 0.1
    assert abs(drive.left[round(0.35 * HZ + HZ * abs(angle) / TURN_RATE)]) < math.radians(10.0)
    assert abs(drive.left[-1]) < math.radians(0.5)
    assert abs(drive.robot.angular) < 0.01
    assert drive.robot.linear == pytest.approx(SPEED, rel=0.01)


@pytest.mark.parametrize("angle", TURNS)
@pytest.mark.parametrize("late", [3, 5])
def test_a_pose_of_the_camera_100_ms_old_and_noisy_neither_swings_nor_misleads(angle: float, late: int) -> None:
    drive = Drive(angle, 3 * HZ, late, MESSY)
    assert drive.overshoot < 2.5
    assert max(abs(left) for left in drive.left[2 * HZ :]) < math.radians(2.5)


def test_a_stick_behind_the_robot_makes_it_back_up_at_once_and_turn_round_on_the_way() -> None:
    drive = Drive(math.radians(179.0), 2 * HZ)
    assert drive.way[8][0] < -10.0, "it backs up"
    assert min(after - before for before, after in zip(drive.ahead, drive.ahead[1:], strict=False)) > -1.0
    assert drive.ahead[HZ // 2] > 60.0
    assert abs(drive.way[-1][1]) < RADIUS, "it ends on the line on which it began"
    assert drive.robot.linear > 0.95 * SPEED


def test_a_stick_exactly_behind_a_noisy_robot_is_not_undecided() -> None:
    for noise in (0.0, MESSY, 2.0):
        drive = Drive(math.pi, 2 * HZ, 3, noise)
        assert abs(drive.left[round(1.5 * HZ)]) < math.radians(12.0)


def test_a_little_push_aims_and_a_full_one_drives() -> None:
    slow, fast = Drive(0.6, HZ, reach=0.125), Drive(0.6, HZ)
    assert abs(slow.left[-1]) < math.radians(2.0)
    assert slow.ahead[-1] < 0.15 * fast.ahead[-1]


def test_a_released_stick_stands_still() -> None:
    assert pointed(0.0, 0.0, 1.0, 2.0, TURN_RATE) == (0.0, 0.0)


def test_the_corner_of_a_stick_is_no_faster_than_its_edge() -> None:
    assert pointed(1.0, 1.0, math.pi / 4, 0.0, TURN_RATE) == pytest.approx((1.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("game", list(games()))
@pytest.mark.parametrize(("stick", "direction"), [((1.0, 0.0), (0, -1)), ((0.0, 1.0), (1, 0)), ((0.0, -1.0), (-1, 0))])
def test_in_every_game_the_stick_points_on_the_screen(
    game: str, stick: tuple[float, float], direction: tuple[int, int]
) -> None:
    match = match_of(game, "human idle idle idle")
    state, robot = match.state, match.state.robots[0]
    robot.heading = 0.3
    match.sit(0, HumanPlayer(lambda: StickState(*stick), AIS[game].driving[POINT]))
    for _ in range(75):
        match.tick()
        action = state.actions[0]
        assert action.linear * STEPS == round(action.linear * STEPS), "a replay stores 64ths"
        assert action.angular * STEPS == round(action.angular * STEPS)
    assert (round(math.cos(robot.heading)), round(math.sin(robot.heading))) == direction


def test_turn_and_drive_passes_the_stick_on() -> None:
    stick = StickState(0.5, -0.25)
    assert AIS["race"].driving[TURN](SimpleNamespace(), 0, stick) == (0.5, -0.25)
