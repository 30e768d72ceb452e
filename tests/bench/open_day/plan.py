"""The schedule of a day: groups of visitors, their wishes and mishaps, the operator's tasks, and what goes wrong."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import cache
from itertools import islice
from math import inf

from pigaming_app.events.spec import Format
from pigaming_app.games.registry import games
from pigaming_app.storage.scores import LETTERS
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.widgets.word_filter import is_rude
from tests.bench.open_day.clock import Times

SIZES, WEIGHTS = (1, 2, 3, 4), (2, 4, 3, 2)  # people of a group, and how often
PADS, PLACES = 3, 4  # pads in the hall, and seats of a match
MISHAPS = ("pull", "lock", "pause", "stop", "rest")  # pad pulled, phone locked, pause, end by hand, nobody drives
PIN = "274918"  # of the operator
FULL_SECONDS = 600.0  # for which a disk is full
KILLS = 5  # of a long day alone
GUESS = "guess"  # look for the way out, and guess the PIN
ONLY = ("events", "phones")  # parts of a day
LONG_DAY = 2.0  # h from which a day has events, quiet hours and a time limit
LAST_ARRIVAL = 0.93  # share of the day
QUIET = ("12:30", "13:30")
LIMIT = 5  # minutes of a group, for a part of a long day


@dataclass(frozen=True)
class Visitor:
    """A person. `initials` differ between all visitors; `phone`: plays by phone, else by pad."""

    number: int
    initials: str
    phone: bool


@dataclass(frozen=True)
class EventWish:
    """An event that a group plays. `ais`: entrants that are AIs; `late`: initials of a late entrant, or empty;
    `shared`: it is prepared for two arcades.
    """

    format: Format
    ais: int
    late: str = ""
    shared: bool = False


@dataclass(frozen=True)
class Group:
    """People who come together. `at`: s since the opening; `matches`: as many as they want to play; `language`: changed
    to on the title; `look`: a page of the title's menu that they visit first, or GUESS; `mishap`: one of MISHAPS.
    """

    number: int
    at: float
    visitors: tuple[Visitor, ...]
    game: str
    matches: int
    language: str = ""
    look: str = ""
    mishap: str = ""
    event: EventWish | None = None

    @property
    def is_class(self) -> bool:
        """True for more people than seats, who all have a phone and take turns."""
        return len(self.visitors) > PLACES and self.event is None


@dataclass(frozen=True)
class Task:
    """A task of the operator, `at` s since the opening. `settings`: by row of the operator's page; `end_all`: ends the
    matches that are being played.
    """

    at: float
    settings: dict[str, str | int] = field(default_factory=dict)
    figures: bool = False
    end_all: bool = False


@dataclass(frozen=True)
class Kill:
    """A kill of the arcade at the first moment after `after` s at which it is at this place, see `clock.PLACES`.

    `power`: the power fails: its supervisor is killed, too, and started again.
    """

    after: float
    place: str
    power: bool = False


@dataclass(frozen=True)
class Day:
    """A day of `seconds`. `full`: the time from which the disk is full for FULL_SECONDS; `second`: what happens at a
    second arcade, which shares the event of the first group.
    """

    seconds: float
    groups: tuple[Group, ...]
    tasks: tuple[Task, ...]
    kills: tuple[Kill, ...]
    seed: int
    times: Times = field(default_factory=Times)
    full: float = inf
    second: "Day | None" = None

    @property
    def visitors(self) -> int:
        """All people who come."""
        return sum(len(group.visitors) for group in self.groups)

    @property
    def crashes(self) -> int:
        """The kills that a supervisor sees."""
        return sum(not kill.power for kill in self.kills)

    def quiet(self, now: datetime) -> bool:
        """True in the quiet hours that the operator has set, if any."""
        ordered = any("quiet_from" in task.settings for task in self.tasks)
        return ordered and QUIET[0] <= f"{now:%H:%M}" < QUIET[1]


def plan(hours: float, visitors: int, seed: int, kills: int = KILLS, only: str = "") -> Day:
    """A day alone. `only`: one of ONLY, visitors who all play in an event, or by phone."""
    rng, seconds, long = random.Random(seed), 3600.0 * hours, hours >= LONG_DAY
    people = iter(crowd(rng, visitors, only == "phones"))
    events = {}
    if long or only == "events":
        late = initials_at(visitors)
        events = {0.12: (6, EventWish(Format.KNOCKOUT, 0)), 0.42: (8, EventWish(Format.SWISS, 2, late))}
    groups = entrants(events, people, seconds)
    left = 0 if only == "events" else visitors - sum(len(group.visitors) for group in groups)
    groups += arrivals(rng, list(islice(people, left)), seconds, long)
    return Day(seconds, in_order(groups), tuple(tasks(seconds, long)), tuple(planned_kills(seconds, long, kills)), seed)


def entrants(events: dict[float, tuple[int, EventWish]], people: Iterator[Visitor], seconds: float) -> list[Group]:
    """The groups that play events, by share of the day."""
    game = next(iter(games()))
    return [
        Group(0, share * seconds, tuple(islice(people, count)), game, 0, event=wish)
        for share, (count, wish) in events.items()
    ]


def arrivals(rng: random.Random, people: list[Visitor], seconds: float, long: bool) -> list[Group]:
    """Groups of up to four, who come one after the other."""
    crews: list[tuple[Visitor, ...]] = []
    while people:
        size = min(len(people), rng.choices(SIZES, WEIGHTS)[0])
        crews.append(tuple(people[:size]))
        people = people[size:]
    return [
        a_group(rng, i, seconds * LAST_ARRIVAL * (i + rng.uniform(0.0, 0.8)) / len(crews), crew, long)
        for i, crew in enumerate(crews)
    ]


def in_order(groups: list[Group]) -> tuple[Group, ...]:
    """The groups by time, numbered."""
    return tuple(replace(group, number=i) for i, group in enumerate(sorted(groups, key=lambda group: group.at)))


def a_group(rng: random.Random, i: int, at: float, crew: tuple[Visitor, ...], long: bool) -> Group:
    """A group with random wishes. Mishaps follow one another, so that a day has all of them."""
    pads = [visitor for visitor in crew if not visitor.phone][PADS:]
    crew = tuple(Visitor(one.number, one.initials, True) if one in pads else one for one in crew)
    mishap = MISHAPS[i // 2 % len(MISHAPS)] if i % 2 == 0 else ""
    return Group(
        0,
        at,
        crew,
        rng.choice(list(games())),
        rng.choice((1, 1, 1, 2, 2, 3)) if long else 1,
        rng.choice(list(LANGUAGES)) if rng.random() < 0.4 else "",
        rng.choice(("howto", "replays", "ladder", GUESS)) if rng.random() < 0.3 else "",
        mishap,
    )


def crowd(rng: random.Random, count: int, phones: bool = False) -> list[Visitor]:
    """Visitors with different, harmless initials; with `phones`, all of them have a phone."""
    return [Visitor(i, initials_at(i), rng.random() < 0.45 or phones) for i in range(count)]


def initials_at(number: int) -> str:
    """The initials with this number: different ones, a few steps from AAA, so that they are entered in time."""
    return _initials()[number]


@cache
def _initials() -> list[str]:
    near = (0, 1, 25, 2, 24, 3, 23, 4, 22, 5, 21)
    names = (LETTERS[a] + LETTERS[b] + LETTERS[c] for a in near for b in near for c in near if (a, b, c) != (0, 0, 0))
    return [name for name in names if not is_rude(name)]


def tasks(seconds: float, long: bool) -> list[Task]:
    """The operator's day."""
    if not long:
        return [Task(0.1 * seconds, figures=True)]
    quiet: dict[str, str | int] = {"quiet_from": QUIET[0], "quiet_until": QUIET[1]}
    return [
        Task(0.01 * seconds, quiet, figures=True),
        Task(0.60 * seconds, {"group_minutes": LIMIT}),
        Task(0.75 * seconds, end_all=True),
        Task(0.80 * seconds, {"group_minutes": 0, "volume_cap": 7}),
        Task(0.95 * seconds, figures=True),
    ]


def planned_kills(seconds: float, long: bool, count: int) -> list[Kill]:
    """The kills; of a long day the last two fall into the second event, so that the last run lasts half the day."""
    if not long:
        return [Kill(0.35 * seconds, "match")][:count]
    second = 0.42 * seconds
    kills = [
        Kill(0.05 * seconds, "match"),
        Kill(0.20 * seconds, "results"),
        Kill(0.30 * seconds, "match"),
        Kill(second + 60.0, "event"),
        Kill(second + 420.0, "ending"),
    ]
    return kills[:count]
