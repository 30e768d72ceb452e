"""Matches of an event among AIs, at full speed and without a window.

The brains of all entrants share one compiled loop for each game, as in a league; matches that are open at the same time
are played as one batch, extra matches one by one. An entrant without a brain is played by DEFAULT_AI.
"""

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from pigaming_app.ai.registry import find_brain
from pigaming_app.events.event import Event
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.match_setup import outcome_of, setup_of
from pigaming_app.events.spec import DEFAULT_AI, Fixture, Result
from pigaming_app.games.game import Row
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import longest
from pigaming_app.scenes.events.quick_match import play
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT

if TYPE_CHECKING:
    from pigaming_app.ai.learning.line_ups import LineUps

WORTH_COMPILING = 600_000  # ticks: half a minute of plain matches, which compiling takes the first time
BATCH = 32  # matches of one compiled batch: the most that a kill can cost


class HeadlessRun:
    """Plays fixtures of one event. `fast`: compiled; None: compiled if it repays compiling."""

    def __init__(self, event: Event, fast: bool | None = None) -> None:
        """Raises ChoiceError for brains, arenas or rules that do not exist."""
        self._line_ups = {game: self._line_up(event, game, fast) for game in dict.fromkeys(event.spec.games)}

    def play(self, event: Event) -> list[Result]:
        """Play the next matches, at least one if any is open: those of one game, with one game's loop."""
        for (game, extra), fixtures in groupby(event.open, lambda fixture: (fixture.game, fixture.extra > 0)):
            if extra:
                return [play(event, next(fixtures), DEFAULT_AI)]
            return self.play_these(event, [*fixtures][: BATCH if self._line_ups[game].fast else 1])
        return []

    def play_these(self, event: Event, fixtures: Sequence[Fixture]) -> list[Result]:
        """Play these fixtures, all of one game. Raises ChoiceError or ArenaError."""
        game = fixtures[0].game
        setups = [setup_of(event, fixture, DEFAULT_AI) for fixture in fixtures]
        states = self._line_ups[game].played(setups)
        return [
            outcome_of(event.spec, fixture, _rows(game, state)) for fixture, state in zip(fixtures, states, strict=True)
        ]

    def _line_up(self, event: Event, game: str, fast: bool | None) -> "LineUps":
        from pigaming_app.ai.learning.line_ups import LineUps  # of another feature

        brains = [*dict.fromkeys(entrant.brain or DEFAULT_AI for entrant in event.entrants)]
        brains += [event.spec.fill] if event.spec.fill else []
        if fast is None:
            matches = matches_left(event) // len({*event.spec.games})
            names, arena = tuple(entrant.name for entrant in event.entrants), (event.spec.arenas.get(game) or ("",))[0]
            example = Fixture(1, 1, "", game, arena, names[: event.spec.seats], 1)
            fast = can_compile() and matches * _ticks(event, example) > WORTH_COMPILING
        return LineUps(game, brains, fast and not any(find_brain(game, name).plain for name in brains))


def seconds_of(event: Event, fixture: Fixture) -> float:
    """Longest time of a match, s."""
    return _ticks(event, fixture) * DT


def matches_left(event: Event) -> int:
    """Matches to come, estimated where they are not drawn yet."""
    kind, count = KINDS[event.spec.format], len(event.entrants)
    return max(len(event.open), kind.matches(event.spec, count) - len(event.outcomes))


def _ticks(event: Event, fixture: Fixture) -> int:
    return longest(setup_of(event, fixture, DEFAULT_AI))


def _rows(game: str, state: Any) -> list[Row]:
    """Place and score of every robot that played."""
    rules, robots = games()[game], state.robots
    keys, _ = standings(rules, state)
    return [
        Row(
            seat,
            robots[seat].team,
            1 + sum(key > own for key in keys.values()),
            robots[seat].score,
            {},
            rules.records(state, seat),
            (),
        )
        for seat, own in keys.items()
    ]
