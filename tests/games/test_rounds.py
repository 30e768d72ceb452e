"""Rounds: rounds won decide, then points; single rounds make the records."""

import pytest

from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.rounds import Rounds


def played(scores: dict[int, int], teams: dict[int, int] | None = None) -> Outcome:
    """A round with these points; the team with most points wins, unless two are level."""
    teams = teams or {seat: seat for seat in scores}
    sums = {team: sum(scores[seat] for seat in scores if teams[seat] == team) for team in teams.values()}
    best = [team for team, points in sums.items() if points == max(sums.values())]
    rows = tuple(
        Row(seat, teams[seat], 1, scores[seat], {}, {"points": scores[seat]}, ())
        for seat in sorted(scores, key=lambda seat: -sums[teams[seat]])
    )
    winners = tuple(seat for seat in scores if teams[seat] == best[0]) if len(best) == 1 else ()
    return Outcome(rows, winners, (), 60.0)


def rounds(*outcomes: Outcome) -> Rounds:
    result = Rounds(3)
    for outcome in outcomes:
        assert not result.done
        result.add(outcome)
    return result


def places(result: Rounds) -> list[tuple[int, int]]:
    return [(row.place, row.seat) for row in result.outcome().rows]


def test_two_of_three_rounds_decide_before_the_third() -> None:
    assert not rounds(played({0: 3, 1: 1})).done
    result = rounds(played({0: 3, 1: 1}), played({0: 2, 1: 1}))
    assert result.done
    assert result.outcome().winners == (0,)
    assert result.outcome().seconds == 120.0


def test_a_round_won_counts_more_than_many_points() -> None:
    result = rounds(played({0: 1, 1: 0}), played({0: 0, 1: 50}), played({0: 1, 1: 0}))
    assert result.done
    assert places(result) == [(1, 0), (2, 1)]
    assert [row.score for row in result.outcome().rows] == [2, 50]


def test_among_equals_the_points_of_all_rounds_decide() -> None:
    result = rounds(played({0: 5, 1: 4, 2: 3}), played({0: 0, 1: 4, 2: 1}), played({0: 1, 1: 2, 2: 9}))
    assert result.done, "after three rounds, although nobody has won two"
    assert places(result) == [(1, 2), (2, 1), (3, 0)]
    assert result.outcome().winners == (2,)


def test_level_in_everything_is_a_tie() -> None:
    result = rounds(played({0: 2, 1: 1, 2: 0}), played({0: 1, 1: 2, 2: 0}), played({0: 1, 1: 1, 2: 0}))
    assert result.outcome().winners == ()
    assert places(result) == [(1, 0), (1, 1), (3, 2)]


def test_tied_rounds_are_won_by_nobody() -> None:
    result = rounds(played({0: 1, 1: 1}), played({0: 1, 1: 1}))
    assert not result.done
    assert dict(result.wins()) == {0: 0, 1: 0}
    result.add(played({0: 1, 1: 0}))
    assert result.done
    assert result.outcome().winners == (0,)


def test_teams_win_rounds_together() -> None:
    teams = {0: 0, 1: 1, 2: 0, 3: 1}
    result = rounds(
        played({0: 9, 1: 1, 2: -3, 3: 2}, teams),
        played({0: 0, 1: 1, 2: 0, 3: 0}, teams),
        played({0: 0, 1: 1, 2: 0, 3: 4}, teams),
    )
    assert dict(result.wins()) == {0: 1, 1: 2, 2: 1, 3: 2}
    assert result.outcome().winners == (1, 3)
    assert places(result) == [(1, 3), (1, 1), (3, 0), (3, 2)]


def test_a_record_is_the_best_round_that_counts() -> None:
    result = Rounds(3)
    result.add(played({0: 9, 1: 8}), assisted=[0])
    result.add(played({0: 3, 1: 5}))
    result.add(played({0: 4, 1: 2}))
    records = {row.seat: row.records for row in result.outcome().rows}
    assert records == {0: {"points": 4}, 1: {"points": 8}}


@pytest.mark.parametrize(("best_of", "needed"), [(1, 1), (3, 2), (5, 3)])
def test_most_of_the_rounds_are_needed(best_of: int, needed: int) -> None:
    assert Rounds(best_of).needed == needed
