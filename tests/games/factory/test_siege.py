"""A robot that leans on a machine, or parks in its slots or on its worker's spot, stops neither it nor the match."""

from math import atan2, hypot

import pytest

from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    CARRYING,
    FETCHING,
    GOING,
    HALF,
    ICE,
    IN_SLOT,
    MACHINE_SLOTS,
    MACHINES,
    RAW,
    RESTING,
    WORKING,
    A,
)
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.sim.action import set_action
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.world import DT, HZ
from tests.cases import one_in
from tests.matches import finished, run

FLOORS = arenas("factory")
WAYS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
EVERY = [(floor, m) for floor in FLOORS for m in range(MACHINES)]


class Stick:
    """Full speed ahead, or alternating with a period in ticks; turning or not."""

    def __init__(self, every=0, angular=0.0, linear=1.0):
        self.every, self.angular, self.linear = every, angular, linear

    def think(self, state, seat):
        back = self.every and state.tick // self.every % 2
        set_action(state.actions[seat], -self.linear if back else self.linear, self.angular, 0, 0)


PARK = Stick(linear=0.0)
MANNERS = {"push": Stick(), "shake": Stick(10), "rub": Stick(angular=0.5), "turn": Stick(angular=1.0, linear=0.0)}


def begun(floor, brains, minutes=5.0):
    """A match; brains are names, sticks, or None for nobody."""
    one, two, three, four = (Seat("idle" if brain else "off", i % 2) for i, brain in enumerate(brains))
    match = Match(Setup("factory", floor, (one, two, three, four), minutes, 1, "standard", 4))
    for seat, brain in enumerate(brains):
        if brain:
            match.sit(seat, make_brain("factory", brain, 4 + seat) if isinstance(brain, str) else brain)
    return match


def put(match, seat, x, y, heading):
    """Put a robot there, at rest."""
    poses = [(robot.x, robot.y, robot.heading) for robot in match.state.robots]
    poses[seat] = (x, y, heading)
    match.plant.place(poses)


def against(state, m):
    """Poses of robots that drive against machine m: one at each free side, and one on its worker's spot."""
    machine, poses = state.machines[m], []
    for dx, dy in WAYS:
        x, y = machine.x + 103.0 * dx, machine.y + 103.0 * dy
        if not in_wall(state, x, y):
            poses.append((x, y, atan2(-dy, -dx)))
    return [*poses, (machine.spot_x, machine.spot_y, atan2(machine.y - machine.spot_y, machine.x - machine.spot_x))]


def time_to_process(floor, m, pose=None, stick=None):
    """Time from a pallet's arrival in the input of machine m to that in its output, s."""
    match = begun(floor, (stick, None, None, None) if pose else (None, PARK, None, None))
    state = match.state
    if pose:
        put(match, 0, *pose)
    run(match, 25)
    state.pallets[0].state, state.pallets[0].fed = RAW if state.machines[m].kind == A else HALF, 1
    move(state, 0, IN_SLOT, MACHINE_SLOTS + 2 * m)
    for tick in range(60 * HZ):
        match.tick()
        if state.slots[MACHINE_SLOTS + 2 * m + 1].pallet:
            return tick * DT
    return 60.0


@pytest.mark.parametrize(("floor", "m"), one_in(12, EVERY))
def test_a_robot_against_a_machine_costs_a_few_seconds_at_most(floor, m):
    """Its worker may have to walk around it, and does not wait for a robot that only spins its wheels."""
    undisturbed = time_to_process(floor, m)
    assert undisturbed < 8.5
    state = begun(floor, (PARK, None, None, None)).state
    for pose in against(state, m):
        for manner, stick in MANNERS.items():
            assert time_to_process(floor, m, pose, stick) < undisturbed + 4.0, (manner, pose)


# ---------------------------------------------------------------------------------------------------- whole matches


def ended(floor, brains, pose=None):
    """Run a match to its end; the robot on seat 1 begins at `pose`."""
    match = begun(floor, brains)
    if pose:
        put(match, 1, *pose)
    finished(match)
    return match


@pytest.mark.parametrize(("floor", "m"), one_in(12, EVERY))
def test_hard_drivers_get_everything_out_while_one_robot_leans_on_a_machine(floor, m):
    """The longest of 4992 such matches took 117 s; 60 s without an obstacle."""
    poses = against(begun(floor, (PARK, None, None, None)).state, m)
    match = ended(floor, ("hand3", MANNERS[("push", "shake")[m % 2]], "hand3", "hand3"), poses[m % len(poses)])
    assert match.state.winner
    assert match.seconds < 150.0


