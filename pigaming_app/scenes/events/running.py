"""A running event and its file. A change is on the disk before any page shows it."""

import contextlib
import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

from pigaming_app.ai.registry import find_brain
from pigaming_app.events import event_files
from pigaming_app.events.changes import calendar
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Summoned
from pigaming_app.events.match_setup import setup_of
from pigaming_app.events.spec import MOST, WEEK, Fixture, Result
from pigaming_app.games.game import Setup
from pigaming_app.scenes.events.names import shortened
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device

log = logging.getLogger("pigaming")


@dataclass
class RunningEvent:
    """The event in a file. `devices`: what each entrant has driven with, since the start of the arcade."""

    path: Path
    event: Event
    devices: dict[str, Device] = field(default_factory=dict)
    arcade: str = ""  # its name, if several play this event
    alone: bool = False  # the computer that has the event does not answer just now
    _version: tuple[int, ...] | None = None  # of the file that was read last
    _known: tuple[Event, Fixture, Setup | None] | None = None  # the latest answer of `setup`

    def change(self, change: Callable[[Event], Event]) -> bool:
        """Change the event and its file, which another process may have changed meanwhile.

        False if it cannot be saved now; it is saved with the next change, or lost when the arcade ends. Raises
        ValueError if the change is not possible any more.
        """
        try:
            self.event = event_files.update(self.path, change, self.event)
        except NotSaved as reason:
            log.warning("%s", reason)
            self.event = change(self.event)
            return False
        except ValueError:
            self.event = event_files.latest(self.path, self.event)
            raise
        return True

    def refresh(self) -> None:
        """Take over what another process has changed, and close the weeks of a ladder that have passed."""
        version = event_files.version(self.path)
        if version != self._version:
            self._version = version
            with contextlib.suppress(ValueError):  # the file has another event now
                self.event = event_files.latest(self.path, self.event)
        if calendar.due(self.event, date.today()):
            self.change(lambda event: calendar.up_to(event, date.today()))

    @property
    def queue(self) -> tuple[Fixture, ...]:
        """The open matches that this arcade may play, the next one first; empty while all are played elsewhere."""
        event, first = self.event, self.event.next_at(self.arcade)
        if first is None:
            return ()
        calls = event.calls
        rest = (one for one in event.open if one != first and calls.get(one.number, self.arcade) == self.arcade)
        return (first, *rest)

    def claim(self) -> None:
        """Call the next match to this arcade, if it has a name and nobody was faster."""

        def claimed(event: Event) -> Event:
            fixture = event.next_at(self.arcade)
            if fixture is None or event.pause is not None or fixture.number in event.calls:
                return event
            return event.after(Summoned(fixture.number, self.arcade))

        if self.arcade and claimed(self.event) is not self.event:
            with contextlib.suppress(ValueError):
                self.change(claimed)

    def release(self) -> None:
        """Take back the calls to this arcade, so that others play these matches."""
        if own := [number for number, arcade in self.event.calls.items() if self.arcade and arcade == self.arcade]:
            with contextlib.suppress(ValueError):
                self.change(lambda event: event.after(Summoned(own[0], None)))

    def setup(self, fixture: Fixture) -> Setup | None:
        """The match of a fixture; None, with a line in the log, if a brain or an arena is missing."""
        if self._known is None or self._known[0] is not self.event or self._known[1] != fixture:
            setup = None
            try:
                setup = setup_of(self.event, fixture)
                for brain in {seat.brain for seat in setup.seats} - {"human", "off"}:
                    find_brain(fixture.game, brain)
            except ValueError as reason:
                log.warning("%s", reason)
                setup = None
            self._known = self.event, fixture, setup
        return self._known[2]

    @property
    def accepts_late(self) -> bool:
        """True as long as late entrants may join: until a match of round two has been played."""
        return accepts_late(self.event)

    def brain(self, name: str) -> str:
        """The brain of an entrant now; empty: a person."""
        return next((entrant.brain for entrant in self.event.entrants if entrant.name == name), "")

    def is_person(self, name: str) -> bool:
        """True for an entrant who is a person, even while an AI drives."""
        late = (entry.entrant for entry in self.event.journal if isinstance(entry, Added))
        return any(one.name == name and not one.brain for one in (*self.event.spec.entrants, *late))

    def without_people(self, fixture: Fixture) -> bool:
        """True if only AIs play that this computer has; programs play on the screen."""
        brains = [self.brain(name) for name in fixture.entrants]
        return all(brain and not brain.startswith("bot:") for brain in brains)


def accepts_late(event: Event) -> bool:
    """True as long as late entrants may join: until a match of round two has been played."""
    if event.progress.kind.on_call:
        return not event.over and len(event.entrants) < MOST
    begun = any(fixture.round > 1 and fixture.number in event.played for fixture in event.fixtures)
    return not begun and not event.over and len(event.entrants) < MOST


def progress_line(words: Words, event: Event) -> str:
    """Round, and matches played of those known; of a ladder the week, of tries how many there were."""
    on_call, progress = event.progress.kind.on_call, event.progress
    if on_call and on_call.periods(event.spec) > 1:
        weeks = on_call.periods(event.spec)
        return words("events.in_week", week=min(progress.closed + 1, weeks), of=weeks)
    if on_call:
        return words("events.tried", count=len(event.played))
    played = len(event.outcomes)
    return words(
        "events.progress", round=max(1, event.round), match=min(played + 1, len(event.fixtures)), of=len(event.fixtures)
    )


def stage_name(words: Words, stage: str, number: int, drawn: Iterable[tuple[str, int]]) -> str:
    """The name of a round, counted within its stage, but for weeks; `drawn`: stage and round of all matches."""
    if stage != WEEK:
        number = len({one for one in drawn if one[0] == stage and one[1] <= number})
    kind, _, group = stage.partition(" ")
    return words(f"events.stage_{kind}", round=number, group=group) if stage else words("events.round", round=number)


def round_name(words: Words, event: Event, fixture: Fixture) -> str:
    """The name of the round of a match that is drawn."""
    return stage_name(words, fixture.stage, fixture.round, ((one.stage, one.round) for one in event.fixtures))


def lots_line(words: Words, event: Event, outcome: Result) -> str:
    """Who goes on by lot, in one line, if lots were drawn after this match; else nothing."""
    if not outcome.extra or not event.lots(outcome.fixture) or outcome != event.played[outcome.fixture][-1]:
        return ""
    fixture = next(one for one in event.fixtures if one.number == outcome.fixture)
    best = event.through(fixture)
    names = [name for name in outcome.places[0] if name in best]
    return words("events.lots", name=", ".join(map(shortened, names)))


def decided_by(words: Words, event: Event, number: int) -> str:
    """What has decided a match, if it was level: extra matches or lots; else nothing."""
    if event.lots(number):
        return words("events.by_lot")
    return words("events.sudden_death") if len(event.played.get(number, ())) > 1 else ""
