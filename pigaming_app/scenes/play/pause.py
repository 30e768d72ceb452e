"""The pause page over a halted match: its owner and a menu. The match is a dark picture behind it.

The owner may act alone for a while (see `access`), shown by a ring. Restarting or ending the match takes a second
press within a few seconds.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

import pygame

from pigaming_app.scenes.features.registry import has_overlay, join_offer
from pigaming_app.scenes.flow.access import OWNER_SECONDS, Access, PauseAccess
from pigaming_app.scenes.flow.scene import Context, Pop, Push, Scene, StackOperation
from pigaming_app.scenes.play.device_table import DeviceTable
from pigaming_app.scenes.play.drivers import Drivers
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.views.hud.ai_sign import name_of
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import Layer, LitImage, fit_size, fit_text, word
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.dialog import FOOT, HEAD, PROMPTS, W, X, Y, overlay
from pigaming_app.ui.widgets.focus import Focus, FocusSpot

ITEMS = ("continue", "restart", "controls", "end")
PITCH, ITEM_H = 74, 66
ITEM_W = 620
NEED_CONFIRMATION = ("restart", "end")  # items that need a confirming press
CONFIRM_SECONDS = 3.0  # seconds for the confirming press
EXPLAIN_SECONDS = 2.0  # seconds for which a rejected press is explained
NAME_ROOM = 460  # px, of a name at LABEL size
RING = X + W - 112, Y + 116


class Robots(Protocol):
    """The robots of a match, as the pages above need them."""

    @property
    def kind(self) -> str:
        """What drives: simulated, emulated or real robots."""

    @property
    def things(self) -> Sequence[ThingSpec]:
        """The things on the mat that are in play."""

    @property
    def items(self) -> Mapping[str, Callable[[Access], Scene]]:
        """Additional menu items: page factories by name, given the access of the pause."""

    @property
    def blocked(self) -> bool:
        """True if the match waits for an event that may never come."""

    def note(self) -> None:
        """Note in the day log what belongs to the match that was noted."""

    def advance_paused(self, seconds: float) -> None:
        """Advance by `seconds` while a page is open."""

    def draw_overlay(self, screen: pygame.Surface) -> None:
        """Draw what must not be hidden by a page."""


@dataclass(frozen=True)
class SimulatedRobots:
    """Those on the screen alone, which need nothing."""

    kind: str = "simulated"
    things: Sequence[ThingSpec] = ()
    items: Mapping[str, Callable[[Access], Scene]] = field(default_factory=dict)
    blocked: bool = False

    def note(self) -> None:
        pass

    def advance_paused(self, seconds: float) -> None:
        pass

    def draw_overlay(self, screen: pygame.Surface) -> None:
        pass


class PausedMatch(Protocol):
    """The match below a page."""

    context: Context
    restart_allowed: bool
    runner: MatchRunner
    drivers: Drivers

    @property
    def names(self) -> Sequence[str]:
        """See `MatchRunner`."""

    @property
    def robots(self) -> Robots:
        """What drives."""

    def restart(self) -> None:
        """Restart the match."""

    def stop(self) -> None:
        """End the match now."""


class Pause:
    """A pause requested by `device`."""

    def __init__(self, match: PausedMatch, device: Device) -> None:
        self.match, self.context = match, match.context
        self.player = match.drivers.devices.index(device) if device in match.drivers.devices else None
        self.access = PauseAccess(match.context, lambda: match.drivers.devices, device)
        self.picture: pygame.Surface | None = None
        self.confirm_left = self.explain_left = 0.0
        items = [item for item in ITEMS[1:] if item != "restart" or match.restart_allowed]
        self.offer = join_offer(match.context)
        phones = ["phones"] if self.offer and self.offer.on else []
        self.focus = Focus(menu_spots((ITEMS[0], *match.robots.items, *phones, *items)))
        hints = [
            (Button.FIRE, "pause.hint_ok"),
            (Button.BACK, "pause.hint_continue"),
            *([(Button.BRAIN, "pause.hint_brain")] if has_overlay() else []),
        ]
        self.prompts = self.context.prompts(hints, PROMPTS, W - 80, device=lambda: self.access.hint_device)

    def on_enter(self) -> None:
        self.context.hush()

    def handle(self, event: InputEvent) -> StackOperation:
        """START, BACK and F4 (Y on a pad), which also shows an AI's thoughts, continue; FIRE activates the item."""
        event = self.prompts.as_button(event)
        if event.button is Button.Y:
            event = replace(event, button=Button.BRAIN)
        admitted = self.access.admit(event)
        acting = self.access.acting
        if admitted is None or (event.button is Button.BRAIN and acting and admitted.device not in acting):
            self.explain_left = EXPLAIN_SECONDS
            return None
        event = admitted
        if event.button is Button.BRAIN:
            self.match.runner.next_brain()
        if event.button in (Button.START, Button.BACK, Button.BRAIN):
            return self._do("continue")
        if self.focus.handle(event):
            self.confirm_left = 0.0
            self.context.sounds.play("move")
        chosen = self.focus.activated(event)
        if chosen in NEED_CONFIRMATION and self.confirm_left <= 0.0:
            self.confirm_left = CONFIRM_SECONDS
            self.context.sounds.play("move")
            return None
        return self._do(chosen) if chosen else None

    def update(self, seconds: float) -> StackOperation:
        """Animate the focus; expire the confirmation and the ownership."""
        self.match.robots.advance_paused(seconds)
        self.access.update(seconds)
        self.focus.update(seconds)
        self.confirm_left -= seconds
        self.explain_left -= seconds
        return None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            color = kit.ICE if self.player is None else kit.PLAYERS[self.player]
            self.picture = overlay(self.match.runner.picture(), color, self._paint)
        screen.blit(self.picture, (0, 0))
        color, box = (kit.ALARM if self.confirm_left > 0.0 else kit.FOCUS), self.focus.spot.rect
        self.focus.draw(screen, color)
        if self.confirm_left > 0.0:
            pygame.draw.rect(screen, (0, 0, 0), box)
            sure(self.context.words(f"pause.sure_{self.focus.name}", button="{button}"), self._button()).draw(
                screen, *box.center
            )
        else:
            word(self.context.words(f"pause.{self.focus.name}"), kit.LABEL, color, "head", 0.45).draw(
                screen, *box.center
            )
        self._draw_owned(screen)
        if self.explain_left > 0.0:
            caption(self._rejection(), kit.FOCUS).draw(screen, 960, PROMPTS)
        else:
            self.prompts.draw(screen)
        self.match.robots.draw_overlay(screen)

    def _button(self) -> str:
        """The label of the button that activates the focused item."""
        return self.context.words.key_name(self.context.controls.label(self.access.hint_device, Button.FIRE))

    def _draw_owned(self, screen: pygame.Surface) -> None:
        """The ring with the remaining seconds of ownership."""
        if not self.access.owned or len(self.access.seated) < 2:
            return
        image, dx, dy = timer_ring(
            kit.FOCUS, math.ceil(12 * self.access.seconds_left / OWNER_SECONDS) * 4, 46, kit.LINE
        )
        screen.blit(image, (RING[0] + dx, RING[1] + dy), special_flags=pygame.BLEND_RGB_ADD)
        word(str(math.ceil(self.access.seconds_left)), kit.LABEL, kit.FOCUS, "head").draw(screen, *RING)

    def _rejection(self) -> str:
        """The reason for which a press was rejected."""
        if self.player is None or not self.access.owned:
            return self.context.words("pause.wait")
        return player_line(self.match, "pause.wait_for", self.player)

    def _do(self, name: str) -> StackOperation:
        self.context.sounds.play("back" if name == "continue" else "accept")
        match name:
            case "restart":
                self.match.restart()
            case "end":
                self.match.stop()
            case "phones" if self.offer:
                return Push(self.offer.page(lambda: self.match.drivers.devices))
            case "controls":
                drivers = self.match.drivers
                return Push(DeviceTable(self.context, drivers.devices, self.access, drivers.style_of))
            case extra if extra in self.match.robots.items:
                return Push(self.match.robots.items[extra](self.access))
        return Pop()

    def _paint(self, layer: Layer) -> None:
        words = self.context.words
        text = words("pause.paused") if self.player is None else player_line(self.match, "pause.by", self.player)
        sheet_title(layer, self.player, text, kit.ICE, RING[0] - 80)
        if self.match.robots.things:
            layer.canvas.body(things_line(words, len(self.match.robots.things)), X + 72, HEAD - 24, kit.MIST, "l", 34)
        for spot in self.focus.spots:
            layer.canvas.text(words(f"pause.{spot.name}"), kit.LABEL, *spot.rect.center, kit.MIST, "head", "c")


