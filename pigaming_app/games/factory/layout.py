"""Robot Factory: parsing of floors. Besides the title and four [[start]] (1st and 3rd ICE, 2nd and 4th FIRE) a file has

[aisle]                  # where people walk and rest
at = [650, 50]           # its upper left corner, px
size = [300, 800]

[[warehouse]]            # four: an entry and an exit for each team
team = "ice"             # or "fire"
kind = "entry"           # or "exit"
at = [66, 96]            # its first slot; three more lie below, 88 px apart

[[machine]]              # four, two of each kind; its body is a square of 132 px
kind = "A"               # or "B"
at = [520, 216]
flow = "down"            # up, down, left or right: from its input slot to its output slot
worker = "right"         # the side on which its worker stands, perpendicular to the flow

[[worker]]               # three: their resting places
at = [800, 450]

[[shared]]               # up to four: slots on the floor for both teams, in the variant party
at = [740, 130]

and [[wall]] as in `sim.arena`; all walls are solid.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import sqrt

from pigaming_app.games.drawing.gaps import narrow_gaps
from pigaming_app.games.factory.state import (
    ENTRY,
    EXIT,
    FIRE,
    HOLD,
    ICE,
    INPUT,
    MACHINES,
    MAX_SHARED,
    NOBODY,
    OUTPUT,
    REACH,
    SHARED,
    SHARED_SLOTS,
    SHELVES,
    TEAMS,
    WORKERS,
    A,
    B,
)
from pigaming_app.games.starts import clear_starts, free_place
from pigaming_app.sim.arena import Layout, WallSpec, raise_first, read_radius, read_starts, read_walls, start_faults
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.flow_field import Route, expand, free_node
from pigaming_app.sim.things.cover import from_capsule
from pigaming_app.sim.things.spec import read_things, wall_capsules
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import CELL, COLUMNS, HEIGHT, NODES, SOLID, WALLS, WIDTH

WAYS = {"right": (1, 0), "left": (-1, 0), "down": (0, 1), "up": (0, -1)}
TEAM_NAMES = {"ice": ICE, "fire": FIRE}
KINDS = {"entry": ENTRY, "exit": EXIT}
BODY = 66.0  # px from a machine's centre to its sides
ROUND = 36.0  # px, radius of a body's corners
SLOT_AT, SPOT_AT = 126.0, 114.0  # px from a machine's centre to its slots, and to its worker
PALLET = 30.0  # px, half a pallet
SHELF = 88.0  # px between slots of a warehouse


@dataclass(frozen=True)
class SlotSpec:
    """A slot, of a team (`machine` is -1), of a machine (`team` is NOBODY), or shared (both are); px."""

    kind: int
    team: int
    machine: int
    x: float
    y: float


@dataclass(frozen=True)
class MachineSpec:
    """A machine and the position of its worker, px; `flow`: unit vector from input to output."""

    kind: int
    x: float
    y: float
    spot_x: float
    spot_y: float
    flow: tuple[int, int]


@dataclass(frozen=True)
class Floor:
    """The parts of a floor besides walls and starts. `slots` in the order of `Factory.slots`, at least SHARED_SLOTS."""

    slots: tuple[SlotSpec, ...]
    machines: tuple[MachineSpec, ...]
    homes: tuple[tuple[float, float], ...]
    aisle: tuple[float, float, float, float]
    walls: tuple[WallSpec, ...] = ()

    @property
    def swapped(self) -> "Floor":
        """The same floor with the warehouses of either team in the places of the other's."""
        own = SHELVES * len(KINDS)
        places = (*self.slots[own : TEAMS * own], *self.slots[:own])
        moved = (replace(slot, x=place.x, y=place.y) for slot, place in zip(self.slots, places, strict=False))
        return replace(self, slots=(*moved, *self.slots[TEAMS * own :]))


def read(table: TomlTable) -> Layout:
    """Parse a floor: warehouses, machines, aisle and workers. Raises FieldError."""
    layout, floor = _parsed(table)
    raise_first(_reach_faults(layout, floor))
    return layout


