"""Additions of party to the floor: slots and pallets for both teams, rush orders, the fast machine."""

from collections.abc import Iterator
from functools import partial
from typing import Any

from pigaming_app.games.factory.state import (
    DAMAGED,
    DELIVERED,
    DONE,
    HALF,
    INPUT,
    MACHINE_SLOTS,
    MACHINES,
    NOBODY,
    OUTPUT,
    RAW,
    TEAMS,
    Factory,
    FactoryRules,
)
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.factory.order_cards import URGENT
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import Batch, put

OPEN_SPEED, FAST_SPEED = 5.0, 14.0  # stages a second of two animations
NOTICE = 5 * HZ  # ticks for which the next fast machine is shown before its turn
BLINK = 9  # ticks for which the fast machine is bright, then dark, at its end: less than three blinks a second
PLATE_X, PLATE_Y = 32.0, -32.0  # px from a crate to the plate with its worth


def draw_floor(light: Batch, state: Factory, clock: float) -> None:
    """Collect the rings around pallets that may be taken, or soon may, and the outline of the fast machine."""
    turn = int(clock * OPEN_SPEED) % signs.OPEN_TURNS
    for s in range(MACHINE_SLOTS, state.slot_count):
        slot = state.slots[s]
        if not slot.pallet or slot.kind == INPUT:
            continue
        pallet = state.pallets[slot.pallet - 1]
        left = state.rules.claim - pallet.waited if slot.kind == OUTPUT else 0
        ring = signs.open_to_all(turn)
        if left > 0:
            ring = signs.claimed(pallet.team, -(-signs.CLAIM_STEPS * left // state.rules.claim))
        put(light, ring, LEFT + slot.x, TOP + slot.y)
    left = turn_left(state)
    for m, machine in enumerate(state.machines):
        x, y = LEFT + machine.x, TOP + machine.y
        if machine.fast and (left > NOTICE or left // BLINK % 2):
            put(light, signs.fast(int(clock * FAST_SPEED) % signs.FAST_STAGES), x, y)
        elif m == next_fast(state) and left <= NOTICE:
            put(light, signs.next_fast(), x, y)


def turn_left(state: Factory) -> int:
    """Ticks until another machine becomes the fast one."""
    return state.rules.fast_every - state.tick % state.rules.fast_every


def next_fast(state: Factory) -> int:
    """The machine that becomes the fast one next."""
    return state.turns[(state.tick // state.rules.fast_every + 1) % MACHINES]


def crate(pallet: Any, tenths: int) -> Any:
    """Sprite of a pallet of a team, or of one that belongs to nobody."""
    if pallet.team == NOBODY:
        return signs.loose_crate(pallet.state, tenths)
    return crates.crate(pallet.team, pallet.state, tenths)


def mark_rush(light: Batch, top: Batch, state: Factory, pallet: Any, x: float, y: float) -> None:
    """Mark a pallet at (x, y), canvas px, if it is a rush order."""
    if pallet.rush and pallet.state != DELIVERED:
        part = -(-signs.RUSH_STEPS * pallet.rush // state.rules.rush)
        urgent = part <= signs.RUSH_STEPS * URGENT // state.rules.rush + 1
        put(light, signs.rush_ring(part, urgent), x, y)
        put(top, signs.times_two(), x + PLATE_X, y + PLATE_Y)


def jobs(rules: FactoryRules) -> Iterator[Job]:
    """Prewarm jobs for these sprites."""
    yield from (signs.times_two, signs.next_fast)
    for turn in range(signs.OPEN_TURNS):
        yield partial(signs.open_to_all, turn)
    for stage in range(signs.FAST_STAGES):
        yield partial(signs.fast, stage)
    for state in (RAW, HALF, DONE, DAMAGED):
        yield from (partial(signs.loose_crate, state, tenths) for tenths in (10, 13, 12, 11))
    for part in range(1, signs.CLAIM_STEPS + 1):
        yield from (partial(signs.claimed, team, part) for team in range(TEAMS))
    for part in range(1, signs.RUSH_STEPS + 1):
        yield partial(signs.rush_ring, part, part <= signs.RUSH_STEPS * URGENT // rules.rush + 1)
