"""Points of a match, alike for two and for more: the share of the opponents that were beaten, a tie as half."""

from pigaming_app.events.formats.field import EntrantField
from pigaming_app.events.spec import WALKOVER, Result

BYE = 1.0  # points, as for a win (FIDE Handbook C.04.1, Basic rules for Swiss systems)


def points(outcome: Result) -> dict[str, float]:
    """Points of each entrant, 0 to 1: between two 1, 1/2 or 0. Of a walkover all for whoever is there."""
    if outcome.note == WALKOVER:
        there = outcome.places[0] if len(outcome.places) > 1 else ()
        return {name: float(name in there) for place in outcome.places for name in place}
    count = sum(map(len, outcome.places))
    found: dict[str, float] = {}
    ahead = 0
    for place in outcome.places:
        beaten = count - ahead - len(place) + (len(place) - 1) / 2
        found |= dict.fromkeys(place, beaten / (count - 1))
        ahead += len(place)
    return found


def scores(field: EntrantField) -> dict[str, float]:
    """Points of everybody so far, with those of byes."""
    total = dict.fromkeys(field.entrants, 0.0)
    for outcome in field.outcomes.values():
        for name, gained in points(outcome).items():
            total[name] += gained
    for name, byes in field.byes().items():
        total[name] += byes * BYE
    return {name: exact(value) for name, value in total.items()}


def exact(points: float) -> float:
    """Points whose sum does not depend on the order of the matches: thirds are rounded."""
    return round(points, 6)
