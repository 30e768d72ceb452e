"""Robot Factory, rule by rule: forks, machines and people, damage, contact, deliveries, end of the match."""

from math import hypot, pi

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory import GAME as FACTORY
from pigaming_app.games.factory.pallets import move
from pigaming_app.games.factory.state import (
    BY_WORKER,
    CARRYING,
    DAMAGED,
    DELIVERED,
    DONE,
    ENTRY,
    EXIT,
    FETCHING,
    FIRE,
    GOING,
    HALF,
    ICE,
    IN_MACHINE,
    IN_SLOT,
    INPUT,
    MACHINE_SLOTS,
    ON_ROBOT,
    RAW,
    RESTING,
    SHIPPED,
    WAITING,
    WORKING,
    A,
    B,
)
from pigaming_app.sim.world import HZ, RADIUS
from tests.games.factory.shop import Shop
from tests.matches import Stick, finished, match_of, player_of

FLOORS = arenas("factory")


def entry(shop, team, which=0):
    return shop.slot(ENTRY, team, which=which)


def leave(shop, team, which=0):
    return shop.slot(EXIT, team, which=which)


def busy(shop, *tasks):
    return [worker for worker in shop.state.workers if worker.task in tasks]


# --------------------------------------------------------------------------------------------------------------- forks


@pytest.mark.parametrize("floor", FLOORS)
def test_each_team_begins_with_four_raw_pallets_on_its_entry(floor):
    shop = Shop(floor)
    for team in (ICE, FIRE):
        on_shelves = [shop.slots[entry(shop, team, i)].pallet - 1 for i in range(4)]
        assert sorted(on_shelves) == shop.own(team)
        assert {shop.pallets[p].state for p in on_shelves} == {RAW}
    assert not any(slot.pallet for slot in shop.slots if slot.kind != ENTRY)


def test_a_press_lifts_the_next_one_sets_down():
    shop = Shop()
    p = shop.slots[entry(shop, ICE)].pallet - 1
    assert shop.press(0, entry(shop, ICE))
    assert (shop.pallets[p].place, shop.pallets[p].at, shop.loads[0].pallet) == (ON_ROBOT, 0, p + 1)
    assert shop.slots[entry(shop, ICE)].pallet == 0
    assert shop.press(0, entry(shop, ICE))
    assert (shop.pallets[p].place, shop.pallets[p].at, shop.loads[0].pallet) == (IN_SLOT, entry(shop, ICE), 0)


def test_holding_fire_is_one_press():
    shop = Shop()
    shop.stand(0, entry(shop, ICE))
    player_of(shop.match).fire = 1
    for _ in range(2 * HZ):
        shop.tick()
        assert shop.loads[0].pallet, "it has lifted, and does not set down"


@pytest.mark.parametrize("heading", [0.0, 0.5 * pi, 2.5])
def test_the_fork_reaches_forty_px_from_64_px_ahead_of_the_robot(heading):
    shop = Shop()
    s = entry(shop, ICE)
    for off, lifts in ((-41.0, False), (-39.0, True)):  # beside the first slot of the row, away from the second
        shop.stand(0, s, off, heading)
        x, y, _ = shop.rails.poses[0]
        assert hypot(x - shop.slots[s].x, y - (shop.slots[s].y + off)) == pytest.approx(64.0)
        player_of(shop.match).fire = 1
        shop.tick()
        player_of(shop.match).fire = 0
        shop.tick()
        assert bool(shop.loads[0].pallet) == lifts


def test_of_two_slots_within_reach_the_nearer_one_counts():
    shop = Shop()
    first, second = entry(shop, ICE, 0), entry(shop, ICE, 1)
    shop.slots[first].y = shop.slots[second].y - 50.0
    for off, nearer in ((-20.0, second), (-30.0, first)):
        p = shop.slots[nearer].pallet
        assert shop.press(0, second, off)
        assert shop.loads[0].pallet == p
        assert shop.press(0, second, off), "back to where it was: the other one is full"


def test_a_full_slot_within_reach_gives_way_to_a_free_one():
    shop = Shop()
    first, second = entry(shop, ICE, 0), entry(shop, ICE, 1)
    assert shop.press(0, first)
    shop.slots[first].y = shop.slots[second].y - 50.0
    assert shop.press(0, second, -15.0), "the second is nearer, but full"
    assert shop.slots[first].pallet


