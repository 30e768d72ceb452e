"""The variant party: endless orders, rush orders, loose and stolen pallets, the fast machine, overtime."""

from random import Random

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory import GAME as FACTORY
from pigaming_app.games.factory.rules import may_lift
from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    DONE,
    ENTRY,
    EXIT,
    FIRE,
    HALF,
    ICE,
    IN_SLOT,
    INPUT,
    MACHINE_SLOTS,
    MACHINES,
    NOBODY,
    ON_ROBOT,
    PALLETS,
    RAW,
    SHARED,
    SHARED_SLOTS,
    A,
    B,
)
from pigaming_app.sim.world import HZ
from tests.cases import one_in
from tests.games.factory.shop import Shop
from tests.games.factory.test_pallets import STEPS, Watch, likely
from tests.matches import finished, match_of

FLOORS = arenas("factory")


def party(**options):
    shop = Shop(variant="party", pallets=0, minutes=options.pop("minutes", 3.0), **options)
    for seat in range(4):
        shop.rails.poses[seat] = (60.0 + 80.0 * seat, 60.0, 0.0)
    return shop


def loose(shop):
    return [p for p in range(PALLETS) if shop.pallets[p].loose]


def put(shop, p, state, team, s, waited=0):
    """Put pallet p into slot s, as if `team` had brought it; whatever is there leaves the match."""
    there = shop.slots[s].pallet
    if there not in (0, p + 1):
        shop.pallets[there - 1].exists = shop.pallets[there - 1].place = 0
    shop.give(p, state, s)
    shop.pallets[p].team, shop.pallets[p].waited = team, waited


def idle_machine(shop, makes):
    """A machine of a kind that is not the fast one."""
    return next(m for m, machine in enumerate(shop.state.machines) if machine.kind == makes and not machine.fast)


# -------------------------------------------------------------------------------------------------------------- orders


@pytest.mark.parametrize("floor", FLOORS)
def test_it_begins_with_four_orders_a_team_and_three_loose_pallets(floor):
    shop = party(arena=floor)
    for team in (ICE, FIRE):
        entry = [shop.slot(ENTRY, team, which=k) for k in range(4)]
        held = [shop.pallets[shop.slots[s].pallet - 1] for s in entry]
        assert [(pallet.state, pallet.team) for pallet in held] == [(RAW, team)] * 4
        assert [bool(pallet.rush) for pallet in held] == [False, False, True, False]
    there = [shop.pallets[p] for p in loose(shop)]
    assert [(pallet.state, pallet.team, pallet.place) for pallet in there] == [(HALF, NOBODY, IN_SLOT)] * 3
    assert len({pallet.at for pallet in there} & set(range(SHARED_SLOTS, shop.state.slot_count))) == 3


def test_where_loose_pallets_lie_depends_on_the_seed():
    free = {next(s for s in range(SHARED_SLOTS, 28) if not party(seed=k).slots[s].pallet) for k in range(20)}
    assert free == {24, 25, 26, 27}


def test_a_delivered_order_is_followed_by_the_next_of_the_same_team():
    shop = party()
    p = shop.slots[shop.slot(ENTRY, ICE)].pallet - 1
    assert shop.press(0, shop.slot(ENTRY, ICE))
    shop.pallets[p].state = DONE
    before = shop.state.ordered[ICE]
    assert shop.press(0, shop.slot(EXIT, ICE))
    assert (shop.pallets[p].state, shop.state.points[ICE], shop.state.delivered[ICE]) == (DELIVERED, 1, 1)
    ticks = shop.until(lambda: shop.pallets[p].state == RAW)
    assert ticks == pytest.approx(shop.state.rules.renew, abs=3)
    assert shop.slots[shop.pallets[p].at].kind == ENTRY
    assert (shop.pallets[p].team, shop.state.ordered[ICE]) == (ICE, before + 1)


def test_every_third_order_of_a_team_is_a_rush():
    shop = party()
    rush = []
    for _ in range(9):
        p = shop.own(FIRE)[0]
        shop.give(p, DELIVERED, shop.slot(EXIT, FIRE))
        shop.pallets[p].waited = shop.state.rules.renew
        shop.tick()
        assert shop.pallets[p].state == RAW
        rush.append(bool(shop.pallets[p].rush))
    assert rush == [False, True, False] * 3  # the first four orders came at the start