def faults(table: TomlTable) -> Iterator[FieldError]:
    """All that makes a floor unplayable."""
    try:
        layout, floor = _parsed(table)
        yield from start_faults(layout)
        yield from _reach_faults(layout, floor)
        bodies = [f"machine[{m + 1}]" for m in range(MACHINES) for _ in range(2)]
        walls = [f"wall[{i + 1}]" for i in range(len(layout.walls) - len(bodies))]
        yield from narrow_gaps(layout.walls, layout.radius, [*bodies, *walls])
    except FieldError as fault:
        yield fault


def _parsed(table: TomlTable) -> tuple[Layout, Floor]:
    """A floor on which some places may be out of reach. Raises FieldError."""
    table.only("title", "start", "aisle", "warehouse", "machine", "worker", "shared", "wall", "thing", "robots")
    starts = read_starts(table)
    machines = tuple(_machine(entry) for entry in table.tables("machine"))
    if sorted(machine.kind for machine in machines) != [A, A, B, B]:
        raise table.error("machine", "two machines of kind A and two of kind B are needed")
    homes = tuple(_home(entry) for entry in table.tables("worker"))
    if len(homes) != WORKERS:
        raise table.error("worker", f"{len(homes)} workers, but there must be {WORKERS}")
    slots = (*_shelves(table), *_machine_slots(machines), *_shared_slots(table))
    bodies = tuple(wall for machine in machines for wall in _body(machine))
    walls = tuple(replace(wall, health=SOLID) for wall in read_walls(table))
    layout = Layout((*bodies, *walls), starts, things=read_things(table), radius=read_radius(table))
    if layout.things:
        layout = replace(layout, starts=clear_starts(layout))
        machines, homes = _beside_things(layout, machines, homes)
        _check_slots(layout, slots)
    floor = Floor(slots, machines, homes, _aisle(table.table("aisle")), walls)
    return replace(layout, plan=floor), floor


def _machine(entry: TomlTable) -> MachineSpec:
    entry.only("kind", "at", "flow", "worker")
    kind = A if entry.word("kind", ("A", "B")) == "A" else B
    x, y = entry.point("at")
    if not (BODY <= x <= WIDTH - BODY and BODY <= y <= HEIGHT - BODY):
        raise entry.error("at", "its body would stand outside the arena")
    flow, side = WAYS[entry.word("flow", tuple(WAYS))], WAYS[entry.word("worker", tuple(WAYS))]
    if flow[0] * side[0] + flow[1] * side[1]:
        raise entry.error("worker", "must be a side across the flow")
    return MachineSpec(kind, x, y, x + SPOT_AT * side[0], y + SPOT_AT * side[1], flow)


def _home(entry: TomlTable) -> tuple[float, float]:
    entry.only("at")
    return entry.point("at")


def _aisle(entry: TomlTable) -> tuple[float, float, float, float]:
    entry.only("at", "size")
    x, y = entry.point("at")
    w, h = entry.numbers("size", 2, 50.0, WIDTH)
    if x + w > WIDTH or y + h > HEIGHT:
        raise entry.error("size", "the aisle ends outside the arena")
    return x, y, w, h


def _shelves(table: TomlTable) -> tuple[SlotSpec, ...]:
    """The slots of all warehouses, in the order of `Factory.slots`. Raises FieldError."""
    first_slots: dict[tuple[int, int], tuple[float, float]] = {}
    for entry in table.tables("warehouse"):
        entry.only("team", "kind", "at")
        key = TEAM_NAMES[entry.word("team", tuple(TEAM_NAMES))], KINDS[entry.word("kind", tuple(KINDS))]
        if key in first_slots:
            raise entry.error("kind", "this team has one already")
        x, y = entry.point("at")
        if y + (SHELVES - 1) * SHELF > HEIGHT - 36:
            raise entry.error("at", "its last slot would lie outside the arena")
        first_slots[key] = x, y
    if len(first_slots) != TEAMS * len(KINDS):
        raise table.error("warehouse", "each team needs an entry and an exit")
    return tuple(
        SlotSpec(kind, team, -1, first_slots[team, kind][0], first_slots[team, kind][1] + i * SHELF)
        for team in range(TEAMS)
        for kind in (ENTRY, EXIT)
        for i in range(SHELVES)
    )


def _machine_slots(machines: tuple[MachineSpec, ...]) -> tuple[SlotSpec, ...]:
    return tuple(
        SlotSpec(kind, NOBODY, m, machine.x + offset * machine.flow[0], machine.y + offset * machine.flow[1])
        for m, machine in enumerate(machines)
        for kind, offset in ((INPUT, -SLOT_AT), (OUTPUT, SLOT_AT))
    )


