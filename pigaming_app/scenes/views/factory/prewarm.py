"""Prewarm jobs for the sprites specific to Robot Factory."""

from collections.abc import Iterator, Sequence
from functools import partial

from pigaming_app.games.factory.state import DELIVERED, DONE, HALF, MAX_PALLETS, SHELVES, TEAMS, A, B, Factory
from pigaming_app.games.factory.state import ICE as ICE_TEAM
from pigaming_app.scenes.views.factory import contest, countdowns
from pigaming_app.scenes.views.factory.announcements import FactoryAnnouncements
from pigaming_app.scenes.views.factory.next_step import AIMS
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites.teams import TEAMS as COLORS
from pigaming_app.ui.draw import ALARM, FOCUS, PLAYERS, dim
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS


def jobs(seats: Sequence[int], state: Factory, notes: FactoryAnnouncements) -> Iterator[Job]:
    """One small job per sprite of a match that begins in `state`."""
    rules = state.rules
    for team in (ICE_TEAM,) if rules.allies else range(TEAMS):
        for turn in range(HEADINGS):
            yield partial(crates.forks, team, turn)
        for form in range(DELIVERED + 1):
            for tenths in (10, 13, 12, 11):
                yield partial(crates.crate, team, form, tenths)
        yield from (partial(crates.busy, team, kind) for kind in (A, B))
        yield from (partial(crates.count, number, team) for number in range(1, MAX_PALLETS + 1 - SHELVES))
        yield from notes.jobs(("delivered", COLORS[team]))
    for working in (False, True):
        for stride in range(crates.STRIDE):
            for turn in range(crates.PERSON_TURNS):
                yield partial(crates.person, turn, stride, working)
    for part in range(crates.COUNTS + 1):
        yield partial(crates.progress, HALF, part)
        yield partial(crates.progress, DONE, part)
        yield partial(crates.frozen, part, crates.FROZEN)
    for seat in seats:
        yield partial(crates.target, PLAYERS[seat], False)
        yield partial(crates.target, dim(PLAYERS[seat], AIMS), True)
        yield partial(signs.dot, PLAYERS[seat])
        yield from (partial(signs.task, seat, lifts) for lifts in (False, True))
        for turn in range(HEADINGS):
            yield partial(crates.dash, PLAYERS[seat], turn)
            yield partial(crates.arrow, PLAYERS[seat], turn)
    yield from countdowns.jobs()
    if rules.party:
        yield from contest.jobs(rules)
        yield from notes.jobs(("rush", FOCUS))
    yield from _moments(seats, bool(rules.party))


def _moments(seats: Sequence[int], party: bool) -> Iterator[Job]:
    for number in (1, 2, 3):
        yield partial(crates.digit, number)
    for seconds in range(1, 11):
        yield partial(crates.awaited, seconds)
    yield from (crates.exclaim, crates.cross)
    for color in (*COLORS, ALARM, *([FOCUS] if party else []), crates.STATES[HALF], crates.STATES[DONE]):
        for size in effects.SPARK_SIZES:
            for turn in range(effects.SPARK_TURNS):
                yield partial(effects.sparks, color, size, turn)
    for color in COLORS:
        for stage in range(effects.WAVE_STEPS):
            yield partial(effects.wave, color, stage)
        for level in range(effects.LIGHT_LEVELS, 0, -1):
            yield partial(effects.light, color, level)
    for seat in seats:
        for level in range(things.POPUP_LEVELS, 0, -1):
            yield partial(things.popup, "+1", seat, level)
            if party:
                yield partial(things.popup, "+2", seat, level)
