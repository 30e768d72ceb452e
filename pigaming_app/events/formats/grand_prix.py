"""Grand Prix: everybody plays in every round, each round is of the next game, and places bring points.

Heats are of equal strength by the seeding (serpentine), then of entrants who have met least. Entrants of the same place
add up the points of their places and share them, as in a dead heat (FIA Formula One Sporting Regulations).
In heats of two, an odd one out has a bye, in turn from the last seed up, with the points of a tie.
"""

from random import Random

from pigaming_app.events.formats import scoring, tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, MatchUp, meetings
from pigaming_app.events.formats.grouping import mixed, serpentine
from pigaming_app.events.spec import WALKOVER, Result, Standing

POINTS = (10.0, 6.0, 3.0, 1.0)  # of each place
BYE = (POINTS[0] + POINTS[1]) / 2
TIE_BREAKS = {key: tie_breaks.place_counts(place) for place, key in enumerate(("first", "second", "third"), 1)}


def rounds(field: EntrantField) -> list[Draw]:
    """The rounds that are not drawn yet, of everybody who is there. Late entrants have missed the first one."""
    spec, names = field.spec, field.present
    draws: list[Draw] = []
    met, rests = field.meetings(), field.byes()
    last = spec.rounds or len(spec.games)
    for number in range(len(field.rounds) + 1, last + 1 if len(names) > 1 else 0):
        order = list(names)
        if number > 1:
            Random(number).shuffle(order)
        byes: list[str] = []
        if spec.seats == 2 and len(order) % 2:
            byes = [min(order, key=lambda name: (rests[name], -field.entrants.index(name)))]
            order.remove(byes[0])
            rests[byes[0]] += 1
        groups = mixed(serpentine(order, spec.seats), met)
        draws.append(Draw(tuple(MatchUp(group) for group in groups), tuple(byes)))
        for pair, times in meetings(iter(groups)).items():
            met[pair] = met.get(pair, 0) + times
    return draws


def shared(first: int, count: int) -> float:
    """Points of each of `count` entrants who share the places from `first` on, from 1."""
    return sum(POINTS[first - 1 : first - 1 + count]) / count


def table(field: EntrantField) -> tuple[Standing, ...]:
    """Points, then most first, second and third places."""
    counted = tie_breaks.counted(field, field.outcomes.values(), _gained, BYE)
    return tie_breaks.table_of(field, field.entrants, counted, TIE_BREAKS)


def _gained(outcome: Result) -> dict[str, float]:
    """Points by place; a walkover is a first place."""
    if outcome.note == WALKOVER:
        return {name: share * POINTS[0] for name, share in scoring.points(outcome).items()}
    found: dict[str, float] = {}
    for place in outcome.places:
        here = shared(len(found) + 1, len(place))
        found |= dict.fromkeys(place, here)
    return found


KIND = FormatKind(
    draws=rounds,
    table=table,
    follows_results=False,
    seats=(4, 2, 3),
    fills=True,
    series=True,
    figures=("points", "wins", "played", "first"),
)