@pytest.mark.parametrize("state", [RAW, HALF, DONE, DAMAGED])
def test_slots_accept_pallets_by_kind_and_state(state):
    """Own entry: any. Own exit: only done. Inputs: any, at the driver's risk. Outputs and other team's slots: none."""
    shop = Shop()
    shop.press(0, entry(shop, ICE))
    p = shop.loads[0].pallet - 1
    assert shop.press(1, entry(shop, FIRE)), "that slot of FIRE's has room"
    for takes, s in (
        (False, entry(shop, FIRE)),
        (False, leave(shop, FIRE)),
        (False, shop.output_of(A)),
        (False, shop.output_of(B)),
        (state == DONE, leave(shop, ICE)),
        (True, shop.input_of(A)),
        (True, shop.input_of(B)),
        (True, entry(shop, ICE)),
    ):
        move(shop.state, p, ON_ROBOT, 0)
        shop.pallets[p].state, shop.pallets[p].waited, shop.state.delivered[ICE] = state, 0, 0
        assert shop.press(0, s) == takes, f"slot {s}"
        assert shop.loads[0].pallet == (0 if takes else p + 1)


def test_nothing_is_set_down_on_the_floor_or_on_another_pallet():
    shop = Shop()
    assert shop.press(0, entry(shop, ICE, 0))
    assert not shop.press(0, entry(shop, ICE, 1))
    assert not shop.press(0, entry(shop, ICE), off=-60.0)
    assert shop.loads[0].pallet


def test_ticks_are_counted_from_a_press_without_effect_to_one_with_effect():
    shop = Shop()
    load = shop.loads[0]
    assert load.refused == 0
    assert not shop.press(0, shop.output_of(A))
    refused = load.refused
    assert refused > 0
    shop.tick(10)
    assert load.refused == refused + 10
    assert shop.press(0, entry(shop, ICE))
    assert load.refused == 0


def test_nobody_lifts_what_belongs_to_the_others_wherever_it_lies():
    shop = Shop()
    p = shop.own(ICE)[0]
    for s, state in (
        (entry(shop, ICE), RAW),
        (shop.input_of(A), RAW),
        (shop.output_of(A), HALF),
        (shop.output_of(B), DONE),
        (shop.input_of(A), DAMAGED),
    ):
        shop.give(p, state, s)
        assert not shop.press(1, s)
        assert not shop.press(3, s)
        assert shop.press(2, s), "a mate does"
        assert shop.press(2, entry(shop, ICE)), "and brings it home"


def test_what_was_put_in_can_be_taken_out_again_before_a_worker_comes():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    assert shop.press(2, shop.input_of(A))
    assert (shop.pallets[p].state, shop.loads[2].pallet) == (RAW, p + 1)
    shop.tick()
    assert len(busy(shop, RESTING)) == 3, "who was on the way turns back"


def test_nobody_takes_a_pallet_out_of_a_machine_at_work():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].place == IN_MACHINE)
    for s in (shop.input_of(A), shop.output_of(A)):
        assert not shop.press(0, s)


# ------------------------------------------------------------------------------------------------- machines and people


@pytest.mark.parametrize("floor", FLOORS)
def test_a_pallet_goes_through_a_and_b_and_out(floor):
    shop = Shop(floor, present=(0, 1))
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    assert shop.pallets[p].state == RAW
    shop.until(lambda: shop.pallets[p].state == HALF)
    assert (shop.pallets[p].place, shop.pallets[p].at) == (IN_SLOT, shop.output_of(A))
    assert shop.carry(0, shop.output_of(A), shop.input_of(B)) == p
    shop.until(lambda: shop.pallets[p].state == DONE)
    assert shop.pallets[p].at == shop.output_of(B)
    assert shop.carry(0, shop.output_of(B), leave(shop, ICE)) == p
    assert shop.pallets[p].state == DELIVERED
    assert shop.state.delivered == [1, 0]


def test_it_takes_six_seconds_from_when_the_worker_takes_it_in():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].place == IN_MACHINE)
    assert shop.slots[shop.input_of(A)].pallet == 0, "the input is free again"
    worker = busy(shop, WORKING)[0]
    machine = shop.state.machines[worker.machine]
    assert hypot(worker.x - machine.spot_x, worker.y - machine.spot_y) < 8.0
    assert shop.until(lambda: shop.pallets[p].place == IN_SLOT) == 6 * HZ


