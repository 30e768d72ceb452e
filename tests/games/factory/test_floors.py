"""Floors: invalid files are refused with key and reason; properties of the valid ones."""

from math import hypot

import pytest

from pigaming_app import ASSETS
from pigaming_app.games.arenas import arenas, load, parse
from pigaming_app.games.factory.layout import BODY, SHELF
from pigaming_app.games.factory.pedestrians import send, walk
from pigaming_app.games.factory.state import ENTRY, EXIT, FORK, INPUT, OUTPUT, REACH, SLOTS, WORKERS, Factory, Worker
from pigaming_app.sim.arena import ArenaError, build
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.world import HEIGHT, HZ, WIDTH, World

FLOORS = arenas("factory")
MACHINE = '[[machine]]\nkind = "A"\nat = [520, 216]\nflow = "down"\nworker = "right"\n'
SHELVES = '[[warehouse]]\nteam = "ice"\nkind = "entry"\nat = [66, 96]\n'
AISLE = "[aisle]\nat = [650, 50]\nsize = [300, 800]\n"
WORKER = "[[worker]]\nat = [720, 450]\n"


def broken(old, new):
    """A valid file with the first occurrence of `old` replaced."""
    source = (ASSETS / "arenas" / "factory" / "hall.toml").read_text(encoding="utf-8")
    assert old in source
    return source.replace(old, new, 1)


@pytest.mark.parametrize(
    ("old", "new", "key", "reason"),
    [
        ("[aisle]", "[[tree]]\nfrom = [9, 9]\n[aisle]", "tree", "unknown key; possible are title, start, aisle"),
        (AISLE, "", "aisle", "a table is missing"),
        ("size = [300, 800]", "size = [300, 900]", "aisle.size", "ends outside the arena"),
        ("size = [300, 800]", "size = [300]", "aisle.size", "a list of 2 numbers"),
        ("size = [300, 800]", "size = [30, 800]", "aisle.size[1]", "30, but 50 to 1600"),
        ("size = [300, 800]", "size = [300, 800]\ncolour = 1", "aisle.colour", "unknown key"),
        (SHELVES, "", "warehouse", "each team needs an entry and an exit"),
        ('team = "ice"', 'team = "water"', "warehouse[1].team", "'water'; possible are ice, fire"),
        ('kind = "entry"', 'kind = "door"', "warehouse[1].kind", "'door'; possible are entry, exit"),
        ('kind = "exit"', 'kind = "entry"', "warehouse[2].kind", "this team has one already"),
        ("at = [66, 96]", "at = [66, 700]", "warehouse[1].at", "its last slot would lie outside the arena"),
        ("at = [66, 96]", "at = [1700, 96]", "warehouse[1].at", "(1700, 96) lies outside the arena"),
        ("at = [66, 96]", "at = [66, 96]\nslots = 3", "warehouse[1].slots", "unknown key; possible are team, kind, at"),
        ("at = [66, 96]", "at = [66, 300]", "warehouse[2]", "its slot at (66, 540) lies over another"),
        ("at = [66, 96]", "at = [520, 96]", "warehouse[1]", "its slot at (520, 184) lies in machine[1]"),
        (MACHINE, "", "machine", "two machines of kind A and two of kind B are needed"),
        ('kind = "A"', 'kind = "B"', "machine", "two machines of kind A and two of kind B are needed"),
        ('kind = "A"', 'kind = "C"', "machine[1].kind", "'C'; possible are A, B"),
        ("at = [520, 216]", "at = [520, 40]", "machine[1].at", "its body would stand outside the arena"),
        ("at = [520, 216]", 'at = "here"', "machine[1].at", "a point [x, y] is needed"),
        ("at = [520, 216]", "at = [520, 110]", "machine[1]", "no robot can reach its slot at (520, -16)"),
        ("at = [520, 216]", "at = [520, 420]", "machine[3]", "its slot at (520, 558) lies over another"),
        ('flow = "down"', 'flow = "sideways"', "machine[1].flow", "possible are right, left, down, up"),
        ('worker = "right"', 'worker = "down"', "machine[1].worker", "must be a side across the flow"),
        (WORKER, "", "worker", "2 workers, but there must be 3"),
        (WORKER, 2 * WORKER, "worker", "4 workers, but there must be 3"),
        (WORKER, WORKER + 'name = "Ada"\n', "worker[1].name", "unknown key; possible are at"),
        (WORKER, WORKER.replace("720", "-5"), "worker[1].at", "(-5, 450) lies outside the arena"),
        (WORKER, WORKER.replace("720, 450", "520, 216"), "worker[1].at", "no person can get to (520, 216)"),
        (WORKER, WORKER.replace("720, 450", "720, 10"), "worker[1].at", "no person can get to (720, 10)"),
        ("at = [1080, 216]", "at = [700, 216]", "machine[1].worker", "no person can get to"),
        ("at = [230, 228]", "at = [520, 216]", "start[1]", "would stand inside a wall"),
    ],
)
def test_a_broken_file_is_refused_in_one_line(old, new, key, reason):
    with pytest.raises(ArenaError) as caught:
        parse("factory", broken(old, new), "broken.toml")
    line = str(caught.value)
    assert line.startswith(f"broken.toml: {key}: ")
    assert reason in line
    assert "\n" not in line


