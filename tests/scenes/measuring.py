"""Text positions on a page, measured while it is drawn, for tests that nothing overlaps or is cut off.

`GlowCanvas` records each line of text and each closed cut box; a `Screen` records those that reach it.
"""

import functools
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import pygame
import pytest

from pigaming_app.ui.draw import glow
from pigaming_app.ui.draw.frame_budget import Steps
from pigaming_app.ui.draw.glow import GlowCanvas, LayeredCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.draw.theme import CAPITALS, line_width

SAFE = pygame.Rect(60, 16, 1800, 1048)  # slightly more than the safe area of menus: prompts may lie in its margin
Painting = Callable[..., Steps[pygame.Surface]]
SMALLEST = 9 * 1920 / 1024  # px, minimum height of capitals: 9 px in a window of 1024 x 768
KEPT = [f"pigaming_app.ui.{name}" for name in ("i18n", "draw.theme", "widgets.word_filter")]  # texts and fonts
SIGNED_ZERO = re.compile(r"(?<![\w.,])[+−-]0(?![.,]?\d*[1-9])(?!\d)")
NEAR = 3  # px, minimum distance between a text and an outline


@dataclass(frozen=True)
class Mark:
    """A line of text or an outline (empty text), and its box on the surface it was drawn on, px."""

    text: str
    box: tuple[float, float, float, float]  # left, top, right, bottom

    def moved(self, dx: float, dy: float) -> "Mark":
        left, top, right, bottom = self.box
        return Mark(self.text, (left + dx, top + dy, right + dx, bottom + dy))


@dataclass
class Measured:
    """Everything drawn on each surface; surfaces are kept alive so that their ids stay unique."""

    kept: dict[int, tuple[pygame.Surface, list[Mark]]] = field(default_factory=dict)

    def note(self, surface: pygame.Surface, marks: list[Mark]) -> None:
        self.kept.setdefault(id(surface), (surface, []))[1].extend(marks)

    def on(self, surface: pygame.Surface) -> list[Mark]:
        return self.kept.get(id(surface), (surface, []))[1]


class Screen(pygame.Surface):
    """A canvas that records the texts drawn on it."""

    def __init__(self, measured: Measured) -> None:
        super().__init__((1920, 1080))
        self.measured, self.marks = measured, list[Mark]()

    def blit(self, source: pygame.Surface, dest: Any = (0, 0), area: Any = None, special_flags: int = 0) -> Any:
        whole = area is None or pygame.Rect(area).size == source.get_size()
        if not special_flags and source.get_size() == self.get_size():
            self.marks.clear()  # it covers everything
        if whole:
            x, y = (dest.x, dest.y) if isinstance(dest, pygame.Rect) else (dest[0], dest[1])
            self.marks += [mark.moved(x, y) for mark in self.measured.on(source)]
        return super().blit(source, dest, area, special_flags)

    @property
    def texts(self) -> list[Mark]:
        """Each line once; text drawn over itself, as in a focused row, counts once."""
        return list(dict.fromkeys(_rounded(mark) for mark in self.marks if mark.text.strip()))

    @property
    def frames(self) -> list[Mark]:
        """The outlines."""
        return list(dict.fromkeys(_rounded(mark) for mark in self.marks if not mark.text))


@contextmanager
def empty_cache() -> Iterator[None]:
    """An empty surface cache in this scope. Afterwards it holds what it held before, and nothing drawn in the scope."""
    tables = {id(entry.table): entry.table for entry in surfaces._order}
    parts: list[dict[Any, Any]] = [surfaces._order, surfaces._holders, *tables.values()]
    kept, size = [part.copy() for part in parts], surfaces.bytes
    for part in parts:
        part.clear()
    surfaces.bytes = 0
    try:
        yield
    finally:
        surfaces.clear()
        for part, before in zip(parts, kept, strict=True):
            part.update(before)
        surfaces.bytes = size