@pytest.mark.parametrize(("left", "points"), [(500, 2), (20, 2), (0, 1)])
def test_a_rush_order_is_worth_double_until_its_deadline(left, points):
    shop = party()
    p = shop.own(ICE)[0]
    put(shop, p, DONE, ICE, shop.slot(ENTRY, ICE))
    assert shop.press(0, shop.slot(ENTRY, ICE))
    shop.pallets[p].rush = left
    assert shop.press(0, shop.slot(EXIT, ICE))
    assert shop.state.points[ICE] == points == shop.state.robots[0].score
    assert shop.state.delivered[ICE] == 1


def test_a_rush_order_expires_wherever_it_is():
    shop = party()
    p = next(p for p in shop.own(ICE) if shop.pallets[p].rush)
    assert shop.pallets[p].rush == shop.state.rules.rush
    assert shop.press(0, shop.pallets[p].at)
    ticks = shop.until(lambda: not shop.pallets[p].rush)
    assert ticks + 3 == shop.state.rules.rush
    shop.tick(10)
    assert (shop.pallets[p].rush, shop.pallets[p].place) == (0, ON_ROBOT)


def test_a_spoiled_pallet_becomes_the_next_order_of_its_warehouse():
    shop = party()
    p = shop.own(ICE)[0]
    put(shop, p, HALF, ICE, shop.slot(ENTRY, ICE))
    shop.carry(0, shop.slot(ENTRY, ICE), MACHINE_SLOTS + 2 * idle_machine(shop, A))
    assert shop.pallets[p].state == DAMAGED
    shop.until(lambda: shop.pallets[p].state == RAW)
    assert (shop.slots[shop.pallets[p].at].kind, shop.slots[shop.pallets[p].at].team) == (ENTRY, ICE)


# --------------------------------------------------------------------------------------------------- loose and stolen


@pytest.mark.parametrize("seat", [0, 1])
def test_anybody_may_take_a_loose_pallet_and_no_theft_is_counted(seat):
    shop = party()
    p = loose(shop)[0]
    assert shop.press(seat, shop.pallets[p].at)
    assert (shop.pallets[p].team, shop.loads[seat].stolen) == (seat % 2, 0)


def test_a_delivered_loose_pallet_counts_and_comes_back_half_done():
    shop = party()
    p = loose(shop)[0]
    assert shop.press(1, shop.pallets[p].at)
    shop.pallets[p].state = DONE
    assert shop.press(1, shop.slot(EXIT, FIRE))
    assert shop.state.points[FIRE] == 1
    shop.until(lambda: shop.pallets[p].state == HALF)
    assert (shop.slots[shop.pallets[p].at].kind, shop.pallets[p].team) == (SHARED, NOBODY)


def test_a_loose_pallet_waits_outside_while_the_shared_slots_are_full():
    shop = party()
    one = loose(shop)[0]
    free = [s for s in range(SHARED_SLOTS, 28) if not shop.slots[s].pallet or shop.slots[s].pallet == one + 1]
    shop.give(one, DELIVERED, shop.slot(EXIT, ICE))
    for p, s in zip(shop.own(FIRE), free, strict=False):
        shop.give(p, RAW, s)
    shop.pallets[one].waited = shop.state.rules.renew
    shop.tick(2)
    assert shop.pallets[one].place not in (IN_SLOT, ON_ROBOT)
    assert shop.press(1, free[0])
    shop.tick()
    assert (shop.pallets[one].place, shop.pallets[one].at) == (IN_SLOT, free[0])


def test_what_a_team_sets_down_in_a_shared_slot_the_others_may_steal():
    shop = party()
    free = next(s for s in range(SHARED_SLOTS, 28) if not shop.slots[s].pallet)
    p = shop.carry(0, shop.slot(ENTRY, ICE), free)
    assert shop.pallets[p].team == ICE
    assert shop.press(1, free)
    assert (shop.pallets[p].team, shop.loads[1].stolen) == (FIRE, 1)


def test_a_stolen_pallet_counts_for_the_thief_and_comes_back_to_its_own_warehouse():
    shop = party()
    p, out = shop.own(FIRE)[0], shop.output_of(B)
    put(shop, p, DONE, FIRE, out, waited=shop.state.rules.claim)
    assert shop.press(0, out)
    assert (shop.pallets[p].team, shop.loads[0].stolen) == (ICE, 1)
    assert shop.press(0, shop.slot(EXIT, ICE))
    assert (shop.state.points, shop.state.delivered) == ([1, 0], [1, 0])
    shop.until(lambda: shop.pallets[p].state == RAW)
    assert (shop.pallets[p].team, shop.slots[shop.pallets[p].at].team) == (FIRE, FIRE)


