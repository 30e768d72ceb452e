"""Grand Prix: everybody plays in every round, each round is of the next game, and places bring points.

Heats are of equal strength by the seeding (serpentine), then of entrants who have met least. Entrants of the same place
add up the points of their places and share them, as in a dead heat (FIA Formula One Sporting Regulations, article 7).
"""

from random import Random

from pigaming_app.events.formats.field import Draw, Field, Match, meetings
from pigaming_app.events.formats.grouping import mixed, serpentine

POINTS = (10.0, 6.0, 3.0, 1.0)  # of each place


def rounds(field: Field) -> list[Draw]:
    """The rounds that are not drawn yet, of everybody who is there. Late entrants have missed the first one."""
    spec, names = field.spec, field.present
    draws: list[Draw] = []
    met = field.meetings()
    for number in range(len(field.rounds) + 1, (spec.rounds or len(spec.games)) + 1):
        order = list(names)
        if number > 1:
            Random(number).shuffle(order)
        groups = mixed(serpentine(order, spec.seats), met)
        draws.append(Draw(tuple(Match(group) for group in groups)))
        for pair, times in meetings(iter(groups)).items():
            met[pair] = met.get(pair, 0) + times
    return draws


def shared(first: int, count: int) -> float:
    """Points of each of `count` entrants who share the places from `first` on, from 1."""
    return sum(POINTS[first - 1 : first - 1 + count]) / count