def test_a_machine_can_be_worked_at_from_either_side():
    right = load("factory", "hall").plan.machines[0]
    left = parse("factory", broken('worker = "right"', 'worker = "left"'), "left.toml").plan.machines[0]
    assert (right.spot_x + left.spot_x, right.spot_y) == (2 * right.x, left.spot_y)


def test_there_are_three_floors():
    assert FLOORS == ["hall", "lines", "yard"]


@pytest.mark.parametrize("floor", FLOORS)
def test_slots_lie_in_rows_and_on_both_sides_of_machines(floor):
    plan = load("factory", floor).plan
    assert len(plan.slots) == SLOTS
    for first in range(0, 16, 4):
        row = plan.slots[first : first + 4]
        assert [slot.y - row[0].y for slot in row] == [0, SHELF, 2 * SHELF, 3 * SHELF]
        assert {(slot.kind, slot.team, slot.x) for slot in row} == {
            ((ENTRY, EXIT)[first // 4 % 2], first // 8, row[0].x)
        }
    for m, machine in enumerate(plan.machines):
        into, out = plan.slots[16 + 2 * m : 18 + 2 * m]
        assert (into.kind, out.kind, into.machine, out.machine) == (INPUT, OUTPUT, m, m)
        assert ((into.x + out.x) / 2, (into.y + out.y) / 2) == (machine.x, machine.y)


@pytest.mark.parametrize("floor", FLOORS)
def test_robots_go_round_machines_but_reach_every_slot_from_one_side_at_least(floor):
    arena = load("factory", floor)
    world = World()
    build(world, arena)
    for machine in arena.plan.machines:
        for dx, dy in ((0, 0), (BODY, 0), (0, -BODY), (BODY - 12, BODY - 12)):
            assert in_wall(world, machine.x + dx, machine.y + dy)
    for slot in arena.plan.slots:
        beside = [(slot.x + dx, slot.y + dy) for dx in (-FORK, 0, FORK) for dy in (-FORK, 0, FORK) if dx or dy]
        assert any(not in_wall(world, x, y) and hypot(x - slot.x, y - slot.y) < FORK + REACH for x, y in beside)


@pytest.mark.parametrize("floor", FLOORS)
def test_people_get_from_home_to_every_machine_and_back(floor):
    arena = load("factory", floor)
    world = Factory()
    build(world, arena)
    assert len(arena.plan.homes) == WORKERS
    for home in arena.plan.homes:
        who = Worker()
        who.x, who.y = home
        for machine in arena.plan.machines:
            for goal in ((machine.spot_x, machine.spot_y), home):
                send(who, *goal)
                assert any(walk(world, who, 130.0, 20.0) for _ in range(15 * HZ)), f"{home} to {goal}"


@pytest.mark.parametrize("floor", FLOORS)
def test_both_teams_have_the_same_ways(floor):
    """Rotated or mirrored, a floor is the same for both teams: neither has shorter ways."""
    arena = load("factory", floor)
    ice, fire = arena.plan.slots[:8], arena.plan.slots[8:16]
    kinds = [machine.kind for machine in arena.plan.machines]

    def ways(shelves, kind):
        machines = [machine for machine, of in zip(arena.plan.machines, kinds, strict=True) if of == kind]
        return sorted(round(hypot(one.x - slot.x, one.y - slot.y), 6) for one in machines for slot in shelves)

    for kind in (0, 1):
        for part in (slice(0, 4), slice(4, 8)):
            assert ways(ice[part], kind) == ways(fire[part], kind)
    assert all(0 < slot.x < WIDTH and 0 < slot.y < HEIGHT for slot in arena.plan.slots)
