"""Slow and late robots: ten matches of random button mashing without a robot in a wall or a false alarm.

Where a robot really is, and so how deep it is in a wall, comes from the emulated arena.
"""

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.arenas import on_mat as arena_on_mat
from pigaming_app.games.registry import games
from pigaming_app.hardware.emulator.radio import RadioChannel
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.trials import FigureEight, MatchResult, follow
from pigaming_app.hardware.robot_kinds import robot_kind
from pigaming_app.jobs.bench.robots import TARGETS, MatMatch, on_mat
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.drivetrain import MM

MATCHES, MINUTES = 10, 0.5
LATE = 0.17, 0.27  # s beyond the 30 ms that an XBee's driver declares; with the latter, a test drive comes first


def places(radius: float) -> list[tuple[str, str]]:
    """The arenas of all games in which robots of a radius, px, can play."""
    found = []
    for game in sorted(games()):
        for name in sorted(arenas(game)):
            try:
                arena_on_mat(game, load(game, name), (), radius)
            except ArenaError:
                continue
            found.append((game, name))
    return found


def stays_out_of_walls(run: MatchResult) -> bool:
    assert run.seconds - run.paused >= 60.0 * MINUTES - 0.1, "a whole match"
    assert run.deepest_mm <= TARGETS["wall_entry_mm"]
    return run.alarms == 0


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("number", range(MATCHES))
def test_thymios_stay_out_of_walls_and_raise_no_alarm(number: int) -> None:
    """As wide, as slow and as late as they are, with their own program, on a dongle."""
    fitting = places(robot_kind("thymio").radius_mm / MM)
    assert len(fitting) >= 8
    game, arena = fitting[number * 7 % len(fitting)]
    assert stays_out_of_walls(on_mat(MatMatch(game, arena, 30.0, 100 + number, MINUTES, carried=True, driver="thymio")))


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("late", LATE)
@pytest.mark.parametrize("number", range(MATCHES))
def test_robots_much_later_than_declared_do_as_well_measured_or_held_slower(number: int, late: float) -> None:
    every = places(0.0)
    game, arena = every[number * 7 % len(every)]
    match = MatMatch(game, arena, 30.0, 100 + number, MINUTES, late=late, tried=late > 0.25)
    assert stays_out_of_walls(on_mat(match))


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
