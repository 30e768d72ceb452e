"""How to play, in four pictures: drive, shoot, break walls, collect. One idea a picture, a few words under it.

The row at the foot shows the keys or buttons of the device used last.
"""

from functools import lru_cache

import pygame

from pigaming_app.games.pitanks.state import POWERS
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import (
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    ORANGE,
    PLAYERS,
    STEEL,
    SUB,
    THIN,
    Ink,
    Page,
    dim,
    icon,
    panel,
    regular,
    text_width,
)
from pigaming_app.scenes.page import heading, key, key_width
from pigaming_app.scenes.pane import Lit, Pane, backdrop, lines_of, span
from pigaming_app.scenes.press import Act, Press
from pigaming_app.scenes.stack import Pop, Turn
from pigaming_app.scenes.tank import robot
from pigaming_app.scenes.wall import draw_wall

PAGES = ("drive", "shoot", "walls", "pickups")
TOP, HIGH = 216, 620
FOOT = 930
LEAVE = (Act.FIRE, Act.BACK, Act.START, Act.CLICK)


class HowTo:
    """The page; FIRE, BACK, START or a click leaves it."""

    def __init__(self, house: House, game: str = "pitanks") -> None:
        self.house, self.game = house, game

    def entered(self) -> None:
        """Nothing moves here."""

    def on(self, press: Press) -> Turn:
        """Leave."""
        if press.act in LEAVE:
            self.house.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> Turn:
        """Wait."""
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """The pictures and the keys."""
        words = self.house.words
        screen.blit(backdrop(), (0, 0))
        heading(words("title.howto"), words(f"games.{self.game}")).draw(screen)
        pictures(tuple(words(f"howto.{name}") for name in PAGES)).draw(screen)
        controls = self.house.controls
        device = controls.last
        moves = controls.moves(device) or "<>"
        turbo = controls.label(device, Act.LEAVE if device.kind == "keys" else Act.BACK)
        items = (
            (moves, words("howto.hint_drive")),
            (words.printed(controls.label(device, Act.FIRE)), words("howto.hint_fire")),
            (turbo, words("howto.hint_turbo")),
        )
        keys(items).draw(screen)


@lru_cache(maxsize=4)
def pictures(captions: tuple[str, ...]) -> Lit:
    """The four panels with their captions."""
    page = Page()
    for i, (draw, caption) in enumerate(zip((_drive, _shoot, _walls, _pickups), captions, strict=True)):
        x, w = span(3 * i, 3)
        panel(page.hot, x, TOP, w, HIGH, STEEL)
        page.hot.fill(regular(40, 30, 0, x + w / 2, TOP), FOCUS)
        page.hot.text(str(i + 1), LABEL, x + w / 2, TOP, (0, 0, 0), "hero", "c")
        draw(page.hot, x + w / 2, TOP + 230)
        lines = lines_of(caption, BODY, w - 48)
        for row, line in enumerate(lines):
            page.body(line, x + w / 2, TOP + 520 + 54 * (row - (len(lines) - 1) / 2), ICE, "c")
    return Lit(page.done(), (0, 0))


@lru_cache(maxsize=8)
def keys(items: tuple[tuple[str, str], ...]) -> Lit:
    """A centred row of buttons and what they do; arrow signs in a label are drawn."""
    widths = [_width(label) + 18 + text_width(what, BODY, "body") for label, what in items]
    gap = 72
    x = (1920 - sum(widths) - gap * (len(widths) - 1)) / 2
    pane = Pane(96, FOOT - 40, 1728, 80)
    for (label, what), width in zip(items, widths, strict=True):
        at = x
        for part in _parts(label):
            at += key(pane.page, at, FOOT, part) + 8
        pane.page.body(what, at + 10, FOOT, MIST)
        x += width + gap
    return pane.done()


def _parts(label: str) -> list[str]:
    """ "← ↑ ↓ →" are four keys; anything else is one."""
    return label.split() if "←" in label else [label]


def _width(label: str) -> float:
    return sum(key_width(part) + 8 for part in _parts(label))


def _drive(ink: Ink, x: float, y: float) -> None:
    """A robot and the four ways of its stick."""
    robot(ink, 0, x, y + 20, -1.5708, 1.6)
    for sign, dx, dy in (("up", 0, -125), ("down", 0, 150), ("left", -135, 20), ("right", 135, 20)):
        icon(ink, sign, x + dx, y + dy, 30, MIST, LINE)


def _shoot(ink: Ink, x: float, y: float) -> None:
    """One robot hits another: +1 here, −1 there."""
    robot(ink, 0, x - 100, y + 110, -0.93, 1.3)
    robot(ink, 1, x + 90, y - 90, 2.2, 1.3)
    for i in range(6):
        ink.line([(x - 40 + 6 * i, y + 30 - 8 * i), (x - 10, y - 10)], dim(PLAYERS[0], 0.2 + 0.13 * i), 3 + i)
    ink.text("+1", SUB, x - 110, y + 10, PLAYERS[0], "hero", "c")
    ink.text("−1", SUB, x + 110, y + 10, ORANGE, "hero", "c")


def _walls(ink: Ink, x: float, y: float) -> None:
    """The same wall with five, three, two and one hits left to take."""
    for row, health in enumerate((5, 4, 2, 1)):
        draw_wall(ink.to(x - 20, y - 130 + 95 * row), 240, 34, health, 7)
        ink.to(0, 0).text(str(health), LABEL, x + 150, y - 130 + 95 * row, MIST, "hero", "c")


def _pickups(ink: Ink, x: float, y: float) -> None:
    """All six, as they lie on the floor."""
    for i, name in enumerate(POWERS):
        cx, cy = x - 75 + 150 * (i % 2), y - 120 + 125 * (i // 2)
        ink.line(regular(6, 50, 0.5236, cx, cy), FOCUS, THIN, True)
        icon(ink, name, cx, cy, 25, FOCUS, 5)
