"""Robot Factory: warehouses, machines, the aisle, resting places, slots for both teams, starts, and walls."""

from collections.abc import Mapping, Sequence
from typing import ClassVar

from pigaming_app.games.drawing.values import Part
from pigaming_app.games.factory.layout import BODY, SHELF, SLOT_AT, SPOT_AT, TEAM_NAMES, WAYS, MachineSpec, SlotSpec
from pigaming_app.games.factory.state import (
    ENTRY,
    EXIT,
    FIRE,
    ICE,
    INPUT,
    MACHINE_SLOTS,
    MAX_SHARED,
    NOBODY,
    OUTPUT,
    SHELVES,
    A,
    B,
)
from pigaming_app.scenes.editor.model.shapes import (
    Dial,
    Outline,
    Paper,
    Shape,
    Tool,
    Tools,
    apart,
    inside,
    square,
    whole,
)
from pigaming_app.scenes.editor.model.symmetry import Image
from pigaming_app.scenes.editor.parts.starts import Start
from pigaming_app.scenes.editor.parts.things import MUD, DrawnThing
from pigaming_app.scenes.editor.parts.walls import SOLID_WALL, DrawnWall
from pigaming_app.scenes.views.factory.background import (
    draw_aisle,
    draw_shared_slot,
    draw_walker,
    draw_warehouse,
    draw_work_place,
)
from pigaming_app.scenes.views.sprites.teams import TEAMS as COLORS
from pigaming_app.scenes.views.things.styles import WORKSHOP
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import FOCUS, LINE, Point, cut_box

LONG = SHELF * (SHELVES - 1)  # px from the first to the last slot of a warehouse
HALF, AROUND = 54.0, 56.0  # px, half the width of a warehouse; from its outer slots to its outline
SLOT = 34.0  # px, half a slot
EDGE = 36.0  # px between slots, or people, and the rim
LEAST = 100  # px, of an aisle
BESIDE = 76.0  # px from a warehouse to the arrows that say in or out
WORDS = tuple(WAYS)


