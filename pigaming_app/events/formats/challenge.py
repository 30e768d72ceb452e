"""Challenge ladder: everybody challenges somebody a few places above; who wins the challenge takes the place.

The seeding is the ladder at first; late entrants stand at its foot. A challenge goes up to `reach` places up, counting
those who have not withdrawn; whoever has an open one neither challenges nor is challenged. If the lower one wins, they
take the place, and everybody between moves down by one; a tie changes nothing. Challenges count in the order in which
they were made. The ladder is open for some weeks. With the end of a week open challenges lapse, and whoever has not
played for IDLE weeks in a row falls by one place.
"""

from pigaming_app.events.formats import tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, OnCall
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import WALKOVER, WEEK, EventSpec, Standing

WEEKS = 4  # by default
IDLE = 2  # weeks without a match after which an entrant falls


def rounds(field: EntrantField) -> list[Draw]:
    """A week without matches yet, once the one before it is closed."""
    return [Draw(())] if len(field.rounds) == field.closed < weeks(field.spec) else []


def weeks(spec: EventSpec) -> int:
    """Weeks for which the ladder is open."""
    return spec.rounds or WEEKS


def ladder(field: EntrantField) -> list[str]:
    """Everybody who is there, the top of the ladder first; then who has withdrawn, in the order of the places left."""
    order: list[str] = []
    idle = dict.fromkeys(field.entrants, 0)  # weeks in a row
    for drawn in field.rounds:
        order += [
            name for name in field.entrants if field.joined.get(name, 0) == drawn.number - 1 and name not in order
        ]
        played: set[str] = set()
        for fixture in drawn.fixtures:
            outcome = field.outcomes.get(fixture.number)
            if outcome is None or (outcome.note == WALKOVER and len(outcome.places) == 1):
                continue
            played |= {*fixture.entrants} if outcome.note != WALKOVER else {*outcome.places[0]}
            low, high = sorted(fixture.entrants, key=order.index, reverse=True)
            if outcome.places[0] == (low,):
                order.remove(low)
                order.insert(order.index(high), low)
        if drawn.number <= field.closed:
            idle |= {name: 0 if name in played else idle[name] + 1 for name in order}
            _fall(order, {name for name in order if idle[name] >= IDLE})
    order += [name for name in field.entrants if name not in order]
    return sorted(order, key=lambda name: name in field.withdrawn)


def _fall(order: list[str], idle: set[str]) -> None:
    """Each of the idle one place down, behind the next who is not."""
    for i in range(len(order) - 2, -1, -1):
        if order[i] in idle and order[i + 1] not in idle:
            order[i], order[i + 1] = order[i + 1], order[i]


def table(field: EntrantField) -> tuple[Standing, ...]:
    """The ladder."""
    order = ladder(field)
    return tie_breaks.ranked(field, order, lambda name: (-order.index(name),))


def in_reach(field: EntrantField, name: str) -> tuple[str, ...]:
    """Whom an entrant can challenge now, the nearest first."""
    order = [one for one in ladder(field) if one not in field.withdrawn]
    if name not in order or name in field.busy:
        return ()
    place = order.index(name)
    return tuple(one for one in order[max(0, place - field.spec.reach) : place][::-1] if one not in field.busy)


def _check(field: EntrantField, names: tuple[str, ...]) -> None:
    if len(names) != 2:
        raise Refused("two")
    if busy := [name for name in names if name in field.busy]:
        raise Refused("challenge_open", name=busy[0])
    if names[1] not in in_reach(field, names[0]):
        raise Refused("reach", name=names[0], reach=field.spec.reach)


def _next(field: EntrantField) -> tuple[str, ...] | None:
    """From the foot up, everybody plays once a week: against the highest in reach who has not played."""
    if not field.rounds or len(field.rounds) == field.closed:
        return None
    played = {name for one in field.rounds[-1].fixtures for name in one.entrants}
    for name in reversed(ladder(field)):
        if name not in played:
            free = [other for other in in_reach(field, name) if other not in played]
            if free:
                return name, free[-1]
    return None


KIND = FormatKind(
    matches=lambda spec, count: weeks(spec) * count // 2,
    draws=rounds,
    table=table,
    follows_results=False,
    follows_withdrawals=False,
    figures=("wins", "played"),
    seats=(2,),
    rounds=(4, 6, 8, 12, 1, 2),
    on_call=OnCall(stage=WEEK, check=_check, next=_next, periods=weeks),
)
