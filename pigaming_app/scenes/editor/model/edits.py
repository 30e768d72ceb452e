"""Changes of a drawing, each made to the images of a part as well."""

from collections.abc import Iterator

from pigaming_app.games.drawing.values import Drawing, Part
from pigaming_app.scenes.editor.model.shapes import Item, Tool, Tools
from pigaming_app.scenes.editor.model.symmetry import Image, Symmetry
from pigaming_app.ui.draw import Point

Changed = tuple[Drawing, list[Item]]  # a drawing, and the parts that were changed, the one meant first


def placed(tools: Tools, drawing: Drawing, tool: Tool, a: Point, b: Point, symmetry: Symmetry) -> Changed:
    """With another part, drawn from a to b, as far as there is room for more of them."""
    return with_copies(tools, drawing, tool.part(a, b).in_whole_px(), tool.most, symmetry)


def with_copies(tools: Tools, drawing: Drawing, part: Part, most: int, symmetry: Symmetry) -> Changed:
    """With a new part and its images."""
    shape, out, parts = tools.shapes[part.kind], drawing, list[Part]()
    for one in (part, *(shape.image(part, image) for image in symmetry.images)):
        if len(out.of(part.kind)) < most and not any(shape.same(one, other) for other in parts):
            out, item = tools.added(out, one)
            parts.append(tools.part(out, item))
    places = [out.of(part.kind).index(one) for one in parts]  # a later one may lie before an earlier one
    return tools.settled(drawing, out), [Item(part.kind, k) for k in places]


def replaced(tools: Tools, drawing: Drawing, item: Item, part: Part, symmetry: Symmetry) -> Changed:
    """With another part in place of one, and its images in place of the images of that one."""
    shape, items, out = tools.shapes[item.kind], [item], tools.with_part(drawing, item, part)
    for image, other in images(tools, drawing, item, symmetry):
        if other not in items:
            before = tools.part(drawing, other)
            out = tools.with_part(out, other, shape.kept(shape.image(part, image), before))
            items.append(other)
    return tools.settled(drawing, out), items


def removed(tools: Tools, drawing: Drawing, item: Item, symmetry: Symmetry) -> Drawing | None:
    """Without a part and its images; None if it is needed."""
    gone = {item, *(other for _, other in images(tools, drawing, item, symmetry))}
    out = drawing
    for one in sorted(gone, key=lambda one: -one.k):
        if not tools.removable(out, one):
            return None
        out = tools.without(out, one)
    return tools.settled(drawing, out)


def images(tools: Tools, drawing: Drawing, item: Item, symmetry: Symmetry) -> Iterator[tuple[Image, Item]]:
    """The images of a part that are in the drawing."""
    shape, part = tools.shapes[item.kind], tools.part(drawing, item)
    others = [other for other in tools.items(drawing) if other.kind == item.kind and other != item]
    for image in symmetry.images:
        looked = shape.image(part, image)
        found = (other for other in others if shape.same(looked, tools.part(drawing, other)))
        if (other := next(found, None)) is not None:
            yield image, other


def changed_items(tools: Tools, before: Drawing, after: Drawing) -> list[Item]:
    """The parts of a drawing that were not, or not there, in the one before."""
    if before == after:
        return []
    old = {tools.part(before, item) for item in tools.items(before)}
    return [item for item in tools.items(after) if tools.part(after, item) not in old]