def test_without_people_no_machine_works():
    shop = Shop()
    move(shop.state, shop.own(FIRE)[0], IN_MACHINE, 3)
    shop.state.machines[3].left = 20 * HZ
    for worker in shop.state.workers:
        worker.task, worker.machine = WORKING, 3
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.tick(19 * HZ)
    assert (shop.pallets[p].state, shop.pallets[p].at) == (RAW, shop.input_of(A))
    shop.until(lambda: shop.pallets[p].state == HALF, 20.0)


def test_work_is_credited_to_the_robot_that_fed_the_machine():
    shop = Shop()
    shop.carry(2, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.slots[shop.output_of(A)].pallet)
    assert [load.steps for load in shop.loads] == [0, 0, 1, 0]
    shop.carry(0, shop.output_of(A), shop.input_of(B))
    shop.until(lambda: shop.slots[shop.output_of(B)].pallet)
    assert [load.steps for load in shop.loads] == [1, 0, 1, 0]


def test_a_machine_begins_only_when_its_output_is_free():
    shop = Shop()
    shop.give(shop.own(FIRE)[0], HALF, shop.output_of(A))
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.tick(10 * HZ)
    assert shop.pallets[p].place == IN_SLOT, "it waits in the input"
    assert shop.press(1, shop.output_of(A))
    shop.until(lambda: shop.pallets[p].state == HALF, 15.0)


def test_the_output_is_kept_for_what_the_machine_has_until_that_is_collected():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    machine = shop.state.machines[shop.slots[shop.input_of(A)].machine]
    assert machine.reserved == 0
    shop.until(lambda: shop.pallets[p].place == IN_MACHINE)
    assert machine.reserved == p + 1
    assert shop.press(1, entry(shop, FIRE))
    assert not shop.press(1, shop.output_of(A)), "nobody else gets in between"
    shop.until(lambda: shop.pallets[p].state == HALF)
    shop.tick(HZ)
    assert machine.reserved == p + 1
    assert shop.press(0, shop.output_of(A))
    shop.tick()
    assert machine.reserved == 0


def test_the_worker_goes_on_with_the_next_pallet_that_lies_ready():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].place == IN_MACHINE)
    q = shop.carry(1, entry(shop, FIRE), shop.input_of(A))
    worker = busy(shop, WORKING)[0]
    shop.until(lambda: shop.pallets[p].state == HALF)
    assert shop.press(0, shop.output_of(A))
    shop.until(lambda: shop.pallets[q].place == IN_MACHINE, 20.0)
    assert busy(shop, WORKING) == [worker]


def test_the_nearest_of_those_who_rest_is_sent_and_no_second_one():
    shop = Shop()
    left, middle, right = shop.state.workers  # the hall: at x = 720, 800 and 880
    shop.give(shop.own(ICE)[0], RAW, shop.input_of(A, 1))  # the right one
    shop.tick()
    assert (left.task, middle.task, right.task) == (RESTING, RESTING, GOING)
    shop.tick(2 * HZ)
    assert (left.task, middle.task) == (RESTING, RESTING)


@pytest.mark.parametrize("longer", [0, 1])
def test_where_something_has_waited_longest_comes_first(longer):
    shop = Shop()
    for which in (0, 1):
        shop.give(shop.own(ICE)[which], RAW, shop.input_of(A, which))
        shop.pallets[shop.own(ICE)[which]].waited = 100 if which == longer else 50
    shop.tick()
    (sent,) = busy(shop, GOING)
    assert sent.machine == shop.slots[shop.input_of(A, longer)].machine


def test_with_three_at_work_the_fourth_machine_waits_for_the_first_who_is_free():
    shop = Shop()
    for p, s in zip(shop.own(ICE), (shop.input_of(A), shop.input_of(A, 1)), strict=False):
        shop.give(p, RAW, s)
    for p, s in zip(shop.own(FIRE), (shop.input_of(B), shop.input_of(B, 1)), strict=False):
        shop.give(p, HALF, s)
    shop.until(lambda: len(busy(shop, WORKING)) == 3, 20.0)
    assert sum(1 for slot in shop.slots if slot.kind == INPUT and slot.pallet) == 1
    shop.until(lambda: sum(machine.reserved > 0 for machine in shop.state.machines) == 4, 20.0)


