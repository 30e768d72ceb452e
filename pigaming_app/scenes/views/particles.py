"""Short-lived effects of a match: sparks, shards, shock waves, light, score popups and screen shake.

Runs in real time with its own random generator. The number of particles is limited: a burst beyond it is reduced.
"""

import math
import random
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import NamedTuple

from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.sprites.effects import (
    LIGHT_LEVELS,
    SHARDS,
    SPARK_SIZES,
    SPARK_TURNS,
    WAVE_STEPS,
    light,
    shards,
    sparks,
    wave,
)
from pigaming_app.scenes.views.sprites.pickups import POPUP_LEVELS, popup
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.draw import Color
from pigaming_app.ui.draw.frame_budget import Unfinished
from pigaming_app.ui.draw.sprites import Batch, Sprite, put, step

MAX_PARTICLES = 320  # limit of live particles
SHAKE = 0.28  # s
CALM_BURSTS = 3  # in a second, in calm mode
RISE, RISING = 60.0, 0.8  # px, s: height and duration of a popup
Cone = tuple[float, float]  # centre and half the opening angle, rad
ALL: Cone = (0.0, math.pi)
Frame = Callable[[float], Sprite]  # picture at a share (0..1) of an effect's life; may be built only then


def reel(make: Callable[..., Sequence[Sprite]], *args: object) -> Frame:
    """The sprites of `make(*args)` in their order."""

    def frame(t: float) -> Sprite:
        frames = make(*args)
        return frames[int(t * len(frames))]

    return frame


def fading(make: Callable[..., Sequence[Sprite]], *args: object) -> Frame:
    """The sprites of `make(*args)` from the last one, the brightest, to the first."""

    def frame(t: float) -> Sprite:
        frames = make(*args)
        return frames[min(int((1.0 - t) * len(frames)), len(frames) - 1)]

    return frame


class Particle(NamedTuple):
    """Moves by (dx, dy) px within `life` seconds, decelerating."""

    born: float
    life: float
    x: float
    y: float
    dx: float
    dy: float
    frame: Frame


class Bloom(NamedTuple):
    """Stationary light that plays its frames once."""

    born: float
    life: float
    x: float
    y: float
    frame: Frame


class ScorePopup(NamedTuple):
    """A rising number."""

    born: float
    x: float
    y: float
    text: str
    player: int


class Particles:
    """All effects of a match, in canvas px and seconds."""

    def __init__(self, calm: bool = False) -> None:
        self.calm = calm  # at most CALM_BURSTS bursts and lights begin in a second
        self.began: list[float] = []  # of the last second
        self.clock = 0.0
        self.random = random.Random(7)
        self.particles: list[Particle] = []
        self.blooms: list[Bloom] = []
        self.scores: list[ScorePopup] = []
        self.shaken = -1.0

    def burst(self, x: float, y: float, color: Color, count: int, start: float, reach: float, cone: Cone = ALL) -> None:
        """Sparks from a radius of `start` px around (x, y), travelling up to `reach` px within a cone."""
        if not self._permitted():
            return
        for _ in range(min(count, MAX_PARTICLES - len(self.particles))):
            a = cone[0] + self.random.uniform(-cone[1], cone[1])
            c, s, far = math.cos(a), math.sin(a), reach * self.random.random() ** 0.6
            near = start * self.random.uniform(1.0, 1.3)
            frame = fading(sparks, color, self.random.choice(SPARK_SIZES), step(a, SPARK_TURNS))
            life = self.random.uniform(0.3, 0.75)
            self.particles.append(Particle(self.clock, life, x + near * c, y + near * s, far * c, far * s, frame))

    def debris(self, ax: float, ay: float, bx: float, by: float, count: int) -> None:
        """Splinters along a line."""
        for _ in range(min(count, MAX_PARTICLES - len(self.particles))):
            t, a, far = self.random.random(), self.random.uniform(0, math.tau), self.random.uniform(20, 90)
            frame = fading(shards, self.random.randrange(SHARDS), self.random.randrange(SPARK_TURNS))
            x, y, life = ax + (bx - ax) * t, ay + (by - ay) * t, self.random.uniform(0.5, 1.1)
            self.particles.append(Particle(self.clock, life, x, y, far * math.cos(a), far * math.sin(a), frame))

    def shock(self, x: float, y: float, color: Color) -> None:
        """Shock wave on the ground."""
        self.bloom(x, y, 0.45, lambda t: wave(color, int(t * WAVE_STEPS)))

    def glow(self, x: float, y: float, color: Color, seconds: float = 0.35) -> None:
        """Fading light on the ground."""
        self.bloom(x, y, seconds, lambda t: light(color, LIGHT_LEVELS - int(t * LIGHT_LEVELS)))

    def bloom(self, x: float, y: float, seconds: float, frame: Frame) -> None:
        """Light that plays its frames once."""
        if self._permitted():
            self.blooms.append(Bloom(self.clock, seconds, x, y, frame))

    def score(self, x: float, y: float, text: str, player: int) -> None:
        """Score popup over a robot, kept inside the arena; replaces an overlapping one."""
        x, y = min(max(x, LEFT + 60), LEFT + WIDTH - 60), max(y, TOP + 48 + RISE)
        self.scores = [popup for popup in self.scores if (popup.player, popup.text[0]) != (player, text[0])]
        self.scores.append(ScorePopup(self.clock, x, y, text, player))

    def shake(self) -> None:
        """Start a slight screen shake."""
        self.shaken = self.clock

    def _permitted(self) -> bool:
        """True if another burst or light may begin: those of the same moment are one."""
        if not self.calm or self.clock in self.began:
            return True
        self.began = [time for time in self.began if self.clock - time < 1.0]
        if len(self.began) == CALM_BURSTS:
            return False
        self.began.append(self.clock)
        return True

    def advance(self, seconds: float) -> None:
        self.clock += seconds
        now = self.clock
        self.particles = [effect for effect in self.particles if now - effect.born < effect.life]
        self.blooms = [effect for effect in self.blooms if now - effect.born < effect.life]
        self.scores = [popup for popup in self.scores if now - popup.born < RISING]

    @property
    def offset(self) -> tuple[int, int]:
        """Current screen shake, px."""
        left = 1.0 - (self.clock - self.shaken) / SHAKE if self.shaken >= 0.0 else 0.0
        if left <= 0.0:
            return 0, 0
        swing = 7.0 * left * left
        return round(swing * math.sin(self.clock * 71.0)), round(swing * math.cos(self.clock * 83.0))

    def draw_light(self, batch: Batch) -> None:
        """Collect the additive sprites that are built, or can be in this frame."""
        now = self.clock
        for born, life, x, y, dx, dy, frame in self.particles:
            t = (now - born) / life
            far = t * (2.0 - t)
            try:
                image, ox, oy = frame(t)
            except Unfinished:
                continue
            batch.append((image, (int(x + dx * far + ox), int(y + dy * far + oy))))
        for born, life, x, y, frame in self.blooms:
            with suppress(Unfinished):
                put(batch, frame((now - born) / life), x, y)

    def draw_scores(self, batch: Batch) -> None:
        """Collect the popups, which cover what is below them."""
        for born, x, y, text, player in self.scores:
            t = (self.clock - born) / RISING
            level = POPUP_LEVELS if t < 0.6 else max(1, math.ceil(POPUP_LEVELS * (1.0 - t) / 0.4))
            put(batch, popup(text, player, level), x, y - RISE * (1.0 - (1.0 - t) ** 2))
