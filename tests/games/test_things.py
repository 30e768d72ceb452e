"""Things on the mat in the three games: nobody drives or shoots through them, and every AI goes round them."""

from math import dist, pi
from random import Random

import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas, load, parse
from pigaming_app.games.race.course import point_at
from pigaming_app.games.race.passages import passages
from pigaming_app.games.race.racing_line import fastest_line
from pigaming_app.games.race.start import reroute
from pigaming_app.games.registry import games
from pigaming_app.games.replay import decode, encode, to_match, verify
from pigaming_app.sim.action import set_action
from pigaming_app.sim.arena import ArenaError, replace_things
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.things.convex import contains, distance
from pigaming_app.sim.things.cover import from_capsule
from pigaming_app.sim.things.spec import ThingSpec, Use, wall_capsules, written
from pigaming_app.sim.world import RADIUS
from tests.cases import one_in, repeated
from tests.floor import box as outline_of
from tests.matches import finished, match_of, run


def box(x, y, w, h, angle=0.0, use=Use.WALL, margin=4.0):
    return ThingSpec(use, outline_of(x, y, w, h, angle), margin)


def arena_with(game, name, *things):
    return parse(game, load(game, name).source + written(things), f"{name}.toml")


def random_boxes(seed, count):
    random = Random(seed)
    return [
        box(
            random.uniform(100, 1500),
            random.uniform(100, 800),
            random.uniform(46, 130),
            random.uniform(46, 100),
            random.uniform(0, pi),
        )
        for _ in range(count)
    ]


def attempt(game, name, *things):
    """The arena with things, or the reason why it cannot be played."""
    try:
        return arena_with(game, name, *things), ""
    except ArenaError as error:
        return None, str(error)


def playable(game, name, seeds, count):
    """Arenas with random things that can be played."""
    for seed in seeds:
        arena, reason = attempt(game, name, *random_boxes(seed, count))
        assert arena or ("\n" not in reason and reason.startswith(f"{name}.toml: "))
        if arena:
            yield arena


@pytest.mark.parametrize("game", games())
def test_no_robot_is_ever_in_a_thing(game):
    arena = next(playable(game, arenas(game)[0], range(20), 4))
    match = match_of(game, ["random"] * 4, arena)
    for _ in range(600):
        match.tick()
        for robot in match.state.robots:
            assert not in_wall(match.state, robot.x, robot.y)
            for thing in arena.things:
                assert distance(thing.outline, robot.x, robot.y) > RADIUS - 2.0


def test_bullets_stop_at_things_and_things_stand():
    arena = arena_with("pitanks", "classic", box(330, 180, 60, 60))
    match = match_of("pitanks", ["idle"] * 4, arena)
    match.state.robots[0].x, match.state.robots[0].y, match.state.robots[0].heading = 200.0, 180.0, 0.0
    seen = 0
    for _ in range(100):
        set_action(match.state.actions[0], 0.0, 0.0, 1, 0)
        match.game.judge(match.state)
        for bullet in match.state.bullets:
            seen += bullet.alive
            assert not bullet.alive or bullet.x < 310.0
    assert seen > 0
    assert match.state.walls[match.state.wall_count - 1].health == -1


@pytest.mark.parametrize("game", games())
def test_tape_that_is_mud_slows_robots_down(game):
    speeds = []
    for use in (Use.MUD, Use.LINE):
        base = load(game, arenas(game)[0])
        start = base.starts[0]
        arena = arena_with(game, base.name, box(start.x, start.y, 50, 50, use=use))
        match = match_of(game, ["idle"] * 4, arena)
        robot = match.state.robots[0]
        robot.x, robot.y = start.x, start.y
        set_action(match.state.actions[0], 1.0, 0.0, 0, 0)
        match.game.judge(match.state)
        speeds.append(robot.requested_linear)
    assert 0.2 * speeds[1] < speeds[0] < 0.6 * speeds[1]


@pytest.mark.parametrize(
    ("game", "name", "i"),
    [(game, name, 0 if game == "race" else k % 4) for game in games() for k, name in enumerate(arenas(game))],
)
def test_starts_move_out_of_the_way_of_things(game, name, i):
    """A race has one start, that of the grid. On a floor slots may be in the way."""
    start = load(game, name).starts[i]
    arena, reason = attempt(game, name, box(start.x, start.y, 46, 46, 0.4))
    if not arena:
        assert game == "factory"
        assert "slot" in reason
        return
    moved = arena.starts[i]
    assert not contains(arena.things[0].outline, moved.x, moved.y)
    assert dist((moved.x, moved.y), (start.x, start.y)) > RADIUS
    match = match_of(game, ["idle"] * 4, arena)
    for robot in match.state.robots:
        assert not in_wall(match.state, robot.x, robot.y)