def test_a_worker_who_has_nothing_to_do_goes_home():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].state == HALF)
    shop.tick(6 * HZ)
    for worker in shop.state.workers:
        assert worker.task == RESTING
        assert hypot(worker.x - worker.home_x, worker.y - worker.home_y) < 8.0


# ------------------------------------------------------------------------------------------------ what nobody collects


@pytest.mark.parametrize("makes", [A, B])
@pytest.mark.parametrize("team", [ICE, FIRE])
def test_after_twenty_seconds_a_worker_carries_it_to_its_owners_entry(team, makes):
    """The same pallet, with its state, on a free slot there; the machine is then free."""
    shop = Shop()
    state, out = (HALF, DONE)[makes], shop.output_of(makes)
    p = shop.own(team)[0]
    assert shop.press(1 - team, entry(shop, 1 - team)), "the others have room too"
    shop.give(p, state, out)
    shop.tick(20 * HZ - 1)
    assert not busy(shop, FETCHING)
    shop.tick()
    assert len(busy(shop, FETCHING)) == 1
    shop.until(lambda: shop.pallets[p].place == BY_WORKER, 15.0)
    carrier = busy(shop, CARRYING)[0]
    assert (carrier.pallet, shop.slots[out].pallet) == (p + 1, 0)
    shop.until(lambda: shop.pallets[p].place == IN_SLOT, 20.0)
    slot = shop.slots[shop.pallets[p].at]
    assert (slot.kind, slot.team, slot.pallet) == (ENTRY, team, p + 1)
    assert (shop.pallets[p].state, carrier.pallet, carrier.task) == (state, 0, RESTING)
    assert shop.press(team, shop.pallets[p].at), "its team lifts it there"


def test_two_pallets_carried_home_at_once_go_to_two_slots():
    shop = Shop()
    shop.give(shop.own(ICE)[0], HALF, shop.output_of(A))
    shop.give(shop.own(ICE)[1], HALF, shop.output_of(A, 1))
    shop.until(lambda: len(busy(shop, CARRYING)) == 2, 40.0)
    assert sorted(worker.shelf for worker in busy(shop, CARRYING)) == [entry(shop, ICE, 0), entry(shop, ICE, 1)]
    shop.until(lambda: len(busy(shop, RESTING)) == 3, 20.0)
    assert {shop.pallets[p].place for p in shop.own(ICE)} == {IN_SLOT}


def test_an_owner_who_comes_in_time_sends_the_worker_home():
    shop = Shop()
    p = shop.own(ICE)[0]
    shop.give(p, HALF, shop.output_of(A))
    shop.tick(20 * HZ + 10)
    assert busy(shop, FETCHING)
    assert shop.press(0, shop.output_of(A))
    shop.tick(5 * HZ)
    assert len(busy(shop, RESTING)) == 3
    assert shop.loads[0].pallet == p + 1


def test_a_pallet_behind_an_uncollected_one_is_processed_eventually():
    """FIRE leaves its half-done pallet in a machine; ICE's raw one waits behind it until the output is cleared."""
    shop = Shop()
    shop.give(shop.own(FIRE)[0], HALF, shop.output_of(A))
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    ticks = shop.until(lambda: shop.pallets[p].state == HALF)
    assert 20.0 + 6.0 < ticks / HZ < 40.0


def test_with_a_full_entry_it_waits_outside_until_there_is_room():
    shop = Shop(pallets=5)
    p = shop.own(ICE)[4]
    assert shop.pallets[p].place == WAITING
    shop.give(p, HALF, shop.output_of(A))
    shop.until(lambda: shop.pallets[p].place == BY_WORKER, 40.0)
    shop.until(lambda: shop.pallets[p].place == WAITING, 20.0)
    assert shop.press(0, entry(shop, ICE, 2))
    shop.tick()
    assert (shop.pallets[p].place, shop.pallets[p].at) == (IN_SLOT, entry(shop, ICE, 2))
    assert shop.pallets[p].state == HALF


# -------------------------------------------------------------------------------------------------------------- damage


