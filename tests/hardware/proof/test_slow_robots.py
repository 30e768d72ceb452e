"""Slow and late robots, as Thymios: ten matches of random button mashing without a robot in a wall or a false alarm."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.registry import games
from pigaming_app.hardware.emulator.radio import RadioChannel
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.trials import FigureEight, follow
from pigaming_app.jobs.bench.robots import TARGETS, MatMatch, on_mat
from tests.cases import repeated

MATCHES, MINUTES = 10, 0.5


@pytest.mark.long
@pytest.mark.parametrize("number", repeated(range(MATCHES)))
def test_slow_and_late_robots_stay_out_of_walls_and_raise_no_alarm(number: int) -> None:
    game = sorted(games())[number % len(games())]
    arena = sorted(arenas(game))[number // len(games()) % len(arenas(game))]
    run = on_mat(MatMatch(game, arena, 30.0, 100 + number, MINUTES, carried=True, driver="thymio"))
    assert run.deepest_mm <= TARGETS["wall_entry_mm"]
    assert run.alarms == 0


@pytest.mark.again
@pytest.mark.long
def test_robots_that_are_later_than_declared_are_measured_within_seconds() -> None:
    """Dead time 200 ms, of which their driver declares 30."""
    bed = testbed.Testbed(5, 30.0, channel=RadioChannel(soonest=0.17, latest=0.178))
    trail = FigureEight(bed)
    follow(trail, 4.0)
    run = follow(trail, 4.0)
    assert run.rmse_mm < TARGETS["pose_rmse_mm"]
    assert run.rmse_deg < TARGETS["pose_rmse_deg"]
