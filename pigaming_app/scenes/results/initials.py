"""Initials entry: everyone in the top eight enters three letters at once, each on their own device.

After ten seconds the letters are accepted as they are; untouched letters count as none.
"""

import logging
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import pygame

from pigaming_app.games.game import Outcome, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.scene import Context, Pop, Scene, StackOperation, Swap
from pigaming_app.scenes.results import initials_view as page
from pigaming_app.scenes.results.high_scores import contest, counts, format_score, table_of
from pigaming_app.scenes.results.spelling import Spelling
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.scores import Score, ScoreTable
from pigaming_app.storage.settings import folders
from pigaming_app.ui.draw import FOCUS, LABEL
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import LitImage, backdrop
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.labels import black_out, call_to_action, heading, pulse
from pigaming_app.ui.widgets.player_card import ask_bar, ready_bar

TOP = 8  # places, today and of all time, that qualify
SECONDS = 10.0  # time limit for all players together
INPUT_LOCKOUT = 0.5  # s during which input is ignored
SPANS = {"results.today": 1, "results.ever": None}  # headings and their spans in days

_log = logging.getLogger(__name__)


Achievements = tuple[tuple[ScoreTable, int], ...]
Then = Callable[[Sequence[Score]], Scene | None]


@dataclass(frozen=True)
class Qualification:
    """Qualifying results of one person: each table with its value.

    `places`: for each table, the places of the value with the headings of the spans.
    """

    seat: int
    device: Device
    achievements: Achievements
    places: tuple[tuple[tuple[str, int], ...], ...]


def qualifying(
    context: Context, outcome: Outcome, setup: Setup, devices: Sequence[Device | None]
) -> list[Qualification]:
    """Qualifying results, ranked together with the other people's of this match. `devices`: driver of each seat."""
    done = achieved(outcome, setup, [seat for seat, device in enumerate(devices) if device])
    out = []
    for seat, achievements in done.items():
        rivals = [
            achievement
            for rival, achievements_of_rival in done.items()
            if rival != seat
            for achievement in achievements_of_rival
        ]
        ranked = [(achievement, places(context, *achievement, rivals)) for achievement in achievements]
        qualified = [(achievement, here) for achievement, here in ranked if here]
        device = devices[seat]
        if qualified and device:
            out.append(
                Qualification(
                    seat,
                    device,
                    tuple(achievement for achievement, _ in qualified),
                    tuple(here for _, here in qualified),
                )
            )
    return out


def achieved(outcome: Outcome, setup: Setup, seats: Sequence[int]) -> dict[int, Achievements]:
    """Results above zero of people for whom the match counts, by seat."""
    achievements = games()[setup.game].records_of(setup.variant)
    done = {}
    for row in outcome.rows:
        if row.seat in seats and setup.seats[row.seat].brain == "human" and counts(setup, row.seat):
            conditions = contest(setup, row.seat)
            values = [
                (table_of(conditions, achievement), row.records.get(achievement.name, 0))
                for achievement in achievements
            ]
            done[row.seat] = tuple((table, value) for table, value in values if value > 0)
    return done


def places(
    context: Context, table: ScoreTable, value: int, rivals: Sequence[tuple[ScoreTable, int]]
) -> tuple[tuple[str, int], ...]:
    """Places of a value in the top eight of today and of all time, with their headings.

    `rivals`: results of the other people in this match; better ones rank ahead.
    """
    others = [other for there, other in rivals if there == table]
    ahead = sum(other < value if table.timed else other > value for other in others)
    ranks = []
    for title, days in SPANS.items():
        place = context.scores.place(table, value, days)
        if place and place + ahead <= TOP:
            ranks.append((title, place + ahead))
    return tuple(ranks)