@pytest.mark.parametrize(("state", "makes"), [(RAW, B), (HALF, A), (DONE, A), (DONE, B)])
def test_in_a_wrong_machine_a_pallet_is_spoiled_at_once_and_replaced_after_ten_seconds(state, makes):
    shop = Shop()
    p = shop.own(ICE)[0]
    shop.press(0, entry(shop, ICE))
    shop.pallets[p].state = state
    s = shop.input_of(makes)
    shop.stand(0, s)
    player_of(shop.match).fire = 1
    shop.tick()
    assert (shop.pallets[p].state, shop.pallets[p].place, shop.pallets[p].at) == (DAMAGED, IN_SLOT, s)
    assert [load.spoiled for load in shop.loads] == [1, 0, 0, 0]
    assert shop.until(lambda: shop.pallets[p].state != DAMAGED) == 10 * HZ - 1
    assert shop.pallets[p].state == RAW
    assert shop.slots[s].pallet == 0
    slot = shop.slots[shop.pallets[p].at]
    assert (slot.kind, slot.team, slot.pallet) == (ENTRY, ICE, p + 1)
    assert not busy(shop, GOING, WORKING), "nobody worked on it"


def test_a_spoiled_pallet_blocks_the_machine_unless_its_team_takes_it_away():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(B))
    assert shop.press(1, entry(shop, FIRE))
    assert not shop.press(1, shop.input_of(B)), "full"
    assert shop.press(2, shop.input_of(B))
    assert shop.press(1, shop.input_of(B)), "free"
    assert shop.pallets[p].state == DAMAGED


def test_it_is_replaced_on_a_fork_too_and_moving_it_about_changes_nothing():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(B))
    began = shop.pallets[p].waited
    assert shop.press(0, shop.input_of(B))
    assert shop.press(0, shop.input_of(A, 1))
    assert shop.press(0, shop.input_of(A, 1))
    assert shop.loads[0].spoiled == 1, "it cannot be spoiled twice"
    left = shop.until(lambda: shop.pallets[p].state == RAW)
    assert began + 9 + left == 10 * HZ
    assert shop.loads[0].pallet == 0
    assert shop.slots[shop.pallets[p].at].kind == ENTRY


def test_the_replacement_waits_while_the_entry_is_full():
    shop = Shop(pallets=5)
    p = shop.carry(0, entry(shop, ICE), shop.input_of(B))
    shop.tick(10 * HZ)
    assert (shop.pallets[p].state, shop.pallets[p].place) == (RAW, WAITING), "the fifth has come into its place"
    assert shop.press(0, entry(shop, ICE, 3))
    shop.tick()
    assert (shop.pallets[p].place, shop.pallets[p].at) == (IN_SLOT, entry(shop, ICE, 3))


def test_its_replacement_can_be_delivered_like_any_other():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(B))
    shop.until(lambda: shop.pallets[p].state == RAW)
    shop.carry(0, shop.pallets[p].at, shop.input_of(A))
    shop.until(lambda: shop.pallets[p].state == HALF)
    shop.carry(0, shop.output_of(A), shop.input_of(B))
    shop.until(lambda: shop.pallets[p].state == DONE)
    shop.carry(0, shop.output_of(B), leave(shop, ICE))
    assert shop.state.delivered == [1, 0]


# -------------------------------------------------------------------------------------------------------------- people


def bump(shop, seat=0, w=1, speed=200.0, gap=0.0):
    """Put the robot `gap` px from a worker's centre, at a speed, for one tick."""
    worker = shop.state.workers[w]
    shop.rails.poses[seat] = (worker.x, worker.y + gap, 0.0)
    shop.state.robots[seat].linear = speed
    shop.tick()


@pytest.mark.parametrize("speed", [200.0, -200.0])
def test_driving_over_a_person_freezes_for_three_seconds(speed):
    shop = Shop()
    shop.match.brains[0] = Stick(angular=0.5)
    worker = shop.state.workers[1]
    before = worker.x, worker.y
    bump(shop, speed=speed, gap=RADIUS + 19.0)
    load, robot = shop.loads[0], shop.state.robots[0]
    assert (load.hits, load.frozen) == (1, 3 * HZ)
    for _ in range(3 * HZ):
        assert (robot.requested_linear, robot.requested_angular, robot.boosting) == (0.0, 0.0, 0)
        shop.tick()
    assert robot.requested_linear > 0
    assert load.hits == 1
    assert (worker.x, worker.y) == before, "nobody is hurt or moved"


