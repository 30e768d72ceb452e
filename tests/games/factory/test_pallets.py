"""Pallets: none is ever lost, duplicated, in two places, or carried by the other team."""

from random import Random

import pytest

from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.rules import may_lift
from pigaming_app.games.factory.state import (
    BY_WORKER,
    DAMAGED,
    DELIVERED,
    DONE,
    ENTRY,
    EXIT,
    HALF,
    IN_MACHINE,
    IN_SLOT,
    INPUT,
    ON_ROBOT,
    OUTPUT,
    RAW,
    SHIPPED,
    WAITING,
    A,
    B,
)
from pigaming_app.sim.world import HZ
from tests.cases import one_in
from tests.games.factory.shop import Shop
from tests.matches import match_of

FLOORS = arenas("factory")
STEPS = {(RAW, HALF), (HALF, DONE), (DONE, DELIVERED), (RAW, DAMAGED), (HALF, DAMAGED), (DONE, DAMAGED), (DAMAGED, RAW)}
PAIRS, TWO = "hand3 random hand2 hand1", "hand3 hand1"


class Watch:
    """Checks the invariants of all pallets of a match after every tick."""

    steps = STEPS

    def __init__(self, state):
        self.state = state
        self.there = [p for p, pallet in enumerate(state.pallets) if pallet.exists]
        self.before = [pallet.state for pallet in state.pallets]
        self.teams = [state.pallets[p].team for p in self.there]
        self.seen = set()

    def look(self):
        """Assert the invariants of all pallets, now and in comparison with the last check."""
        state = self.state
        assert [p for p, pallet in enumerate(state.pallets) if pallet.exists] == self.there
        assert self.held() == {p: (state.pallets[p].place, state.pallets[p].at) for p in self.there if self.shown(p)}
        for p in self.there:
            self.look_at(p)
        self.look_at_teams()

    def look_at_teams(self):
        """Assert that each team has its pallets and what it has delivered."""
        assert [self.state.pallets[p].team for p in self.there] == self.teams
        out = [self.state.pallets[p].team for p in self.there if self.state.pallets[p].state == DELIVERED]
        assert self.state.delivered == [out.count(0), out.count(1)]

    def shown(self, p):
        """True if any place holds pallet p."""
        place = self.state.pallets[p].place
        assert place in (IN_SLOT, ON_ROBOT, IN_MACHINE, BY_WORKER, WAITING, SHIPPED)
        return place not in (WAITING, SHIPPED)

    def held(self):
        """The location of each pallet, from the contents of all places."""
        state, where = self.state, {}
        for place, holders in (
            (IN_SLOT, state.slots),
            (ON_ROBOT, state.loads),
            (IN_MACHINE, state.machines),
            (BY_WORKER, state.workers),
        ):
            for at, holder in enumerate(holders):
                if holder.pallet:
                    assert holder.pallet - 1 not in where, "two hold it"
                    where[holder.pallet - 1] = place, at
        return where

    def look_at(self, p):
        """Assert that a pallet's location is valid for its state and team, and that its change of state is legal."""
        pallet = self.state.pallets[p]
        if pallet.state != self.before[p]:
            step = self.before[p], pallet.state
            assert step in self.steps
            self.seen.add(step)
            self.before[p] = pallet.state
        if pallet.place == ON_ROBOT:
            assert self.state.robots[pallet.at].present
            assert self.state.robots[pallet.at].team == pallet.team
        elif pallet.place == IN_SLOT:
            slot = self.state.slots[pallet.at]
            assert slot.team in (-1, pallet.team)
            assert (slot.kind == EXIT) == (pallet.state == DELIVERED)
            assert slot.kind != ENTRY or pallet.state in (RAW, HALF, DONE, DAMAGED)
        elif pallet.place == IN_MACHINE:
            assert pallet.state in (RAW, HALF)
        elif pallet.place == SHIPPED:
            assert pallet.state == DELIVERED
        elif pallet.place == WAITING:
            assert pallet.state in (RAW, HALF, DONE)


@pytest.mark.parametrize(
    ("floor", "brains"), one_in(2, [(floor, brains) for floor in FLOORS for brains in (PAIRS, TWO)])
)
@pytest.mark.parametrize("pallets", one_in(3, [5, 2, 8]))
def test_invariants_hold_while_drivers_of_all_kinds_play(floor, pallets, brains):
    match = match_of("factory", brains, floor, 5.0, pallets, "standard", pallets)
    watch = Watch(match.state)
    assert len(watch.there) == 2 * pallets
    while not match.over and match.seconds < 75.0:
        match.tick()
        watch.look()
    assert {(RAW, HALF), (HALF, DONE), (DONE, DELIVERED)} <= watch.seen


def likely(shop, seat, chance):
    """A slot at which a robot can act: usually the right one, sometimes a wrong machine or any slot."""
    load = shop.loads[seat]
    luck = chance.random()
    if luck < 0.15:
        return chance.randrange(len(shop.slots))
    if not load.pallet:
        full = [s for s in range(len(shop.slots)) if may_lift(shop.state, seat, s)]
        return chance.choice([s for s in full if shop.slots[s].kind == OUTPUT] or full or [0])
    state = shop.pallets[load.pallet - 1].state
    free = [s for s, slot in enumerate(shop.slots) if slot.kind == INPUT and not slot.pallet]
    if free and luck < (0.6 if state == DONE else 0.25):  # few pallets are ever done, so these go astray more often
        return chance.choice(free)
    exit_slot = shop.slot(EXIT, seat % 2, -1, chance.randrange(4))
    return {RAW: shop.input_of(A), HALF: shop.input_of(B), DONE: exit_slot}.get(state, 0)


def jump(shop, present, chance, seconds):
    """Robots jump from slot to slot and press fire, with checks; returns all changes of state that occurred."""
    watch = Watch(shop.state)
    for _ in range(seconds * HZ):
        for seat in present:
            if chance.random() < 0.1:
                shop.match.brains[seat].fire = 1 - shop.match.brains[seat].fire
                shop.stand(seat, likely(shop, seat, chance), heading=chance.uniform(-3.0, 3.0))
        shop.tick()
        watch.look()
        if shop.state.over:
            break
    return watch.seen


@pytest.mark.parametrize("present", [(0, 1, 2, 3), (0, 1)])
@pytest.mark.parametrize("pallets", one_in(3, range(2, 9)))
@pytest.mark.parametrize("floor", FLOORS)
def test_invariants_hold_while_robots_jump_from_slot_to_slot_and_press_fire(floor, pallets, present):
    """Within a short time every permitted lift and drop occurs, right or wrong."""
    seen = jump(Shop(floor, pallets, present), present, Random(f"{floor} {pallets} {present}"), 40)
    assert (RAW, HALF) in seen


@pytest.mark.long
def test_every_change_of_state_occurs_while_robots_jump():
    """Otherwise the test above would not cover some of them."""
    chance = Random(5)
    assert set().union(*(jump(Shop("hall", 8, seed=k), range(4), chance, 60) for k in range(16))) == STEPS
