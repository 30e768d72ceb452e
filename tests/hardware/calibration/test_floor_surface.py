"""Sizes of surfaces: scale, and the smallest for robots of a size."""

from itertools import permutations

import pytest

from pigaming_app.games.arenas import has_room, load, on_mat, shipped_arenas, widest
from pigaming_app.hardware.calibration.floor_surface import FloorSurface, narrow_arena
from pigaming_app.hardware.control.homing import BERTHS
from pigaming_app.hardware.control.path_planner import find_path, inflated_floor
from pigaming_app.hardware.control.rig import unmeasured
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.hardware.robot_kinds import DEFAULT
from pigaming_app.sim.arena import build
from pigaming_app.sim.drivetrain import twist
from pigaming_app.sim.world import World
from tests.hardware.sentences import sentence


def is_passable(arena, berth):
    """True if homing finds a way from each start of an arena to each."""
    world = World()
    build(world, arena)
    floor, starts = inflated_floor(world, berth), [(start.x, start.y) for start in arena.starts]
    return all(find_path(floor, *pair) for pair in permutations(starts, 2))


@pytest.mark.parametrize("game", ["pitanks", "factory", "football"])
def test_the_widest_robots_for_which_an_arena_is_offered_find_their_ways(game):
    for name in shipped_arenas(game):
        arena = load(game, name)
        radius = widest(game, arena.source, SPARE)
        assert is_passable(on_mat(game, arena, (), radius), BERTHS[-1]), name
        assert not has_room(game, arena.source, radius + 0.1, SPARE)


def test_the_picture_fills_a_surface_as_far_as_it_can():
    """By hand: 1.6 m of 1920 px, where 1 m would allow 0.926 mm a px."""
    surface = FloorSurface(1600.0, 1000.0)
    assert surface.mm == pytest.approx(1600 / 1920)
    assert surface.field == pytest.approx((4000 / 3, 750.0))
    assert surface.corner == pytest.approx((160.5 * 5 / 6, 50.0 + 140.5 * 5 / 6))


def test_an_arena_that_is_too_small_is_named_with_the_smallest():
    """By hand: a 3pi of 47.5 mm is 57 px at 1 px = 5/6 mm, and 1600 of these are 1333 mm."""
    assert FloorSurface.smallest(47.5, 57.0).field[0] == pytest.approx(4000 / 3)
    assert narrow_arena(2112.0, 60.0, 57.0) is None
    assert narrow_arena(1333.0, 47.5, 57.0) is None
    narrow = narrow_arena(1332.0, 47.5, 57.0)
    assert narrow is not None
    assert sentence(narrow) == "An arena of 1332 mm is too small for robots of 95 mm: make it at least 1333 mm wide."


def test_a_robot_is_as_fast_in_millimetres_on_every_surface():
    for mm in (0.75, 1.32, 2.0):
        linear, _ = twist(unmeasured(DEFAULT, mm, 0.03), 1.0, 1.0)
        _, angular = twist(unmeasured(DEFAULT, mm, 0.03), 0.5, -0.5)
        assert linear * mm == pytest.approx(twist(unmeasured(DEFAULT, 1.32, 0.03), 1.0, 1.0)[0] * 1.32)
        assert angular == pytest.approx(twist(unmeasured(DEFAULT, 1.32, 0.03), 0.5, -0.5)[1])
