"""A new event: entrants, format, games. Prints its first matches."""

import os
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from pigaming_app.ai.brain_files import is_path
from pigaming_app.ai.registry import find_brain
from pigaming_app.events import event_files
from pigaming_app.events.entrant_lists import entrants_of_text, entrants_of_words, read_list
from pigaming_app.events.event import Event
from pigaming_app.events.match_setup import check_playable
from pigaming_app.events.spec import (
    FEWEST,
    MAX_ROUNDS,
    MAX_SEED,
    MAX_TITLE,
    MOST,
    SEATS,
    Advance,
    Entrant,
    EventSpec,
    Format,
)
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError, require_game, require_one_of
from pigaming_app.jobs.events.files import file_option
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import DEFAULT_GAME, decimal, integer, word
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.parsing import describe_error, quote
from pigaming_app.storage.safe_files import require_writable

T = TypeVar("T")
BY_GAME = "for one game, or GAME=VALUE,GAME=VALUE"
DEFAULT_SEATS = {Format.GRAND_PRIX: 4}  # else 2


def options(parser: ArgumentParser) -> None:
    file_option(parser)
    names = ", ".join(games())
    parser.add_argument(
        "--game", default=DEFAULT_GAME, help=f"{names}, or several with commas: by turns; default {DEFAULT_GAME}"
    )
    parser.add_argument("--format", required=True, help=", ".join(Format))
    parser.add_argument(
        "--entrants",
        required=True,
        help=f"{FEWEST} to {MOST}: NAME, NAME=AI or NAME/TEAM=AI with commas, or @FILE with one in a line, or CSV",
    )
    parser.add_argument(
        "--rounds",
        type=integer(high=MAX_ROUNDS),
        metavar="NUMBER",
        default=0,
        help="of a Swiss or a Grand Prix; of a round robin: times that everybody meets everybody",
    )
    parser.add_argument("--seats", type=integer(SEATS[0], SEATS[-1]), metavar="NUMBER", help="entrants of a match")
    parser.add_argument("--minutes", help=f"length of a match; {BY_GAME}")
    parser.add_argument("--arena", help=f"arena, or several with + by turns; {BY_GAME}")
    parser.add_argument("--rules", "--variant", help=f"set of rules; {BY_GAME}")
    parser.add_argument("--advance", default=Advance.HALF.value, help="in a knock-out: the better half, or quarter")
    parser.add_argument("--fill", default="", metavar="AI", help="AI on empty seats of a Grand Prix")
    parser.add_argument("--title", type=word, help="default: the name of the file")
    parser.add_argument("--seed", type=integer(0, MAX_SEED), metavar="NUMBER", default=1, help="random seed; default 1")
    parser.add_argument("--json", action="store_true", help="print the event as one JSON object")


def run(arguments: Namespace) -> int:
    """Write the file. Raises Refusal or NotSaved."""
    if arguments.file.exists():
        raise Refusal(f"{arguments.file}: exists already; event run continues it")
    with refused(ChoiceError, ArenaError, ValueError):
        spec = _spec(arguments)
        require_for_brains(entrant.brain for entrant in spec.entrants)
        event = Event(spec)
        _ = event.progress  # checks the spec
        check_playable(spec, find_brain)
    require_writable(arguments.file)  # its folder has to exist
    event_files.save(arguments.file, event)
    print_event(event, arguments.json)
    return 0


def _spec(arguments: Namespace) -> EventSpec:
    played = tuple(name.strip() for name in arguments.game.split(","))
    for name in played:
        require_game(name)
    require_one_of("format", arguments.format, list(Format))
    require_one_of("choice for --advance:", arguments.advance, list(Advance))
    form = Format(arguments.format)
    return EventSpec(
        title=arguments.title or arguments.file.stem[:MAX_TITLE],
        format=form,
        games=played,
        entrants=tuple(_with_whole_path(entrant) for entrant in _entrants(arguments.entrants, played)),
        rounds=arguments.rounds,
        seats=arguments.seats or DEFAULT_SEATS.get(form, SEATS[0]),
        arenas=_by_game("--arena", arguments.arena, played, _arenas),
        minutes=_by_game("--minutes", arguments.minutes, played, decimal(0.0, 3600.0)),
        variants=_by_game("--rules", arguments.rules, played, str),
        seed=arguments.seed,
        advance=Advance(arguments.advance),
        fill=arguments.fill,
    )


def _entrants(text: str, played: tuple[str, ...]) -> tuple[Entrant, ...]:
    if not text.startswith("@"):
        return entrants_of_words(text.split(","))
    file = Path(text[1:])
    try:
        content = read_list(file)
    except (OSError, ValueError) as error:
        raise Refusal(f"{quote(text[1:])}: cannot be read ({describe_error(error)})") from None
    try:
        found = entrants_of_text(content, lambda brain: _require_brain(brain, played))
    except ValueError as error:
        raise Refusal(f"{file}: {error}") from None
    if (count := len(found.entrants)) < FEWEST:
        where = f"{file}: line {len(content.splitlines())}"
        raise Refusal(f"{where}: the list ends with {count} entrants; an event has {FEWEST} to {MOST}")
    if found.ignored:
        print(
            f"PiGaming: {file}: columns that are not known are ignored: {', '.join(map(quote, found.ignored))}",
            file=sys.stderr,
        )
    return found.entrants


def _require_brain(brain: str, played: tuple[str, ...]) -> None:
    """Raises ChoiceError unless an AI plays all games, or Refusal if what runs it is missing."""
    require_for_brains([brain])
    for game in played:
        find_brain(game, brain)


def _with_whole_path(entrant: Entrant) -> Entrant:
    """A brain's file is found from any folder."""
    return replace(entrant, brain=os.path.abspath(entrant.brain)) if is_path(entrant.brain) else entrant


def _arenas(text: str) -> tuple[str, ...]:
    """Arenas that take turns; files by their whole path, found from any folder."""
    return tuple(os.path.abspath(name) if name.endswith(".toml") else name for name in text.split("+"))


def _by_game(option: str, text: str | None, played: tuple[str, ...], of: Callable[[str], T]) -> dict[str, T]:
    """The values of an option by game: one for all games, or GAME=VALUE for some. Raises Refusal."""
    if text is None:
        return {}
    if "=" not in text:
        return {game: _value(option, text, of) for game in played}
    found = {}
    for part in text.split(","):
        game, _, value = part.strip().partition("=")
        if game not in played:
            raise Refusal(f"{option}: {quote(part)}; GAME=VALUE is needed, with one of {', '.join(played)}")
        found[game] = _value(option, value, of)
    return found


def _value(option: str, text: str, of: Callable[[str], T]) -> T:
    try:
        return of(text)
    except ArgumentTypeError as error:
        raise Refusal(f"{option}: {error}") from None