def _shared_slots(table: TomlTable) -> tuple[SlotSpec, ...]:
    """The shared slots of a floor, if any. Raises FieldError."""
    entries = table.tables("shared")
    if len(entries) > MAX_SHARED:
        raise table.error("shared", f"{len(entries)} shared slots, but there may be {MAX_SHARED}")
    return tuple(SlotSpec(SHARED, NOBODY, -1, *_home(entry)) for entry in entries)


def _body(machine: MachineSpec) -> tuple[WallSpec, WallSpec]:
    """Two thick walls that together fill the square of the body."""
    inner = BODY - ROUND
    left, right = machine.x - inner, machine.x + inner
    upper, lower = (WallSpec(left, machine.y + dy, right, machine.y + dy, ROUND, SOLID) for dy in (-inner, inner))
    return upper, lower


def _beside_things(
    layout: Layout, machines: tuple[MachineSpec, ...], homes: tuple[tuple[float, float], ...]
) -> tuple[tuple[MachineSpec, ...], tuple[tuple[float, float], ...]]:
    """Machines whose workers stand on the free side, and resting places, both clear of things. Raises FieldError."""
    world = layout.built()
    sides = []
    for spec in machines:
        other = replace(spec, spot_x=2 * spec.x - spec.spot_x, spot_y=2 * spec.y - spec.spot_y)
        open_ones = [one for one in (spec, other) if not in_wall(world, one.spot_x, one.spot_y)]
        sides.append((open_ones or [spec])[0])
    return tuple(sides), tuple(home if not in_wall(world, *home) else free_place(world, *home) for home in homes)


def _check_slots(layout: Layout, slots: tuple[SlotSpec, ...]) -> None:
    """Raises FieldError if a thing covers a slot."""
    for one in wall_capsules(layout.things, WALLS - len(layout.walls)):
        for slot in slots:
            if from_capsule(one, slot.x, slot.y) < PALLET:
                raise FieldError("thing", f"one covers the slot at ({slot.x:g}, {slot.y:g})")


def _reach_faults(layout: Layout, floor: Floor) -> Iterator[FieldError]:
    """Slots that no robot can reach or that overlap, and machines and resting places that no person can get to."""
    world = layout.built()
    field = Route()
    expand(world, field, free_node(world, layout.starts[0].x, layout.starts[0].y), -1)
    fork = layout.radius + HOLD
    free = [(node % COLUMNS * CELL, node // COLUMNS * CELL) for node in range(NODES) if field.reach[node]]
    for k, slot in enumerate(floor.slots):
        at = slot.x, slot.y, PALLET
        if not any(fork - REACH < sqrt((x - slot.x) ** 2 + (y - slot.y) ** 2) < fork + REACH for x, y in free):
            yield FieldError(_name(k, slot), f"no robot can reach its slot at ({slot.x:g}, {slot.y:g})", at)
        for other in floor.slots[:k]:
            if abs(slot.x - other.x) < 68 and abs(slot.y - other.y) < 68:
                yield FieldError(_name(k, slot), f"its slot at ({slot.x:g}, {slot.y:g}) lies over another", at)
        for m, machine in enumerate(floor.machines):
            if slot.machine != m and abs(slot.x - machine.x) < BODY + 34 and abs(slot.y - machine.y) < BODY + 34:
                yield FieldError(_name(k, slot), f"its slot at ({slot.x:g}, {slot.y:g}) lies in machine[{m + 1}]", at)
    places = [(f"machine[{m + 1}].worker", spec.spot_x, spec.spot_y) for m, spec in enumerate(floor.machines)]
    places += [(f"worker[{i + 1}].at", x, y) for i, (x, y) in enumerate(floor.homes)]
    for key, x, y in places:
        if in_wall(world, x, y) or not field.reach[free_node(world, x, y)]:
            yield FieldError(key, f"no person can get to ({x:g}, {y:g})", (x, y, PALLET))


def _name(k: int, slot: SlotSpec) -> str:
    if slot.kind == SHARED:
        return f"shared[{k - SHARED_SLOTS + 1}]"
    return f"machine[{slot.machine + 1}]" if slot.machine >= 0 else f"warehouse[{k // SHELVES + 1}]"