def test_a_processed_pallet_is_its_owners_for_four_seconds():
    shop = party()
    rules, p, out = shop.state.rules, shop.own(FIRE)[0], shop.output_of(A)
    assert rules.claim == 4 * HZ
    put(shop, p, HALF, FIRE, out, waited=rules.claim - 10)
    assert not may_lift(shop.state, 0, out)
    assert may_lift(shop.state, 1, out)
    shop.tick(9)
    assert not may_lift(shop.state, 0, out)
    shop.tick()
    assert may_lift(shop.state, 0, out)


@pytest.mark.parametrize("place", ["input", "entry", "exit"])
def test_elsewhere_pallets_are_safe(place):
    shop = party()
    p = shop.own(FIRE)[0]
    s = {"input": shop.input_of(B), "entry": shop.slot(ENTRY, FIRE), "exit": shop.slot(EXIT, FIRE)}[place]
    put(shop, p, DONE if place == "exit" else RAW, FIRE, s, waited=10**4)
    assert not may_lift(shop.state, 0, s)
    assert not shop.press(0, s)


def test_in_standard_nobody_takes_a_pallet_of_the_others():
    shop = Shop()
    out = shop.output_of(B)
    shop.give(shop.own(FIRE)[0], DONE, out)
    shop.pallets[shop.own(FIRE)[0]].waited = 900
    assert not may_lift(shop.state, 0, out)
    assert shop.state.slot_count == SHARED_SLOTS


def test_of_two_forks_at_one_pallet_no_seat_is_always_the_first():
    won = set()
    for wait in range(4):
        shop = party()
        s = shop.pallets[loose(shop)[0]].at
        shop.tick(wait)
        for seat in (0, 1):
            shop.stand(seat, s, heading=3.14 * seat)
            shop.match.brains[seat].fire = 1
        shop.tick()
        won |= {seat for seat in (0, 1) if shop.loads[seat].pallet}
    assert won == {0, 1}


# -------------------------------------------------------------------------------------------------------- fast machine


def test_each_machine_is_the_fast_one_for_a_quarter_of_three_minutes():
    shop = party()
    turns = []
    for tick in range(180 * HZ):
        if tick % (45 * HZ) == 0:
            shop.state.tick = tick
            shop.tick()
            fast = [m for m, machine in enumerate(shop.state.machines) if machine.fast]
            assert len(fast) == 1
            turns += fast
    assert sorted(turns) == [0, 1, 2, 3]


def test_the_order_of_the_fast_machines_is_drawn():
    assert len({tuple(party(seed=k).state.turns) for k in range(30)}) > 10


def test_the_fast_machine_needs_no_worker_and_two_seconds():
    shop = party()
    m = next(m for m in range(MACHINES) if shop.state.machines[m].fast)
    machine = shop.state.machines[m]
    p = shop.own(ICE)[0]
    state, after = (RAW, HALF) if machine.kind == A else (HALF, DONE)
    put(shop, p, state, ICE, MACHINE_SLOTS + 2 * m)
    shop.pallets[p].fed = 1
    shop.tick()
    assert (machine.pallet, machine.worker, machine.quick) == (p + 1, 0, 1)
    ticks = shop.until(lambda: shop.pallets[p].state == after)
    assert ticks == pytest.approx(shop.state.rules.fast_process, abs=2)
    assert shop.loads[0].steps == 1


def test_any_other_machine_needs_a_worker_and_six_seconds():
    shop = party()
    m, p = idle_machine(shop, A), shop.own(ICE)[0]
    put(shop, p, RAW, ICE, MACHINE_SLOTS + 2 * m)
    shop.pallets[p].fed = 1
    shop.tick(2)
    assert not shop.state.machines[m].pallet
    ticks = shop.until(lambda: shop.pallets[p].state == HALF)
    assert ticks > shop.state.rules.process
    assert shop.state.machines[m].quick == 0


# ------------------------------------------------------------------------------------------------------------- the end


def ending(points, minutes=0.1):
    shop = party(minutes=minutes)
    shop.state.points[:] = points
    shop.tick(round(minutes * 60 * HZ))
    return shop


def test_more_points_win_when_the_time_is_up():
    shop = ending([3, 2])
    assert shop.match.over
    assert sorted(shop.match.outcome().winners) == [0, 2]


def test_level_teams_play_on_until_the_next_point():
    shop = ending([2, 2])
    assert not shop.match.over
    p = shop.own(FIRE)[0]
    put(shop, p, DONE, FIRE, shop.slot(ENTRY, FIRE))
    assert shop.press(1, shop.slot(ENTRY, FIRE))
    shop.stand(1, shop.slot(EXIT, FIRE))
    shop.match.brains[1].fire = 1
    shop.tick(2)
    assert shop.match.over
    assert sorted(shop.match.outcome().winners) == [1, 3]


