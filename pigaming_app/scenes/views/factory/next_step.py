"""Next-step guide: a dashed arrow for people, small corners around the targets of AIs.

An AI in a team with a person also shows a thin dotted line and a sign: an arrow up where it will lift a pallet, down
where it will set one down.
"""

import math

from pigaming_app.games.factory.rules import may_lift, may_set_down
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, INPUT, NOBODY, OUTPUT, Factory
from pigaming_app.games.factory.workers import fits
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.scenes.views.view import Pose
from pigaming_app.sim.world import WIDTH
from pigaming_app.ui.draw import PLAYERS, dim
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step

EVERY = 10  # ticks between two updates
PITCH, SPEED = 34.0, 50.0  # px between dashes, px/s of their motion
AIMS = 0.8  # brightness of a driver's colour for a target
DOTS = 24.0  # px between the dots of a mate's line
SIGN = 66.0  # px from a slot to the sign of a task
STAY = 120.0  # px, hysteresis: another slot must be nearer by this much to become the target


class NextStepGuide:
    """Suggested next slot of each seat; -1: none."""

    def __init__(self, players: list[str]) -> None:
        self.players = players
        self.slots = [-1] * len(players)

    def update(self, state: Factory) -> None:
        """Update the suggestions every EVERY ticks."""
        for seat, robot in enumerate(state.robots):
            if not robot.present or (state.tick + seat) % EVERY:
                continue
            if self.players[seat] == "human":
                self.slots[seat] = next_slot(state, seat, self.slots[seat])
            else:
                self.slots[seat] = state.loads[seat].aim - 1

    def draw(self, light: Batch, top: Batch, state: Factory, seat: int, pose: Pose, clock: float) -> None:
        """Draw the arrow, or the corners and the line to them."""
        s, human = self.slots[seat], self.players[seat] == "human"
        if s < 0 or state.over:
            return
        x, y = LEFT + state.slots[s].x, TOP + state.slots[s].y
        put(light, crates.target(PLAYERS[seat] if human else dim(PLAYERS[seat], AIMS), not human), x, y)
        if not human and not (self._has_human_mate(state, seat) and is_task(state, seat, s)):
            return
        fork = state.rules.fork
        from_x, from_y = pose[0] + fork * math.cos(pose[2]), pose[1] + fork * math.sin(pose[2])
        way = math.dist((from_x, from_y), (x, y))
        angle = math.atan2(y - from_y, x - from_x)
        if human:
            _arrow(light, seat, (from_x, from_y, angle), way, clock)
        else:
            _dots(light, seat, (from_x, from_y, angle), way)
            dx, dy = _beside(state, s)
            put(top, signs.task(seat, not state.loads[seat].pallet), x + dx, y + dy)

    def _has_human_mate(self, state: Factory, seat: int) -> bool:
        team = state.robots[seat].team
        return any(
            driver == "human" and robot.present and robot.team == team
            for driver, robot in zip(self.players, state.robots, strict=True)
        )


def is_task(state: Factory, seat: int, s: int) -> bool:
    """True if slot s is where robot `seat` can lift or set down something now, or soon; not if it only waits there."""
    if state.loads[seat].pallet:
        return bool(may_set_down(state, seat, s)) or state.slots[s].kind == INPUT
    slot = state.slots[s]
    return bool(may_lift(state, seat, s) or (slot.kind == OUTPUT and state.machines[slot.machine].pallet))


def _beside(state: Factory, s: int) -> tuple[float, float]:
    """Offset of a task's sign from slot s, px: towards the outer wall, away from a machine's worker, or above."""
    slot = state.slots[s]
    if slot.machine < 0:
        return (0.0, -SIGN) if slot.team == NOBODY else (-SIGN if slot.x < WIDTH / 2 else SIGN, 0.0)
    machine = state.machines[slot.machine]
    dx, dy = machine.x - machine.spot_x, machine.y - machine.spot_y
    far = math.hypot(dx, dy)
    return SIGN * dx / far, SIGN * dy / far


def _arrow(light: Batch, seat: int, start: Pose, way: float, clock: float) -> None:
    """A dashed arrow of `way` px from a pose; its dashes move."""
    if way < 90.0:
        return
    x, y, angle = start
    c, s = math.cos(angle), math.sin(angle)
    turn, end = step(angle, HEADINGS), way - 66.0
    put(light, crates.arrow(PLAYERS[seat], turn), x + end * c, y + end * s)
    at = 30.0 + clock * SPEED % PITCH
    while at < end - 24.0:
        put(light, crates.dash(PLAYERS[seat], turn), x + at * c, y + at * s)
        at += PITCH


def _dots(light: Batch, seat: int, start: Pose, way: float) -> None:
    """A dotted line of `way` px from a pose."""
    x, y, angle = start
    c, s = math.cos(angle), math.sin(angle)
    at = DOTS
    while at < way - 44.0:
        put(light, signs.dot(PLAYERS[seat]), x + at * c, y + at * s)
        at += DOTS


def next_slot(state: Factory, seat: int, before: int) -> int:
    """The nearest slot for a robot's next step; later production stages take precedence."""
    robot, load = state.robots[seat], state.loads[seat]
    best, least = -1, 1e9
    for s in range(state.slot_count):
        slot = state.slots[s]
        useful = _drop_cost(state, seat, s) if load.pallet else _lift_cost(state, seat, s)
        if useful < 0.0:
            continue
        cost = math.dist((robot.x, robot.y), (slot.x, slot.y)) + useful - (STAY if s == before else 0.0)
        if cost < least:
            best, least = s, cost
    return best


def _drop_cost(state: Factory, seat: int, s: int) -> float:
    """Cost, in addition to the distance, of setting the load down there; below 0: it does not belong there."""
    slot, pallet = state.slots[s], state.pallets[state.loads[seat].pallet - 1]
    if not may_set_down(state, seat, s):
        return -1.0
    if pallet.state == DAMAGED:
        return 0.0 if slot.kind == ENTRY else -1.0
    if slot.kind == INPUT:
        machine = state.machines[slot.machine]
        return -1.0 if not fits(machine.kind, pallet.state) else 300.0 if machine.reserved else 0.0
    return 0.0 if slot.kind == EXIT and pallet.state == DONE else -1.0


def _lift_cost(state: Factory, seat: int, s: int) -> float:
    """Cost, in addition to the distance, of lifting the load there; below 0: there is none, or it is in its right
    place.
    """
    slot = state.slots[s]
    if not may_lift(state, seat, s):
        return -1.0
    pallet = state.pallets[slot.pallet - 1]
    if pallet.state == DAMAGED or (slot.kind == INPUT and fits(state.machines[slot.machine].kind, pallet.state)):
        return -1.0
    return 400.0 if slot.kind == ENTRY else 0.0