class Initials:
    """Entry page for all `qualifying` at once. `then`: makes the next scene from the new rows; None: the one below."""

    def __init__(
        self,
        context: Context,
        qualifying: Sequence[Qualification],
        then: Then,
        format_value: Callable[[int, ScoreTable], str] = format_score,
    ) -> None:
        self.context, self.claims = context, sorted(qualifying, key=lambda claim: claim.seat)
        self.then, self.format_value = then, format_value
        self.spellings = {claim.device: Spelling() for claim in self.claims}
        self.age = 0.0
        self.prewarm_queue = PrewarmQueue(self._prewarm_jobs())

    def prewarm(self) -> None:
        """Prewarm one widget of the page, to avoid one long frame."""
        self.prewarm_queue.work(0.0)

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """Each player's input changes only their own letters."""
        device = self._device_of(event)
        if self.age < INPUT_LOCKOUT or device is None:
            return None
        if sound := self.spellings[device].handle(event.button):
            self.context.sounds.play(sound, next(claim.seat for claim in self.claims if claim.device == device))
        return self._end() if all(spelling.done for spelling in self.spellings.values()) else None

    def update(self, seconds: float) -> StackOperation:
        self.age += seconds
        for spelling in self.spellings.values():
            spelling.update(seconds)
        return self._end() if self.age >= SECONDS else None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw one panel per player and the remaining time."""
        words = self.context.words
        screen.blit(backdrop(), (0, 0))
        heading(words("results.high_score"), color=FOCUS).draw(screen)
        page.clock(screen, max(0.0, SECONDS - self.age), SECONDS)
        corners = page.corners(len(self.claims))
        black_out(screen, *(page.panel_at(x) for x in corners))
        for x, claim in zip(corners, self.claims, strict=True):
            self._panel(screen, x, claim)
        call_to_action(words("results.three"), "", LABEL).draw(screen, 960, page.FOOT_Y)

    # ---- inside

    def _device_of(self, event: InputEvent) -> Device | None:
        """The device whose letters an event controls; None for a key shared by two players on one keyboard."""
        if not event.among:
            return event.device if event.device in self.spellings else None
        clusters = [device for device in event.among if device in self.spellings]
        return clusters[0] if len(clusters) == 1 else None

    def _panel(self, screen: pygame.Surface, x: int, claim: Qualification) -> None:
        words, spelling = self.context.words, self.spellings[claim.device]
        self._frame(claim, spelling.done).draw(screen, x, page.TOP_Y)
        page.letters(screen, x, claim.seat, spelling)
        if spelling.done:
            ready_bar(claim.seat, words("results.done")).draw(screen, x, page.TOP_Y)
            return
        if spelling.refused:
            page.refused(words("results.another")).draw(screen, x, page.TOP_Y)
            return
        key = "done" if spelling.last else "next_letter"
        label = words.key_name(self.context.controls.label(claim.device, Button.FIRE))
        ask_bar(label, words(f"results.{key}"), pulse(self.age, 5)).draw(screen, x, page.TOP_Y)

    def _frame(self, claim: Qualification, done: bool) -> LitImage:
        label = self.context.controls.owner(claim.device) or self.context.words("lobby.seat", player=claim.seat + 1)
        return page.frame(claim.seat, label, self._lines(claim), done)

    def _prewarm_jobs(self) -> Iterator[Callable[[], object]]:
        words = self.context.words
        yield partial(heading, words("results.high_score"), color=FOCUS)
        for done in (False, True):
            for claim in self.claims:
                yield partial(self._frame, claim, done)
        for claim in self.claims:
            yield partial(ready_bar, claim.seat, words("results.done"))

    def _lines(self, claim: Qualification) -> tuple[tuple[str, str], ...]:
        """Lines of a panel: each achievement with its value, and the places it takes."""
        words = self.context.words
        lines = []
        for (table, value), ranks in zip(claim.achievements, claim.places, strict=True):
            listed = ranks if len(claim.achievements) == 1 else ranks[-1:]
            lines.append((words(f"setup.best_{table.achievement}"), words.decimal(self.format_value(value, table))))
            lines += [(words("results.place", board=words(title), place=place), "") for title, place in listed]
        return tuple(lines)

    def _end(self) -> StackOperation:
        """Save the entries, if there are any, and continue."""
        fresh = self._entered()
        if fresh:
            try:
                self.context.scores.save(folders().data)
            except NotSaved as reason:
                _log.warning("%s", reason)
        scene = self.then(fresh)
        return Swap(scene) if scene else Pop()

    def _entered(self) -> list[Score]:
        return [
            self.context.scores.add(table, initials, value)
            for claim in self.claims
            if (initials := self.spellings[claim.device].taken)
            for table, value in claim.achievements
        ]
