"""The title: the name in tubes of light, four robots on their way, three games, and what else there is.

Nobody there for a while: an AI match begins. One focus for pad, keyboard and mouse: three tiles above, a row below.
"""

import math

import pygame

from pigaming_app.games import GAMES
from pigaming_app.scenes.focus import Focus, Spot
from pigaming_app.scenes.house import House
from pigaming_app.scenes.ink import (
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    STEEL,
    SUB,
    Page,
    button,
    button_width,
    cut,
    dim,
    icon,
    panel,
    text_width,
)
from pigaming_app.scenes.logo import logo, trails, vignette
from pigaming_app.scenes.pane import LEFT, RIGHT, Lit, Pane, backdrop, span, word
from pigaming_app.scenes.press import Act, Press
from pigaming_app.scenes.stack import Push, Quit, Turn

TILES = ("pitanks", "factory", "race")
TILE_Y, TILE_H = 416, 416
ROW_Y = 990


class Title:
    """The lowest scene of all."""

    def __init__(self, house: House) -> None:
        self.house = house
        self.age = 0.0
        self.page: pygame.Surface | None = None
        self.row: dict[str, Lit] = {}
        self.focus = Focus([])
        self.language = ""

    def entered(self) -> None:
        """Back here: words may be other ones now."""
        self.house.sounds.music(False)
        self.house.idle = 0.0
        if self.language != self.house.words.language:
            self._make()

    def on(self, press: Press) -> Turn:
        """Choose, or change the language with one press."""
        if press.act is Act.ALT:
            self._switch()
            return None
        if press.act is Act.BACK:
            return None
        if press.act in (Act.EXTRA, Act.LEAVE, Act.FOUND, Act.LOST):
            return None
        moved = self.focus.on(press)
        if moved:
            self.house.sounds.play("move")
        chosen = self.focus.chosen(press)
        if chosen is None:
            return None
        return self._open(chosen)

    def update(self, seconds: float) -> Turn:
        """Wait; after a while, show what it is about."""
        self.age += seconds
        self.focus.update(seconds)
        if self.house.idle > self.house.settings.attract_seconds:
            from pigaming_app.scenes.attract import Attract

            self.house.idle = 0.0
            return Push(Attract(self.house))
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """The page as it was made, and what pulses on it."""
        if self.page is None:
            self._make()
        assert self.page is not None
        screen.blit(self.page, (0, 0))
        beat = round(4 + 4 * (0.5 + 0.5 * math.cos(self.age * math.tau)))
        line = self.house.words("title.press", button=self.house.controls.label(None, Act.FIRE))
        word(line, SUB, FOCUS, "head", 0.45, level=beat).draw(screen, 960, 900)
        w = text_width(line, SUB) / 2
        for side in (-1, 1):
            for k in range(3):
                step = (round(self.age * 3) + k) % 3
                x = 960 + side * (w + 44 + 34 * k)
                arrow("right" if side < 0 else "left", (8, 5, 2)[step]).draw(screen, x, 900)
        self.focus.draw(screen)

    # ---- inside

    def _open(self, name: str) -> Turn:
        self.house.sounds.play("accept")
        if name in GAMES:
            from pigaming_app.scenes.lobby import Lobby

            return Push(Lobby(self.house, name))
        if name == "howto":
            from pigaming_app.scenes.howto import HowTo

            return Push(HowTo(self.house))
        if name == "options":
            from pigaming_app.scenes.options import Options

            return Push(Options(self.house))
        if name == "quit":
            return Quit()
        if name == "language":
            self._switch()
        else:
            self.house.sounds.play("error")
        return None

    def _switch(self) -> None:
        self.house.words.switch(self.house.words.other)
        self.house.settings.language = self.house.words.language
        self.house.sounds.play("accept")
        self._make()

    def _make(self) -> None:
        """Paint all of the page that stands still."""
        self.language = self.house.words.language
        at = self.focus.name
        page = Page()
        trails(page.hot)
        logo(page.hot, LEFT + 16, 84, 30)
        spots = [self._tile(page, i, game) for i, game in enumerate(TILES)]
        spots += self._row(page)
        self.page = backdrop().copy()
        self.page.blit(page.done(), (0, 0), special_flags=pygame.BLEND_RGB_ADD)
        self.focus = Focus(spots, at)

    def _tile(self, page: Page, i: int, game: str) -> Spot:
        words, there = self.house.words, game in GAMES
        x, w = span(4 * i, 4)
        ink = page.hot
        panel(ink, x, TILE_Y, w, TILE_H, STEEL)
        vignette(game, ink, x, TILE_Y + 4)
        ink.line([(x + 24, TILE_Y + 284), (x + w - 24, TILE_Y + 284)], STEEL, 2)
        page.text(words(f"games.{game}"), LABEL, x + 32, TILE_Y + 326, ICE if there else MIST)
        page.body(words(f"games.{game}_line") if there else words("title.soon"), x + 32, TILE_Y + 380, MIST)
        return Spot(game, pygame.Rect(x, TILE_Y, w, TILE_H))

    def _row(self, page: Page) -> list[Spot]:
        """How to play, options, quit on the left; the languages on the right."""
        words, spots, x = self.house.words, [], LEFT
        names = ["howto", "options"] + ([] if self.house.kiosk else ["quit"])
        for name in names:
            text = words(f"title.{name}")
            w = round(text_width(text, BODY)) + 56
            page.hot.line(cut(x, ROW_Y - 34, w, 68, 12), STEEL, 4, True)
            page.cold.text(text, BODY, x + w / 2, ROW_Y, ICE, "head", "c")
            spots.append(Spot(name, pygame.Rect(x, ROW_Y - 34, w, 68)))
            x += w + 24
        x = RIGHT
        for language in ("PT", "EN"):
            w = round(text_width(language, BODY)) + 48
            lit = language.lower() == words.language
            page.hot.line(cut(x - w, ROW_Y - 32, w, 64, 12), ICE if lit else STEEL, 4, True)
            page.cold.text(language, BODY, x - w / 2, ROW_Y, ICE if lit else MIST, "head", "c")
            x -= w + 12
        label = self.house.controls.label(None, Act.ALT)
        w = round(button_width(label))
        button(page, x - w - 8, ROW_Y, label)
        spots.append(Spot("language", pygame.Rect(x, ROW_Y - 34, RIGHT - x, 68)))
        return spots


_ARROWS: dict[tuple[str, int], Lit] = {}


def arrow(name: str, level: int) -> Lit:
    """A chevron round (0, 0), `level` of 8 parts of its brightness."""
    if (name, level) not in _ARROWS:
        pane = Pane(-24, -24, 48, 48)
        icon(pane.hot, name, 0, 0, 24, dim(FOCUS, level / 8), LINE)
        _ARROWS[name, level] = pane.done()
    return _ARROWS[name, level]
