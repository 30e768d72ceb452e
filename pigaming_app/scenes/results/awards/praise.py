"""A kind word for the last place: how close it was, or what the player was best at."""

from collections.abc import Mapping, Sequence

from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.awards.award import Award
from pigaming_app.scenes.results.awards.feats import Feats
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.ui.i18n import Words

CLOSE_POINTS, CLOSE_SECONDS = 3, 5.0  # the largest gap to the next place that is called close


def places(outcome: Outcome) -> dict[int, int]:
    """The place of each seat, 1 is best; a team counts as one."""
    teams = {row.team: row.place for row in outcome.rows}
    return {row.seat: 1 + sum(place < row.place for place in teams.values()) for row in outcome.rows}


def last_seats(outcome: Outcome) -> list[int]:
    """The seats in the last place, if there are others before it."""
    place = places(outcome)
    last = max(place.values())
    return [seat for seat in place if place[seat] == last] if last > 1 else []


def praises(words: Words, ended: EndedMatch, awards: Mapping[int, Award], feats: Mapping[int, Feats]) -> dict[int, str]:
    """A sentence for each seat in the last place; those of a team have different ones."""
    said: dict[int, str] = {}
    for seat in last_seats(ended.outcome):
        led = feats.get(seat, {}).get("led")
        choices = [
            _close(words, ended, seat),
            words("awards.led") if led else "",
            _best_at(words, awards[seat], feats.get(seat, {})),
        ]
        said[seat] = next((one for one in choices if one and one not in said.values()), choices[-1])
    return said


def _best_at(words: Words, award: Award, feats: Feats) -> str:
    """What the player was best at; after an award that compares nobody, the way driven."""
    if award.figure:
        return words(key if (key := f"awards.{award.key}_praise") in words else "awards.praise")
    meters = round(feats.get("meters", 0.0))
    return words("awards.driven", meters=meters) if meters else words("awards.thanks")


def _close(words: Words, ended: EndedMatch, seat: int) -> str:
    """The gap to the next better place in points or s, if it was small; else empty."""
    outcome, place = ended.outcome, places(ended.outcome)
    better = max(place[other] for other in place if place[other] < place[seat])
    own = [row for row in outcome.rows if place[row.seat] == place[seat]]
    next_ones = [row for row in outcome.rows if place[row.seat] == better]
    if games()[ended.setup.game].timed:
        return _close_in_time(words, ended.setup.goal, own[0], next_ones[0])
    gap = _points(next_ones) - _points(own)
    return words.counted("awards.close", gap, count=gap) if 0 < gap <= CLOSE_POINTS else ""


def _close_in_time(words: Words, goal: int, own: Row, other: Row) -> str:
    gap = sum(own.times) - sum(other.times)
    both = len(own.times) == len(other.times) == goal
    return words("awards.close_time", seconds=f"{gap:.1f}") if both and 0.05 <= gap <= CLOSE_SECONDS else ""


def _points(rows: Sequence[Row]) -> int:
    """The points of the first team among these rows."""
    return sum(row.score for row in rows if row.team == rows[0].team)
