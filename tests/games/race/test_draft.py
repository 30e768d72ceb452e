"""Robot Race, `draft`: slipstream and boost pads for the last of several, and nothing for the others."""

import pytest

from pigaming_app.games.match import Match
from tests.games.race.test_party import put
from tests.matches import Stick, match_of, setup_of

ORDERS = [(0, 1, 2, 3), (3, 1, 0, 2), (2, 3, 1, 0)]  # seats, the leader first


def race(order, variant="draft"):
    """A race in which the robots of these seats stand on a straight in this order, 100 px apart; the rest is off."""
    brains = ["idle" if seat in order else "off" for seat in range(4)]
    match = Match(setup_of("race", brains, "classic", 10.0, 1, variant, 3))
    for place, seat in enumerate(order):
        _, racer = put(match, seat, 2900.0 + 100.0 * (len(order) - place))
        racer.progress = racer.left = 0.0
        racer.last_x, racer.last_y = match.state.robots[seat].x, match.state.robots[seat].y
        racer.passed = 1 + 4 * 2 if place + 1 < len(order) else 0  # laps ahead, but for the last
    return match


@pytest.mark.parametrize("order", ORDERS)
def test_only_the_last_has_a_slipstream(order):
    slipping = {}
    for variant in ("draft", "party"):
        match = race(order, variant)
        for robot in match.state.robots:
            robot.linear, robot.turbo = 300.0, 0.2
        match.tick()
        assert match.state.racers[order[-1]].rank == 4
        slipping[variant] = {seat for seat in range(4) if match.state.racers[seat].slip}
    assert slipping == {"draft": {order[-1]}, "party": {*order[1:]}}


@pytest.mark.parametrize("order", [*ORDERS, (1, 3), (2, 0, 1)])
def test_only_the_last_has_the_pads(order):
    for seat in order:
        match = race(order)
        match.sit(seat, Stick())
        pad = match.state.pads[0]
        put(match, seat, pad.along, pad.aside)
        racer = match.state.racers[seat]
        racer.last_x, racer.last_y = match.state.robots[seat].x, match.state.robots[seat].y
        match.tick()
        assert (racer.rank == len(order)) == bool(racer.surge) == (seat == order[-1])


def test_who_drives_alone_is_not_last():
    match = match_of("race", ["idle", "off", "off", "off"], variant="draft")
    pad = match.state.pads[1]
    put(match, 0, pad.along, pad.aside)
    match.tick()
    assert not match.state.racers[0].surge


@pytest.mark.parametrize("track", ["classic", "kidney"])
def test_all_else_is_as_in_standard(track):
    draft, standard = (
        match_of("race", ["idle"] * 4, track, variant=variant).state for variant in ("draft", "standard")
    )
    assert draft.rules.mud == standard.rules.mud
    assert [(r.x, r.y, r.heading) for r in draft.robots] == [(r.x, r.y, r.heading) for r in standard.robots]
    assert [racer.line for racer in draft.racers] == [racer.line for racer in standard.racers]
    assert len({(round(pad.x), round(pad.y)) for pad in draft.pads}) == 3
    assert all((box.x, box.y) == (0.0, 0.0) for box in draft.boxes)


def test_no_boxes_and_no_oil():
    match = race(ORDERS[0])
    robot = match.state.robots[3]
    robot.x, robot.y = 0.0, 0.0  # where boxes of no course would lie
    match.tick()
    assert not any(racer.item or racer.spin for racer in match.state.racers)
