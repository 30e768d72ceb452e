"""A television lying flat in place of mat and projector: it shines by itself, its glass mirrors lamps, and it flickers.

Robots stand on the glass. Unlike a projector's, its light does not reach their lids, which room light alone shows.
"""

from math import floor
from typing import NamedTuple

import numpy as np

from pigaming_app.hardware.emulator.optics import SENSOR, Map, Optics

DIFFUSE = 0.05  # share of the room light that the glass scatters


class MirroredLamp(NamedTuple):
    """A lamp above the glass: place and height, mm; radius, mm; its mirror image in grey levels."""

    x: float
    y: float
    height: float
    radius: float
    light: float


class Television(NamedTuple):
    """`light`: grey levels of white seen from above; seen at an angle it falls by the power `falloff` of its cosine.
    The backlight is on for the share `duty` of each period of 1/`hertz` s.
    """

    light: float = 130.0
    falloff: float = 2.5
    lamps: tuple[MirroredLamp, ...] = ()
    hertz: float = 120.0
    duty: float = 1.0

    def seen(self, optics: Optics) -> tuple[Map, Map]:
        """For every px of the sensor: grey levels of white, and those of the lamps in the glass."""
        x, y = optics.plane(0.0, slice(0, SENSOR[1]), slice(0, SENSOR[0]))
        lean = optics.rays[..., 0] ** 2 + optics.rays[..., 1] ** 2  # squared tangent of the angle
        white = np.asarray(self.light * (1.0 + lean) ** (-0.5 * self.falloff), dtype=np.float32)
        mirrored = np.zeros_like(white)
        for lamp in self.lamps:
            u, v = x + optics.rays[..., 0] * lamp.height - lamp.x, y + optics.rays[..., 1] * lamp.height - lamp.y
            mirrored += lamp.light * np.exp(-(((u * u + v * v) / lamp.radius**2) ** 4))
        return white, mirrored.astype(np.float32)

    def shine(self, begin: float, shutter: float) -> float:
        """The mean light, 1: as if it did not flicker, of an exposure of `shutter` s from `begin` s on."""
        return (self._lit(begin + shutter) - self._lit(begin)) / (shutter * self.duty)

    def _lit(self, time: float) -> float:
        """Seconds of light up to a time."""
        periods = time * self.hertz
        return (floor(periods) * self.duty + min(periods % 1.0, self.duty)) / self.hertz
