"""The variant together: one team against the clock, with stars."""

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.factory import GAME as FACTORY
from pigaming_app.games.factory.stars import THREE_STARS, TWO_STARS, expected_time, way
from pigaming_app.games.factory.state import DELIVERED, DONE, ENTRY, EXIT, ICE, IN_SLOT, SHIPPED, WAITING
from pigaming_app.games.replay import decode, encode, verify
from pigaming_app.games.setup import ChoiceError, make_setup
from pigaming_app.sim.world import HZ
from tests.cases import one_in
from tests.games.factory.shop import Shop
from tests.games.factory.test_pallets import Watch
from tests.matches import finished, match_of

FLOORS = arenas("factory")


def allies(pallets=4, **options):
    return Shop(variant="together", pallets=pallets, **options)


def right(shop, kind, which=0):
    """A slot of the warehouses on the other side."""
    return [s for s, one in enumerate(shop.slots) if (one.kind, one.machine) == (kind, -1) and s < 16][4 + which]


def deliver(shop, seat, s):
    """Deliver another pallet in slot s."""
    p = next(
        p for p, pallet in enumerate(shop.pallets) if pallet.exists and pallet.place == IN_SLOT and pallet.state < 2
    )
    shop.pallets[p].state = DONE
    shop.carry(seat, shop.pallets[p].at, s)


def test_everything_belongs_to_everybody_and_lies_in_both_entries():
    shop = allies(5)
    assert {robot.team for robot in shop.state.robots} == {ICE}
    there = [pallet for pallet in shop.pallets if pallet.exists]
    assert [pallet.team for pallet in there] == [ICE] * 5
    assert sorted(pallet.at for pallet in there) == [0, 1, 2, 8, 9]
    for seat in range(4):
        assert shop.press(seat, there[seat].at)


@pytest.mark.parametrize("side", [0, 1])
def test_either_exit_takes_what_is_done(side):
    shop = allies(5)
    deliver(shop, 3, shop.slot(EXIT, ICE) if side == 0 else right(shop, EXIT))
    assert (shop.state.delivered, shop.loads[3].delivered) == ([1, 0], 1)
    assert not shop.match.over


def test_a_full_exit_is_cleared_on_its_own_side():
    shop = allies(12)
    for k in range(4):
        deliver(shop, 0, right(shop, EXIT, k))
    shipped = [pallet for pallet in shop.pallets if pallet.place == SHIPPED]
    assert [(pallet.state, pallet.at) for pallet in shipped] == [(DELIVERED, 1)]
    assert shop.state.delivered == [4, 0]
    waiting = [pallet.at for pallet in shop.pallets if pallet.exists and pallet.place == WAITING]
    assert waiting == [1, 1], "those of the other entry, which is still full"


def finish(shop, tick):
    """Deliver all four pallets, the last one at a tick."""
    for k in range(3):
        deliver(shop, k, shop.slot(EXIT, ICE, which=k))
    p = next(p for p, pallet in enumerate(shop.pallets) if pallet.exists and pallet.state < DONE)
    assert shop.press(3, shop.pallets[p].at)
    shop.pallets[p].state = DONE
    shop.stand(3, right(shop, EXIT))
    shop.state.tick = tick - 1
    shop.match.brains[3].fire = 1
    shop.tick()


@pytest.mark.parametrize(("late", "stars"), [(0, 3), (1, 2)])
@pytest.mark.parametrize("limit", ["three_stars", "two_stars"])
def test_stars_by_the_tick(limit, late, stars):
    shop = allies()
    finish(shop, getattr(shop.state.rules, limit) + late)
    assert shop.match.over
    assert shop.state.stars == stars - (limit == "two_stars")
    outcome = shop.match.outcome()
    assert sorted(outcome.winners) == [0, 1, 2, 3]
    assert {row.place for row in outcome.rows} == {1}
    assert all(row.records["time"] == 20 * shop.state.tick for row in outcome.rows)


def test_without_everything_delivered_there_is_no_star_and_no_winner():
    shop = allies(minutes=0.1)
    deliver(shop, 0, shop.slot(EXIT, ICE))
    shop.until(lambda: shop.match.over)
    outcome = shop.match.outcome()
    assert (shop.state.stars, outcome.winners) == (0, ())
    assert not any(row.records for row in outcome.rows)