@contextmanager
def measuring(patch: pytest.MonkeyPatch) -> Iterator[Screen]:
    """Measure everything rendered in this scope, with empty caches; surfaces stay black."""
    forget()
    measured = Measured()
    text, line, draw = GlowCanvas.text, GlowCanvas.line, LitImage.draw

    def noted_text(ink: Any, said: str, size: int, x: float, y: float, *rest: Any, **named: Any) -> Any:
        face = named.get("face", rest[1] if len(rest) > 1 else "head")
        align = named.get("align", rest[2] if len(rest) > 2 else "l")
        px, py = (value / ink.ss for value in ink._at((x, y)))
        scale = ink.k / ink.ss
        w = line_width(said, face, round(size * ink.k)) / ink.ss
        left = px - w * {"l": 0.0, "c": 0.5, "r": 1.0}[align]
        half = CAPITALS * size * scale / 2
        marks_of(ink).append(Mark(said, (left, py - half, left + w, py + half)))
        return text(ink, said, size, x, y, *rest, **named)

    def noted_line(ink: Any, points: Any, color: Any, width: float = 6, closed: bool = False) -> Any:
        if closed and len(points) == 8:
            at = [ink._at(point) for point in points]
            xs, ys = [x / ink.ss for x, _ in at], [y / ink.ss for _, y in at]
            if max(xs) - min(xs) > 90 and max(ys) - min(ys) > 40:
                marks_of(ink).append(Mark("", (min(xs), min(ys), max(xs), max(ys))))
        return line(ink, points, color, width, closed)

    def noted(make: Painting, parts: Callable[[Any], list[Any]]) -> Painting:
        def made(self: Any, *rest: Any) -> Steps[pygame.Surface]:
            out = yield from make(self, *rest)
            measured.note(out, [mark for ink in parts(self) for mark in marks_of(ink)])
            return out

        return made

    def drawn(
        lit: LitImage, surface: pygame.Surface, dx: float = 0.0, dy: float = 0.0, *rest: Any, **named: Any
    ) -> None:
        draw(lit, surface, dx, dy, *rest, **named)
        if not isinstance(surface, Screen):
            measured.note(surface, [mark.moved(lit.at[0] + dx, lit.at[1] + dy) for mark in measured.on(lit.image)])

    leave_black(patch)
    patch.setattr(GlowCanvas, "text", noted_text)
    patch.setattr(GlowCanvas, "line", noted_line)
    patch.setattr(GlowCanvas, "downscale_steps", noted(GlowCanvas.downscale_steps, lambda ink: [ink]))
    patch.setattr(GlowCanvas, "sprite_steps", noted(GlowCanvas.sprite_steps, lambda ink: [ink]))
    patch.setattr(
        LayeredCanvas,
        "render_steps",
        noted(LayeredCanvas.render_steps, lambda page: [page.soft, page.crisp, page.glow]),
    )
    patch.setattr(LitImage, "draw", drawn)
    with empty_cache():
        yield Screen(measured)
    forget()


def leave_black(patch: pytest.MonkeyPatch) -> None:
    """Render surfaces without their drawing, for tests of what is drawn and where: it takes a quarter of the time."""
    patch.setattr(glow, "add_glow", _no_steps)
    patch.setattr(glow.Supersampled, "downscale", _no_steps)


def _no_steps(*_: Any) -> Steps[None]:
    yield from ()


def forget() -> None:
    """Clear every other cache of rendered surfaces."""
    for cached in _caches(len(sys.modules)):
        cached.cache_clear()


@functools.lru_cache(1)
def _caches(modules: int) -> list[Any]:
    """The caches of functions in scenes and ui, of which `modules` are loaded, but not those of texts and fonts."""
    found = []
    for name, module in list(sys.modules.items()):
        if name.startswith(("pigaming_app.scenes", "pigaming_app.ui")):
            for part in [module, *(one for one in vars(module).values() if isinstance(one, type))]:
                found += [one for one in vars(part).values() if isinstance(one, functools._lru_cache_wrapper)]
    return [one for one in found if one.__module__ not in KEPT]


def marks_of(ink: Any) -> list[Mark]:
    """The marks recorded by a canvas."""
    found: list[Mark] = ink.__dict__.setdefault("marks", [])
    return found


def lit_boxes(picture: pygame.Surface, above: int = 40) -> list[pygame.Rect]:
    """The boxes of all parts of a picture that are brighter than so much."""
    lit = pygame.mask.from_threshold(picture, (0, 0, 0), (above, above, above, 255))
    lit.invert()
    return lit.get_bounding_rects()


def faults(screen: Screen, safe: pygame.Rect = SAFE) -> list[str]:
    """Overlaps, crossed outlines, texts too small to read, and marks outside of the safe area."""
    found = [f"{mark.text!r} is too small" for mark in screen.texts if _too_small(mark)]
    found += [f"{mark.text!r} has a sign at zero" for mark in screen.texts if SIGNED_ZERO.search(mark.text)]
    found += [f"{mark.text!r} leaves the picture" for mark in screen.texts if not safe.contains(_rect(mark))]
    for one, other in combinations(screen.texts, 2):
        if _shared(one, other) and one.text != other.text:
            found.append(f"{one.text!r} touches {other.text!r}")
    for mark in screen.texts:
        found += [f"{mark.text!r} crosses its frame" for frame in screen.frames if _crosses(mark, frame)]
    return sorted(set(found))


def _too_small(mark: Mark) -> bool:
    """True for words below SMALLEST; a single sign may be an ornament, such as the number in a badge."""
    return len(mark.text.strip()) > 1 and mark.box[3] - mark.box[1] < SMALLEST - 0.5


def _shared(one: Mark, other: Mark, apart: float = 0.0) -> bool:
    """True if two boxes overlap or are nearer than `apart` px."""
    (a, b, c, d), (e, f, g, h) = one.box, other.box
    return min(c, g) - max(a, e) > -apart and min(d, h) - max(b, f) > -apart


def _crosses(mark: Mark, frame: Mark) -> bool:
    """True if a mark is neither inside nor outside an outline."""
    (a, b, c, d), (e, f, g, h) = mark.box, frame.box
    inside = a >= e + NEAR and c <= g - NEAR and b >= f + NEAR and d <= h - NEAR
    return not inside and _shared(mark, frame, NEAR)


def _rect(mark: Mark) -> pygame.Rect:
    left, top, right, bottom = mark.box
    return pygame.Rect(round(left), round(top), round(right - left), round(bottom - top))


def _rounded(mark: Mark) -> Mark:
    left, top, right, bottom = (float(round(value)) for value in mark.box)
    return Mark(mark.text, (left, top, right, bottom))
