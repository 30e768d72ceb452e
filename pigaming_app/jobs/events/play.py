"""Play an event from where it stopped, in the arcade; with --headless without a window, its AIs at full speed.

An entrant without a brain is played by level3; in the arcade that is a person, and matches of AIs alone follow one
another by themselves. Every result is in the file before the next match; the event goes on from there after Ctrl-C, a
kill or a power cut.
"""

import sys
from argparse import ArgumentTypeError
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import groupby
from math import inf
from pathlib import Path
from time import perf_counter, sleep
from typing import TYPE_CHECKING, Any

from pigaming_app.ai.registry import find_brain
from pigaming_app.events import event_files, resume
from pigaming_app.events.event import Event
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.match_setup import check_playable, outcome_of, setup_of
from pigaming_app.events.network.mirror import SCHEME, Host, host_at
from pigaming_app.events.spec import DEFAULT_AI, Fixture, Result, check_name
from pigaming_app.games.game import Row
from pigaming_app.games.match import standings
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, longest
from pigaming_app.jobs import arcade
from pigaming_app.jobs.events.files import loaded
from pigaming_app.jobs.events.joining import joined
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import JsonOption, KioskOptions, argument, decimal, flag, option, path, word
from pigaming_app.jobs.terminal.refusal import Refusal, module_of, refused, require_for_brains
from pigaming_app.scenes.events.quick_match import play
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import DT
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.safe_files import require_writable
from pigaming_app.storage.settings import folders
from pigaming_app.ui.web import PORT

if TYPE_CHECKING:
    from pigaming_app.ai.learning.line_ups import LineUps

WORTH_COMPILING = 600_000  # ticks: half a minute of plain matches, which compiling takes the first time
BATCH = 32  # matches of one compiled batch: the most that a kill can cost


def _speed(text: str) -> float:
    """Times real time; infinity for "max"."""
    return inf if text == "max" else decimal(0.01, 10_000.0)(text)


def _place(text: str) -> Path | Host:
    """A file, or the computer at an address."""
    if not text.lower().startswith(SCHEME):
        return path(text)
    try:
        return host_at(text, PORT)
    except ValueError:
        raise ArgumentTypeError(f"{quote(text)} is not the address of a desk, as http://192.168.1.5:{PORT}") from None


@dataclass(frozen=True, kw_only=True)
class PlayEventOptions(KioskOptions, JsonOption):
    """The event, and how to play it."""

    file: Path | Host = argument("the event, or the address of a desk that has it: http://…", _place, metavar="FILE")
    arcade: str = option("name of this arcade, if several play the event", word, "", metavar="NAME")
    headless: bool = flag("no window, no sound")
    speed: float = option("with --headless: times real time, or max; default max", _speed, inf)


def run(options: PlayEventOptions) -> int:
    """Play all matches that are left and print the table, or open the event in the arcade. Raises Refusal, NotSaved."""
    if options.arcade:
        with refused(ValueError):
            check_name(options.arcade, "bad_arcade")
    if isinstance(options.file, Host) and (options.headless or not options.arcade):
        raise Refusal("event run: an address needs --arcade, and goes without --headless")
    file = joined(options.file, options.arcade) if isinstance(options.file, Host) else options.file
    event = loaded(file)
    if not options.headless:
        return _in_window(options, file, event)
    if options.kiosk or options.display is not None or options.scoreboard or options.arcade:
        raise Refusal("event run: --kiosk, --display, --scoreboard and --arcade go without --headless")
    module_of("learning", "learning")  # whose compiled loops play the matches
    require_writable(file)
    require_for_brains([*(entrant.brain for entrant in event.entrants), event.spec.fill or ""])
    began, before = perf_counter(), len(event.outcomes)
    with refused(ChoiceError, ArenaError, ValueError):
        check_playable(replace(event.spec, entrants=event.entrants), find_brain)
        headless = HeadlessRun(event)
        while not event.over:
            if not event.open:
                event = event_files.update(file, _continued, event)
                continue
            started = perf_counter()
            outcomes, entrants = headless.play(event), event.entrants
            event = event_files.update(file, partial(_recorded, outcomes), event)
            if event.entrants != entrants:  # changed by another process
                headless = HeadlessRun(event)
            _progress(event)
            if options.speed < inf:
                sleep(max(0.0, _longest(event, outcomes) / options.speed - (perf_counter() - started)))
    seconds, played = perf_counter() - began, len(event.outcomes) - before
    if sys.stderr.isatty():
        print(end="\r\x1b[K", file=sys.stderr)
    print_event(event, options.json, seconds=seconds, matches_per_second=played / seconds)
    return 0


def _in_window(options: PlayEventOptions, file: Path, event: Event) -> int:
    """The arcade on the page of the next match; in a kiosk under a supervisor. Raises Refusal or NotSaved."""
    if options.json or options.speed < inf:
        raise Refusal("event run: --json and --speed need --headless")
    if arcade.needs_supervisor(options):
        resume.mark(folders().data, file, options.arcade)
        return arcade.supervised(options)
    from pigaming_app.boot.fetch import COMMAND
    from pigaming_app.scenes.events.choice import page_of
    from pigaming_app.scenes.events.running import RunningEvent
    from pigaming_app.scenes.launch import Options

    plain = Options(display=options.display, scoreboard=options.scoreboard, kiosk=options.kiosk, fetch_networks=COMMAND)
    if options.kiosk:  # which opens the event that is marked, until somebody leaves it
        return arcade.show(plain)
    running = RunningEvent(file, event, arcade=options.arcade)
    return arcade.show(replace(plain, first_scene=lambda context: page_of(context, running)))


def _continued(event: Event) -> Event:
    """The event with what AIs do next in a format on call, unless another process was faster."""
    return event if event.open or event.over else event.continued()


def _recorded(outcomes: list[Result], event: Event) -> Event:
    """The event with these outcomes, as far as another process has not been faster. Raises ValueError."""
    for outcome in outcomes:
        before = len(event.played.get(outcome.fixture, ()))
        if outcome.fixture not in event.outcomes and outcome.extra == before:
            event = event.record(outcome)
    return event


def _longest(event: Event, outcomes: list[Result]) -> float:
    """Length of these matches one after the other, s."""
    numbers = {outcome.fixture for outcome in outcomes}
    return sum(seconds_of(event, fixture) for fixture in event.fixtures if fixture.number in numbers)


def _progress(event: Event) -> None:
    if sys.stderr.isatty():
        left = len(event.open)
        print(
            end=f"\r\x1b[Kround {event.round}: {len(event.outcomes)} matches, {left} open", file=sys.stderr, flush=True
        )


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