def test_the_sooner_the_better_and_all_is_better_than_some():
    keys = []
    for tick in (3000, 4000):
        shop = allies()
        finish(shop, tick)
        keys.append(FACTORY.ranking_key(shop.state, 2))
    shop = allies(minutes=0.1)
    deliver(shop, 0, shop.slot(EXIT, ICE))
    shop.until(lambda: shop.match.over)
    keys.append(FACTORY.ranking_key(shop.state, 0))
    assert keys[0] > keys[1] > 0.0 > keys[2] > FACTORY.ranking_key(allies().state, 0)


# ----------------------------------------------------------------------------------------------------------- the limits


@pytest.mark.parametrize("floor", FLOORS)
def test_limits_follow_the_number_of_robots_and_pallets(floor):
    plan = load("factory", floor).plan
    assert 900.0 < way(plan) < 2200.0
    alone = [expected_time(plan, 1, pallets) for pallets in (4, 8, 12)]
    assert alone == sorted(alone)
    assert expected_time(plan, 2, 8) < 0.7 * expected_time(plan, 1, 8)
    assert expected_time(plan, 4, 8) == expected_time(plan, 3, 8), "then the machines are the limit"
    for present in ((0,), (0, 3), (0, 1, 2, 3)):
        rules = allies(8, arena=floor, present=present).state.rules
        expected = expected_time(plan, len(present), 8) * HZ
        assert (rules.three_stars, rules.two_stars) == (round(THREE_STARS * expected), round(TWO_STARS * expected))


@pytest.mark.parametrize("floor", one_in(3, FLOORS))
@pytest.mark.parametrize("brains", one_in(3, ["hand3 hand3 hand3 hand3", "hand3 off off off", "hand3 hand1 hand2 off"]))
def test_ais_deliver_everything_and_nothing_is_lost(floor, brains):
    match = match_of("factory", brains, floor, 5.0, 5, "together", 6)
    watch = Watch(match.state)
    while not match.over:
        match.tick()
        if match.state.tick % 5 == 0:
            watch.look()
    least = 1 if "hand1" in brains else 3
    assert match.state.stars >= least
    assert len(match.outcome().winners) == 4 - brains.split().count("off")


@pytest.mark.long
def test_four_easy_ones_get_a_star_on_every_floor():
    for floor in FLOORS:
        assert 1 <= finished(match_of("factory", ["hand1"] * 4, floor, 5.0, 5, "together", 8)).state.stars <= 2


# --------------------------------------------------------------------------------------------------------- who may play


@pytest.mark.parametrize("brains", [["hand3"], ["hand3", "hand1"], ["off", "hand3", "off", "hand1"], ["hand3"] * 4])
def test_one_to_four_robots_play_together(brains):
    setup = make_setup("factory", brains, None, None, 1, "together", None, ["hand3", "hand1"])
    assert {seat.team for seat in setup.seats} == {0}
    assert (setup.goal, setup.minutes) == (8, 5.0)


@pytest.mark.parametrize(
    ("brains", "teams", "reason"),
    [
        (["hand3", "hand3"], (0, 1, 0, 1), "all robots are in team 0"),
        (["hand3", "hand3"], (1, 1, 1, 1), "all robots are in team 0"),
        (["off"], None, "at least one seat"),
    ],
)
def test_but_not_in_two_teams_and_not_nobody(brains, teams, reason):
    with pytest.raises(ChoiceError, match=reason):
        make_setup("factory", brains, None, None, 1, "together", teams, ["hand3"])


def test_one_robot_alone_cannot_play_standard():
    with pytest.raises(ChoiceError, match="two seats"):
        make_setup("factory", ["hand3"], None, None, 1, "standard", None, ["hand3"])


@pytest.mark.parametrize("variant", ["party", "together"])
def test_a_replay_of_a_variant_can_be_verified(variant):
    match = finished(match_of("factory", ["hand3"] * 4, "yard", 0.2, 3, variant), 15.0)
    assert verify(decode(encode(match), "match.replay"))


def test_an_entry_slot_may_be_used_to_put_a_pallet_back_on_either_side():
    shop = allies(3)
    p = shop.carry(0, shop.slot(ENTRY, ICE), right(shop, ENTRY, 3))
    assert (shop.pallets[p].place, shop.pallets[p].at) == (IN_SLOT, right(shop, ENTRY, 3))