def test_a_race_is_driven_round_things_in_nearly_the_same_time():
    times = []
    for things in ((), (box(800, 130, 70, 60, 0.3), box(300, 170, 60, 60), box(1490, 450, 46, 80))):
        match = finished(match_of("race", ["hand3"] * 4, arena_with("race", "classic", *things), goal=2))
        assert [robot.score for robot in match.state.robots] == [2] * 4
        times.append(match.seconds)
    assert times[1] < 1.3 * times[0]


@pytest.mark.long
@pytest.mark.parametrize("turn", repeated(range(4)))
@pytest.mark.parametrize("name", repeated(arenas("race")))
def test_every_driver_finishes_among_random_things(name, turn):
    played, k = 0, arenas("race").index(name)
    brain = ("hand1", "hand3", "level2", "level5")[(k + turn) % 4]
    for arena in playable("race", name, range(3), 6):
        match = match_of("race", ["idle"] * 4, arena, 4.0, variant="party", goal=2)
        for seat in range(4):
            match.sit(seat, make_brain("race", brain, seat))
        finished(match)
        assert [racer.finished for racer in match.state.racers] == [1] * 4
        played += 1
    assert played


@pytest.mark.parametrize("name", one_in(4, arenas("race")))
def test_the_racing_line_keeps_clear_of_things(name):
    played = 0
    for arena in playable("race", name, range(2), 5):
        state, parts = match_of("race", ["idle"] * 4, arena).state, wall_capsules(arena.things, 63)
        for k in range(state.course.count):
            x, y = point_at(state.course, k * state.course.step, state.ideal[k])
            assert min(from_capsule(one, x, y) for one in parts) > RADIUS
        played += 1
    assert played


def test_a_closed_course_is_named_with_its_place():
    with pytest.raises(ArenaError, match=r"classic\.toml: thing: no robot can pass the things at \("):
        arena_with("race", "classic", box(800, 130, 40, 300))
    plan = load("race", "classic").plan
    free = passages(plan.course, (), fastest_line(plan.course, 250.0, 4.0)[0], plan.lines)
    assert all(low == -high for low, high in free)


def test_tape_across_the_course_moves_the_nearest_line():
    base = load("race", "classic").plan
    along = base.lines[0] + 120.0
    x, y = point_at(base.course, along, 0.0)
    ahead = point_at(base.course, along + 5.0, 0.0)
    across = box(x, y, 20, 150, angle=pi * 0 if abs(ahead[0] - x) > abs(ahead[1] - y) else pi / 2, use=Use.LINE)
    moved = arena_with("race", "classic", across).plan.lines
    assert abs(moved[0] - along) < 10.0
    assert moved[1:] == base.lines[1:]


def test_a_slot_that_a_thing_covers_is_named():
    slot = load("factory", "hall").plan.slots[0]
    with pytest.raises(ArenaError, match="covers the slot at"):
        arena_with("factory", "hall", box(slot.x, slot.y, 50, 50))


def test_a_worker_stands_on_the_other_side_of_a_machine_where_a_thing_covers_its_place():
    base = load("factory", "hall").plan.machines[0]
    moved = arena_with("factory", "hall", box(base.spot_x, base.spot_y, 46, 46)).plan.machines[0]
    assert moved.spot_x == pytest.approx(2 * base.x - base.spot_x)
    assert moved.spot_y == pytest.approx(2 * base.y - base.spot_y)


@pytest.mark.parametrize("game", games())
def test_a_match_with_things_is_replayed_bit_by_bit(game):
    arena = next(playable(game, arenas(game)[0], range(20), 3))
    match = run(match_of(game, ["level2"] * 4, arena), 300)
    replay = decode(encode(match), "match.replay")
    assert verify(replay)
    again = to_match(replay)
    assert again.arena.things == arena.things


def test_drivers_go_round_a_thing_that_was_put_on_their_line_during_the_race():
    base = load("race", "classic")
    match = run(match_of("race", ["hand3"] * 4, base, goal=3), 400)
    things = (box(800, 130, 70, 60, 0.3),)
    apply = reroute(base, match.state.rules, things)
    replace_things(match.state, things, len(base.walls))
    apply(match.state)
    while not match.over:
        match.tick()
        assert all(distance(things[0].outline, robot.x, robot.y) > RADIUS - 2.0 for robot in match.state.robots)
    assert [robot.score for robot in match.state.robots] == [3] * 4
    assert match.seconds < 45.0
