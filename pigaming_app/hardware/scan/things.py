"""The things on a mat as games get them, and their file: convex outlines in arena px with kind and height.

The file is kept beside the calibration. It also holds the projector's place, so that a later scan needs no robots.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Annotated

import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from pigaming_app.sim.things import convex
from pigaming_app.sim.things.convex import contains, is_convex, signed_area
from pigaming_app.sim.things.spec import CORNERS, MAX_MARGIN, MOST, ThingSpec, Use
from pigaming_app.storage import schema
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.storage.parsing import ParseError, parse_toml, quote
from pigaming_app.storage.schema import between

VERSION = 1

Place = Annotated[float, between(-1000.0, 3000.0)]
Foot = Annotated[float, between(-1e5, 1e5)]
Outline = NDArray[np.float64]  # (n, 2) arena px, convex, clockwise on screen


class ThingKind(StrEnum):
    """`tall`: it stops robots and bullets; `flat`: tape or paper, which robots drive over."""

    TALL = "tall"
    FLAT = "flat"


@dataclass(frozen=True)
class Thing:
    """A thing on the mat. `outline`: its footprint; `margin_px`: by how far it may extend beyond the outline.

    `mud`: a flat one slows robots down, by the operator's choice; else it is only a line.
    """

    kind: ThingKind
    outline: Annotated[tuple[tuple[Place, Place], ...], Meta(min_length=3, max_length=CORNERS)]  # arena px
    height_mm: Annotated[float, between(0.0, 1000.0)]
    margin_px: Annotated[float, between(0.0, 100.0)]
    mud: bool = False

    @property
    def use(self) -> Use:
        """What it is in a game: everything tall is a wall."""
        if self.kind is ThingKind.TALL:
            return Use.WALL
        return Use.MUD if self.mud else Use.LINE

    def as_mud(self, mud: bool) -> "Thing":
        """A flat thing as mud, or as a line."""
        return replace(self, mud=mud and self.kind is ThingKind.FLAT)

    @property
    def spec(self) -> ThingSpec:
        """The thing as arenas have it."""
        return ThingSpec(self.use, hull(self.outline), min(self.margin_px, MAX_MARGIN))

    @property
    def points(self) -> Outline:
        """The outline as an array, (n, 2) arena px."""
        return np.array(self.outline)

    @property
    def middle(self) -> tuple[float, float]:
        """Mean of the corners, arena px."""
        x, y = self.points.mean(axis=0).tolist()
        return x, y

    def grown(self, px: float) -> Outline:
        """The outline with every side moved outwards, (n, 2) arena px."""
        return moved_outwards(self.points, px)

    def contains(self, x: float, y: float) -> bool:
        """True for a point on the thing, as for a mouse that points at it; arena px."""
        return contains(hull(self.outline), x, y)


@dataclass(frozen=True)
class ProjectorPlace:
    """The projector is `height` mm above the mat, over the point `foot` (arena px)."""

    foot: tuple[Foot, Foot]
    height: Annotated[float, between(200.0, 20_000.0)]  # mm


@dataclass(frozen=True)
class ThingLayout:
    """Everything found on a mat. `without` removes one thing; all else is kept."""

    things: Annotated[tuple[Thing, ...], Meta(max_length=MOST)] = ()
    projector: ProjectorPlace | None = None

    def without(self, thing: Thing) -> "ThingLayout":
        """The layout with one thing removed, as the player does by hand."""
        return ThingLayout(tuple(other for other in self.things if other is not thing), self.projector)

    def replaced(self, thing: Thing, new: Thing) -> "ThingLayout":
        """The layout with another thing in the place of one."""
        return ThingLayout(tuple(new if other is thing else other for other in self.things), self.projector)


class LayoutError(OperatorError):
    """A file of things that cannot be used."""


def moved_outwards(corners: Outline, by: float) -> Outline:
    """A convex outline with every side moved outwards by a distance (inwards if negative), (n, 2); corners stay sharp.

    Sides meet where their lines cross, but no corner moves further than twice the distance.
    """
    ways = np.roll(corners, -1, axis=0) - corners
    length = np.maximum(np.hypot(ways[:, 0], ways[:, 1]), 1e-9)
    normals = np.column_stack([ways[:, 1], -ways[:, 0]]) / length[:, None]
    area = float((corners[:, 0] * np.roll(corners[:, 1], -1) - np.roll(corners[:, 0], -1) * corners[:, 1]).sum())
    normals *= 1.0 if area > 0.0 else -1.0
    before = np.roll(normals, 1, axis=0)
    bisector = normals + before
    share = np.maximum((bisector * bisector).sum(axis=1), 1.0)[:, None]
    return np.asarray(corners + 2.0 * by * bisector / share)


def to_toml(layout: ThingLayout) -> str:
    """Serialize a layout, rounded to a hundredth of a px and a tenth of a mm."""
    things = tuple(
        replace(
            thing,
            outline=tuple((round(x, 2), round(y, 2)) for x, y in thing.outline),
            height_mm=round(thing.height_mm, 1),
            margin_px=round(thing.margin_px, 2),
        )
        for thing in layout.things
    )
    return schema.to_toml({"version": VERSION, **schema.to_plain(replace(layout, things=things))})


def read(text: str) -> ThingLayout:
    """Parse a layout. Raises LayoutError."""
    try:
        entries = parse_toml(text)
        if entries.get("version") != VERSION:
            raise LayoutError(OperatorMessage("version_things", theirs=quote(entries.get("version")), ours=VERSION))
        layout = schema.typed(entries, ThingLayout)
    except ParseError as error:
        raise LayoutError(OperatorMessage("damaged_things", detail=error)) from error
    if any(not (is_convex(thing.outline) or is_convex(thing.outline[::-1])) for thing in layout.things):
        raise LayoutError(OperatorMessage("damaged_things", detail="not convex"))
    return layout


def largest(things: Sequence[Thing]) -> tuple[Thing, ...]:
    """The MOST largest things, the tall ones first."""
    return tuple(
        sorted(things, key=lambda thing: (thing.kind != ThingKind.TALL, -abs(signed_area(thing.outline))))[:MOST]
    )


def hull(points: Iterable[convex.Point]) -> convex.Outline:
    """The corners of the convex hull, clockwise on screen; none on a straight side.

    Rounded to 0.1 px, as an arena file holds them. Monotone chain (A. M. Andrew, Inf. Proc. Letters 9, 1979).
    """
    corners = sorted({(round(x, 1), round(y, 1)) for x, y in points})
    return (*_half(corners)[:-1], *_half(corners[::-1])[:-1])


def _half(corners: list[convex.Point]) -> list[convex.Point]:
    """The part of the hull from the first corner to the last one."""
    kept: list[convex.Point] = []
    for x, y in corners:
        while len(kept) > 1 and _turn(kept[-2], kept[-1], (x, y)) <= 0.0:
            kept.pop()
        kept.append((x, y))
    return kept


def _turn(a: convex.Point, b: convex.Point, c: convex.Point) -> float:
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
