"""What an operator changes in the file of an event, a word each, also while arcades play it.

Each prints the event, and raises Refusal or NotSaved.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date

from pigaming_app.events import event_files
from pigaming_app.events.changes import actions, calendar
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Entry, Paused, Resumed, Summoned, Swapped, Withdrawn
from pigaming_app.events.spec import Entrant
from pigaming_app.jobs.events.files import EventOptions, loaded
from pigaming_app.jobs.events.new import require_brain, with_whole_path
from pigaming_app.jobs.events.show import print_event
from pigaming_app.jobs.terminal.options import argument, flag, integer, option, word
from pigaming_app.jobs.terminal.refusal import Refusal, refused

PLACES = "scores, A=3 B=1: more is better; or places, A B: best first, and A+B share one"


@dataclass(frozen=True, kw_only=True)
class MatchOption(EventOptions):
    """A match of an event."""

    match: int = argument("its number, as `event show` prints it", integer(), metavar="MATCH")


@dataclass(frozen=True, kw_only=True)
class ResultOptions(MatchOption):
    """The match and its result."""

    places: tuple[str, ...] = argument(PLACES, word, nargs="+", metavar="ENTRANT")


@dataclass(frozen=True, kw_only=True)
class CorrectOptions(ResultOptions):
    """The match, its right result, and why it was wrong."""

    reason: str = option("why; it stays in the file", word, required=True, metavar="TEXT")


@dataclass(frozen=True, kw_only=True)
class EnterOptions(EventOptions):
    """Who comes late."""

    entrant: str = argument("NAME, NAME/TEAM, NAME=AI or NAME/TEAM=AI", word, metavar="NAME[/TEAM][=AI]")


@dataclass(frozen=True, kw_only=True)
class WithdrawOptions(EventOptions):
    """Who withdraws."""

    name: str = argument("the entrant", word, metavar="NAME")


@dataclass(frozen=True, kw_only=True)
class SwapOptions(EventOptions):
    """The two."""

    name: str = argument("an entrant", word, metavar="A")
    other: str = argument("another one", word, metavar="B")


@dataclass(frozen=True, kw_only=True)
class SeatOptions(MatchOption):
    """The match and its seats."""

    seats: tuple[str, ...] = argument("A=2 B=1; the others keep their order", word, nargs="+", metavar="NAME=SEAT")


@dataclass(frozen=True, kw_only=True)
class CallOptions(MatchOption):
    """The match and where it is played."""

    arcade: str = argument("name of the arcade, as `event run --arcade`; none: the only one", word, "", nargs="?")
    off: bool = flag("take the call back")


@dataclass(frozen=True, kw_only=True)
class PauseOptions(EventOptions):
    """The break."""

    note: str = argument("what everybody reads, as `until 11:30`", word, "", nargs="?", metavar="TEXT")
    off: bool = flag("end the break")


@dataclass(frozen=True, kw_only=True)
class ArrangeOptions(EventOptions):
    """The event, and who plays."""

    names: tuple[str, ...] = argument("entrants; of a challenge, the challenger first", metavar="NAME", nargs="+")


def result(options: ResultOptions) -> int:
    """Enter the result of a match that was played elsewhere."""
    return _enter(options, lambda event: actions.recorded(event, options.match, options.places))


def correct(options: CorrectOptions) -> int:
    """Replace the result of a match that has been played, for a reason that the file keeps."""
    return _enter(options, lambda event: actions.corrected(event, options.match, options.places, options.reason))


def enter(options: EnterOptions) -> int:
    """Enter a late entrant, until a match of round two has been played."""
    return _enter(options, lambda event: actions.entered(event, options.entrant, _complete))


def _complete(entrant: Entrant, games: Sequence[str]) -> Entrant:
    if entrant.brain:
        require_brain(entrant.brain, games)
    return with_whole_path(entrant)


def withdraw(options: WithdrawOptions) -> int:
    """Withdraw an entrant, who plays no more; open matches of two are walkovers."""
    return _enter(options, lambda _: Withdrawn(options.name))


def swap(options: SwapOptions) -> int:
    """Let two entrants exchange their places in the round that is open, as far as they have not played in it."""
    return _enter(options, lambda _: Swapped(options.name, options.other))


def seat(options: SeatOptions) -> int:
    """Choose the seats of a match: seat 1 is that of the first pad."""
    return _enter(options, lambda event: actions.seats(event, options.match, options.seats))


def call(options: CallOptions) -> int:
    """Call a match to an arcade, or take the call back."""
    if options.off and options.arcade:
        raise Refusal("event call: --off goes without the name of an arcade")
    return _enter(options, lambda _: Summoned(options.match, None if options.off else options.arcade))


def pause(options: PauseOptions) -> int:
    """Begin a break, in which no match is called, or end it."""
    if options.off and options.note:
        raise Refusal("event break: --off goes without a text")
    return _enter(options, lambda _: Resumed() if options.off else Paused(options.note[: actions.MAX_NOTE]))


def arrange(options: ArrangeOptions) -> int:
    """Arrange a match of those who want to play: a challenge, the challenger first, or a try.

    For formats without a draw: challenge ladder, time trial, high score.
    """
    return _change(options, lambda event: calendar.up_to(event, date.today()).arrange(*options.names))


def close(options: EventOptions) -> int:
    """End the week of a challenge ladder, or the day of a time trial or a high score. Open matches lapse."""
    return _change(options, Event.close)


def _enter(options: EventOptions, action: Callable[[Event], Entry]) -> int:
    """Add the entry that an action makes of the event."""
    return _change(options, lambda event: event.after(action(event)))


def _change(options: EventOptions, change: Callable[[Event], Event]) -> int:
    """Change the event in the file, and print it."""
    known = loaded(options.file)  # restores a damaged one
    with refused(ValueError):
        event = event_files.update(options.file, change, known)
    print_event(event, options.json)
    return 0
