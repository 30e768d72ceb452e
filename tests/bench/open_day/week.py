"""The schedule of a week of five days: classes with phones beside groups, three events, and a fault of each kind.

The second day has a clock that is set back by an hour, the third is a night in which summer time ends, on the fourth
the disk is full for a while, and on the last one two arcades play one event. The power fails every day.
"""

import random
from dataclasses import replace
from datetime import UTC, datetime
from itertools import islice
from math import inf

from pigaming_app.events.spec import Format
from pigaming_app.games.registry import games
from pigaming_app.ui.i18n import LANGUAGES
from tests.bench.open_day.clock import Times
from tests.bench.open_day.plan import (
    KILLS,
    LAST_ARRIVAL,
    LONG_DAY,
    PLACES,
    Day,
    EventWish,
    Group,
    Kill,
    Visitor,
    arrivals,
    crowd,
    entrants,
    in_order,
    initials_at,
    plan,
    tasks,
)

CLASS = 32  # visitors of a class that comes with its phones
CLASSES = 0.8  # share of a week's visitors that come in classes
SUMMER_ENDS = datetime(2026, 10, 25, 1, 0, tzinfo=UTC)  # at 3:00 the clock goes back to 2:00
OPENINGS = (  # of a week, at 10:00, on five dates; the night of the third day is found from its length
    datetime(2026, 10, 22, 8, 0, tzinfo=UTC),
    datetime(2026, 10, 23, 8, 0, tzinfo=UTC),
    SUMMER_ENDS,
    datetime(2026, 10, 26, 9, 0, tzinfo=UTC),
    datetime(2026, 10, 27, 9, 0, tzinfo=UTC),
)
SECOND_DAY, NIGHT, FOURTH_DAY, LAST_DAY = 1, 2, 3, 4  # see above


def plan_week(hours: float, visitors: int, seed: int) -> tuple[Day, ...]:
    """Five days of so many hours, and what goes wrong on each."""
    rng, seconds, days = random.Random(seed), 3600.0 * hours, len(OPENINGS)
    people, late = iter(crowd(rng, visitors)), initials_at(visitors)
    events: dict[int, dict[float, tuple[int, EventWish]]] = {
        0: {0.9: (6, EventWish(Format.KNOCKOUT, 0))},
        NIGHT: {0.4: (8, EventWish(Format.SWISS, 2, late))},
        LAST_DAY: {0.0: (8, EventWish(Format.SWISS, 0, shared=True))},
    }
    found = []
    for i in range(days):
        crew = list(islice(people, visitors * (i + 1) // days - visitors * i // days))
        own = entrants(events.get(i, {}), iter(crew), seconds)
        crew = crew[sum(len(group.visitors) for group in own) :]
        classes = max(1, int(CLASSES * len(crew)) // CLASS)
        size = min(CLASS, int(CLASSES * len(crew)) // classes)
        languages = iter(list(LANGUAGES) * classes)
        taught = [a_class(rng, [crew.pop() for _ in range(size)], next(languages)) for _ in range(classes)]
        groups = spread(rng, [*taught, *arrivals(rng, crew, seconds, long=False)], seconds)
        second = None
        if i == LAST_DAY:
            second = Day(1.0, tuple(own), (), (Kill(60.0, "event"),), seed + 1, Times(OPENINGS[i].timestamp()))
        opening = OPENINGS[i].timestamp() - (min(0.6 * seconds, 2.8 * 3600.0) if i == NIGHT else 0.0)
        found.append(
            Day(
                seconds,
                in_order([*own, *groups]),
                tuple(tasks(seconds, hours >= LONG_DAY)),
                (Kill(0.05 * seconds, "match"), Kill(0.3 * seconds, "results"), Kill(0.5 * seconds, "match", True)),
                seed + i,
                Times(opening, 0.35 * seconds if i == SECOND_DAY else inf),
                0.7 * seconds if i == FOURTH_DAY else inf,
                second,
            )
        )
    return tuple(found)


def days_of(
    hours: float, visitors: int, seed: int, kills: int = KILLS, only: str = "", week: bool = False
) -> tuple[Day, ...]:
    """The days of these wishes: one, or a week."""
    return plan_week(hours, visitors, seed) if week else (plan(hours, visitors, seed, kills, only),)


def spread(rng: random.Random, groups: list[Group], seconds: float) -> list[Group]:
    """The groups in random order over the day: a class takes as much time as so many of its matches."""
    rng.shuffle(groups)
    total, begun, found = sum(map(_matches, groups)), 0, []
    for group in groups:
        found.append(replace(group, at=seconds * LAST_ARRIVAL * begun / total))
        begun += _matches(group)
    return found


def _matches(group: Group) -> int:
    return -(-len(group.visitors) // PLACES)


def a_class(rng: random.Random, crew: list[Visitor], language: str) -> Group:
    """A class, in its language, which plays until everybody has had a turn."""
    visitors = tuple(replace(visitor, phone=True) for visitor in crew)
    return Group(0, 0.0, visitors, rng.choice(list(games())), 0, language, mishap=rng.choice(("lock", "pause", "rest")))
