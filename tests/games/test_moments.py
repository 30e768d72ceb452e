"""Moments of a match: its last point, a close finish, a streak."""

import pytest

from pigaming_app.games.match import Match
from pigaming_app.games.moments import CLOSE, LAST, STREAK, Moment, moments
from pigaming_app.games.setup import make_setup


def finished(game: str, points: dict[int, list[float]], teams: list[int] | None = None) -> Match:
    """A match that is over, in which these seats scored at these times, s."""
    match = Match(make_setup(game, ["idle"] * 4, None, None, 1, None, teams, ["idle"]))
    for seat, times in points.items():
        match.series[seat] += [(seconds, i + 1) for i, seconds in enumerate(times)]
        match.state.robots[seat].score = len(times)
    match.state.over = 1
    return match


def test_nothing_happened() -> None:
    assert moments(finished("pitanks", {})) == ()


def test_a_match_that_was_ended_has_none() -> None:
    match = finished("pitanks", {0: [3.0]})
    match.state.over = 0
    assert moments(match) == ()


def test_the_last_point_and_a_close_finish() -> None:
    assert moments(finished("pitanks", {0: [10.0, 50.0], 1: [20.0]})) == (
        Moment(LAST, 2500, 0),
        Moment(CLOSE, 2500, 0, 1.0),
    )


@pytest.mark.parametrize("points", [{0: [10.0, 20.0, 30.0], 1: [15.0]}, {0: [10.0], 1: [20.0]}])
def test_a_clear_win_and_a_tie_are_no_close_finish(points: dict[int, list[float]]) -> None:
    assert [moment.kind for moment in moments(finished("pitanks", points))] == [LAST]


def test_a_point_lost_is_no_moment() -> None:
    match = finished("pitanks", {0: [9.0, 10.0]})
    match.series[1].append((55.0, -1))
    match.state.robots[1].score = -1
    assert moments(match) == (Moment(LAST, 500, 0),)


def test_teams_finish_close_by_their_sums() -> None:
    match = finished("pitanks", {0: [1.0, 20.0], 2: [30.0], 1: [40.0, 50.0]}, [0, 1, 0, 1])
    assert Moment(CLOSE, 2500, 1, 1.0) in moments(match)


@pytest.mark.parametrize(("times", "streak"), [([10.0, 12.0, 16.0], True), ([10.0, 12.0, 16.1], False)])
def test_three_points_within_six_seconds_are_a_streak(times: list[float], streak: bool) -> None:
    found = moments(finished("pitanks", {2: times}))
    assert (Moment(STREAK, 800, 2) in found) == streak


@pytest.mark.parametrize(("gap", "close"), [(0.9, True), (1.1, False)])
def test_a_race_is_close_by_time(gap: float, close: bool) -> None:
    laps = [20.0, 40.0, 60.0, 80.0, 100.0]
    found = moments(finished("race", {0: laps, 3: [*laps[:-1], 100.0 + gap], 1: [30.0]}))
    assert [moment.seat for moment in found if moment.kind == CLOSE] == ([0] if close else [])
    assert all(moment.lead == pytest.approx(gap) for moment in found if moment.kind == CLOSE)