@pytest.mark.parametrize(("work", "winners"), [((3, 2), [0, 2]), ((2, 2), [])])
def test_after_the_overtime_work_decides(work, winners):
    shop = ending([2, 2])
    shop.loads[0].steps, shop.loads[1].steps = work
    shop.tick(shop.state.rules.overtime - 1)
    assert not shop.match.over
    shop.tick()
    assert shop.match.over
    assert sorted(shop.match.outcome().winners) == winners
    assert shop.state.rules.overtime == FACTORY.variants["party"].overtime * HZ


def test_points_are_the_record_of_party_and_time_that_of_the_others():
    shop = ending([5, 2])
    assert {row.seat: dict(row.records) for row in shop.match.outcome().rows} == {
        0: {"points": 5},
        2: {"points": 5},
        1: {"points": 2},
        3: {"points": 2},
    }
    assert [kind.name for kind in FACTORY.records_of("party")] == ["points"]
    assert [kind.name for kind in FACTORY.records_of("standard")] == ["time"]
    assert [kind.name for kind in FACTORY.records_of("together")] == ["time"]


# --------------------------------------------------------------------------------------------------------- conservation


class PartyWatch(Watch):
    """The invariants of party: pallets come back, and change their team only when they are lifted or ordered."""

    steps = STEPS | {(DELIVERED, RAW), (DELIVERED, HALF), (DAMAGED, HALF)}

    def look_at_teams(self):
        state = self.state
        for team in (ICE, FIRE):
            assert state.points[team] == sum(robot.score for robot in state.robots if robot.team == team)
            assert state.delivered[team] <= state.points[team] <= 2 * state.delivered[team]
            assert state.delivered[team] == sum(state.loads[i].delivered for i in range(4) if i % 2 == team)

    def look_at(self, p):
        super().look_at(p)
        pallet, state = self.state.pallets[p], self.state
        assert 0 <= pallet.rush <= state.rules.rush
        if pallet.team == NOBODY:
            assert pallet.loose
            assert pallet.state == HALF
        if pallet.place == IN_SLOT:
            assert pallet.at < state.slot_count
            assert pallet.team != NOBODY or state.slots[pallet.at].kind == SHARED


@pytest.mark.parametrize("brains", one_in(2, ["planner hand3 level1 random", "planner planner planner planner"]))
@pytest.mark.parametrize("floor", one_in(3, FLOORS))
def test_no_pallet_is_lost_or_doubled_while_drivers_play(floor, brains):
    match = match_of("factory", brains, floor, 3.0, 7, "party")
    watch = PartyWatch(match.state)
    assert len(watch.there) == 11
    while not match.over and match.seconds < 60.0:
        match.tick()
        watch.look()
    assert {(RAW, HALF), (HALF, DONE), (DONE, DELIVERED), (DELIVERED, RAW)} <= watch.seen


@pytest.mark.parametrize("floor", one_in(3, FLOORS))
def test_no_pallet_is_lost_or_doubled_while_robots_jump_from_slot_to_slot(floor):
    shop, chance = party(arena=floor, minutes=10.0), Random(floor)
    watch = PartyWatch(shop.state)
    for _ in range(40 * HZ):
        for seat in range(4):
            if chance.random() < 0.1:
                shop.match.brains[seat].fire = 1 - shop.match.brains[seat].fire
                shop.stand(seat, likely(shop, seat, chance), heading=chance.uniform(-3.0, 3.0))
        shop.tick()
        watch.look()
    assert sum(load.stolen for load in shop.loads)
    assert {(RAW, HALF), (DAMAGED, RAW)} <= watch.seen


# ------------------------------------------------------------------------------------------------- without shared slots


def test_a_floor_without_shared_slots_has_no_loose_pallets_on_it():
    from pigaming_app import ASSETS
    from pigaming_app.games.arenas import parse

    source = (ASSETS / "arenas" / "factory" / "hall.toml").read_text(encoding="utf-8")
    arena = parse("factory", source.split("[[shared]]", maxsplit=1)[0], "bare.toml")
    match = finished(match_of("factory", ["hand3"] * 4, arena, variant="party"), 30.0)
    assert match.state.slot_count == SHARED_SLOTS
    assert sum(match.state.delivered) > 0
    assert all(pallet.place not in (IN_SLOT, ON_ROBOT) for pallet in match.state.pallets if pallet.loose)
    assert all(slot.kind in (ENTRY, EXIT, INPUT, INPUT + 1) for slot in match.state.slots[:SHARED_SLOTS])
