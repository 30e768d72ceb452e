"""From a fixture to the setup of its match, and from the result of the match to the outcome."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from pigaming_app.events.event import Event
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.spec import Entrant, EventSpec, Fixture, Result
from pigaming_app.games.arenas import load
from pigaming_app.games.game import ALLIES, ALONE, FREE, Row, Setup, Variant
from pigaming_app.games.registry import games
from pigaming_app.games.setup import PEOPLE, ChoiceError, make_setup, require_game, require_one_of

SUDDEN_DEATH = 3.0  # minutes of an extra match, at most


def setup_of(event: Event, fixture: Fixture, person: str = "human") -> Setup:
    """The match of a fixture; `person`: the driver of an entrant without a brain. Raises ChoiceError.

    Entrants of one team play together where the rules know teams. An extra match has the shortest length that the rules
    offer, of minutes or laps, and ends with the first point, or lap.
    """
    spec, extra = event.spec, bool(fixture.extra)
    by_name = {entrant.name: entrant for entrant in event.entrants}
    playing = [by_name[name] for name in fixture.entrants]
    brains = [entrant.brain or person for entrant in playing] + [spec.fill] * fixture.fill
    variant = variant_of(spec, fixture.game)
    minutes = spec.minutes.get(fixture.game) or float(variant.default_minutes)
    setup = make_setup(
        fixture.game,
        brains,
        fixture.arena or None,
        min(minutes, *variant.minutes, SUDDEN_DEATH) if extra else minutes,
        fixture.seed,
        variant.name,
        _teams(variant, playing),
        [brain for brain in brains if brain not in PEOPLE],
        min(variant.goals) if extra and variant.goals and games()[fixture.game].timed else None,
    )
    return replace(setup, sudden_death=extra)


def check_playable(spec: EventSpec, find_brain: Callable[[str, str], object]) -> None:
    """Raises ChoiceError or ArenaError, with one line, unless every entrant can play every game of the event.

    `find_brain(game, name)` raises ChoiceError for a brain that does not exist.
    """
    for game in spec.games:
        variant = variant_of(spec, game)
        for brain in dict.fromkeys([*(entrant.brain for entrant in spec.entrants), spec.fill]):
            if brain:
                find_brain(game, brain)
        if KINDS[spec.format].timed and time_record(game, variant) is None:
            raise ChoiceError(f"{game} takes no times, so it has no time trial")
        seats = ["idle"] * spec.seats
        for arena in spec.arenas.get(game) or (None,):
            minutes = spec.minutes.get(game) or None
            setup = make_setup(game, seats, arena or None, minutes, 1, variant.name, None, seats)
            load(game, setup.arena)


def variant_of(spec: EventSpec, game: str) -> Variant:
    """The rules of a game of the event. Raises ChoiceError."""
    require_game(game)
    variants = games()[game].variants
    name = spec.variants.get(game) or games()[game].default.name
    require_one_of("variant", name, list(variants))
    if variants[name].team_mode == ALLIES:
        raise ChoiceError(f"{game}, {name}: all play together, so nobody wins")
    return variants[name]


def time_record(game: str, variant: Variant) -> str | None:
    """The record of a game whose shortest time counts in a time trial, such as a lap; None if it takes no times."""
    return next((kind.name for kind in games()[game].records_of(variant.name) if kind.timed), None)


def outcome_of(spec: EventSpec, fixture: Fixture, rows: Iterable[Row], note: str = "") -> Result:
    """The outcome of a match; AIs on filled seats have no place. In a time trial the scores are times, s, if any."""
    own = [row for row in rows if row.seat < len(fixture.entrants)]
    names = {row.seat: fixture.entrants[row.seat] for row in own}
    places = sorted({row.place for row in own})
    timed = KINDS[spec.format].timed
    return Result(
        fixture.number,
        tuple(tuple(sorted(names[row.seat] for row in own if row.place == place)) for place in places),
        _times(spec, fixture, own, names) if timed else {names[row.seat]: float(row.score) for row in own},
        note,
        fixture.extra,
    )


def _times(spec: EventSpec, fixture: Fixture, rows: Sequence[Row], names: Mapping[int, str]) -> dict[str, float]:
    record = time_record(fixture.game, variant_of(spec, fixture.game)) or ""
    return {names[row.seat]: row.records[record] / 1000 for row in rows if record in row.records}


def _teams(variant: Variant, playing: Sequence[Entrant]) -> tuple[int, ...]:
    """The team of each seat: that of the entrants, if the rules permit it and there are two or more."""
    sides = [entrant.team or f"\0{entrant.name}" for entrant in playing]  # no team has such a name
    different = [*dict.fromkeys(sides)]
    fair = len(different) == 2 and max(sides.count(side) for side in different) <= 2
    if variant.team_mode == ALONE or len(different) < 2 or (variant.team_mode != FREE and not fair):
        return variant.teams
    numbers = [different.index(side) for side in sides]
    free = [number for number in range(len(variant.teams)) if number not in numbers] or [0]
    rest = range(len(numbers), len(variant.teams))
    if variant.team_mode == FREE:
        return (*numbers, *(free[(seat - len(numbers)) % len(free)] for seat in rest))
    for _ in rest:
        numbers.append(int(numbers.count(0) > numbers.count(1)))
    return tuple(numbers)
