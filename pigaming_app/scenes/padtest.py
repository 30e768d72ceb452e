"""Test the controls: every pad and every corner of the keyboard, live. What is pressed lights up."""

from functools import lru_cache

import pygame

from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import (
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    THIN,
    cut,
    icon,
    panel,
    text_width,
)
from pigaming_app.scenes.keyboard import CLUSTERS
from pigaming_app.scenes.page import heading
from pigaming_app.scenes.pane import Lit, Pane, backdrop, span
from pigaming_app.scenes.press import Act, Device, Drive, Press
from pigaming_app.scenes.prompts import Prompts
from pigaming_app.scenes.stack import Pop, Turn

PLACES = 4
HIGH = 340
ROWS = (212, 588)  # upper edges: pads, keys
STICK = 84  # px, radius
HOLD = 1.0  # s for which BACK is held on a pad to leave: its button is tested here too


class PadTest:
    """The page. Escape or a click on the hint leaves it; on a pad, B held for a second does."""

    def __init__(self, house: House) -> None:
        self.house = house
        self.holding: Device | None = None
        self.held = 0.0
        self.prompts = Prompts(house, [(Act.BACK, "padtest.hint_hold")], 1000)

    def entered(self) -> None:
        """Nothing to prepare."""

    def on(self, press: Press) -> Turn:
        """Only leaving means anything."""
        clicked = press.act is Act.CLICK
        press = self.prompts.meant(press)
        if press.act is Act.BACK and press.device.kind == "pad":
            self.holding, self.held = press.device, 0.0
        elif press.act is Act.BACK and (clicked or press.device.kind == "keys"):
            return self._leave()
        return None

    def update(self, seconds: float) -> Turn:
        """Notice that BACK is held."""
        if self.holding and self.house.controls.drive(self.holding).turbo:
            self.held += seconds
            if self.held > HOLD:
                return self._leave()
        else:
            self.holding = None
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Every device as it is held now."""
        words, controls = self.house.words, self.house.controls
        screen.blit(backdrop(), (0, 0))
        heading(words("padtest.title"), words("padtest.line")).draw(screen)
        pads = controls.pads()[:PLACES]
        for i in range(PLACES):
            x, _ = span(3 * i, 3)
            if i < len(pads):
                frame(controls.name(pads[i]), "A", "B", True).draw(screen, x, ROWS[0])
                self._live(screen, x, ROWS[0], controls.drive(pads[i]))
            else:
                frame(words("padtest.none"), "", "", False).draw(screen, x, ROWS[0])
            printed = CLUSTERS[i].printed
            frame(CLUSTERS[i].moves, printed[Act.FIRE], printed[Act.LEAVE], True).draw(screen, x, ROWS[1])
            self._live(screen, x, ROWS[1], controls.drive(Device("keys", i)))
        self.prompts.draw(screen)

    def _leave(self) -> Turn:
        self.house.sounds.play("back")
        return Pop()

    def _live(self, screen: pygame.Surface, x: int, y: int, drive: Drive) -> None:
        """The stick's dot, and the two lamps."""
        dot().draw(screen, x + 130 + STICK * drive.angular, y + 200 - STICK * drive.linear)
        if drive.fire:
            lamp(0).draw(screen, x + 316, y + 150)
        if drive.turbo:
            lamp(1).draw(screen, x + 316, y + 266)


@lru_cache(maxsize=16)
def frame(name: str, fire: str, turbo: str, there: bool) -> Lit:
    """The still part of one device; upper left at (0, 0)."""
    w = span(0, 3)[1]
    pane = Pane(0, 0, w, HIGH)
    if not there:
        pane.hot.dashes(cut(0, 0, w, HIGH, 20), STEEL, THIN, 22, 16)
        pane.page.body(name, w / 2, HIGH / 2, MIST, "c")
        return pane.done()
    panel(pane.hot, 0, 0, w, HIGH, STEEL)
    if "←" in name:
        for i, sign in enumerate(("left", "up", "down", "right")):
            icon(pane.hot, sign, 44 + 52 * i, 52, 20, ICE, LINE)
    else:
        pane.page.text(name, LABEL, 28, 52, ICE)
    pane.hot.ring(130, 200, STICK + 16, STEEL, LINE)
    for label, y in ((fire, 150), (turbo, 266)):
        pane.hot.ring(316, y, 34, STEEL, LINE)
        size = BODY if text_width(label, BODY) < 60 else 30
        pane.page.cold.text(label, size, 316, y - 54, MIST, "head", "c")
    return pane.done()


@lru_cache(maxsize=1)
def dot() -> Lit:
    """Where the stick is; round (0, 0)."""
    pane = Pane(-20, -20, 40, 40)
    pane.hot.disc(0, 0, 18, FOCUS)
    return pane.done()


@lru_cache(maxsize=2)
def lamp(which: int) -> Lit:
    """A pressed button: 0 fire, 1 turbo; round (0, 0)."""
    pane = Pane(-30, -30, 60, 60)
    pane.hot.disc(0, 0, 27, (FOCUS, ALARM)[which])
    return pane.done()
