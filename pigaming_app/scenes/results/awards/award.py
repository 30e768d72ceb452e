"""The awards, and who gets which: each player one, all different, that at which the player stands out most.

An award says what is true: it goes to the player with the most of a figure, or the least. Who has the most of nothing
gets one that compares nobody.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from random import Random
from statistics import fmean, pstdev

from pigaming_app.games.game import Outcome, Row
from pigaming_app.games.registry import games
from pigaming_app.scenes.results.awards.feats import Feats
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.i18n import Words

SHARED = 0.3  # weight of an award that two players have earned alike
LEAD = 0.1  # weight of the relative lead beside that of the standard score
CLOSE_POINTS, CLOSE_SECONDS = 3, 5.0  # the largest gap to the next place that is called close


@dataclass(frozen=True)
class Award:
    """`key`: of its text, `awards.KEY`; `figure`: what it is read from, empty: nothing; `least`: the least counts;
    `above`: what the figure must exceed; `weight`: a skill counts more than a habit.
    """

    key: str
    icon: str
    figure: str = ""
    least: bool = False
    above: float = -1.0
    weight: float = 1.0


@dataclass(frozen=True)
class Player:
    """One who gets an award. `place`: 1 is best; `figures`: statistics of the game and feats, by name."""

    seat: int
    person: bool
    place: int
    figures: Mapping[str, float]


GENERAL = (
    Award("first", "first", "first", least=True),
    Award("escape", "shield", "escape", above=5.0),
    Award("comeback", "rebound", "comeback", above=0.0),
    Award("finish", "up", "finish", above=0.0),
    Award("fastest", "clock", "fastest", least=True),
    Award("even", "even", "spread", least=True),
    Award("distance", "road", "distance", above=400.0, weight=0.9),
    Award("turbo", "speed", "turbo", above=1.0, weight=0.8),
    Award("explorer", "compass", "explored", above=6.0, weight=0.8),
    Award("near", "amid", "near", least=True, weight=0.7),
    Award("dancer", "spiral", "turning", above=6.3, weight=0.7),
    Award("calm", "calm", "turning", least=True, weight=0.7),
    Award("straight", "ahead", "straight", above=300.0, weight=0.7),
    Award("reverse", "behind", "reverse", above=300.0, weight=0.7),
    Award("patient", "hourglass", "rest", above=3.0, weight=0.6),
)
"""Awards of every game, as far as it has the figures."""

FREE = (Award("fair", "fair"), Award("sport", "medal"), Award("company", "smile"), Award("luck", "clover"))
"""Awards that compare nobody; one for each seat."""


def own_awards(icons: Mapping[str, str]) -> tuple[Award, ...]:
    """The awards for statistics of a game. `icons`: by statistic; after a minus sign the least of it counts."""
    return tuple(
        Award(name.removeprefix("-"), icon, name.removeprefix("-"), least=name.startswith("-"), above=above)
        for name, icon in icons.items()
        for above in (-1.0 if name.startswith("-") else 0.0,)
    )


def awarded(players: Sequence[Player], own: Sequence[Award] = (), seed: int = 0) -> dict[int, Award]:
    """The award of each seat. `own`: awards of the game; `seed`: decides between players who have earned the same.

    People go before AIs if there is not one for everybody, and lower places choose first among equals.
    """
    lots = Random(seed).sample(range(ROBOTS), ROBOTS)
    order = sorted(players, key=lambda player: (-player.place, lots[player.seat]))
    earned = [_earned(player, players, (*own, *GENERAL)) for player in order]
    best = max(_choices(earned), key=lambda choice: _worth(choice, order))
    return {player.seat: award for player, (award, _) in zip(order, best, strict=True)}


Earned = tuple[Award, float]  # an award, and how far its player stands out


def _earned(player: Player, players: Sequence[Player], awards: Sequence[Award]) -> list[Earned]:
    """The awards of a player, best first; more than there are seats are never needed."""
    found = [(award, standout(award, player, players)) for award in awards]
    real = sorted(((award, far) for award, far in found if far is not None), key=lambda pair: -pair[1])
    return [*real[:ROBOTS], *((award, 0.0) for award in FREE)]


def _choices(earned: Sequence[Sequence[Earned]]) -> Iterator[tuple[Earned, ...]]:
    """All ways to give every player another award."""
    return (pick for pick in product(*earned) if len({award.key for award, _ in pick}) == len(pick))


def _worth(choice: Sequence[Earned], players: Sequence[Player]) -> tuple[int, int, float]:
    """People with an award that they have earned, AIs with one, and how far all stand out."""
    people = sum(bool(award.figure) and player.person for (award, _), player in zip(choice, players, strict=True))
    return people, sum(bool(award.figure) for award, _ in choice) - people, sum(far for _, far in choice)


def standout(award: Award, player: Player, players: Sequence[Player]) -> float | None:
    """How far a player stands out by an award's figure, from 0; None: another one is better, or it is too little.

    The standard score among those present, and a little of the relative lead over the next.
    """
    known = [other.figures[award.figure] for other in players if award.figure in other.figures]
    if award.figure not in player.figures or player.figures[award.figure] <= award.above:
        return None
    value = player.figures[award.figure]
    if value != (min(known) if award.least else max(known)):
        return None
    others = sorted(known, reverse=not award.least)[1:]
    alone = 0.0 if others else 1.0  # nobody else has the figure
    score = abs(value - fmean(known)) / pstdev(known) if max(known) > min(known) else alone
    lead = abs(others[0] - value) / max(abs(others[0]), abs(value), 1e-9) if others else 1.0
    return award.weight * (score + LEAD * lead) * (SHARED if others and others[0] == value else 1.0)


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
