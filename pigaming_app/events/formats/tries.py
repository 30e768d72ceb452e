"""Time trial and high score: everybody tries as often as there is time, and the best try counts, then the second best.

Entrants play a try alone, or beside AIs on the other seats; for a high score several of them can share a match. A time
trial counts the best lap, a high score the points of the robot. A try without a lap counts for nothing. With the end of
the day the event is over; an open try lapses. `rounds` limits the tries of everybody.
"""

from dataclasses import replace
from math import inf

from pigaming_app.events.formats import tie_breaks
from pigaming_app.events.formats.field import Draw, EntrantField, FormatKind, OnCall
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import WALKOVER, EventSpec, Format, Standing

TRIES = 3  # of AIs, unless the spec has another number


def rounds(field: EntrantField) -> list[Draw]:
    """The day, without matches yet."""
    return [] if field.rounds else [Draw(())]


def tries(field: EntrantField) -> dict[str, list[float]]:
    """What everybody has reached, the best try first."""
    timed = field.spec.format is Format.TIME_TRIAL
    found: dict[str, list[float]] = {name: [] for name in field.entrants}
    for outcome in field.outcomes.values():
        if outcome.note != WALKOVER:
            for name, value in outcome.scores.items():
                found[name].append(value)
    return {name: sorted(values, reverse=not timed) for name, values in found.items()}


def table(field: EntrantField) -> tuple[Standing, ...]:
    """By the best try, then by the second best and so on; who has fewer tries of equal worth is behind."""
    found, sign = tries(field), -1.0 if field.spec.format is Format.TIME_TRIAL else 1.0
    most = max(map(len, found.values()), default=0)

    def key(name: str) -> tuple[float, ...]:
        """Higher is better."""
        values = [sign * value for value in found[name]]
        return (*values, *[-inf] * (most - len(values)))

    def values(name: str) -> dict[str, float]:
        return dict(zip(("best", "second_best"), (*found[name], 0.0, 0.0), strict=False))

    return tie_breaks.ranked(field, field.entrants, key, values)


def _check(field: EntrantField, names: tuple[str, ...]) -> None:
    if not 1 <= len(names) <= field.spec.seats or len({*names}) < len(names):
        raise Refused("once", most=field.spec.seats)
    for name in names:
        if name in field.busy:
            raise Refused("try_open", name=name)
        if field.spec.rounds and made(field, name) >= field.spec.rounds:
            raise Refused("tries", name=name, most=field.spec.rounds)


def _check_spec(spec: EventSpec) -> None:
    if len(spec.games) > 1 or any(len(arenas) > 1 for arenas in spec.arenas.values()):
        raise ValueError("tries can be compared in one game and one arena only")
    if spec.seats > 1 and not spec.fill:
        raise ValueError("an AI is needed for the seats beside whoever tries")


def made(field: EntrantField, name: str) -> int:
    """Matches of an entrant, played or open."""
    return sum(name in one.entrants for drawn in field.rounds for one in drawn.fixtures)


def _next(field: EntrantField) -> tuple[str, ...] | None:
    """Everybody by turns, alone."""
    most, playing = field.spec.rounds or TRIES, field.busy
    free = (name for name in field.present if name not in playing)
    name = min(free, key=lambda name: made(field, name), default=None)
    return (name,) if name is not None and made(field, name) < most else None


HIGH_SCORE = FormatKind(
    matches=lambda spec, count: (spec.rounds or TRIES) * count,
    draws=rounds,
    table=table,
    check=_check_spec,
    follows_results=False,
    follows_withdrawals=False,
    seats=(4, 1, 2, 3),
    rounds=(0, 1, 2, 3, 5, 10),
    figures=("best", "second_best", "played"),
    fills=True,
    single=True,
    on_call=OnCall(stage="try", check=_check, next=_next, periods=lambda spec: 1),
)
TIME_TRIAL = replace(HIGH_SCORE, seats=(1, 2, 3, 4), timed=True)