@pytest.mark.parametrize(("speed", "gap"), [(200.0, RADIUS + 21.0), (19.0, 40.0), (-19.0, 40.0), (0.0, 0.0)])
def test_passing_by_or_hardly_moving_does_not_count(speed, gap):
    shop = Shop()
    bump(shop, speed=speed, gap=gap)
    assert (shop.loads[0].hits, shop.loads[0].frozen) == (0, 0)


def test_it_counts_once_for_each_contact():
    shop = Shop()
    bump(shop, gap=50.0)
    for _ in range(5 * HZ):
        bump(shop, gap=50.0)
    assert shop.loads[0].hits == 1, "still the same contact"
    bump(shop, gap=60.0)
    bump(shop, gap=50.0)
    assert shop.loads[0].hits == 1, "4 px apart is no parting"
    bump(shop, gap=70.0)
    bump(shop, gap=50.0)
    assert shop.loads[0].hits == 2
    assert shop.loads[0].frozen == 3 * HZ


def test_each_pair_of_robot_and_person_counts_separately():
    shop = Shop()
    bump(shop, seat=0, w=1, gap=50.0)
    bump(shop, seat=3, w=1, gap=50.0)
    assert [load.hits for load in shop.loads] == [1, 0, 0, 1]
    bump(shop, seat=0, w=0, gap=50.0)
    assert [load.hits for load in shop.loads] == [2, 0, 0, 1]


def test_a_frozen_robot_lifts_nothing_and_keeps_what_it_carries():
    shop = Shop()
    assert shop.press(0, entry(shop, ICE))
    bump(shop, gap=50.0)
    shop.state.robots[0].linear = 0.0
    assert not shop.press(0, entry(shop, ICE))
    assert shop.loads[0].refused == 0, "it did not even try"
    shop.until(lambda: not shop.loads[0].frozen, 4.0)
    assert shop.press(0, entry(shop, ICE))


def test_a_worker_who_is_driven_over_continues_working():
    shop = Shop()
    p = shop.carry(0, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].place == IN_MACHINE)
    w = next(i for i, worker in enumerate(shop.state.workers) if worker.task == WORKING)
    bump(shop, w=w, gap=50.0)
    assert shop.loads[0].hits == 1
    assert shop.until(lambda: shop.pallets[p].state == HALF) < 6 * HZ


def test_stick_and_turbo_ask_for_the_speeds_of_the_rules():
    shop = Shop()
    robot = shop.state.robots[0]
    shop.match.brains[0] = stick = Stick(angular=0.5)
    shop.tick()
    assert (robot.requested_linear, robot.requested_angular) == (260.0, 1.5)
    stick.turbo = 1
    shop.tick()
    assert robot.requested_linear == pytest.approx(1.3 * 260.0)
    shop.tick(2 * HZ)
    assert robot.requested_linear == 260.0, "the meter is empty after two seconds"


# ---------------------------------------------------------------------------------------------------------- deliveries


def deliver(shop, seat, which=0):
    """Bring a pallet of the seat's team, set to done, to its exit; returns its index."""
    team = seat % 2
    p = next(p for p in shop.own(team) if shop.pallets[p].state == RAW and shop.pallets[p].place == IN_SLOT)
    assert shop.press(seat, shop.pallets[p].at)
    shop.pallets[p].state = DONE
    assert shop.press(seat, leave(shop, team, which))
    return p


def test_a_delivery_counts_for_robot_and_team_and_stays_delivered():
    shop = Shop()
    p = deliver(shop, 3, which=2)
    assert shop.pallets[p].state == DELIVERED
    assert shop.state.delivered == [0, 1]
    assert [robot.score for robot in shop.state.robots] == [0, 0, 0, 1]
    assert shop.loads[3].delivered == 1
    assert not shop.press(3, leave(shop, FIRE, 2)), "it is not lifted again"


def test_the_fifth_delivery_finds_room_since_the_oldest_drives_off():
    shop = Shop(pallets=6)
    first, *rest = [deliver(shop, 0, which) for which in (2, 0, 1)]
    assert shop.pallets[first].place == IN_SLOT
    rest.append(deliver(shop, 2, 3))
    assert shop.pallets[first].place == SHIPPED
    assert [shop.pallets[p].place for p in rest] == [IN_SLOT] * 3
    rest.append(deliver(shop, 0, 2))
    assert shop.state.delivered == [5, 0]
    assert not shop.match.over
    deliver(shop, 0, next(i for i in range(4) if not shop.slots[leave(shop, ICE, i)].pallet))
    assert shop.match.over


