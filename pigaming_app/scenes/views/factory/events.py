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

    def detect(self, state: Factory) -> list[FactoryEvent]:
        """Events since the last call."""
        events = [*self._robots(state), *self._pallets(state)]
        self._store(state)
        return events

    def _store(self, state: Factory) -> None:
        self.loads = [(load.pallet, load.refused, load.frozen) for load in state.loads]
        self.pallets = [(pallet.state, pallet.place, pallet.at) for pallet in state.pallets]

    def _robots(self, state: Factory) -> list[FactoryEvent]:
        events = []
        for k, (load, robot) in enumerate(zip(state.loads, state.robots, strict=True)):
            _, refused, frozen = self.loads[k]
            if load.refused == 1 and refused != 1:
                events.append(FactoryEvent(REFUSED, k, robot.x, robot.y))
            if load.frozen > frozen:
                events.append(FactoryEvent(FROZEN, k, robot.x, robot.y))
            elif frozen and not load.frozen:
                events.append(FactoryEvent(THAWED, k, robot.x, robot.y))
        return events

    def _pallets(self, state: Factory) -> list[FactoryEvent]:
        events = []
        for p, pallet in enumerate(state.pallets):
            old_state, old_place, old_at = self.pallets[p]
            if (pallet.state, pallet.place, pallet.at) == (old_state, old_place, old_at):
                continue
            carrier = old_at if old_place == ON_ROBOT else pallet.at if pallet.place == ON_ROBOT else None
            x, y = spot(state, p)
            if pallet.state == DELIVERED and old_state != DELIVERED:
                events.append(FactoryEvent(DELIVERY, carrier, x, y, p))
            elif pallet.state == DAMAGED and old_state != DAMAGED:
                events.append(FactoryEvent(SPOILED, carrier, x, y, p))
            elif old_state == DAMAGED and pallet.state != DAMAGED:
                events.append(FactoryEvent(RENEWED, None, x, y, p))
            elif pallet.place == ON_ROBOT:
                events.append(FactoryEvent(LIFTED, carrier, x, y, p))
            elif pallet.place == IN_MACHINE:
                events.append(FactoryEvent(STARTED, None, x, y, p))
            elif old_place == IN_MACHINE:
                events.append(FactoryEvent(DONE, None, x, y, p))
            elif pallet.place == IN_SLOT and old_place == ON_ROBOT:
                events.append(FactoryEvent(SET_DOWN, carrier, x, y, p))
        return events


def spot(state: Factory, p: int) -> tuple[float, float]:
    """Position of a pallet in arena px: its slot, its machine, or the robot or worker carrying it."""
    pallet = state.pallets[p]
    owner: Any = {IN_SLOT: state.slots, ON_ROBOT: state.robots, IN_MACHINE: state.machines}.get(
        pallet.place, state.workers
    )
    at = owner[min(pallet.at, len(owner) - 1)]
    return at.x, at.y
