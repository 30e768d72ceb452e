"""What is in hand: a part that is being drawn, moved, or dragged at one of its grips."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from pigaming_app.games.drawing.values import Drawing
from pigaming_app.scenes.editor.model.edits import Changed, placed, replaced
from pigaming_app.scenes.editor.model.shapes import Item, Tool, Tools, apart
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.scenes.editor.pointer import Pointer
from pigaming_app.ui.draw import Point
from pigaming_app.ui.input.events import InputEvent

NEAR = 20.0  # px of the arena, from a grip
TOUCH = 12.0  # px from a part that is still pointed at


@dataclass
class Hand:
    """Begun by `event` at the point `start` of the drawing `base`, with a tool, or with a grip of an item.

    `loose`: it stays in hand although the button was released, until the next press.
    """

    event: InputEvent
    base: Drawing
    start: Point
    tool: Tool | None = None
    item: Item | None = None
    grip: int | None = None  # None: the whole part
    loose: bool = False
    moved: bool = False
    drawing: Drawing = field(init=False)
    items: Sequence[Item] = ()

    def __post_init__(self) -> None:
        self.drawing = self.base

    def follow(self, tools: Tools, pointer: Pointer, symmetry: Symmetry) -> None:
        """Move to the pointer."""
        at = pointer.x, pointer.y
        self.moved = self.moved or apart(at, self.start) > TOUCH
        if self.tool:
            changed = placed(tools, self.base, self.tool, pointer.snapped(*self.start), pointer.snapped(*at), symmetry)
        elif self.item and self.moved:
            changed = self._dragged(tools, self.item, pointer, symmetry)
        else:
            changed = self.base, [self.item] if self.item else []
        self.drawing, self.items = changed

    def _dragged(self, tools: Tools, item: Item, pointer: Pointer, symmetry: Symmetry) -> Changed:
        shape, part = tools.shapes[item.kind], tools.part(self.base, item)
        if self.grip is not None:
            after = shape.pulled(part, self.grip, *pointer.snapped(pointer.x, pointer.y))
        else:
            x, y = shape.grips(part)[0]
            to_x, to_y = pointer.snapped(x + pointer.x - self.start[0], y + pointer.y - self.start[1])
            after = shape.moved(part, to_x - x, to_y - y)
        return replaced(tools, self.base, item, after, symmetry)


def grip_at(tools: Tools, drawing: Drawing, item: Item | None, at: Point) -> int | None:
    """The grip of the selected part that is pointed at; the first one is the part itself if there are others."""
    if item is None:
        return None
    grips = tools.shapes[item.kind].grips(tools.part(drawing, item))
    near = [(apart(grip, at), i) for i, grip in enumerate(grips)]
    distance, i = min(near)
    return i if distance <= NEAR else None


def item_at(tools: Tools, drawing: Drawing, at: Point) -> Item | None:
    """The uppermost part that is pointed at."""
    for item in reversed(tools.items(drawing)):
        part = tools.part(drawing, item)
        shape = tools.shapes[item.kind]
        if any(touched(outline, at, shape.hollow) for outline in shape.outlines(part, item.k)):
            return item
    return None


def touched(outline: Sequence[Point], at: Point, hollow: bool = False) -> bool:
    """True for a point near to a closed outline, or in it, unless it is hollow."""
    x, y = at
    inside = False
    for (ax, ay), (bx, by) in zip(outline, (*outline[1:], outline[0]), strict=True):
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            inside = not inside
        ex, ey = bx - ax, by - ay
        length2 = ex * ex + ey * ey
        share = min(1.0, max(0.0, ((x - ax) * ex + (y - ay) * ey) / length2)) if length2 else 0.0
        if apart((ax + share * ex, ay + share * ey), at) <= TOUCH:
            return True
    return inside and not hollow