@pytest.mark.parametrize("pallets", range(2, 9))
def test_the_first_team_to_deliver_everything_wins_at_once(pallets):
    shop = Shop(pallets=pallets)
    assert len(shop.own(ICE)) == len(shop.own(FIRE)) == pallets
    for k in range(pallets):
        assert not shop.match.over
        room = [i for i in range(4) if not shop.slots[leave(shop, FIRE, i)].pallet]
        deliver(shop, (1, 3)[k % 2], room[0])
    assert shop.match.over
    assert shop.state.winner == 1 + FIRE
    assert sum(shop.pallets[p].place == SHIPPED for p in shop.own(FIRE)) == max(0, pallets - 4), "the last stay"
    outcome = shop.match.outcome()
    assert sorted(outcome.winners) == [1, 3]
    assert [row.place for row in outcome.rows] == [1, 1, 3, 3]
    assert [set(row.records) for row in outcome.rows] == [{"time"}, {"time"}, set(), set()]
    assert outcome.rows[0].records["time"] == round(1000 * shop.match.seconds)
    assert sum(row.stats["delivered"] for row in outcome.rows) == pallets
    assert tuple(outcome.rows[0].stats) == FACTORY.columns


@pytest.mark.parametrize("work", [(0, 0), (9, 0), (0, 9)])
@pytest.mark.parametrize("seats", [(0, 1), (2, 1), (0, 3), (3, 2)])
@pytest.mark.parametrize("last", [False, True])
def test_two_teams_that_finish_on_the_same_tick_tie(seats, work, last):
    """Independent of seats and of work done, and also on the last tick of the match."""
    shop = Shop(pallets=2)
    for seat, steps in zip(seats, work, strict=True):
        deliver(shop, seat)
        assert shop.press(seat, entry(shop, seat % 2, 1))
        shop.pallets[shop.loads[seat].pallet - 1].state = DONE
        shop.loads[seat].steps = steps
        shop.stand(seat, leave(shop, seat % 2, 1))
        shop.tick()
    for seat in seats:
        shop.match.brains[seat].fire = 1
    if last:
        shop.state.rules.ticks = shop.state.tick + 1
    shop.tick()
    assert shop.match.over
    assert (shop.state.delivered, shop.state.winner) == ([2, 2], 0)
    outcome = shop.match.outcome()
    assert outcome.winners == ()
    assert [row.place for row in outcome.rows] == [1] * 4
    assert [row.records for row in outcome.rows] == [{"time": 20 * shop.state.tick}] * 4


@pytest.mark.parametrize("first", [0, 1])
def test_a_tick_earlier_is_a_win_whatever_the_others_have_done(first):
    """Both have their last pallet on the fork; the other team has had far more work done."""
    shop = Shop(pallets=2)
    for seat in (0, 1):
        deliver(shop, seat)
        assert shop.press(seat, entry(shop, seat, 1))
        shop.pallets[shop.loads[seat].pallet - 1].state = DONE
        shop.stand(seat, leave(shop, seat, 1))
    shop.loads[1 - first].steps = 2000
    shop.match.brains[first].fire = 1
    shop.tick()
    assert (shop.match.over, shop.state.winner) == (True, 1 + first)
    assert sorted(shop.match.outcome().winners) == [first, first + 2]


def test_when_it_is_over_everything_stands_still():
    shop = Shop(pallets=2)
    deliver(shop, 0)
    deliver(shop, 0, 1)
    assert shop.match.over
    shop.match.brains[1] = Stick(angular=0.5)
    tick = shop.state.tick
    assert not shop.press(1, entry(shop, FIRE))
    assert (shop.state.robots[1].requested_linear, shop.state.tick) == (0.0, tick)


@pytest.mark.parametrize(
    ("ice", "fire", "winners"),
    [
        ((1, 0), (0, 9), [0, 2]),
        ((2, 3), (2, 2), [0, 2]),
        ((2, 2), (2, 3), [1, 3]),
        ((1, 2), (1, 2), []),
        ((0, 0),) * 2 + ([],),
    ],
)
def test_when_the_time_is_up_deliveries_count_then_work(ice, fire, winners):
    shop = Shop(minutes=0.5)
    for seat, (delivered, steps) in enumerate((ice, fire)):
        for which in range(delivered):
            deliver(shop, seat, which)
        shop.loads[seat].steps, shop.loads[seat + 2].steps = steps - steps // 2, steps // 2
    assert shop.until(lambda: shop.match.over) <= 30 * HZ
    assert shop.state.tick == 30 * HZ
    assert sorted(shop.match.outcome().winners) == winners
    assert shop.state.winner == 0
    assert not any(row.records for row in shop.match.outcome().rows)