@pytest.mark.parametrize(("floor", "m"), one_in(6, EVERY[::2]))
def test_and_while_one_is_parked_in_a_slot_of_a_machine(floor, m):
    state = begun(floor, (PARK, None, None, None)).state
    slot = state.slots[MACHINE_SLOTS + 2 * m + m // 2]
    match = ended(floor, ("hand3", PARK, "hand3", "hand3"), (slot.x, slot.y, 0.0))
    assert match.state.winner
    assert match.seconds < 150.0


def test_a_pair_gets_everything_out_while_both_others_stand_in_its_way():
    """One on a worker's spot, the other in the yard, where it blocks the direct way to the last free exit slot."""
    match = begun("yard", ("hand3", Stick(), "hand3", Stick()))
    for seat, pose in ((1, against(match.state, 0)[-1]), (3, (800.0, 414.0, -1.57))):
        put(match, seat, *pose)
    finished(match)
    assert match.state.winner == 1 + ICE


# -------------------------------------------------------------------------------------------------- who takes over


def shut_in(match, w):
    """Put four robots around worker w, who rests at (600, 450)."""
    worker = match.state.workers[w]
    worker.x, worker.y = worker.home_x, worker.home_y = 600.0, 450.0
    match.plant.place([(600.0 + 70.0 * dx, 450.0 + 70.0 * dy, 0.0) for dx, dy in WAYS])
    for motion, robot in zip(match.state.motions, match.state.robots, strict=True):
        motion.x, motion.y = robot.x, robot.y


def test_an_idle_worker_takes_over_from_one_who_cannot_get_there():
    match = begun("hall", (PARK,) * 4)
    state = match.state
    shut_in(match, 0)
    move(state, 0, IN_SLOT, MACHINE_SLOTS)
    state.pallets[0].fed = 1
    match.tick()
    assert state.machines[0].worker == 1, "the nearest is called first"
    run(match, state.rules.patience + 2)
    assert state.machines[0].worker == 2, "then the next"
    assert state.workers[0].task == RESTING
    while state.workers[1].task == GOING:
        match.tick()
    assert state.workers[1].task == WORKING
    assert match.seconds < 8.0


def test_another_machine_comes_before_the_one_that_nobody_gets_to():
    """Two of the three are working elsewhere, and the third cannot reach the machine that has waited longest."""
    match = begun("hall", (PARK,) * 4)
    state = match.state
    match.plant.place([(60.0 + 80.0 * k, 60.0, 0.0) for k in range(4)])
    state.machines[0].spot_x, state.machines[0].spot_y = state.machines[0].x, state.machines[0].y
    for m, p in ((0, 0), (1, 1), (2, 2), (3, 3)):
        state.pallets[p].state, state.pallets[p].fed = RAW if state.machines[m].kind == A else HALF, 1
        move(state, p, IN_SLOT, MACHINE_SLOTS + 2 * m)
        state.pallets[p].waited = 500 - 100 * m
    run(match, 25 * HZ)
    assert [bool(state.slots[MACHINE_SLOTS + 2 * m + 1].pallet) for m in range(4)] == [False, True, True, True]
    assert state.machines[0].stalled > 20 * HZ


def test_a_worker_who_cannot_fetch_leaves_that_to_another_too():
    match = begun("hall", (PARK,) * 4)
    state = match.state
    shut_in(match, 0)
    state.pallets[0].state = HALF
    move(state, 0, IN_SLOT, MACHINE_SLOTS + 1)
    state.pallets[0].waited = state.rules.collect
    match.tick()
    assert state.workers[0].task == FETCHING
    while state.pallets[0].place == IN_SLOT and match.seconds < 20.0:
        match.tick()
    assert state.workers[1].task == CARRYING


@pytest.mark.parametrize(("floor", "m"), one_in(12, EVERY))
def test_a_driver_takes_its_pallet_to_the_other_machine_if_nobody_comes_to_this_one(floor, m):
    """Its worker's spot is unreachable."""
    match = begun(floor, ("hand3", None, None, None))
    machine = match.state.machines[m]
    machine.spot_x, machine.spot_y = machine.x, machine.y
    finished(match)
    assert match.state.winner == 1 + ICE
    assert match.seconds < 240.0
    assert match.state.loads[0].spoiled == 0


def test_a_driver_that_waits_for_its_turn_leaves_its_pallet_where_it_is():
    """All workers are busy for ten seconds, which is no reason to take the pallet away."""
    match = begun("hall", ("hand3", None, "hand3", None))
    lifted = 0
    while not match.over:
        before = [match.state.slots[MACHINE_SLOTS + 2 * m].pallet for m in range(MACHINES)]
        match.tick()
        lifted += sum(bool(load.pallet) and load.pallet in before for load in match.state.loads)
    assert not lifted


def test_beside_a_robot_on_its_place_a_worker_works_as_near_as_there_is_room():
    match = begun("hall", (PARK, None, None, None))
    state = match.state
    machine = state.machines[0]
    put(match, 0, machine.spot_x, machine.spot_y, 0.0)
    move(state, 0, IN_SLOT, MACHINE_SLOTS)
    while state.machines[0].pallet == 0 and match.seconds < 20.0:
        match.tick()
    worker = next(worker for worker in state.workers if worker.task == WORKING)
    assert 56.0 < hypot(worker.x - machine.spot_x, worker.y - machine.spot_y) <= 70.0
