"""Things on the mat as walls and mud of the simulator."""

from math import cos, hypot, pi, sin
from random import Random

import pytest

from pigaming_app.sim.arena import Arena, StartPose, build, replace_things
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import Route, update_route
from pigaming_app.sim.grid import BLOCKED
from pigaming_app.sim.record import copy, digest
from pigaming_app.sim.things.convex import contains, distance, inradius, inset, is_convex, sides, signed_area
from pigaming_app.sim.things.cover import CUT, around, capsules, excess, from_capsule
from pigaming_app.sim.things.mud import in_mud
from pigaming_app.sim.things.spec import ThingSpec, Use, mud_capsules, read_things, wall_capsules, written
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import CELL, COLUMNS, NODES, World
from tests.floor import box


def disc(x, y, r, corners=16):
    return tuple((x + r * cos(2 * pi * k / corners), y + r * sin(2 * pi * k / corners)) for k in range(corners))


def random_outline(seed):
    """A convex outline with random corners on an ellipse."""
    random = Random(seed)
    angles = sorted(random.uniform(0, 2 * pi) for _ in range(random.randint(5, 30)))
    a, b, turn = random.uniform(20, 150), random.uniform(20, 150), random.uniform(0, pi)
    points = [(a * cos(t), b * sin(t)) for t in angles]
    c, s = cos(turn), sin(turn)
    return tuple((800 + c * x - s * y, 450 + s * x + c * y) for x, y in points)


BOXES = ((90, 60, 0.3), (45, 45, 0.7), (20, 200, 0.5), (160, 220, 1.0), (400, 300, 0.2))
SHAPES = [
    *(box(800, 450, *size) for size in BOXES),
    *(disc(800, 450, radius) for radius in (35, 120)),
    *(random_outline(seed) for seed in range(60)),
]


def world_with(*things, walls=()):
    world = World()
    build(world, Arena("", {}, walls, (StartPose(100, 100, 0),) * 4, "", things=things))
    return world


@pytest.mark.parametrize("outline", SHAPES)
def test_capsules_cover_the_outline_and_hardly_more(outline):
    margin = 4.0
    parts = capsules(outline, margin)
    for (ax, ay), (bx, by) in sides(outline):
        for k in range(10):
            x, y = ax + (bx - ax) * k / 10, ay + (by - ay) * k / 10
            assert min(from_capsule(one, x, y) for one in parts) < CUT - margin + 0.5
    assert max(excess(one, outline) for one in parts) < margin + 6.0


@pytest.mark.parametrize("outline", SHAPES)
def test_no_node_inside_a_thing_is_free(outline):
    world = world_with(ThingSpec(Use.WALL, outline, 0.0))
    for node in range(NODES):
        if contains(outline, node % COLUMNS * CELL, node // COLUMNS * CELL):
            assert world.grid[node] & BLOCKED


def test_a_cup_is_one_capsule_and_a_box_four():
    assert len(capsules(disc(800, 450, 35), 4.0)) == 1
    assert len(capsules(box(800, 450, 90, 60), 4.0)) == 4


def test_the_narrowest_capsule_contains_every_corner():
    for outline in SHAPES:
        one = around(outline, 0.0)
        assert max(from_capsule(one, x, y) for x, y in outline) < 1e-6


def test_an_outline_moved_inwards_is_as_far_from_every_side():
    outline = box(800, 450, 100, 60, 0.4)
    smaller = inset(outline, 10.0)
    assert abs(signed_area(smaller)) == pytest.approx(80 * 40)
    assert inradius(outline) == pytest.approx(30.0, abs=1e-3)
    assert inset(outline, 31.0) == []
    assert distance(outline, 800, 450) == 0.0
    assert distance(box(800, 450, 100, 60), 800, 500) == pytest.approx(20.0)


def test_things_are_read_as_they_were_written():
    things = (ThingSpec(Use.WALL, box(300, 300, 90, 60), 4.0), ThingSpec(Use.MUD, box(600, 300, 90, 20), 0.0))
    assert read_things(TomlTable.parse(written(things))) == things


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('[[thing]]\nuse = "lava"\noutline = [[0,0],[50,0],[50,50]]', "use"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[50,0]]', "outline: 3 to 48"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[0,50],[50,50],[50,0]]', "clockwise"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[50,0],[10,10],[0,50]]', "convex"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[50,0],[50,1e9]]', "outline[3]"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[50,0],[50,50]]\nmargin = nan', "margin"),
        ('[[thing]]\nuse = "wall"\noutline = [[0,0],[50,0],[50,50]]\nheight = 3', "height"),
        ("\n".join(['[[thing]]\nuse = "line"\noutline = [[0,0],[50,0],[50,50]]'] * 25), "at most 24"),
    ],
)
def test_a_damaged_thing_is_named(text, reason):
    with pytest.raises(FieldError) as error:
        read_things(TomlTable.parse(text))
    assert reason in str(error.value)


