"""How one game appears on the screens, apart from its texts."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pygame

from pigaming_app.scenes.flow.used_keys import FIRE, STEER, TURBO
from pigaming_app.scenes.views.lesson import Lesson
from pigaming_app.scenes.views.preview import fitted, floor, robots, walls
from pigaming_app.scenes.views.view import MatchView, ViewOptions
from pigaming_app.sim.arena import Arena
from pigaming_app.ui.draw import ADD, Color, GlowCanvas, Point, shape_points
from pigaming_app.ui.draw.frame_budget import Steps
from pigaming_app.ui.i18n import Words

LESSONS_PER_PAGE = 4

Placed = Callable[[list[Point]], list[Point]]
"""Points of a piece of confetti, px from its middle, as they lie on the canvas."""


def player_shape(ink: GlowCanvas, placed: Placed, size: float, shape: int, color: Color) -> None:
    """Confetti: the shape of a player."""
    piece = placed(shape_points(shape, size))
    ink.solid(piece).fill(piece, color)


@dataclass(frozen=True)
class GameScreens:
    """How one game appears.

    - `view(arena, state, players, options, words)`: the view of a match.
    - `tile(canvas, x, y)`: its picture, in 560 x 284 px below and right of (x, y); the title shows it smaller.
    - `fire`: text key (table `howto`) of what FIRE does; empty: nothing.
    - `preview(arena, w, h, allies)`: an arena as additive light in w x h px.
    - `plan(canvas, arena, left, top, scale)`: what a preview shows besides, such as the lines of a pitch; (left, top)
      is the corner of the arena on the canvas.
    - `floor(canvas, arena)`: what lies on the floor of an arena for all of a match, in px of it, as a poster shows it.
    - `deal(canvas, arena, state)`: what the seed of a match deals, over its preview, in px of the arena; the robots.
    - `first_keys`: the keys that new players are shown until they have used them, in this order.
    - `confetti(canvas, placed, size, shape, color)`: a piece of it at the celebration.
    - `team_colors`: winners have the colour of their team, not their own.
    - `lessons`: by text key of their captions (table `howto.lessons`), in pages of four.
    - `lesson_pages`: rule set of each page, if there is more than one.
    - `awards`: icons (keys of ICONS) of the awards for the most of a statistic, by its name, after a minus sign for the
      least; else a medal. Their texts are `awards.NAME`, and for the last place `awards.NAME_praise`.
    - `forget(folder)`: deletes what it keeps in the data folder besides scores, as they are cleared; may raise OSError.
    - `signs`: icons (keys of ICONS) that stand for wishes and topics of its AIs in F4, by name; else a circle.
    """

    view: Callable[[Arena, Any, list[str], ViewOptions, Words | None], MatchView]
    tile: Callable[[GlowCanvas, float, float], None]
    fire: str = ""
    preview: Callable[[Arena, int, int, bool], Steps[pygame.Surface]] = walls
    confetti: Callable[[GlowCanvas, Placed, float, int, Color], None] = player_shape
    team_colors: bool = False
    lessons: Mapping[str, Lesson] = field(default_factory=dict)
    lesson_pages: tuple[str, ...] = ()
    signs: Mapping[str, str] = field(default_factory=dict)
    awards: Mapping[str, str] = field(default_factory=dict)
    plan: Callable[[GlowCanvas, Arena, float, float, float], object] | None = None
    floor: Callable[[GlowCanvas, Arena], object] = floor
    deal: Callable[[GlowCanvas, Arena, Any], object] = robots
    first_keys: tuple[str, ...] = (STEER, FIRE, TURBO)
    forget: Callable[[Path], object] = lambda folder: None

    @property
    def page_count(self) -> int:
        """Pages of lessons."""
        return -(-len(self.lessons) // LESSONS_PER_PAGE)

    def picture(self, arena: Arena, w: int, h: int, allies: bool) -> Steps[pygame.Surface]:
        """The preview of an arena in w x h px, with its plan."""
        out = yield from self.preview(arena, w, h, allies)
        if self.plan:
            ink = GlowCanvas(w, h, 3)
            self.plan(ink, arena, *fitted(w, h))
            yield
            out.blit((yield from ink.lit_steps(0.5)), (0, 0), special_flags=ADD)
        return out
