"""Event detection for Robot Factory, by comparing a match with its previous tick; read-only."""

from typing import Any, NamedTuple

from pigaming_app.games.factory.state import DAMAGED, DELIVERED, IN_MACHINE, IN_SLOT, ON_ROBOT, Factory

LIFTED, SET_DOWN, REFUSED, SPOILED, DELIVERY = "lift", "set_down", "refused", "spoiled", "delivered"
STARTED, DONE, FROZEN, THAWED, RENEWED = "machine_start", "machine_done", "freeze", "thaw", "arrived"


class FactoryEvent(NamedTuple):
    """An event at (x, y), px; `player`: the robot that caused it, or None; `what`: pallet or machine, -1: neither."""

    kind: str
    player: int | None
    x: float
    y: float
    what: int = -1


class FactoryEventDetector:
    """Keeps the previous tick of one match."""

    def __init__(self, state: Factory) -> None:
        self._store(state)

    def look(self, state: Factory) -> list[FactoryEvent]:
        """Events since the last call."""
        found = [*self._robots(state), *self._pallets(state)]
        self._store(state)
        return found

    def _store(self, state: Factory) -> None:
        self.loads = [(load.pallet, load.refused, load.frozen) for load in state.loads]
        self.pallets = [(one.state, one.place, one.at) for one in state.pallets]

    def _robots(self, state: Factory) -> list[FactoryEvent]:
        found = []
        for k, (load, robot) in enumerate(zip(state.loads, state.robots, strict=True)):
            _, refused, frozen = self.loads[k]
            if load.refused == 1 and refused != 1:
                found.append(FactoryEvent(REFUSED, k, robot.x, robot.y))
            if load.frozen > frozen:
                found.append(FactoryEvent(FROZEN, k, robot.x, robot.y))
            elif frozen and not load.frozen:
                found.append(FactoryEvent(THAWED, k, robot.x, robot.y))
        return found

    def _pallets(self, state: Factory) -> list[FactoryEvent]:
        found = []
        for p, one in enumerate(state.pallets):
            was, place, at = self.pallets[p]
            if (one.state, one.place, one.at) == (was, place, at):
                continue
            who = at if place == ON_ROBOT else one.at if one.place == ON_ROBOT else None
            x, y = spot(state, p)
            if one.state == DELIVERED and was != DELIVERED:
                found.append(FactoryEvent(DELIVERY, who, x, y, p))
            elif one.state == DAMAGED and was != DAMAGED:
                found.append(FactoryEvent(SPOILED, who, x, y, p))
            elif was == DAMAGED and one.state != DAMAGED:
                found.append(FactoryEvent(RENEWED, None, x, y, p))
            elif one.place == ON_ROBOT:
                found.append(FactoryEvent(LIFTED, who, x, y, p))
            elif one.place == IN_MACHINE:
                found.append(FactoryEvent(STARTED, None, x, y, p))
            elif place == IN_MACHINE:
                found.append(FactoryEvent(DONE, None, x, y, p))
            elif one.place == IN_SLOT and place == ON_ROBOT:
                found.append(FactoryEvent(SET_DOWN, who, x, y, p))
        return found


def spot(state: Factory, p: int) -> tuple[float, float]:
    """Position of a pallet in arena px: its slot, its machine, or the robot or worker carrying it."""
    one = state.pallets[p]
    owner: Any = {IN_SLOT: state.slots, ON_ROBOT: state.robots, IN_MACHINE: state.machines}.get(
        one.place, state.workers
    )
    here = owner[min(one.at, len(owner) - 1)]
    return here.x, here.y
