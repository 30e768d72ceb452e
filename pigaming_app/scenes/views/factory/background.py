"""Background of Robot Factory: warehouses in team colours, machines, the aisle; rendered once per floor."""

import math
from collections.abc import Iterator, Sequence

import pygame

from pigaming_app.games.factory.layout import BODY, Floor, MachineSpec, SlotSpec
from pigaming_app.games.factory.state import DONE, ENTRY, HALF, INPUT, MACHINE_SLOTS, RAW, SHARED_SLOTS, SHELVES, A
from pigaming_app.games.factory.state import ICE as FIRST_TEAM
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.sprites.factory import STATES, state_icon
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.surface_cache import cached

SLOT = 68  # px
MARGIN_X = 84  # px from the arena's edge to the signs outside it
WALKWAY = (124, 104, 30)
Inks = tuple[kit.GlowCanvas, kit.GlowCanvas]  # glowing and crisp canvas


@cached
@resumable
def bare(floor: Floor, allies: bool = False, party: bool = False) -> Steps[pygame.Surface]:
    """Static canvas of a floor; the warehouses of `allies` all belong to one team, a `party` has shared slots."""
    page = kit.LayeredCanvas()
    for ink in (page.glow, page.crisp):
        ink.set_transform(LEFT, TOP)
    for x in range(50, int(WIDTH), 50):
        for y in range(50, int(HEIGHT), 50):
            page.crisp.disc(x, y, 1.6, (26, 37, 54))
    yield
    yield from draw_floor((page.glow, page.crisp), floor, colors_of(allies), party)
    for slots in warehouses(floor):
        draw_storage((page.glow, page.crisp), slots, colors_of(allies)[slots[0].team])
    page.glow.line(kit.cut_box(-3, -3, WIDTH + 6, HEIGHT + 6, 28), kit.WALL, kit.THIN, True)
    yield
    return (yield from page.render_steps())


def colors_of(allies: bool) -> Sequence[kit.Color]:
    """Colours of the warehouses, by team; those of allies all belong to the first one."""
    return TEAMS[:1] * 2 if allies else TEAMS


def warehouses(floor: Floor) -> Iterator[tuple[SlotSpec, ...]]:
    """The slots of each warehouse."""
    for first in range(0, MACHINE_SLOTS, SHELVES):
        yield floor.slots[first : first + SHELVES]


def draw_floor(canvases: Inks, floor: Floor, colors: Sequence[kit.Color], party: bool = False) -> Steps[None]:
    """Draw aisle, warehouses, machines and shared slots in arena px. `colors`: of the warehouses, by team."""
    draw_aisle(canvases, floor.aisle, walkers=not party)
    for slot in floor.slots[SHARED_SLOTS:] if party else ():
        draw_shared_slot(canvases[1], slot.x, slot.y)
    yield
    for slots in warehouses(floor):
        draw_warehouse(canvases, slots, colors[slots[0].team])
        yield
    for wall in floor.walls:
        ends = [(wall.ax, wall.ay), (wall.bx, wall.by)]
        canvases[0].line(ends, kit.WALL, 2 * wall.half).line(ends, kit.dim(kit.WALL, 0.8), 2 * wall.half - 4)
    for m, machine in enumerate(floor.machines):
        draw_work_place(canvases, floor.slots[MACHINE_SLOTS + 2 * m :][:2], machine)
        yield


def draw_aisle(canvases: Inks, aisle: tuple[float, float, float, float], walkers: bool) -> None:
    """Draw the area where people walk."""
    x, y, w, h = aisle
    _, crisp = canvases
    crisp.dashes(kit.cut_box(x, y, w, h, 20), kit.dim(WALKWAY, 0.9), 5, 24, 18)
    tall = h > w
    for share in (0.18, 0.82) if walkers else ():  # shared slots may lie there
        px, py = (x + w / 2, y + h * share) if tall else (x + w * share, y + h / 2)
        draw_walker(crisp, px, py, kit.dim(WALKWAY, 0.8))


def draw_walker(ink: kit.GlowCanvas, x: float, y: float, color: kit.Color) -> None:
    """Draw a person, 84 px high."""
    ink.disc(x + 3, y - 38, 9, color)
    limbs = ([(0, -22), (-2, 4)], [(-2, 4), (14, 18), (16, 38)], [(-2, 4), (-8, 22), (-20, 36)])
    for limb in (*limbs, [(0, -20), (16, -8), (26, -4)], [(0, -20), (-14, -8), (-16, 6)]):
        ink.line([(x + u, y + v) for u, v in limb], color, 8)


def draw_warehouse(canvases: Inks, slots: Sequence[SlotSpec], color: kit.Color) -> None:
    """Draw a warehouse around its slots."""
    glow, crisp = canvases
    x = slots[0].x
    top, bottom = slots[0].y, slots[-1].y
    box = kit.cut_box(x - 54, top - 56, 108, bottom - top + 112, 16)
    glow.fill(box, kit.dim(color, 0.05)).neon(box, color, kit.LINE, True)
    for slot in slots:
        draw_slot(crisp, slot.x, slot.y, kit.dim(color, 0.6))


