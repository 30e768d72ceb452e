"""Moments of a match that are worth showing again: its last point, a close finish, a streak of points."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

from pigaming_app.games.game import ALONE
from pigaming_app.games.match import Match
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.schema import Count, Finite, between, one_of

LAST, CLOSE, STREAK = "last", "close", "streak"
KINDS = (LAST, CLOSE, STREAK)
CLOSE_POINTS = 1  # largest lead, in points, of a close finish
CLOSE_SECONDS = 1.0  # s, largest lead of a close finish of a match for a goal
STREAK_POINTS, STREAK_SECONDS = 3, 6.0  # a streak: so many points of one robot within so many s


@dataclass(frozen=True)
class Moment:
    """One of KINDS, its tick, its robot, and for a close finish the lead in points or s."""

    kind: Annotated[str, one_of(*KINDS)]
    tick: Count
    seat: Annotated[int, between(0, ROBOTS - 1)]
    lead: Finite = 0.0


def moments(match: Match) -> tuple[Moment, ...]:
    """The moments of a finished match, at most one of each kind; none of an unfinished one."""
    points = sorted((seconds, seat) for seat in range(len(match.series)) for seconds in _points(match, seat))
    if not match.over or not points:
        return ()
    found = [Moment(LAST, round(points[-1][0] * HZ), points[-1][1])]
    return (*found, *_close(match, *points[-1]), *_streak(match))


def _points(match: Match, seat: int) -> list[float]:
    """The times, s, at which a robot scored; one entry for each point."""
    line = match.series[seat]
    return [after for (_, old), (after, new) in pairwise(line) for _ in range(new - old)]


def _close(match: Match, last: float, scorer: int) -> list[Moment]:
    """The finish, if the second was close behind the winner: in a match without teams by time, else by points."""
    if match.game.variants[match.setup.variant].team_mode == ALONE:
        seats = [seat for seat in range(len(match.series)) if _done(match, seat)]
        arrivals = sorted((_points(match, seat)[-1], seat) for seat in seats)
        if len(arrivals) < 2 or arrivals[1][0] - arrivals[0][0] > CLOSE_SECONDS:
            return []
        return [Moment(CLOSE, round(arrivals[0][0] * HZ), arrivals[0][1], arrivals[1][0] - arrivals[0][0])]
    outcome = match.outcome()
    teams = list(dict.fromkeys(row.team for row in outcome.rows))
    if not outcome.winners or len(teams) < 2:
        return []
    first, second = (sum(row.score for row in outcome.rows if row.team == team) for team in teams[:2])
    return [Moment(CLOSE, round(last * HZ), scorer, float(first - second))] if first - second <= CLOSE_POINTS else []


def _done(match: Match, seat: int) -> bool:
    """True if the robot has scored and reached the goal of the match on its own."""
    return bool(match.state.robots[seat].score >= max(1, match.setup.goal))


def _streak(match: Match) -> list[Moment]:
    """The last streak of the match."""
    ends = []
    for seat in range(len(match.series)):
        times = _points(match, seat)
        for first, last in zip(times, times[STREAK_POINTS - 1 :], strict=False):
            if last - first <= STREAK_SECONDS:
                ends.append((last, seat))
    return [Moment(STREAK, round(when * HZ), seat) for when, seat in sorted(ends)[-1:]]
