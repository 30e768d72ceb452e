"""Words at the place of an event, such as "Delivered!" at an exit: they pop up, rise and fade."""

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

from pigaming_app.scenes.views.sprites.factory_signs import LEVELS, POPS, shout
from pigaming_app.ui.draw import Color
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import Batch, put
from pigaming_app.ui.i18n import Words

LASTS, POP, RISE = 1.5, 0.2, 54.0  # s; s of the growing; px
FADES = 0.4  # share of the time in which it fades
EDGE = 12  # px between a word and the edge of the picture
CLEAR = 70.0  # px, vertical distance below which a new word replaces an old one


class FactoryAnnouncement(NamedTuple):
    """A word of a colour, first centred at (x, y), canvas px."""

    born: float
    x: float
    y: float
    text: str
    color: Color


class FactoryAnnouncements:
    """The current announcements. Without `words` there are none."""

    def __init__(self, words: Words | None) -> None:
        self.words = words
        self.notes: list[FactoryAnnouncement] = []

    def add(self, now: float, x: float, y: float, key: str, color: Color) -> None:
        """Announce a text of the table `factory` at (x, y)."""
        if self.words is None:
            return
        word = self.words(f"factory.{key}")
        half = shout(word, color, POPS - 1, LEVELS).image.get_width() / 2 + EDGE
        x = min(max(x, half), 1920 - half)
        self.notes = [note for note in self.notes if abs(note.y - y) > CLEAR or abs(note.x - x) > 2 * half]
        self.notes.append(FactoryAnnouncement(now, x, y, word, color))

    def draw(self, top: Batch, now: float) -> None:
        """Collect the sprites."""
        self.notes = [note for note in self.notes if now - note.born < LASTS]
        for born, x, y, text, color in self.notes:
            age = now - born
            t = age / LASTS
            pop = min(POPS - 1, int(age / POP * POPS))
            level = LEVELS if t < 1.0 - FADES else max(1, round(LEVELS * (1.0 - t) / FADES))
            put(top, shout(text, color, pop, level), x, y - RISE * (1.0 - (1.0 - t) ** 2))

    def jobs(self, *keys: tuple[str, Color]) -> Iterator[Job]:
        """Prewarm jobs for these texts and colours."""
        for key, color in keys:
            word = self.words(f"factory.{key}") if self.words else ""
            yield from (partial(shout, word, color, pop, LEVELS) for pop in range(POPS))
            yield from (partial(shout, word, color, POPS - 1, level) for level in range(1, LEVELS))
