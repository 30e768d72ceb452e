"""Steering help in Robot Factory: it leads a person's robot to a slot where FIRE does something useful.

The slot is near, and roughly where the robot points or where the person turns, so that somebody who knows where to go
leads, and somebody who presses keys at random gets somewhere. Along the way to it the robot turns by itself while the
person does not, a turn rolls on, and reverse only slows down. A turn away from it counts less the farther the robot
points off the way. At the slot the robot waits for FIRE. A released stick stays released.
"""

from math import atan2, cos, sin, sqrt

from pigaming_app.ai.brain.driving import SteeringHelp
from pigaming_app.ai.factory.navigation import FAR, Ways, find_way
from pigaming_app.games.factory.observation import FactoryObservation, FactorySenses, SlotView, observe
from pigaming_app.games.factory.state import DAMAGED, DONE, ENTRY, EXIT, INPUT, OUTPUT, RAW, SHARED, A, B, Factory
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record

PERIOD = 5  # ticks between two choices of a slot
LEAN = 0.5  # rad by which a full turn of the stick moves the direction that counts as ahead
PER_RAD = 170.0  # px of way that one rad between that direction and a slot counts as
KEEP = 210.0  # px by which another slot must be better while the stick does not turn
ALONG = 0.9  # rad between robot and way, below which a robot drives along it
LEAD = 0.9  # share of the way's turn, along the way of a stick that does not turn
STRAY = 0.3, 0.5  # rad off the way: from there a turn away counts less, and how far off it counts least
STRAIGHT = 0.35  # rad off the way up to which it does not slow down
COAST = 0.4  # forward stick of reverse along the way
TURN = 2.0  # stick for each rad off the way
CLOSE, NEAR = 26.0, 86.0  # px before the slot: reverse and turns are as they are; it slows down unless it points there
AT = 26.0  # px between fork and slot within which it waits
WAITING, LEAVING = 0.1, 0.4  # share of forward stick and turn, and of reverse, at the slot


@record
class View:
    """Where the help leads one seat."""

    target: int  # 1 + the slot, 0: none is useful
    observation: FactoryObservation
    senses: FactorySenses
    ways: Ways


class Guide:
    """Steering help of all seats. Reads matches only."""

    def __init__(self) -> None:
        self._match: Factory | None = None
        self._views: dict[int, View] = {}

    def helped_stick(self, match: Factory, seat: int, linear: float, angular: float) -> tuple[float, float]:
        """The stick of `seat`, both axes in [-1, 1], after the help in this tick."""
        if match is not self._match:
            self._match, self._views = match, {}
        return steer(match, seat, linear, angular, self._views.setdefault(seat, View()))


@kernel
def steer(match: Factory, seat: int, linear: float, angular: float, view: View) -> tuple[float, float]:
    """The same as a kernel, with the view of the seat."""
    if linear == 0.0 and angular == 0.0:
        return 0.0, 0.0
    if match.tick % PERIOD == 0 or not view.target:
        _look(match, seat, angular, view)
    return _lead(match, seat, linear, angular, view) if view.target else (linear, angular)


@kernel
def _look(match: Factory, seat: int, angular: float, view: View) -> None:
    """Choose the slot, and find the way to it."""
    obs = view.observation
    observe(match, seat, view.senses, obs)
    target, least = 0, FAR
    for s in range(obs.slot_count):
        slot = obs.slots[s]
        if _is_useful(obs, slot):
            cost = _cost(obs, slot, angular) - (KEEP * (1.0 - abs(angular)) if view.target == s + 1 else 0.0)
            if cost < least:
                target, least = s + 1, cost
    view.target = target
    if target:
        slot = obs.slots[target - 1]
        find_way(match, match.robots[seat], obs, view.ways, slot.x, slot.y)


@kernel
def _lead(match: Factory, seat: int, linear: float, angular: float, view: View) -> tuple[float, float]:
    """The stick on the way to the slot."""
    robot, obs = match.robots[seat], view.observation
    slot = obs.slots[view.target - 1]
    dx, dy = slot.x - robot.x, slot.y - robot.y
    fork_x, fork_y = dx - obs.fork * cos(robot.heading), dy - obs.fork * sin(robot.heading)
    if fork_x * fork_x + fork_y * fork_y < AT * AT:
        return linear * (WAITING if linear > 0.0 else LEAVING), angular * WAITING
    off = turn_to(atan2(obs.waypoint_y - robot.y, obs.waypoint_x - robot.x) - robot.heading)
    distance = sqrt(dx * dx + dy * dy)
    if abs(off) < ALONG and not (obs.straight and distance - obs.fork < CLOSE):
        linear = linear if linear > 0.0 else -COAST * linear if linear < 0.0 else abs(angular)
    if linear > 0.0:
        linear = min(linear, _speed(obs, off, distance))
    share = _share(off, angular)
    return linear, angular + share * (max(-1.0, min(1.0, TURN * off)) - angular)


@kernel
def _is_useful(obs: FactoryObservation, slot: SlotView) -> bool:
    """True if the robot has a job there: to lift a pallet, or to set its own down where it gets on."""
    if not obs.carries:
        return bool(slot.lift != 0 and 0 < slot.holds <= DAMAGED and slot.kind in (ENTRY, OUTPUT, SHARED))
    state = obs.carries - 1
    if not slot.put:
        return False
    if state in (DONE, DAMAGED):
        return slot.kind == (EXIT if state == DONE else ENTRY)
    return slot.kind == INPUT and slot.makes == (A if state == RAW else B)


@kernel
def _cost(obs: FactoryObservation, slot: SlotView, angular: float) -> float:
    """Distance of a slot, and more for one that is not ahead, px."""
    dx, dy = slot.x - obs.x, slot.y - obs.y
    off = turn_to(atan2(dy, dx) - obs.heading - LEAN * angular)
    return sqrt(dx * dx + dy * dy) + PER_RAD * abs(off)


@kernel
def _speed(obs: FactoryObservation, off: float, distance: float) -> float:
    """Highest forward stick: less for a turn, and short of the slot."""
    speed = max(0.1, 1.0 - 0.9 * max(0.0, abs(off) - STRAIGHT))
    short = distance - obs.fork
    if not obs.straight or short >= NEAR:
        return speed
    if abs(distance * sin(off)) > 20.0:
        speed = min(speed, max(0.0, (short - 36.0) / 60.0))
    return min(speed, short / 40.0) if short < 20.0 else speed


@kernel
def _share(off: float, angular: float) -> float:
    """Share of the way's turn in the stick."""
    if angular * off < 0.0:
        return LEAD * min(1.0, abs(off) / STRAY[1]) if abs(off) > STRAY[0] else 0.0
    return LEAD * (1.0 - abs(angular)) if abs(off) < ALONG else 0.0


HELP = SteeringHelp(View, steer)
