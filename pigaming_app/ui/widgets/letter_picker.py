"""Letter picker for stick and button: names in the Lab, initials in the high scores."""

from collections.abc import Sequence

import pygame

from pigaming_app.ui.draw import FOCUS, LINE, STEEL, THIN, Color, brackets, cut_box, icon, panel
from pigaming_app.ui.draw.layers import Layer, LitImage, word
from pigaming_app.ui.draw.surface_cache import cached

ROLL = 0.09  # seconds for which a letter rolls into place


class LetterPicker:
    """The letters of `text`, each from `alphabet`; the one at `slot` is being changed."""

    def __init__(self, alphabet: str, text: str) -> None:
        self.alphabet = alphabet
        self.letters = [alphabet.index(letter) for letter in text]
        self.slot = 0
        self._rolled, self._rolling = 0, ROLL

    @property
    def spelled(self) -> str:
        """The current letters."""
        return "".join(self.alphabet[letter] for letter in self.letters)

    @property
    def roll(self) -> float:
        """Distance of the letter at `slot` from its place, -1..1 letters."""
        return self._rolled * max(0.0, 1.0 - self._rolling / ROLL)

    def turn(self, by: int) -> str:
        """Turn the letter at `slot` by `by` letters. Returns the name of the sound."""
        self.letters[self.slot] = (self.letters[self.slot] + by) % len(self.alphabet)
        self._rolled, self._rolling = by, 0.0
        return "move"

    def move(self, by: int) -> str | None:
        """Move to another slot, without wrapping. Returns the name of the sound, None if nothing moved."""
        before, self.slot = self.slot, max(0, min(len(self.letters) - 1, self.slot + by))
        self._rolled = 0
        if self.slot == before:
            return None
        return "accept" if self.slot > before else "back"

    def update(self, seconds: float) -> None:
        """Advance the roll animation."""
        self._rolling += seconds


def draw_letters(
    screen: pygame.Surface,
    picker: LetterPicker,
    xs: Sequence[float],
    y: float,
    size: int,
    pitch: float,
    color: Color,
    open_: bool = True,
) -> None:
    """Draw the letters centred on (x, y), `size` px high; a rolling letter starts `pitch` px away.

    `open_`: highlight the letter at the slot, as it can still be changed.
    """
    for i, (letter, x) in enumerate(zip(picker.spelled, xs, strict=True)):
        here = open_ and i == picker.slot
        if letter != " ":
            word(letter, size, FOCUS if here else color).draw(screen, x, y + (pitch * picker.roll if here else 0.0))


@cached
def cursor(w: int, h: int, arm: int, corner: int, width: float, arrows: tuple[float, int, float]) -> LitImage:
    """Brackets round a letter of w x h px and the arrows above and below it, centred on (0, 0).

    `arrows`: px from the middle to an arrow, its size, and the vertical reach of the glow.
    """
    away, r, reach = arrows
    layer = Layer(-w / 2 - 20, -reach, w + 40, 2 * reach)
    brackets(layer.glow, -w / 2, -h / 2, w, h, FOCUS, arm, corner, width)
    for side, name in ((-1, "up"), (1, "down")):
        icon(layer.glow, name, 0, side * away, r, FOCUS, LINE)
    return layer.render()


@cached
def letter_box(w: float, h: float) -> LitImage:
    """Box of a letter, px, centred on (0, 0)."""
    layer = Layer(-w / 2, -h / 2, w, h)
    panel(layer.glow, -w / 2, -h / 2, w, h)
    layer.glow.line(cut_box(-w / 2, -h / 2, w, h, 20), STEEL, THIN, True)
    return layer.render()
