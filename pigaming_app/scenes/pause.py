"""The page over a match that stands still: who paused, and what now. The match is one dark picture behind it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Protocol

import pygame

from pigaming_app.scenes.devices import DeviceTable
from pigaming_app.scenes.focus import Focus, Spot
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import FOCUS, ICE, LABEL, MIST, PLAYERS, TITLE, Color, badge
from pigaming_app.scenes.overlay import FOOT, HEAD, PROMPTS, W, X, Y, overlay
from pigaming_app.scenes.pane import Pane, fitted, word
from pigaming_app.scenes.press import Act, Device, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.stack import Pop, Push, Scene, Turn

ITEMS = ("continue", "restart", "controls", "end")
PITCH, ITEM_H = 74, 66
ITEM_W = 620


class Held(Protocol):
    """The match below a page."""

    house: House
    devices: list[Device | None]

    def picture(self) -> pygame.Surface:
        """The match as it lies behind a page."""

    def think_aloud(self) -> None:
        """Show what the next AI thinks."""

    def restart(self) -> None:
        """Begin anew."""

    def stop(self) -> None:
        """End the match now."""

    @property
    def extras(self) -> Mapping[str, Callable[[], Scene]]:
        """What else the pause offers: by its name, a page."""

    def hold(self, seconds: float) -> None:
        """Let time pass under a page."""

    def shine(self, screen: pygame.Surface) -> None:
        """Paint what no page may hide."""


class Pause:
    """A pause that `device` has asked for."""

    def __init__(self, match: Held, device: Device) -> None:
        self.match, self.house = match, match.house
        self.player = match.devices.index(device) if device in match.devices else None
        self.picture: pygame.Surface | None = None
        self.focus = Focus(items((ITEMS[0], *match.extras, *ITEMS[1:])))
        hints = [(Act.FIRE, "pause.hint_ok"), (Act.BACK, "pause.hint_continue"), (Act.BRAIN, "pause.hint_brain")]
        self.prompts = Prompts(self.house, hints, PROMPTS, W - 80)

    def entered(self) -> None:
        """Quiet."""
        self.house.sounds.music(False)

    def on(self, press: Press) -> Turn:
        """START and BACK go on; so does F4, or ALT of a pad, with a look into an AI; FIRE takes what has the focus."""
        press = self.prompts.meant(press)
        if press.act is Act.ALT:
            press = replace(press, act=Act.BRAIN)
        if press.act is Act.BRAIN:
            self.match.think_aloud()
        if press.act in (Act.START, Act.BACK, Act.BRAIN):
            return self._do("continue")
        if self.focus.on(press):
            self.house.sounds.play("move")
        chosen = self.focus.chosen(press)
        return self._do(chosen) if chosen else None

    def update(self, seconds: float) -> Turn:
        """Only the focus moves."""
        self.match.hold(seconds)
        self.focus.update(seconds)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """The page, painted once, and the item in focus."""
        if self.picture is None:
            color = ICE if self.player is None else PLAYERS[self.player]
            self.picture = overlay(self.match.picture(), color, self._paint)
        screen.blit(self.picture, (0, 0))
        self.focus.draw(screen)
        text = self.house.words(f"pause.{self.focus.name}")
        word(text, LABEL, FOCUS, "head", 0.45).draw(screen, *self.focus.spot.rect.center)
        self.prompts.draw(screen)
        self.match.shine(screen)

    def _do(self, name: str) -> Turn:
        self.house.sounds.play("back" if name == "continue" else "accept")
        match name:
            case "restart":
                self.match.restart()
            case "end":
                self.match.stop()
            case "controls":
                return Push(DeviceTable(self.house, self.match.devices))
            case extra if extra in self.match.extras:
                return Push(self.match.extras[extra]())
        return Pop()

    def _paint(self, pane: Pane) -> None:
        words = self.house.words
        text = words("pause.paused") if self.player is None else words("pause.by", player=self.player + 1)
        title(pane, self.player, text, ICE)
        for spot in self.focus.spots:
            pane.page.text(words(f"pause.{spot.name}"), LABEL, *spot.rect.center, MIST, "head", "c")


def items(names: Sequence[str] = ITEMS) -> list[Spot]:
    """Where the items of a menu are."""
    pitch = min(PITCH, (FOOT - HEAD - 8) // len(names))
    high = pitch - PITCH + ITEM_H
    top = HEAD + (FOOT - HEAD - pitch * len(names)) // 2 + (pitch - high) // 2
    return [Spot(name, pygame.Rect(960 - ITEM_W // 2, top + pitch * i, ITEM_W, high)) for i, name in enumerate(names)]


def title(pane: Pane, player: int | None, text: str, color: Color) -> None:
    """The head of a sheet: a badge, if it is about somebody, and one line."""
    x = X + 72
    if player is not None:
        badge(pane.hot, player, X + 122, Y + 124 - (8 if player == 1 else 0), 60)
        x = X + 232
    pane.page.text(text, fitted(text, TITLE, X + W - 60 - x), x, Y + 116, color)