class Warehouse(Shape):
    """An entry or an exit of a team."""

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        x, y = part.point("at")
        return (cut_box(x - HALF, y - AROUND, 2 * HALF, LONG + 2 * AROUND, 16),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        x, y = part.point("at")
        team, entry = TEAM_NAMES.get(str(part.get("team")), ICE), part.get("kind") == "entry"
        slots = [SlotSpec(ENTRY if entry else EXIT, team, -1, x, y + i * SHELF) for i in range(SHELVES)]
        ink = paper.flat()
        draw_warehouse((ink, ink), slots, COLORS[team])
        inwards = 1 if x < WIDTH / 2 else -1
        way = inwards if entry else -inwards
        for i in (-1, 0, 1):
            px, py = x + inwards * BESIDE, y + LONG / 2 + 34 * i
            ink.line([(px - 8 * way, py - 11), (px + 6 * way, py), (px - 8 * way, py + 11)], COLORS[team], LINE)

    def reach(self, part: Part) -> Sequence[Point]:
        x, y = part.point("at")
        return *square(x, y, EDGE), *square(x, y + LONG, EDGE)

    def image(self, part: Part, image: Image) -> Part:
        x, y = part.point("at")
        return part.changed("at", whole(*image.point(x, y + LONG if image.down else y)))

    def same(self, part: Part, other: Part) -> bool:
        """Teams have the same warehouses."""
        return apart(part.point("at"), other.point("at")) < 2.0

    def kept(self, part: Part, other: Part) -> Part:
        return part.changed("team", other.get("team")).changed("kind", other.get("kind"))


class DrawnMachine(Shape):
    """A machine with its slots and the place of its worker."""

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        x, y = part.point("at")
        spec, slots = _spec(part), _slots(part)
        boxes = [cut_box(slot.x - SLOT, slot.y - SLOT, 2 * SLOT, 2 * SLOT, 4) for slot in slots]
        spot = cut_box(spec.spot_x - 16, spec.spot_y - 16, 32, 32, 10)
        return cut_box(x - BODY, y - BODY, 2 * BODY, 2 * BODY, 20), *boxes, spot

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        ink, spec = paper.flat(), _spec(part)
        draw_work_place((ink, ink), _slots(part), spec)
        ink.ring(spec.spot_x, spec.spot_y, 14, FOCUS, 5)

    def reach(self, part: Part) -> Sequence[Point]:
        spec = _spec(part)
        corners = [corner for slot in _slots(part) for corner in square(slot.x, slot.y, EDGE)]
        return *corners, *square(spec.spot_x, spec.spot_y, EDGE)

    def image(self, part: Part, image: Image) -> Part:
        part = super().image(part, image)
        for key in ("flow", "worker"):
            part = part.changed(key, image.way(_word(part, key)))
        return part

    def dials(self, part: Part) -> Sequence[Dial]:
        return (
            Dial("turn", lambda part: self.moved(_turned(part), 0.0, 0.0)),  # back into the arena
            Dial("worker", lambda part: self.moved(_swapped(part), 0.0, 0.0)),
        )


class DrawnWorker(Shape):
    """The resting place of a worker."""

    def reach(self, part: Part) -> Sequence[Point]:
        return square(*part.point("at"), EDGE)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        x, y = part.point("at")
        return (cut_box(x - 30, y - 50, 60, 94, 12),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        draw_walker(paper.flat(), *part.point("at"), FOCUS)


class Shared(Shape):
    """A slot for both teams."""

    fixed = False

    def reach(self, part: Part) -> Sequence[Point]:
        return square(*part.point("at"), EDGE)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        x, y = part.point("at")
        return (cut_box(x - SLOT, y - SLOT, 2 * SLOT, 2 * SLOT, 4),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        draw_shared_slot(paper.flat(), *part.point("at"))


class Aisle(Shape):
    """The area where people walk."""

    hollow = has_ends = True

    def grips(self, part: Part) -> tuple[Point, ...]:
        x, y, w, h = _box(part)
        return (x, y), (x + w, y + h)

    def outlines(self, part: Part, k: int) -> Sequence[Outline]:
        return (cut_box(*_box(part), 20),)

    def draw(self, paper: Paper, part: Part, k: int) -> None:
        ink = paper.flat()
        draw_aisle((ink, ink), _box(part), walkers=False)

    def reach(self, part: Part) -> Sequence[Point]:
        return self.grips(part)

    def moved(self, part: Part, dx: float, dy: float) -> Part:
        dx, dy = inside(self.reach(part), dx, dy)
        x, y, _, _ = _box(part)
        return part.changed("at", whole(x + dx, y + dy))

    def pulled(self, part: Part, grip: int, x: float, y: float) -> Part:
        (ax, ay), (bx, by) = self.grips(part)
        if grip:
            bx, by = max(ax + LEAST, min(x, WIDTH)), max(ay + LEAST, min(y, HEIGHT))
        else:
            ax, ay = min(bx - LEAST, max(x, 0.0)), min(by - LEAST, max(y, 0.0))
        return part.changed("at", whole(ax, ay)).changed("size", (round(bx - ax), round(by - ay)))

    def image(self, part: Part, image: Image) -> Part:
        (ax, ay), (bx, by) = (image.point(*grip) for grip in self.grips(part))
        return part.changed("at", whole(min(ax, bx), min(ay, by)))


class FactoryTools(Tools):
    """The editor of Robot Factory."""

    game = "factory"
    shapes: ClassVar[Mapping[str, Shape]] = {
        "aisle": Aisle(),
        "thing": DrawnThing(WORKSHOP),
        "warehouse": Warehouse(),
        "shared": Shared(),
        "machine": DrawnMachine(),
        "wall": DrawnWall(healthy=False),
        "worker": DrawnWorker(),
        "start": Start(),
    }
    palette = (SOLID_WALL, Tool("shared", "shared", lambda a, b: Part.of("shared", at=whole(*a)), MAX_SHARED), MUD)
    template = "hall"

    def ways(self, arena: Arena) -> list[tuple[Point, Point]]:
        """Of each team: from its entry through the nearest machines to its exit."""
        slots, ends = arena.plan.slots, list[tuple[Point, Point]]()
        places = [(slot.x, slot.y) for slot in slots]
        kinds = [machine.kind for machine in arena.plan.machines]
        for team in (ICE, FIRE):
            entry, leave = (_middle(slots, team, kind) for kind in (ENTRY, EXIT))
            first = _nearest(places, kinds, A, entry)
            second = _nearest(places, kinds, B, places[MACHINE_SLOTS + 2 * first + 1])
            a, b = MACHINE_SLOTS + 2 * first, MACHINE_SLOTS + 2 * second
            ends += [(entry, places[a]), (places[a + 1], places[b]), (places[b + 1], leave)]
        return ends


def _nearest(places: Sequence[Point], kinds: Sequence[int], kind: int, at: Point) -> int:
    """The machine of a kind whose input is nearest to a point."""
    found = [m for m, other in enumerate(kinds) if other == kind]
    return min(found, key=lambda m: apart(places[MACHINE_SLOTS + 2 * m], at))


def _middle(slots: Sequence[SlotSpec], team: int, kind: int) -> Point:
    """A point before the middle of a warehouse."""
    own = [(slot.x, slot.y) for slot in slots if slot.team == team and slot.kind == kind]
    x, y = sum(x for x, _ in own) / len(own), sum(y for _, y in own) / len(own)
    return (x + 100.0 if x < WIDTH / 2 else x - 100.0), y


def _word(part: Part, key: str) -> str:
    word = str(part.get(key))
    return word if word in WAYS else WORDS[0]


def _spec(part: Part) -> MachineSpec:
    (x, y), flow, side = part.point("at"), WAYS[_word(part, "flow")], WAYS[_word(part, "worker")]
    return MachineSpec(A if part.get("kind") == "A" else B, x, y, x + SPOT_AT * side[0], y + SPOT_AT * side[1], flow)


def _slots(part: Part) -> list[SlotSpec]:
    spec = _spec(part)
    ends = ((INPUT, -SLOT_AT), (OUTPUT, SLOT_AT))
    return [SlotSpec(kind, NOBODY, 0, spec.x + by * spec.flow[0], spec.y + by * spec.flow[1]) for kind, by in ends]


def _turned(part: Part) -> Part:
    """Turned clockwise by a quarter."""
    for key in ("flow", "worker"):
        x, y = WAYS[_word(part, key)]
        part = part.changed(key, next(word for word, way in WAYS.items() if way == (-y, x)))
    return part


def _swapped(part: Part) -> Part:
    """With its worker on the other side."""
    x, y = WAYS[_word(part, "worker")]
    return part.changed("worker", next(word for word, way in WAYS.items() if way == (-x, -y)))


def _box(part: Part) -> tuple[float, float, float, float]:
    x, y = part.point("at")
    match part.get("size"):
        case (int() | float() as w, int() | float() as h) if 0 < w <= WIDTH and 0 < h <= HEIGHT:
            return x, y, float(w), float(h)
    return x, y, float(LEAST), float(LEAST)


TOOLS = FactoryTools()
