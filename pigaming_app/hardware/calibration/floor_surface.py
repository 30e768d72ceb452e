"""The surface that robots drive on: its size and the scale of an arena on it.

The whole picture lies on it, 1920 x 1080 px: the arena, and the margins with score and corner markers.
"""

from dataclasses import dataclass

from pigaming_app.hardware.calibration.boards import ARENA_AT, CANVAS
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.storage.messages import OperatorMessage


@dataclass(frozen=True)
class FloorSurface:
    """A surface of `width` x `height` mm. Unless that is 16:9, it is wider or higher than the picture."""

    width: float
    height: float

    @classmethod
    def smallest(cls, radius: float, widest: float) -> "FloorSurface":
        """The smallest surface for robots of a radius, mm, where the `widest` that can play have that one, px."""
        return cls(CANVAS[0] * radius / widest, CANVAS[1] * radius / widest)

    @property
    def mm(self) -> float:
        """Millimetres of an arena px."""
        return min(self.width / CANVAS[0], self.height / CANVAS[1])

    @property
    def field(self) -> tuple[float, float]:
        """Width and height of the arena, mm."""
        return WIDTH * self.mm, HEIGHT * self.mm

    @property
    def corner(self) -> tuple[float, float]:
        """The arena's top left corner, mm from that of the surface, with the picture in the middle."""
        left, top = (self.width - CANVAS[0] * self.mm) / 2.0, (self.height - CANVAS[1] * self.mm) / 2.0
        return left + (ARENA_AT[0] + 0.5) * self.mm, top + (ARENA_AT[1] + 0.5) * self.mm


def narrow_arena(width: float, radius: float, widest: float) -> OperatorMessage | None:
    """The message if an arena of this width is too small for robots of this radius, mm; else None.

    `widest`: radius of the widest that can play, px.
    """
    least = FloorSurface.smallest(radius, widest).field[0]
    if width >= least - 0.5:
        return None
    return OperatorMessage("narrow", width=f"{width:.0f}", size=f"{2.0 * radius:.0f}", least=f"{least:.0f}")
