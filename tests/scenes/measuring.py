"""Where texts stand on a page, measured while it is painted: for tests that nothing touches or is cut off.

`GlowCanvas` notes each line of text and each closed cut box; a `Screen` notes which of them reach it.
"""

import functools
import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import pygame
import pytest

from pigaming_app.ui.draw.frame_budget import Steps
from pigaming_app.ui.draw.glow import GlowCanvas, LayeredCanvas
from pigaming_app.ui.draw.layers import LitImage
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.draw.theme import CAPITALS, font

SAFE = pygame.Rect(60, 16, 1800, 1048)  # a little more than the safe area of menus: hints may stand in its margin
Painting = Callable[..., Steps[pygame.Surface]]
NEAR = 3  # px between a text and an outline, at least


@dataclass(frozen=True)
class Mark:
    """A line of text, or an outline (no text), and its box on the surface it was drawn on, px."""

    text: str
    box: tuple[float, float, float, float]  # left, top, right, bottom

    def moved(self, dx: float, dy: float) -> "Mark":
        left, top, right, bottom = self.box
        return Mark(self.text, (left + dx, top + dy, right + dx, bottom + dy))


@dataclass
class Measured:
    """What has been drawn on each surface; surfaces are kept so that no other gets their id."""

    kept: dict[int, tuple[pygame.Surface, list[Mark]]] = field(default_factory=dict)

    def note(self, surface: pygame.Surface, marks: list[Mark]) -> None:
        self.kept.setdefault(id(surface), (surface, []))[1].extend(marks)

    def on(self, surface: pygame.Surface) -> list[Mark]:
        return self.kept.get(id(surface), (surface, []))[1]


class Screen(pygame.Surface):
    """A canvas that knows the texts painted on it."""

    def __init__(self, measured: Measured) -> None:
        super().__init__((1920, 1080))
        self.measured, self.marks = measured, list[Mark]()

    def blit(self, source: pygame.Surface, dest: Any = (0, 0), area: Any = None, special_flags: int = 0) -> Any:
        whole = area is None or pygame.Rect(area).size == source.get_size()
        if not special_flags and source.get_size() == self.get_size():
            self.marks.clear()  # it hides all
        if whole:
            x, y = (dest.x, dest.y) if isinstance(dest, pygame.Rect) else (dest[0], dest[1])
            self.marks += [mark.moved(x, y) for mark in self.measured.on(source)]
        return super().blit(source, dest, area, special_flags)

    @property
    def texts(self) -> list[Mark]:
        """Each line once; what is painted over itself, such as a row in focus, counts once."""
        return list(dict.fromkeys(_rounded(mark) for mark in self.marks if mark.text.strip()))

    @property
    def frames(self) -> list[Mark]:
        """The outlines."""
        return list(dict.fromkeys(_rounded(mark) for mark in self.marks if not mark.text))


@contextmanager
def measuring(patch: pytest.MonkeyPatch) -> Iterator[Screen]:
    """Everything that is lit from now on is measured; what was lit before is forgotten first."""
    forget()
    measured = Measured()
    text, line, draw = GlowCanvas.text, GlowCanvas.line, LitImage.draw

    def noted_text(ink: Any, said: str, size: int, x: float, y: float, *rest: Any, **named: Any) -> Any:
        face = named.get("face", rest[1] if len(rest) > 1 else "head")
        align = named.get("align", rest[2] if len(rest) > 2 else "l")
        px, py = (value / ink.ss for value in ink._at((x, y)))
        scale = ink.k / ink.ss
        w = font(face, round(size * ink.k)).size(said)[0] / ink.ss
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

    patch.setattr(GlowCanvas, "text", noted_text)
    patch.setattr(GlowCanvas, "line", noted_line)
    patch.setattr(GlowCanvas, "shrinking", noted(GlowCanvas.shrinking, lambda ink: [ink]))
    patch.setattr(GlowCanvas, "spriting", noted(GlowCanvas.spriting, lambda ink: [ink]))
    patch.setattr(
        LayeredCanvas, "lighting", noted(LayeredCanvas.lighting, lambda page: [page.soft, page.crisp, page.glow])
    )
    patch.setattr(LitImage, "draw", drawn)
    yield Screen(measured)
    forget()


def forget() -> None:
    """Empty every cache of the scenes."""
    surfaces.clear()
    for cached in gc.get_objects():
        if isinstance(cached, functools._lru_cache_wrapper) and cached.__module__.startswith("pigaming_app.scenes"):
            cached.cache_clear()


def marks_of(ink: Any) -> list[Mark]:
    """What an ink has noted."""
    found: list[Mark] = ink.__dict__.setdefault("marks", [])
    return found


def faults(screen: Screen, safe: pygame.Rect = SAFE) -> list[str]:
    """What touches what, crosses an outline or leaves the picture."""
    found = [f"{mark.text!r} leaves the picture" for mark in screen.texts if not safe.contains(_rect(mark))]
    for one, other in combinations(screen.texts, 2):
        if _shared(one, other) and one.text != other.text:
            found.append(f"{one.text!r} touches {other.text!r}")
    for mark in screen.texts:
        found += [f"{mark.text!r} crosses its frame" for frame in screen.frames if _crosses(mark, frame)]
    return sorted(set(found))


def _shared(one: Mark, other: Mark, apart: float = 0.0) -> bool:
    """Whether two boxes share something, or are nearer to each other than `apart` px."""
    (a, b, c, d), (e, f, g, h) = one.box, other.box
    return min(c, g) - max(a, e) > -apart and min(d, h) - max(b, f) > -apart


def _crosses(mark: Mark, frame: Mark) -> bool:
    """It is neither inside of an outline nor outside."""
    (a, b, c, d), (e, f, g, h) = mark.box, frame.box
    inside = a >= e + NEAR and c <= g - NEAR and b >= f + NEAR and d <= h - NEAR
    return not inside and _shared(mark, frame, NEAR)


def _rect(mark: Mark) -> pygame.Rect:
    left, top, right, bottom = mark.box
    return pygame.Rect(round(left), round(top), round(right - left), round(bottom - top))


def _rounded(mark: Mark) -> Mark:
    left, top, right, bottom = (float(round(value)) for value in mark.box)
    return Mark(mark.text, (left, top, right, bottom))
