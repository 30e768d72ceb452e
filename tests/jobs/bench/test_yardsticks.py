"""The scenes that `bench` compares the simulator with obey the same physics, and go without where pymunk is missing."""

import sys

import numpy as np
import pytest

from pigaming_app.games.arenas import load
from pigaming_app.jobs.bench import bench, figures, yardsticks
from pigaming_app.jobs.bench.yardsticks import BULLETS, BulletBodies, BulletQueries, NumpyBatch
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.world import RADIUS

WALLS = load(yardsticks.GAME, yardsticks.ARENA).walls


def depth(wall, place, radius):
    """Overlap of a circle with a wall, px."""
    return wall.half + radius - np.hypot(*offset_from_wall(wall, *place))


@pytest.fixture(autouse=True)
def small_batch(monkeypatch):
    monkeypatch.setattr(yardsticks, "MATCHES", 32)


def test_robots_and_bullets_of_the_numpy_batch_move_and_stay_out_of_walls():
    scene = NumpyBatch()
    before = scene.x.copy()
    scene.play(150)
    assert np.abs(scene.x - before).mean() > 50.0
    for x, y in zip(scene.x[:20].ravel(), scene.y[:20].ravel(), strict=True):
        assert max(depth(wall, (x, y), RADIUS) for wall in WALLS) < 6.0, "no more than a step, between two walls"
        assert RADIUS <= x <= 1600.0 - RADIUS
    flown = np.hypot(scene.bullet_x - scene.x[:, scene.owner], scene.bullet_y - scene.y[:, scene.owner])
    assert flown.shape == (yardsticks.MATCHES, BULLETS)
    assert 100.0 < flown.mean() < 600.0


@pytest.mark.parametrize("scene", [BulletBodies, BulletQueries])
def test_the_pymunk_scene_has_about_ten_bullets_in_flight_and_robots_that_walls_stop(scene):
    pytest.importorskip("pymunk", reason="the extra `bench` is not installed")
    match, flying = scene(), []
    for _ in range(600):
        match.play(1)
        flying.append(len(match.bullets) if scene is BulletQueries else len(match.space.bodies) - 4)
        for body in match.robots:
            assert max(depth(wall, body.position, RADIUS) for wall in WALLS) < RADIUS
    assert 6.0 < np.mean(flying[100:]) < 14.0


def test_without_pymunk_its_figures_are_missing_and_one_line_says_how_to_get_them(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "pymunk", None)
    monkeypatch.setattr(yardsticks, "ROUNDS", 1)
    monkeypatch.setattr(figures, "can_compile", lambda: False)
    found = figures._comparison("pickups")
    assert (found.pop("numpy_batch_us_per_tick") or 0.0) > 0.0
    assert set(found.values()) == {None}
    monkeypatch.setattr(bench, "_game", lambda game, variant: {"comparison": found})
    from pigaming_app.jobs.cli import main

    assert main(["bench"]) == 0
    assert "pymunk is missing (extra `bench`): " in capsys.readouterr().out.splitlines()[-1]
