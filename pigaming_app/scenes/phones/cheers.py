"""Cheers as a wave of people along the foot of the screen, and the votes in one line."""

import math
from dataclasses import dataclass

import pygame

from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import RIGHT, Layer, LitImage, fit_text, text
from pigaming_app.ui.draw.surface_cache import cached

COLORS: tuple[kit.Color, ...] = (
    (60, 160, 255), (255, 146, 0), (20, 228, 140), (255, 144, 214),
    (255, 236, 64), (190, 140, 255), (90, 230, 255), (226, 238, 255),
)  # fmt: skip
SIGNS = ("", "★", "!")  # beside the name, by kind
SECONDS = 2.2  # s of a wave from one side to the other
PITCH, REACH, RISE = 40, 230, 76  # px: between two people, half the wave's width, how high they rise
MOST = 6  # waves at a time
VOTES_Y = 60  # px, above the line beside a heading


@dataclass
class Wave:
    """One cheer on its way."""

    label: str
    color: kit.Color
    age: float = 0.0


class Cheers:
    """The waves; a cheer too many is left out."""

    def __init__(self) -> None:
        self.waves: list[Wave] = []

    def add(self, kind: int, color: kit.Color, name: str) -> None:
        """Begin a wave of somebody."""
        if len(self.waves) < MOST:
            self.waves.append(Wave(f"{name} {SIGNS[kind % len(SIGNS)]}".strip(), color))

    def advance(self, seconds: float) -> None:
        """Move on; those that have arrived end."""
        for wave in self.waves:
            wave.age += seconds
        self.waves = [wave for wave in self.waves if wave.age < SECONDS]

    def draw(self, screen: pygame.Surface, named: bool) -> None:
        """Draw the people, each as high as the wave is where they stand, and, if asked for, the names above."""
        for wave in self.waves:
            middle = -REACH + (screen.get_width() + 2 * REACH) * wave.age / SECONDS
            first = max(0, math.ceil((middle - REACH) / PITCH))
            for place in range(first, min(48, math.floor((middle + REACH) / PITCH)) + 1):
                height = RISE * math.cos((place * PITCH - middle) / REACH * math.pi / 2)
                person(wave.color).draw(screen, place * PITCH, screen.get_height() - height)
            if wave.label and named:
                text(wave.label, 34, wave.color).draw(screen, middle, screen.get_height() - RISE - 26)


@cached
def person(color: kit.Color) -> LitImage:
    """Somebody with raised arms; the hands touch y = 0."""
    layer = Layer(-24, 0, 48, 90)
    layer.glow.disc(0, 22, 9, color)
    layer.glow.line([(-15, 4), (-9, 40), (9, 40), (15, 4)], color, kit.THIN).line([(0, 40), (0, 90)], color, kit.LINE)
    return layer.render()


@cached
def votes_line(line: str) -> LitImage:
    """The votes, at the right end above the text beside a heading."""
    fitting, size = fit_text(line, 34, 1000, "body")
    layer = Layer(RIGHT - 1000, VOTES_Y - 30, 1000, 60)
    layer.canvas.body(fitting, RIGHT, VOTES_Y, kit.FOCUS, "r", size)
    return layer.render()
