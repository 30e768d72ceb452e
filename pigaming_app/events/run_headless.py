"""Matches of an event among AIs, at full speed and without a window.

The brains of all entrants share one compiled loop for each game, as in a league; matches that are open at the same time
are played as one batch. An entrant without a brain is played by DEFAULT_AI.
"""

from collections.abc import Sequence
from itertools import groupby
from typing import Any

from pigaming_app.ai.brain.baselines import IDLE
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.experiments.cast import Cast
from pigaming_app.ai.experiments.league import MIN_COMPILED_MATCHES
from pigaming_app.ai.experiments.rollout import compiled_rollout, plain_rollout
from pigaming_app.ai.registry import find_brain
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import outcome_of, setup_of, variant_of
from pigaming_app.events.spec import DEFAULT_AI, EventSpec, Fixture, Format, Outcome
from pigaming_app.games.batch import initial_states
from pigaming_app.games.game import Row, Setup
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import DT, HZ, ROBOTS

BATCH = 32  # matches of one compiled batch: what a kill can cost


class HeadlessRun:
    """Plays fixtures of one event. `fast`: compiled; None: compiled if it repays compiling."""

    def __init__(self, event: Event, fast: bool | None = None) -> None:
        """Raises ChoiceError for brains, arenas or rules that do not exist."""
        self.fast: dict[str, bool] = {}
        self._casts: dict[str, tuple[frozenset[BrainKind], Cast]] = {}
        compilable = can_compile()
        for game in dict.fromkeys(event.spec.games):
            ticks = ticks_of(event.spec, game) * matches_left(event) // len({*event.spec.games})
            plain = any(kind.plain for kind in _kinds(event, game))
            wanted = compilable and ticks > MIN_COMPILED_MATCHES if fast is None else fast
            self.fast[game] = wanted and not plain

    def play(self, event: Event) -> list[Outcome]:
        """Play the next matches, at least one if any is open: those of one game, with one game's loop."""
        if not event.open:
            return []
        game, fixtures = next((key, [*group]) for key, group in groupby(event.open, lambda fixture: fixture.game))
        return self.play_these(event, fixtures[: BATCH if self.fast[game] else 1])

    def play_these(self, event: Event, fixtures: Sequence[Fixture]) -> list[Outcome]:
        """Play these fixtures, all of one game. Raises ChoiceError or ArenaError."""
        game = fixtures[0].game
        fast = self.fast[game]
        setups = [setup_of(event, fixture, DEFAULT_AI) for fixture in fixtures]
        cast = self._cast(event, game)
        states = initial_states(setups)
        matches = packed(states) if fast else states
        minds = cast.minds([_line_up(setup) for setup in setups])
        loop = (compiled_rollout if fast else plain_rollout)(game, cast.families)
        loop(matches, minds, cast.weights, ticks_of(event.spec, game))
        ended = [unpack(games()[game].state, row) for row in matches] if fast else matches
        return [outcome_of(fixture, _rows(game, state)) for fixture, state in zip(fixtures, ended, strict=True)]

    def _cast(self, event: Event, game: str) -> Cast:
        kinds = frozenset(_kinds(event, game))
        if game not in self._casts or self._casts[game][0] != kinds:
            self._casts[game] = kinds, Cast([*dict.fromkeys(_kinds(event, game))], self.fast[game])
        return self._casts[game][1]


def ticks_of(spec: EventSpec, game: str) -> int:
    """Ticks after which a match of this game is over."""
    variant = variant_of(spec, game)
    return round(((spec.minutes.get(game) or variant.default_minutes) * 60 + variant.overtime) * HZ)


def seconds_of(spec: EventSpec, game: str) -> float:
    """Longest match of this game, s."""
    return ticks_of(spec, game) * DT


def matches_left(event: Event) -> int:
    """Matches to come, estimated where they are not drawn yet."""
    spec, count = event.spec, len(event.entrants)
    if spec.format == Format.KNOCKOUT:
        return max(len(event.open), 2 * count // (spec.seats - 1) - len(event.outcomes))
    if spec.format == Format.SWISS:
        return max(len(event.open), (spec.rounds or 6) * count // spec.seats - len(event.outcomes))
    return len(event.open)


def _kinds(event: Event, game: str) -> list[BrainKind]:
    """The brains of all entrants, of the default AI, of filled and of empty seats."""
    names = [*(entrant.brain or DEFAULT_AI for entrant in event.entrants)]
    names += [event.spec.fill] if event.spec.fill else []
    return [IDLE, *(find_brain(game, name) for name in names)]


def _line_up(setup: Setup) -> list[tuple[BrainKind, int]]:
    """Brain and seed of every seat, as `new_match` has them."""
    kinds = [IDLE if seat.brain == "off" else find_brain(setup.game, seat.brain) for seat in setup.seats]
    return [(kind, setup.seed * ROBOTS + seat) for seat, kind in enumerate(kinds)]


def _rows(game: str, state: Any) -> list[Row]:
    """Place and score of every robot that played."""
    keys, _ = standings(games()[game], state)
    robots = state.robots
    return [
        Row(seat, robots[seat].team, 1 + sum(key > own for key in keys.values()), robots[seat].score, {}, {}, ())
        for seat, own in keys.items()
    ]
