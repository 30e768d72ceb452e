"""Steering help in the factory: keys at random deliver half as much as a beginner, who loses nothing by it."""

from math import pi
from statistics import mean

import pytest

from pigaming_app.ai.brain.kind import BrainPlayer, HumanPlayer
from pigaming_app.ai.factory.steering_help import Guide
from pigaming_app.ai.game_ai import HELPED_POINT, HELPED_TURN, POINT, TURN
from pigaming_app.ai.people.models import MASHER
from pigaming_app.ai.registry import AIS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import DONE, ENTRY, EXIT, HALF, ICE, INPUT, OUTPUT, RAW
from pigaming_app.sim.action import quantise, set_action
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.input.events import StickState
from tests.cases import one_in
from tests.games.factory.shop import Shop
from tests.matches import match_of

FLOORS = arenas("factory")


class Helped:
    """A player, with or without help."""

    def __init__(self, player, helped=True):
        self.player, self.guide = player, Guide() if helped else None

    def think(self, state, seat):
        self.player.think(state, seat)
        action = state.actions[seat]
        if self.guide:
            stick = self.guide.helped_stick(state, seat, action.linear, action.angular)
            set_action(action, *stick, action.fire, action.turbo)


def alone(player, floor):
    return match_of("factory", player, floor, 5.0, 1, "together", 4)


@pytest.mark.parametrize("floor", one_in(2, FLOORS))
def test_keys_at_random_deliver_a_pallet_with_help(floor):
    match = alone("human", floor)
    match.sit(0, Helped(BrainPlayer(MASHER, ROBOTS)))
    while not match.over and not match.state.delivered[ICE]:
        match.tick()
    assert match.state.delivered[ICE] == 1


@pytest.mark.again
@pytest.mark.long
@pytest.mark.parametrize("mates", [0, 3])
def test_keys_at_random_deliver_half_as_much_as_a_beginner_without_help(mates):
    """Mean of two matches on each floor, of three minutes."""
    games = [(floor, seed) for floor in FLOORS for seed in range(2)]
    everybody = (("masher", True), ("masher", False), ("beginner", True), ("beginner", False))
    helped, masher, led, beginner = (
        mean(delivered(floor, seed, mates, *one) for floor, seed in games) for one in everybody
    )
    assert helped > 0.5 * beginner
    assert masher < 0.1 * beginner
    assert led > 0.7 * beginner


def delivered(floor, seed, mates, name, helped):
    """Deliveries in three minutes, of the robot alone."""
    match = match_of("factory", [name, *["level1"] * mates], floor, 5.0, seed, "together", 12)
    match.sit(0, Helped(BrainPlayer(MASHER, ROBOTS * seed) if name == MASHER.name else match.brains[0], helped))
    while not match.over and match.seconds < 180.0:
        match.tick()
    return match.state.loads[0].delivered * 180.0 / match.seconds


def stick_at(shop, linear, angular):
    """The helped stick of seat 0, one tick after it was placed."""
    shop.tick()
    return Guide().helped_stick(shop.state, 0, linear, angular)


def laden(state):
    """A floor with something to lift at every machine, and robot 0 with a pallet in this state; None: without."""
    shop = Shop("hall", 8)
    if state is not None:
        assert shop.press(0, shop.slot(ENTRY, ICE))
        shop.pallets[shop.loads[0].pallet - 1].state = state
    later = iter(shop.own(ICE)[-4:])
    for kind, machine in ((OUTPUT, 0), (INPUT, 1), (OUTPUT, 2), (INPUT, 3)):
        shop.give(next(later), HALF, shop.slot(kind, machine=machine))
    return shop


