"""Duels and leagues: Wilson's interval, and pairing that favours neither seed nor side."""

from math import sqrt

import pytest

from pigaming_app.ai.learning import league
from pigaming_app.ai.learning.league import duel, wilson
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import digest


@pytest.mark.parametrize(("wins", "low", "high"), [(100, 0.963, 1.0), (0, 0.0, 1 - 0.963)])
def test_hundred_wins_of_hundred_say_at_least_96_percent_and_none_the_mirror(wins, low, high):
    assert wilson(wins, 100) == pytest.approx((low, high), abs=5e-4)


def test_half_of_hundred_is_ten_percent_either_way():
    # Wilson at 1/2: z sqrt(n + z^2) / (2 (n + z^2))
    z = 1.959964
    low, high = wilson(50, 100)
    assert high - 0.5 == pytest.approx(z / (2 * sqrt(100 + z * z)))
    assert low + high == pytest.approx(1.0)


def test_more_matches_say_more():
    widths = [high - low for low, high in (wilson(n // 2, n) for n in (10, 100, 1000))]
    assert widths == sorted(widths, reverse=True)


def test_a_duel_with_oneself_is_even():
    """Both matches of a pair are identical, so a win on one side is a loss on the other."""
    result = duel("pitanks", "fsm", "fsm", matches=8, seed=5, minutes=0.5, variant="plain", fast=False)
    assert result.wins == result.losses
    assert result.mean_score_left == result.mean_score_right
    assert result.wins + result.ties + result.losses == 8


class Rigged:
    """A batch in which the first seat wins every match by 3 to 1."""

    seen: list[tuple[list[str], list[int]]]

    def __init__(self, setups, kinds, fast, twin):
        self.setups = setups
        assert twin is None or twin.setups[: len(setups)] == setups
        self.seen.append(([kind.name for kind in kinds], [setup.seed for setup in setups]))

    def play(self, ticks):
        assert ticks == (2 * 60 + 30) * 50, "with the overtime of party"

    def ticks(self):
        return 1

    def ended(self):
        states = []
        for setup in self.setups:
            state = games()[setup.game].state()
            for robot, seat, score in zip(state.robots, setup.seats, (3, 1, 0, 0), strict=True):
                robot.present, robot.team, robot.score = int(seat.brain != "off"), seat.team, score
            states.append(state)
        return states


def test_each_seed_is_played_from_both_sides(monkeypatch):
    monkeypatch.setattr(league, "Batch", Rigged)
    Rigged.seen = []
    result = duel("pitanks", "hand1", "hand3", matches=6, seed=7, fast=False)
    assert Rigged.seen == [(["hand1", "hand3"], [7, 8, 9]), (["hand3", "hand1"], [7, 8, 9])]
    assert (result.wins, result.losses, result.ties) == (3, 3, 0)
    assert result.mean_score_left == result.mean_score_right == 2.0


@pytest.mark.parametrize(
    "fast", [False, pytest.param(True, marks=pytest.mark.skipif(not can_compile(), reason="numba"))]
)
def test_a_twin_starts_with_equal_matches_of_its_own(fast):
    setups = league._setups("pitanks", "hand1", "hand3", 6, 7, None, None, "party", None)
    first = Batch(setups[::2], [], fast)
    again, twin = Batch(setups[1:5:2], [], fast), Batch(setups[1:5:2], [], fast, twin=first)
    before = [digest(match) for match in first.ended()]
    assert [digest(match) for match in twin.ended()] == [digest(match) for match in again.ended()] == before[:2]
    if fast:
        twin.matches["robots"]["score"] = 1
    else:
        twin.matches[0].robots[0].score = 1
    assert digest(twin.ended()[0]) != before[0]
    assert [digest(match) for match in first.ended()] == before


def test_left_and_right_swapped_is_the_same_duel_seen_from_the_other_side():
    one = duel("pitanks", "random", "idle", matches=8, seed=3, minutes=0.5, variant="plain", fast=False)
    other = duel("pitanks", "idle", "random", matches=8, seed=3, minutes=0.5, variant="plain", fast=False)
    assert (one.wins, one.ties, one.losses) == (other.losses, other.ties, other.wins)
    assert one.mean_score_left == other.mean_score_right
    assert one.wilson95 == wilson(one.wins, 8)


def test_a_brain_that_is_not_there_is_refused():
    with pytest.raises(ChoiceError, match="no seat 'genius'"):
        duel("pitanks", "genius", "random", matches=2, seed=1)


def test_allies_play_the_same_seeds_alone_and_the_better_time_wins():
    won, even = (
        duel("factory", "level5", other, matches=1, seed=7, goal=4, minutes=1.0, variant="together", fast=False)
        for other in ("idle", "level5")
    )
    assert (won.wins, won.ties, won.losses) == (1, 0, 0)
    assert (won.mean_score_left, won.mean_score_right) == (4.0, 0.0)
    assert (even.wins, even.ties, even.losses) == (0, 1, 0)


# ------------------------------------------------------------------------------------------------------------- leagues


def test_a_league_is_every_pairs_duel_over_the_same_seeds(monkeypatch):
    monkeypatch.setattr(league, "Batch", Rigged)
    Rigged.seen = []
    found = league.league("pitanks", ["hand1", "hand3", "idle"], matches=4, seed=7, fast=False)
    pairs = [("hand1", "hand3"), ("hand1", "idle"), ("hand3", "idle")]
    assert [(one.left, one.right) for one in found.duels] == pairs
    both = [([a, b], [7, 8]) for left, right in pairs for a, b in ((left, right), (right, left))]
    assert Rigged.seen == both
    assert [(one.wins, one.ties, one.losses, one.mean_score) for one in found.standings] == [(4, 0, 4, 2.0)] * 3
    assert [one.rating.rating for one in found.standings] == [0.0] * 3


@pytest.mark.parametrize(("game", "minutes"), [("pitanks", 0.5), ("race", 0.5)])
def test_a_league_puts_who_plays_before_who_stands_still(game, minutes):
    found = league.league(game, ["idle", "level5", "random"], matches=2, seed=1, minutes=minutes, fast=False)
    assert found.standings[0].brain == "level5"
    assert {one.brain for one in found.standings} == {"idle", "level5", "random"}
    for standing in found.standings:
        assert standing.rating.low <= standing.rating.rating <= standing.rating.high
        assert standing.wins + standing.ties + standing.losses == 4
    alone = duel(game, "idle", "level5", matches=2, seed=1, minutes=minutes, fast=False)
    first = found.duels[0]
    assert (alone.wins, alone.ties, alone.losses) == (first.wins, first.ties, first.losses)
    assert alone.mean_score_right == first.mean_score_right


@pytest.mark.parametrize(
    ("brains", "said"),
    [
        ([], "two brains or more"),
        (["level5"], "two brains or more"),
        (["level5", "idle", "level5"], "'level5' is named twice"),
        (["level5", "genius"], "no brain 'genius'"),
    ],
)
def test_what_is_no_league_is_refused(brains, said):
    with pytest.raises(ChoiceError, match=said):
        league.league("pitanks", brains, matches=2, seed=1)


@pytest.mark.parametrize("matches", [0, -3, 10**9])
def test_more_matches_than_fit_into_memory_and_none_at_all_are_refused(matches):
    with pytest.raises(ChoiceError, match="--matches"):
        league.duel("pitanks", "idle", "idle", matches=matches, seed=1)