def draw_slot(ink: kit.GlowCanvas, x: float, y: float, color: kit.Color) -> None:
    """Draw the four corners of a pallet slot."""
    h, k = SLOT / 2, 18
    for sx in (-1, 1):
        for sy in (-1, 1):
            ink.line(
                [(x + sx * h, y + sy * (h - k)), (x + sx * h, y + sy * h), (x + sx * (h - k), y + sy * h)],
                color,
                kit.THIN,
            )


def draw_shared_slot(ink: kit.GlowCanvas, x: float, y: float) -> None:
    """Draw the corners of a slot for both teams."""
    for sx, color in ((-1, TEAMS[FIRST_TEAM]), (1, TEAMS[1 - FIRST_TEAM])):
        for sy in (-1, 1):
            h, k = sx * SLOT / 2, sx * 20
            ink.line([(x + h, y + sy * (34 - 20)), (x + h, y + sy * 34), (x + h - k, y + sy * 34)], color, kit.THIN)


def draw_machine(canvases: Inks, kind: int, x: float, y: float) -> None:
    """Draw the body of a machine, without its slots."""
    glow, crisp = canvases
    body = kit.cut_box(x - BODY, y - BODY, 2 * BODY, 2 * BODY, 20)
    glow.fill(body, (10, 14, 22)).neon(body, kit.dim(kit.WALL, 0.55), kit.LINE, True)
    glow.ring(x, y, 44, kit.dim(kit.STEEL, 0.38), 10)
    crisp.text("A" if kind == A else "B", 62, x, y, kit.ICE, "hero", "c")


def draw_work_place(canvases: Inks, slots: Sequence[SlotSpec], machine: MachineSpec) -> None:
    """Draw a machine with its two slots."""
    _, crisp = canvases
    kind, x, y = machine.kind, machine.x, machine.y
    draw_machine(canvases, kind, x, y)
    takes, gives = (RAW, HALF) if kind == A else (HALF, DONE)
    for slot in slots:
        into = slot.kind == INPUT
        draw_slot(crisp, slot.x, slot.y, kit.WALL)
        state_icon(crisp, takes if into else gives, slot.x, slot.y, 13, kit.dim(STATES[takes if into else gives], 0.55))
        a = math.atan2(y - slot.y, x - slot.x)
        cx, cy = slot.x + 47 * math.cos(a), slot.y + 47 * math.sin(a)
        a += 0.0 if into else math.pi
        c, s = math.cos(a), math.sin(a)
        crisp.fill([(cx + u * c - v * s, cy + u * s + v * c) for u, v in ((8, 0), (-6, 13), (-6, -13))], kit.WALL)


def draw_storage(canvases: Inks, slots: tuple[SlotSpec, ...], color: kit.Color) -> None:
    """Draw a shelf or lorry beside a warehouse, outside the arena, with the direction of the pallets."""
    glow, _ = canvases
    entry = slots[0].kind == ENTRY
    left = slots[0].x < WIDTH / 2
    x, y = -MARGIN_X if left else WIDTH + MARGIN_X, (slots[0].y + slots[-1].y) / 2
    if entry:
        _shelf(glow, x, y - 20, color)
    else:
        draw_lorry(glow, x, y - 20, color, -1 if left else 1)
    way = (1 if left else -1) * (1 if entry else -1)
    for k in (-1, 0, 1):
        tip = [(x + way * (k * 20 - 6), y + 52), (x + way * (k * 20 + 8), y + 66), (x + way * (k * 20 - 6), y + 80)]
        glow.line(tip, kit.dim(color, 0.5 + 0.25 * (k + 1)), kit.LINE)


def _shelf(ink: kit.GlowCanvas, x: float, y: float, color: kit.Color) -> None:
    for side in (-42, 42):
        ink.line([(x + side, y - 36), (x + side, y + 36)], color, 5)
    for down in (0, 36):
        ink.line([(x - 42, y + down), (x + 42, y + down)], color, 5)
    for u, v in ((-20, -15), (18, -15), (0, 21)):
        ink.disc(x + u, y + v, 11, STATES[RAW])


def draw_lorry(ink: kit.GlowCanvas, x: float, y: float, color: kit.Color, way: int) -> None:
    """Draw a lorry heading left (`way` -1) or right (1)."""
    box = [(-46, -30), (12, -30), (12, 16), (-46, 16)]
    cab = [(12, -14), (30, -14), (42, 2), (42, 16), (12, 16)]
    for part in (box, cab):
        ink.line([(x + way * u, y + v) for u, v in part], color, 5, True)
    ink.fill(kit.star_points(13, x - way * 17, y - 8), color)
    for k in (-24, 24):
        ink.disc(x + k, y + 20, 13, kit.BLACK).ring(x + k, y + 20, 8, color, 5)
