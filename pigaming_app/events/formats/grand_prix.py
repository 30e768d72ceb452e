"""Grand Prix: everybody plays in every round, each round is of the next game, and places bring points.

Heats are of equal strength by the seeding (serpentine), then of entrants who have met least. Entrants of the same place
add up the points of their places and share them, as in a dead heat (FIA Formula One Sporting Regulations).
In heats of two, an odd one out has a bye, in turn from the last seed up, with the points of a tie.
"""

from random import Random

from pigaming_app.events.formats.field import Draw, EntrantField, MatchUp, meetings
from pigaming_app.events.formats.grouping import mixed, serpentine

POINTS = (10.0, 6.0, 3.0, 1.0)  # of each place
BYE = (POINTS[0] + POINTS[1]) / 2


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
