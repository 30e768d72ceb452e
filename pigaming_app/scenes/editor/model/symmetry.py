"""Symmetry of a drawing: each change is made to the images of a part, too."""

from dataclasses import dataclass
from enum import Enum

from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import Point


@dataclass(frozen=True)
class Image:
    """A reflection of the arena, left to right, top to bottom, or both, which is half a turn."""

    across: bool
    down: bool

    def point(self, x: float, y: float) -> Point:
        """The image of a point, px."""
        return WIDTH - x if self.across else x, HEIGHT - y if self.down else y

    def heading(self, degrees: float) -> float:
        """The image of a direction, in [0, 360)."""
        turned = 180.0 - degrees if self.across else degrees
        return (-turned if self.down else turned) % 360.0

    def way(self, word: str) -> str:
        """The image of up, down, left or right."""
        swapped = {"left": "right", "right": "left"} if word in ("left", "right") else {"up": "down", "down": "up"}
        return swapped[word] if (self.across if word in ("left", "right") else self.down) else word


class Symmetry(Enum):
    """The images that a drawing gets besides each part."""

    OFF = ()
    ACROSS = (Image(True, False),)
    TURN = (Image(True, True),)
    FOUR = (Image(True, False), Image(False, True), Image(True, True))

    @property
    def images(self) -> tuple[Image, ...]:
        found: tuple[Image, ...] = self.value
        return found

    @property
    def following(self) -> "Symmetry":
        """The next one, after the last the first."""
        every = list(Symmetry)
        return every[(every.index(self) + 1) % len(every)]
