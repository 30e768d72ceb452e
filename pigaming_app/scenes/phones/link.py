"""The link between the scenes and the phones: follows the settings, and shows each phone its seat and score."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.ui.draw import MIST, PLAYERS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phone_messages import SeatView

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.scenes.play.drivers import Drivers
    from pigaming_app.scenes.results.headline import EndedMatch

PAGE_TEXTS = (
    "page_player", "page_join", "page_fire", "page_turbo", "page_ok", "page_back", "page_lost", "page_old",
    "page_full", "page_refused", "page_elsewhere",
)  # fmt: skip
TALLY_SECONDS = 0.25  # s between two looks at scores and clock, hence between two messages about them


@runtime_checkable
class Seated(Protocol):
    """A scene that knows the device of each seat."""

    access: Access


@runtime_checkable
class Driven(Protocol):
    """A scene in which devices drive robots."""

    drivers: "Drivers"


@runtime_checkable
class Ended(Protocol):
    """A scene after a match."""

    ended: "EndedMatch"


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
        self._tallies: dict[int, Tally] = {}  # by seat
        self._counted_at = -TALLY_SECONDS
        self._texts: dict[str, dict[str, str]] = {}  # of the page, by language

    def update(self, scenes: Sequence[Scene]) -> None:
        """Switch phones on or off as set, and tell each phone its seat on the uppermost scene that has seats."""
        context, settings = self.context, self.context.settings
        texts = self._texts.setdefault(context.words.language, page_texts(context.words))
        self.host.switch(settings.phones, settings.phones_network, settings.phones_port, texts)
        phones = context.controls.phones
        if not phones.plugged:
            return
        seated = next((scene for scene in reversed(scenes) if isinstance(scene, Seated)), None)
        devices = seated.access.devices() if seated else []
        playing = bool(scenes) and isinstance(scenes[-1], Driven)
        if (now := self._clock()) - self._counted_at >= TALLY_SECONDS:
            self._counted_at, self._tallies = now, tallies(scenes, context.words)
        for number in phones.plugged:
            phones.translate(number, texts)
            device = Device("phone", number)
            seat = devices.index(device) if device in devices else -1
            red, green, blue = PLAYERS[seat] if seat >= 0 else MIST
            tally = self._tallies.get(seat, Tally())
            phones.show(
                number,
                SeatView(
                    seat,
                    f"#{red:02x}{green:02x}{blue:02x}",
                    playing and seat >= 0,
                    tally.score,
                    tally.clock,
                    tally.place,
                ),
            )


def tallies(scenes: Sequence[Scene], words: Words) -> dict[int, Tally]:
    """The tally of each seat: during a match as on the second screen, after it from its outcome."""
    if scenes and isinstance(scenes[-1], Ended):
        rows = scenes[-1].ended.outcome.rows
        return {row.seat: Tally(place=f"{row.place}{words(f'race.place_{row.place}')}") for row in rows}
    from pigaming_app.scenes.results.snapshot import match_of, snapshot  # late: the title does not wait for it

    match, on_top = match_of(scenes)
    if match is None:
        return {}
    now = snapshot(match, words, on_top)
    return {seat: Tally(side.score, now.clock) for side in now.sides for seat in side.seats}


def page_texts(words: Words) -> dict[str, str]:
    """The texts of the phones' page; the player's number is filled in there."""
    return {key: words(f"phones.{key}", player="{player}") for key in PAGE_TEXTS}
