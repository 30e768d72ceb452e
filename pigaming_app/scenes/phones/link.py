"""The link between the scenes and the phones: follows the settings, gives phones their turns, shows each its part."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.phones.audience import Audience
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.seating import Calling, Driven, Ended, Seating, seating
from pigaming_app.ui.draw import MIST, PLAYERS, Color
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phone_messages import ITS_TURN, LEFT_QUEUE, SeatView
from pigaming_app.ui.input.phones.guest import Guest, Stage

PAGE_TEXTS = (
    "page_player", "page_join", "page_fire", "page_turbo", "page_ok", "page_back", "page_lost", "page_old",
    "page_full", "page_refused", "page_elsewhere", "page_removed", "page_next", "page_before",
    "page_idle", "page_game", "page_arena", "page_name", "page_colour", "page_hand", "page_save", "page_unkind",
    "page_awake", "page_asleep", "page_called",
)  # fmt: skip
TALLY_SECONDS = 0.25  # s between two looks at scores and clock, hence between two messages about them
CALL = 1.0, 1.0, 0.6  # rumble of a phone that is called: its motors, and s
RESULT_SECONDS = 2.5  # s for which a result is seen before those who played make room


@dataclass(frozen=True)
class Tally:
    """Score, clock and place of a seat; empty: none."""

    score: str = ""
    clock: str = ""
    place: str = ""


class PhoneLink:
    """Call `update` once a frame."""

    def __init__(self, context: Context, clock: Callable[[], float] = time.monotonic) -> None:
        self.context, self.host, self._clock = context, context.shared(phone_host), clock
        self.audience = Audience(context)
        self._tallies: dict[int, Tally] = {}  # by seat
        self._line = ""  # the match in one line
        self._counted_at = -TALLY_SECONDS
        self._texts: dict[str, dict[str, str]] = {}  # of the page, by language
        self._called: set[int] = set()
        self._match = False  # one is running, or its players have not made room yet
        self._ended_at: float | None = None

    def update(self, scenes: Sequence[Scene]) -> None:
        """Switch phones on or off as set, give them their turns, and tell each what it is to show."""
        context, settings = self.context, self.context.settings
        if (language := context.words.language) not in self._texts:
            self._texts[language] = page_texts(context.words)
        texts = self._texts[language]
        self.host.switch(settings.phones, settings.phones_network, settings.phones_port, texts)
        phones, roster = context.controls.phones, self.host.roster
        if not self.host.on and not phones.plugged:
            return
        now = seating(scenes)
        self._take_turns(now, scenes)
        shown = sorted({*phones.plugged, *phones.watching})
        self.audience.update(roster, now, scenes, shown)
        if not shown:
            return
        playing = bool(scenes) and isinstance(scenes[-1], Driven)
        if (clock := self._clock()) - self._counted_at >= TALLY_SECONDS:
            self._counted_at = clock
            self._tallies, self._line = tallies(scenes, context.words)
        queue = {guest.number: place for place, guest in enumerate(roster.queue())}
        for number in shown:
            phones.translate(number, texts)
            device, guest = Device("phone", number), roster.guest(number)
            seat = now.devices.index(device) if device in now.devices else -1
            seated = seat >= 0 and (guest is None or guest.placed)
            view = self._seated(seat, playing) if seated else self._waiting(guest, queue)
            if seat >= 0 and not seated:  # it has just played
                view = replace(view, place=self._tallies.get(seat, Tally()).place)
            phones.show(number, replace(view, name=phones.names.get(number, "")))

    def _take_turns(self, now: Seating, scenes: Sequence[Scene]) -> None:
        """Who has played makes room for those who wait, a moment after the result."""
        roster, settings, ended = (
            self.host.roster,
            self.context.settings,
            bool(scenes) and isinstance(scenes[-1], Ended),
        )
        if now.match:
            self._match, self._ended_at = True, None
        elif self._match:
            over = any(isinstance(scene, Ended) for scene in scenes)
            if now.winners is None or not ended:
                self._ended_at = None
            elif self._ended_at is None:
                self._ended_at = self._clock()
            if not over or (self._ended_at is not None and self._clock() - self._ended_at >= RESULT_SECONDS):
                self._match, self._ended_at = False, None
                roster.update(now.places, now.phones, True, False, now.called)
                roster.rotate((now.winners if settings.phones_stay else None) or now.kept)
        roster.update(now.places, now.phones, self._match, now.seat_free, now.called)
        self._shake()

    def _shake(self) -> None:
        """Shake the phones that are called."""
        called = set(self.context.controls.phones.called)
        for number in called - self._called if self.context.settings.rumble else ():
            self.context.controls.phones.rumble(number, *CALL)
        self._called = called

    def _seated(self, seat: int, playing: bool) -> SeatView:
        tally = self._tallies.get(seat, Tally())
        return SeatView(seat, css(PLAYERS[seat]), playing, tally.score, tally.clock, tally.place)

    def _waiting(self, guest: Guest | None, queue: dict[int, int]) -> SeatView:
        """What a phone without a seat shows."""
        if guest is None:
            return SeatView(color=css(MIST))
        before = LEFT_QUEUE if guest.stage is Stage.IDLE else queue.get(guest.number, ITS_TURN)
        called = guest.number in self.context.controls.phones.called
        return SeatView(color=css(self.audience.color(guest.colour)), before=before, line=self._line, called=called)


def tallies(scenes: Sequence[Scene], words: Words) -> tuple[dict[int, Tally], str]:
    """The tally of each seat, and the match in one line: during a match as on the second screen, after it from its
    outcome.
    """
    if scenes and isinstance(scenes[-1], Ended):
        rows = scenes[-1].ended.outcome.rows
        return {row.seat: Tally(place=f"{row.place}{words(f'race.place_{row.place}')}") for row in rows}, ""
    if isinstance(calls := scenes[-1] if scenes else None, Calling):
        return {}, " – ".join(name for name, _ in calls.called.values())
    from pigaming_app.scenes.results.snapshot import match_of, snapshot  # late: the title does not wait for it

    match, on_top = match_of(scenes)
    if match is None:
        return {}, ""
    now = snapshot(match, words, on_top)
    parts = (f"{side.name} {side.score}".replace(" ", "\u00a0") for side in now.sides)  # none is broken on a phone
    line = "  ·  ".join([*parts, now.clock])
    return {seat: Tally(side.score, now.clock) for side in now.sides for seat in side.seats}, line


def page_texts(words: Words) -> dict[str, str]:
    """The texts of the phones' page; numbers are filled in there."""
    return {key: words(f"phones.{key}", player="{player}", count="{count}") for key in PAGE_TEXTS}


def css(color: Color) -> str:
    """A colour as #rrggbb."""
    red, green, blue = color
    return f"#{red:02x}{green:02x}{blue:02x}"
