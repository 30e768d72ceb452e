"""A new event: entrants, format, games. Prints its first matches."""

import os
import sys
from argparse import ArgumentTypeError
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path
from random import Random
from typing import TypeVar

from pigaming_app.ai.brain_files import is_path
from pigaming_app.ai.registry import find_brain
from pigaming_app.events import event_files
from pigaming_app.events.entrant_lists import EntrantList, entrants_of_text, entrants_of_words, read_list
from pigaming_app.events.event import Event
from pigaming_app.events.formats.registry import KINDS
from pigaming_app.events.match_setup import check_playable
from pigaming_app.events.spec import (
    DEFAULT_AI,
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
from pigaming_app.games.setup import ChoiceError, require_game, require_one_of
from pigaming_app.jobs.events.files import FileOption
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import DEFAULT_GAME, JsonOption, decimal, games_and, integer, option, word
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require_for_brains
from pigaming_app.sim.arena import ArenaError
from pigaming_app.storage.parsing import describe_error, quote
from pigaming_app.storage.safe_files import require_writable

T = TypeVar("T")
SEEDINGS = ("list", "random")
BY_GAME = "for one game, or GAME=VALUE,GAME=VALUE"


@dataclass(frozen=True, kw_only=True)
class NewEventOptions(FileOption, JsonOption):
    """Entrants, format and games."""

    game: str = option(games_and("or several with commas: by turns", default=DEFAULT_GAME), default=DEFAULT_GAME)
    format: str = option(", ".join(Format), required=True)
    entrants: str = option(
        f"{FEWEST} to {MOST}: NAME, NAME=AI or NAME/TEAM=AI with commas, or @FILE with one in a line, or CSV",
        required=True,
    )
    teams: str | None = option("`class`: each class of the list is a team", metavar="class")
    seeding: str = option("list: best first; or random, by --seed; default list", default="list")
    rounds: int = option(
        "of a Swiss or a Grand Prix; times that everybody meets everybody; weeks of a ladder; most tries of everybody",
        integer(high=MAX_ROUNDS),
        0,
        metavar="NUMBER",
    )
    seats: int | None = option("entrants of a match", integer(1, SEATS[-1]), metavar="NUMBER")
    minutes: str | None = option(f"length of a match; {BY_GAME}")
    arena: str | None = option(f"arena, or several with + by turns; {BY_GAME}")
    rules: str | None = option(f"set of rules; {BY_GAME}", name=("--rules", "--variant"))
    advance: str = option("in a knock-out: the better half, or quarter", default=Advance.HALF.value)
    fill: str = option("AI on empty seats of a Grand Prix, or beside whoever tries", default="", metavar="AI")
    reach: int = option(
        "of a challenge ladder: places up to which a challenge goes; default 3", integer(1, MOST - 1), 3
    )
    title: str | None = option("default: the name of the file", word)
    seed: int = option("random seed; default 1", integer(0, MAX_SEED), 1, metavar="NUMBER")


def run(options: NewEventOptions) -> int:
    """Write the file. Raises Refusal or NotSaved."""
    if options.file.exists():
        raise Refusal(f"{options.file}: exists already; event run continues it")
    with refused(ChoiceError, ArenaError, ValueError):
        spec = _spec(options)
        require_for_brains([*(entrant.brain for entrant in spec.entrants), spec.fill or ""], play=False)
        event = Event(spec)
        _ = event.progress  # checks the spec
        check_playable(spec, find_brain)
    require_writable(options.file)  # its folder has to exist
    event_files.save(options.file, event)
    print_event(event, options.json)
    return 0


def _spec(options: NewEventOptions) -> EventSpec:
    played = tuple(name.strip() for name in options.game.split(","))
    for name in played:
        require_game(name)
    require_one_of("format", options.format, list(Format))
    require_one_of("seeding", options.seeding, SEEDINGS)
    if options.teams is not None:
        require_one_of("choice for --teams:", options.teams, ["class"])
    require_one_of("choice for --advance:", options.advance, list(Advance))
    form = Format(options.format)
    kind = KINDS[form]
    seats = options.seats or kind.seats[0]
    return EventSpec(
        title=options.title or options.file.stem[:MAX_TITLE],
        format=form,
        games=played,
        entrants=tuple(with_whole_path(entrant) for entrant in _seeded(options, _entrants(options, played))),
        rounds=options.rounds,
        seats=seats,
        arenas=_by_game("--arena", options.arena, played, _arenas),
        minutes=_by_game("--minutes", options.minutes, played, decimal(0.0, 3600.0)),
        variants=_by_game("--rules", options.rules, played, str),
        seed=options.seed,
        advance=Advance(options.advance),
        fill=options.fill or (DEFAULT_AI if kind.single and seats > 1 else ""),
        reach=options.reach,
        start=date.today().isoformat() if form is Format.CHALLENGE else "",
    )


def _seeded(options: NewEventOptions, entrants: tuple[Entrant, ...]) -> tuple[Entrant, ...]:
    """The entrants in the order of their seeding."""
    if options.seeding == SEEDINGS[0]:
        return entrants
    return tuple(Random(f"seeding {options.seed}").sample(entrants, len(entrants)))


def _entrants(options: NewEventOptions, played: tuple[str, ...]) -> tuple[Entrant, ...]:
    text, by_class = options.entrants, options.teams is not None
    if not text.startswith("@"):
        if by_class:
            raise Refusal("--teams class needs a list with a column of classes: --entrants @FILE")
        return entrants_of_words(text.split(","))
    file = Path(text[1:])
    try:
        content = read_list(file)
    except (OSError, ValueError) as error:
        raise Refusal(f"{quote(text[1:])}: cannot be read ({describe_error(error)})") from None
    try:
        found = entrants_of_text(content, lambda brain: require_brain(brain, played))
        found = found.by_class if by_class else found
    except ValueError as error:
        raise Refusal(f"{file}: {error}") from None
    if (count := len(found.entrants)) < FEWEST:
        where = f"{file}: line {len(content.splitlines())}"
        raise Refusal(f"{where}: the list ends with {count} entrants; an event has {FEWEST} to {MOST}")
    for line in _notes(found, by_class):
        print(f"PiGaming: {file}: {line}", file=sys.stderr)
    return found.entrants


def _notes(found: EntrantList, by_class: bool) -> Iterator[str]:
    """What has become of a list, a line each."""
    if found.ignored:
        yield f"columns that are not known are ignored: {', '.join(map(quote, found.ignored))}"
    if found.told_apart:
        yield f"equal first names are told apart: {', '.join(found.told_apart)}"
    if found.classes and not by_class:
        yield "with --teams class each class is a team"


def require_brain(brain: str, played: Sequence[str]) -> None:
    """Raises ChoiceError unless an AI plays all games, or Refusal if what runs it is missing."""
    require_for_brains([brain], play=False)
    for game in played:
        find_brain(game, brain)


def with_whole_path(entrant: Entrant) -> Entrant:
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
