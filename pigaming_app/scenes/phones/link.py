"""The link between the scenes and the phones: follows the settings, and shows each phone its seat."""

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.ui.draw import MIST, PLAYERS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phones.protocol import SeatView

PAGE_TEXTS = (
    "page_player", "page_join", "page_fire", "page_turbo", "page_ok", "page_back", "page_lost", "page_old",
    "page_full", "page_refused", "page_elsewhere",
)  # fmt: skip


@runtime_checkable
class Seated(Protocol):
    """A scene that knows the device of each seat."""

    access: Access


@runtime_checkable
class Driven(Protocol):
    """A scene in which devices drive robots."""

    def is_free(self, device: Device) -> bool:
        """True if this device drives no seat."""


class PhoneLink:
    """Call `update` once a frame."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self._texts: dict[str, dict[str, str]] = {}  # of the page, by language

    def update(self, scenes: Sequence[Scene]) -> None:
        """Switch phones on or off as set, and tell each phone its seat on the uppermost scene that has seats."""
        context, settings = self.context, self.context.settings
        texts = self._texts.setdefault(context.words.language, page_texts(context.words))
        context.phone_host.switch(settings.phones, settings.phones_network, settings.phones_port, texts)
        phones = context.controls.phones
        if not phones.plugged:
            return
        seated = next((scene for scene in reversed(scenes) if isinstance(scene, Seated)), None)
        devices = seated.access.devices() if seated else []
        playing = bool(scenes) and isinstance(scenes[-1], Driven)
        for number in phones.plugged:
            device = Device("phone", number)
            seat = devices.index(device) if device in devices else -1
            red, green, blue = PLAYERS[seat] if seat >= 0 else MIST
            phones.show(number, SeatView(seat, f"#{red:02x}{green:02x}{blue:02x}", playing and seat >= 0))


def page_texts(words: Words) -> dict[str, str]:
    """The texts of the phones' page; the player's number is filled in there."""
    return {key: words(f"phones.{key}", player="{player}") for key in PAGE_TEXTS}