def player_line(match: PausedMatch, key: str, seat: int) -> str:
    """The text of `key` about who plays on a seat: an entrant by name, anybody else by number."""
    words = match.context.words
    if name := name_of(match.names, seat):
        return words(f"{key}_name", name=fit_text(name, kit.LABEL, NAME_ROOM, "head", kit.LABEL)[0])
    return words(key, player=seat + 1)


def things_line(words: Words, count: int) -> str:
    """The number of things in play."""
    return words("things.one_in_play" if count == 1 else "things.in_play", count=count)


def menu_spots(names: Sequence[str] = ITEMS) -> list[FocusSpot]:
    """The spots of the menu items."""
    pitch = min(PITCH, (FOOT - HEAD - 8) // len(names))
    high = pitch - PITCH + ITEM_H
    top = HEAD + (FOOT - HEAD - pitch * len(names)) // 2 + (pitch - high) // 2
    return [
        FocusSpot(name, pygame.Rect(960 - ITEM_W // 2, top + pitch * i, ITEM_W, high)) for i, name in enumerate(names)
    ]


@cached
def sure(sentence: str, label: str) -> LitImage:
    """A confirmation prompt centred on (0, 0); "{button}" in the text is replaced by the drawn button."""
    before, _, after = sentence.partition("{button}")
    wide = kit.button_width(label) + 36
    size = fit_size(before.strip() + after.strip(), kit.LABEL, ITEM_W - 24 - wide)
    ends = [kit.text_width(part.strip(), size) for part in (before, after)]
    x = -(sum(ends) + wide) / 2
    layer = Layer(x, -40, -2 * x, 80)
    layer.canvas.text(before.strip(), size, x, 0, kit.ALARM)
    kit.button(layer.canvas, x + ends[0] + 18, 0, label, kit.ALARM)
    layer.canvas.text(after.strip(), size, x + ends[0] + wide, 0, kit.ALARM)
    return layer.render()


def sheet_title(layer: Layer, player: int | None, text: str, color: kit.Color, right: float = X + W - 60) -> None:
    """The head of a dialog: an optional badge and one line that ends before x = `right`."""
    x = X + 72
    if player is not None:
        kit.badge(layer.glow, player, X + 122, Y + 124 - (8 if player == 1 else 0), 60)
        x = X + 232
    layer.canvas.text(text, fit_size(text, kit.TITLE, right - x), x, Y + 116, color)