def test_with_little_room_the_smallest_things_get_a_single_capsule():
    things = [ThingSpec(Use.WALL, box(200 + 150 * k, 300, 60 + 5 * k, 60), 0.0) for k in range(8)]
    assert len(wall_capsules(things, 63)) == 32
    few = wall_capsules(things, 20)
    assert len(few) == 20
    for thing in things:
        assert min(from_capsule(one, *thing.middle) for one in few) < 20.0
    with pytest.raises(FieldError, match="room for 7"):
        wall_capsules(things, 7)
    with pytest.raises(FieldError, match="mud"):
        mud_capsules([ThingSpec(Use.MUD, box(300, 300, 90, 60))] * 5, 16)


def test_tape_is_mud_and_no_wall_and_a_line_is_neither():
    tape, line = ThingSpec(Use.MUD, box(800, 450, 200, 30)), ThingSpec(Use.LINE, box(800, 600, 200, 30))
    world = world_with(tape, line)
    assert world.wall_count == 0
    assert in_mud(world, 880, 455)
    assert not in_mud(world, 880, 480)
    assert not in_mud(world, 800, 600)


def test_things_that_move_leave_nothing_behind_and_routes_are_planned_anew():
    first = ThingSpec(Use.WALL, box(800, 450, 60, 500), 0.0)
    world = world_with(first)
    empty = digest(world_with())
    route = Route()
    route.active, route.goal_x, route.goal_y = 1, 1200.0, 450.0
    update_route(world, route, 400.0, 450.0)
    assert not route.straight
    moved = copy(world)
    replace_things(moved, (ThingSpec(Use.WALL, box(800, 850, 60, 60), 0.0),), 0)
    update_route(moved, route, 400.0, 450.0)
    assert route.straight
    replace_things(moved, (first,), 0)
    update_route(moved, route, 400.0, 450.0)
    assert not route.straight
    assert route.walls >> 6 == 2
    replace_things(moved, (), 0)
    assert moved.wall_count == 0
    assert not any(part & BLOCKED and not rim for part, rim in zip(moved.grid, world_with().grid, strict=True))
    moved.shifts = 0
    moved.walls = World().walls
    assert digest(moved) == empty


def test_robots_stop_at_things():
    world = world_with(ThingSpec(Use.WALL, box(800, 450, 90, 60, 0.3), 4.0))
    assert in_wall(world, 800, 450)
    assert in_wall(world, 800, 450 + 30 + 36)
    assert not in_wall(world, 800, 450 + 60 + 36 + 4)


def test_convexity():
    assert is_convex(box(0, 0, 10, 10))
    assert not is_convex(tuple(reversed(box(0, 0, 10, 10))))
    assert not is_convex(((0, 0), (10, 0), (20, 0)))
    assert all(hypot(x - 800, y - 450) < 160 for outline in SHAPES[7:] for x, y in outline)