@pytest.mark.parametrize("state", [None, RAW, HALF, DONE])
def test_where_the_robot_waits_fire_gets_a_pallet_on(state):
    waits = 0
    for s in range(laden(state).state.slot_count):
        shop = laden(state)
        shop.stand(0, s)
        if stick_at(shop, 1.0, 1.0) != pytest.approx((0.1, 0.1)):
            continue
        waits += 1
        load, kind = shop.loads[0], shop.slots[s].kind
        assert shop.press(0, s)
        assert not load.spoiled
        assert kind in ((ENTRY, OUTPUT) if state is None else (INPUT, EXIT))
        assert load.delivered == (state == DONE)
    assert waits


@pytest.mark.parametrize("heading", [0.0, 1.0, -2.0, pi])
def test_a_released_stick_stays_released(heading):
    shop = Shop()
    shop.stand(0, shop.slot(ENTRY, ICE), 150.0, heading)
    assert stick_at(shop, 0.0, 0.0) == (0.0, 0.0)


def test_a_turn_leads_to_what_lies_on_its_side():
    """In front of it a pallet to the left and one to the right, both 45 degrees off its way."""
    shop = Shop("hall", 4)
    first, second = (shop.slot(ENTRY, ICE, which=which) for which in (0, 1))
    low, high = sorted((shop.slots[first], shop.slots[second]), key=lambda slot: slot.y)
    middle = 0.5 * (low.y + high.y)
    for p in shop.own(ICE)[2:]:
        shop.slots[shop.pallets[p].at].pallet, shop.pallets[p].exists = 0, 0
    shop.rails.poses[0] = (low.x + 0.5 * (high.y - low.y), middle, pi)
    shop.tick()
    for turn in (1.0, -1.0):  # clockwise, from facing left: upwards
        guide = Guide()
        guide.helped_stick(shop.state, 0, 1.0, turn)
        drifting = guide.helped_stick(shop.state, 0, 1.0, 0.0)[1]
        assert drifting * turn > 0.0


def test_a_turn_away_from_the_way_counts_less_and_one_towards_it_in_full():
    shop = Shop("hall", 4)
    s = shop.slot(ENTRY, ICE)
    shop.rails.poses[0] = (shop.slots[s].x + 400.0, shop.slots[s].y, pi - 0.8)  # the slot is to its right
    shop.tick()
    right, left = (Guide().helped_stick(shop.state, 0, 1.0, turn)[1] for turn in (1.0, -1.0))
    assert right == 1.0
    assert left > 0.0


def test_the_stick_stays_in_its_range_and_the_match_is_not_changed():
    shop = Shop()
    for heading in (-2.0, 0.0, 0.7, 2.0):
        for s in range(0, 16, 3):
            shop.stand(0, s, 130.0, heading)
            shop.tick()
            before = digest(shop.state)
            for linear in (-1.0, 0.0, 0.5, 1.0):
                for angular in (-1.0, 0.0, 1.0):
                    stick = Guide().helped_stick(shop.state, 0, linear, angular)
                    assert all(-1.0 <= value <= 1.0 for value in stick)
            assert digest(shop.state) == before


def test_a_new_match_begins_anew():
    guide, first, second = Guide(), alone("human", "hall"), alone("human", "yard")
    for match in (first, second):
        match.tick()
    guide.helped_stick(first.state, 0, 1.0, 0.0)
    assert guide.helped_stick(second.state, 0, 1.0, 0.0) == Guide().helped_stick(second.state, 0, 1.0, 0.0)


def test_a_helped_person_drives_by_the_helped_stick_of_the_style():
    driving, stick = AIS["factory"].driving, StickState(0.5, 0.75, False, True)
    for name, style in ((HELPED_TURN, driving[TURN]), (HELPED_POINT, driving[POINT])):
        shop = Shop()
        shop.stand(0, shop.slot(ENTRY, ICE), 200.0)
        shop.tick()
        HumanPlayer(lambda: stick, driving[name]).think(shop.state, 0)
        action = shop.state.actions[0]
        expected = Guide().helped_stick(shop.state, 0, *style(shop.state, 0, stick))
        assert (action.linear, action.angular) == tuple(map(quantise, expected))
        assert (action.fire, action.turbo) == (0, 1)
