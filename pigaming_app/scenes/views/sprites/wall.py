"""Destructible wall: each lit cell stands for one more bullet. It cracks, gapes, turns to rubble, then to a stain."""

import math
import random

from pigaming_app.ui.draw import BLACK, HAIR, LINE, WALL, GlowCanvas, Point, cut_box, dim, regular_polygon
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached

SOLID = -1  # health of an indestructible wall


def draw_wall(ink: GlowCanvas, length: float, thick: float, health: int, seed: int, whole: int = 5) -> GlowCanvas:
    """Draw a wall centred on the origin of `ink`, along x; `health` of `whole` bullets, or SOLID."""
    outline = cut_box(-length / 2, -thick / 2, length, thick, min(12, thick / 3))
    if health == SOLID:
        return _solid(ink, outline, length, thick)
    cells = _Cells(ink, length, thick, whole, seed)
    if health == 0:
        for i in range(whole):
            cells.dust(i, 0.22, 3)
    elif health == 1 and whole > 2:
        cells.rubble(health, all_dust=True)
    elif 2 * health < whole:
        cells.rubble(health, all_dust=False)
    else:
        ink.solid(outline).neon(outline, WALL, LINE, True)
        cells.cracked(health)
    return ink


@cached
def wall(length: float, thick: float, angle: float, health: int, seed: int, whole: int = 5) -> Sprite:
    """Wall at `angle` rad. Premultiplied alpha."""
    c, s = abs(math.cos(angle)), abs(math.sin(angle))
    w, h = int((length * c + thick * s) / 2 + 40), int((length * s + thick * c) / 2 + 40)
    ink = draw_wall(GlowCanvas(2 * w, 2 * h, 3).set_transform(w, h, angle), length, thick, health, seed, whole)
    return trim(ink.sprite(0.8), w, h)


def _solid(ink: GlowCanvas, outline: list[Point], length: float, thick: float) -> GlowCanvas:
    ink.solid(outline).neon(outline, WALL, LINE, True)
    half, count = thick / 2 - 9, max(1, round((length - 24) / 18))
    for i in range(count):
        x = -length / 2 + 12 + (length - 24) * (i + 0.5) / count
        ink.line([(x - half * 0.5, half), (x + half * 0.5, -half)], dim(WALL, 0.5), 3)
    return ink


class _Cells:
    """Cells of a wall, their slanted joints, and the order in which they are lost."""

    def __init__(self, ink: GlowCanvas, length: float, thick: float, whole: int, seed: int) -> None:
        self.ink, self.thick, self.half, self.whole = ink, thick, thick / 2, whole
        self.rng = random.Random(seed)
        self.order = self.rng.sample(range(whole), whole)
        cell = (length - 8) / whole
        inner = range(1, whole)
        self.joints = [-length / 2, *(-length / 2 + 4 + cell * i for i in inner), length / 2]
        self.slant = [0.0, *(self.rng.uniform(-9, 9) for _ in inner), 0.0]

    def cracked(self, health: int) -> None:
        """Lit cells, and cracks in place of lost ones."""
        lost = self.order[: self.whole - health]
        for i in range(self.whole):
            a, b, half = self.joints[i], self.joints[i + 1], self.half
            if i not in lost:
                self.ink.fill(cut_box(a + 7, -half + 8, b - a - 14, self.thick - 16, 4), dim(WALL, 0.42))
                continue
            x, sa, sb = (a + b) / 2, self.slant[i], self.slant[i + 1]
            crack = [(x - 9, -half), (x - 2 + sa, -half * 0.35), (x + 4 - sb, half * 0.2), (x + 8, half)]
            self.ink.line(crack, BLACK, 9).line(crack, WALL, 3).line([crack[1], (x + 19, -half * 0.1)], WALL, 3)
            self.ink.line([crack[2], (x - 15, half * 0.4)], WALL, 3)

    def rubble(self, health: int, all_dust: bool) -> None:
        """Separated shards; either all lost cells are dust or only the first."""
        lost = self.order[: self.whole - health]
        for i in range(self.whole):
            if i in lost and (all_dust or i == lost[0]):
                self.dust(i, 0.7, 4)
            else:
                self._shard(i, i in lost)

    def dust(self, i: int, bright: float, grains: int) -> None:
        """Dust in place of one cell."""
        a, b = self.joints[i], self.joints[i + 1]
        for _ in range(grains):
            x, y = self.rng.uniform(a + 6, b - 6), self.rng.uniform(-self.half, self.half)
            grain = regular_polygon(3, self.rng.uniform(3, 6), self.rng.random() * 6, x, y)
            self.ink.line(grain, dim(WALL, bright), HAIR, True)

    def _shard(self, i: int, broken: bool) -> None:
        a, b, sa, sb, half = self.joints[i], self.joints[i + 1], self.slant[i], self.slant[i + 1], self.half
        shard = [(a + 4 - sa, -half), (b - 4 - sb, -half), (b - 4 + sb, half), (a + 4 + sa, half)]
        if broken:
            shard = [shard[0], shard[1], ((a + b) / 2 + sa, half * 0.2), (a + 8, half)]
        turn, dy, x0 = self.rng.uniform(-0.14, 0.14), self.rng.uniform(-4, 4), (a + b) / 2
        c, s = math.cos(turn), math.sin(turn)
        shard = [(x0 + (x - x0) * c - y * s, dy + (x - x0) * s + y * c) for x, y in shard]
        self.ink.solid(shard).neon(shard, WALL, 5, True)
        if not broken:
            self.ink.fill([(x0 + (x - x0) * 0.55, y * 0.45) for x, y in shard], dim(WALL, 0.42))
