"""Background of a walled arena: frame, grid, start positions, and walls, which are redrawn when damaged."""

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import pygame

from pigaming_app.scenes.views.background import LEFT, TOP, Background
from pigaming_app.scenes.views.sprites.floors import FLOORS
from pigaming_app.scenes.views.sprites.wall import wall
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ADD, LINE, PLAYERS, PRE, WALL, GlowCanvas, LayeredCanvas, cut_box, dim, shape_points
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.sprites import Batch, Sprite, light_sprite, put
from pigaming_app.ui.draw.surface_cache import cached

MARGIN = 96  # px left and right of the arena that marks may reach
Starts = tuple[tuple[int, float, float], ...]  # seat, px, px


class WalledBackground(Background):
    """Background with the first `count` walls, those of the arena; the others belong to real things. `floor` renders
    what lies under them; `starts` are marked on it.
    """

    def __init__(self, count: int, floor: Callable[[], pygame.Surface], starts: Starts) -> None:
        super().__init__(floor)
        self.starts = starts
        self.health: list[int] = [0] * count
        self.sprites: list[Sprite | None] = [None] * count

    @cached_property
    def bare(self) -> pygame.Surface:
        """The floor, with the starts of this match."""
        marks: Batch = []
        out = self._paint().copy()
        for seat, x, y in self.starts:
            put(marks, start_mark(seat), LEFT + x, TOP + y)
        out.fblits(marks, ADD)
        return out

    def show_walls(self, state: Any) -> None:
        """Bake the walls whose health has changed."""
        for i in range(len(self.sprites)):
            part = state.walls[i]
            if self.sprites[i] is None or part.health != self.health[i]:
                before, now = self.sprites[i], wall_sprite(part, part.health)
                self.health[i], self.sprites[i] = part.health, now
                box = _box(part, now)
                self._bake_walls(state, box.union(_box(part, before)) if before else box)

    def _bake_walls(self, state: Any, box: pygame.Rect) -> None:
        self.surface.set_clip(box)
        self.surface.blit(self.bare, box, box)
        for part, sprite in zip(state.walls, self.sprites, strict=False):
            if sprite:
                at = _box(part, sprite)
                if at.colliderect(box):
                    self.surface.blit(sprite.image, at, special_flags=PRE)
        self.surface.set_clip(None)


def wall_sprite(part: Any, health: int) -> Sprite:
    """Wall sprite for a given health."""
    length = math.dist((part.ax, part.ay), (part.bx, part.by)) + 2 * part.half - 4
    angle = math.atan2(part.by - part.ay, part.bx - part.ax)
    return wall(
        length, 2 * part.half - 4, angle, health, int(part.ax * 7 + part.ay * 13 + part.bx), max(1, part.initial_health)
    )


def _box(part: Any, sprite: Sprite) -> pygame.Rect:
    x, y = LEFT + (part.ax + part.bx) / 2, TOP + (part.ay + part.by) / 2
    return sprite.image.get_rect(topleft=(int(x + sprite.dx + 0.5), int(y + sprite.dy + 0.5)))


@light_sprite(48, 0.0)
def start_mark(ink: GlowCanvas, seat: int) -> None:
    """The shape of a seat on the floor, where its robot begins."""
    ink.line([(y, -x) for x, y in shape_points(seat, 40)], dim(PLAYERS[seat], 0.20), 3, True)


@cached
@resumable
def walled_floor(pattern: str, *marks: Any) -> Steps[pygame.Surface]:
    """Floor and frame. `pattern`: one of FLOORS; `marks`: see `SimpleView.floor_marks`."""
    canvas = LayeredCanvas()
    glow, crisp = canvas.glow, canvas.crisp
    FLOORS[pattern](crisp.set_transform(LEFT, TOP))
    crisp.set_transform(0, 0)
    yield
    glow.neon(cut_box(LEFT - 3, TOP - 3, WIDTH + 6, HEIGHT + 6, 28), WALL, LINE, True)
    crisp.line(cut_box(LEFT + 14, TOP + 14, WIDTH - 28, HEIGHT - 28, 24), (38, 53, 78), 2, True)
    yield
    out = yield from canvas.render_steps()
    if marks:
        draw, *arguments = marks
        ink = GlowCanvas(int(WIDTH) + 2 * MARGIN, int(HEIGHT)).set_transform(MARGIN, 0)
        draw(ink, *arguments)
        yield
        out.blit((yield from ink.lit_steps(0.7)), (LEFT - MARGIN, TOP), special_flags=ADD)
    return out
