"""Slow and late robots, as Thymios: ten matches of random button mashing without a robot in a wall or a false alarm."""

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.registry import games
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