# ------------------------------------------------------------------------------------------------------ who takes part


def test_pallets_above_four_come_onto_the_entry_as_its_slots_get_free():
    shop = Shop(pallets=8)
    assert [shop.pallets[p].place for p in shop.own(ICE)] == [IN_SLOT] * 4 + [WAITING] * 4
    for k in range(4):
        assert shop.press(0, entry(shop, ICE, k))
        shop.tick()
        late = shop.own(ICE)[4 + k]
        assert (shop.pallets[late].place, shop.pallets[late].at) == (IN_SLOT, entry(shop, ICE, k))
        shop.give(shop.loads[0].pallet - 1, DELIVERED, leave(shop, ICE, k))
        shop.loads[0].pallet = 0
    assert shop.press(0, entry(shop, ICE, 0))
    shop.tick(5)
    assert not shop.slots[entry(shop, ICE, 0)].pallet, "none are left"


def test_the_default_is_four_pallets_per_team():
    assert len(Shop(pallets=0).own(ICE)) == FACTORY.default.default_goal == 4
    assert tuple(FACTORY.default.goals) == tuple(range(2, 9))


@pytest.mark.parametrize("seats", [(0, 1), (0, 3), (2, 1), (2, 3)])
def test_one_against_one(seats):
    """The match works without the other two robots."""
    shop = Shop(present=seats, pallets=2)
    ice, fire = seats
    p = shop.carry(ice, entry(shop, ICE), shop.input_of(A))
    shop.until(lambda: shop.pallets[p].state == HALF)
    shop.tick(HZ)
    deliver(shop, fire)
    deliver(shop, fire, 1)
    assert shop.match.over
    outcome = shop.match.outcome()
    assert outcome.winners == (fire,)
    assert [row.seat for row in outcome.rows] == [fire, ice]


@pytest.mark.parametrize("teams", [(0, 1, 0, 1), (1, 0, 1, 0), (0, 0, 1, 1), (1, 0, 0, 1)])
@pytest.mark.parametrize("floor", FLOORS)
def test_a_teams_robots_start_beside_its_entry(floor, teams):
    for seed in range(8):
        match = match_of("factory", ["idle"] * 4, floor, seed=seed, teams=teams).state
        for team in (ICE, FIRE):
            robots = [robot for robot in match.robots if robot.team == team]
            slots = [slot for slot in match.slots[:MACHINE_SLOTS] if (slot.team, slot.kind) == (team, ENTRY)]
            assert len({(robot.x, robot.y) for robot in robots}) == 2
            assert len({slot.x < 800.0 for slot in slots} | {robot.x < 800.0 for robot in robots}) == 1


@pytest.mark.parametrize("floor", FLOORS)
def test_both_teams_get_either_end_and_its_four_slots_of_each_kind(floor):
    ends: dict[int, set[tuple[tuple[int, float, float], ...]]] = {ICE: set(), FIRE: set()}
    for seed in range(12):
        match = match_of("factory", ["idle"] * 4, floor, seed=seed).state
        for team in (ICE, FIRE):
            slots = [slot for slot in match.slots[:MACHINE_SLOTS] if slot.team == team]
            ends[team].add(tuple((slot.kind, slot.x, slot.y) for slot in slots))
    assert ends[ICE] == ends[FIRE]
    assert len(ends[ICE]) == 2


def test_allies_keep_the_warehouses_as_they_are_drawn():
    slots = {
        tuple((slot.x, slot.y) for slot in match_of("factory", ["idle"] * 4, seed=seed, variant="together").state.slots)
        for seed in range(8)
    }
    assert len(slots) == 1


@pytest.mark.parametrize("off", range(4))
def test_two_against_one(off):
    match = finished(match_of("factory", ["off" if i == off else "idle" for i in range(4)], minutes=0.1))
    assert {row.seat for row in match.outcome().rows} == {0, 1, 2, 3} - {off}
