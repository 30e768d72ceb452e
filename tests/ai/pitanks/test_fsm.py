"""The hand-written opponent of PiTanks: ordered strengths, and never stuck."""

from collections import deque
from math import hypot

import pytest

from pigaming_app.ai.experiments.league import duel, wilson
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ
from tests.cases import one_in

STUCK_SECONDS, STUCK_PX = 3.0, 10.0


def test_hard_beats_easy():
    result = duel("pitanks", "hard", "easy", matches=12, seed=100, minutes=1.0, variant="plain", fast=False)
    assert result.wins > result.losses
    assert result.mean_score_left > 0


def test_fsm_beats_random():
    """Of 100 such matches it won 73 and lost 5 when measured; here it must win more than half of those decided."""
    result = duel("pitanks", "fsm", "random", matches=40, seed=200, minutes=1.0, variant="plain", fast=False)
    assert wilson(result.wins, result.wins + result.losses)[0] > 0.5
    assert result.mean_score_left > 0


@pytest.mark.parametrize("strength", ["easy", "normal", "hard"])
def test_every_strength_thinks_without_changing_anything_but_its_action(strength):
    one, two, three, four = (Seat(strength, team) for team in range(4))
    match = Match(Setup("pitanks", "classic", (one, two, three, four), 1.0, 1, "pickups"))
    brain = make_brain("pitanks", strength, 1)
    action = match.state.actions[0]
    before = digest(match.state)
    brain.think(match.state, 0)
    action.linear = action.angular = 0.0
    action.fire = action.turbo = 0
    assert digest(match.state) == before


def stuck(arena, seed, strengths):
    """(seat, second, x, y) whenever a seat held its stick for 3 s and moved less than 10 px.

    Against an opponent that is in contact it may push for long: such times do not count.
    """
    one, two, three, four = (Seat(brain, team) for team, brain in enumerate(strengths))
    match = Match(Setup("pitanks", arena, (one, two, three, four), 1.0, seed, "pickups"))
    for seat, brain in enumerate(strengths):
        if brain != "off":
            match.sit(seat, make_brain("pitanks", brain, seed * 4 + seat))
    trails = [deque(maxlen=round(STUCK_SECONDS * HZ)) for _ in range(4)]
    times = []
    while not match.over:
        match.tick()
        robots = match.state.robots
        for seat, trail in enumerate(trails):
            robot = robots[seat]
            if not robot.present:
                continue
            crowded = any(
                other is not robot and other.present and hypot(other.x - robot.x, other.y - robot.y) < 80.0
                for other in robots
            )
            if match.state.actions[seat].linear == 0.0 or crowded:
                trail.clear()
                continue
            trail.append((robot.x, robot.y))
            if len(trail) == trail.maxlen:
                x, y = trail[0]
                if max(hypot(a - x, b - y) for a, b in trail) < STUCK_PX:
                    times.append((seat, match.seconds, round(robot.x), round(robot.y)))
                    trail.clear()
    return times


@pytest.mark.parametrize("arena", one_in(3, arenas("pitanks")))
def test_nobody_is_stuck(arena):
    for seed in (1, 2):
        assert stuck(arena, seed, ("hard", "normal", "easy", "fsm")) == []
        assert stuck(arena, seed, ("normal", "normal", "off", "off")) == []
