"""Event detection for Robot Factory, by comparing a match with its previous tick; read-only."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from pigaming_app.games.factory.pallets import first_slot
from pigaming_app.games.factory.state import (
    BY_WORKER,
    DAMAGED,
    DELIVERED,
    ENTRY,
    EXIT,
    IN_MACHINE,
    IN_SLOT,
    MACHINES,
    NOBODY,
    ON_ROBOT,
    SHARED_SLOTS,
    SHIPPED,
    TEAMS,
    WAITING,
    Factory,
)
from pigaming_app.scenes.views.factory.star_panel import stars_left
from pigaming_app.sim.world import WIDTH

LIFTED, SET_DOWN, REFUSED, SPOILED, DELIVERY = "lift", "set_down", "refused", "spoiled", "delivered"
STARTED, DONE, FROZEN, THAWED, RENEWED = "machine_start", "machine_done", "freeze", "thaw", "arrived"
ONE_TO_GO, STOLEN, RUSH, EXPIRED, FAST, STAR_LOST = "one_to_go", "stolen", "rush", "expired", "fast", "star_lost"


class FactoryEvent(NamedTuple):
    """An event at (x, y), px; `player`: the robot that caused it, or None.

    `what`: index of the pallet or machine, -1: none. `worth`: points of a delivery; of other events the team concerned.
    """

    kind: str
    player: int | None
    x: float
    y: float
    what: int = -1
    worth: int = 0


class FactoryEventDetector:
    """Keeps the previous tick of one match."""

    def __init__(self, state: Factory) -> None:
        self._store(state)

    def detect(self, state: Factory) -> list[FactoryEvent]:
        """Events since the last call."""
        events = [*self._robots(state), *self._pallets(state), *self._match(state)]
        self._store(state)
        return events

    def _store(self, state: Factory) -> None:
        self.loads = [(load.pallet, load.refused, load.frozen) for load in state.loads]
        self.pallets = [(pallet.state, pallet.place, pallet.at) for pallet in state.pallets]
        self.owners = [pallet.team for pallet in state.pallets]
        self.rushes = [pallet.rush for pallet in state.pallets]
        self.scores = [robot.score for robot in state.robots]
        self.stolen = [load.stolen for load in state.loads]
        self.delivered = list(state.delivered)
        self.fast = [machine.fast for machine in state.machines]
        self.stars = stars_left(state)

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
                worth = 0 if carrier is None else state.robots[carrier].score - self.scores[carrier]
                events.append(FactoryEvent(DELIVERY, carrier, x, y, p, worth))
            elif pallet.state == DAMAGED and old_state != DAMAGED:
                events.append(FactoryEvent(SPOILED, carrier, x, y, p))
            elif old_state in (DAMAGED, DELIVERED) and pallet.state not in (DAMAGED, DELIVERED):
                events.append(FactoryEvent(RENEWED, None, x, y, p))
            elif pallet.place == ON_ROBOT:
                events.append(FactoryEvent(LIFTED, carrier, x, y, p))
                if carrier is not None and state.loads[carrier].stolen > self.stolen[carrier]:
                    events.append(FactoryEvent(STOLEN, carrier, x, y, p, self.owners[p]))
            elif pallet.place == IN_MACHINE:
                events.append(FactoryEvent(STARTED, None, x, y, p))
            elif old_place == IN_MACHINE:
                events.append(FactoryEvent(DONE, None, x, y, p))
            elif pallet.place == IN_SLOT and old_place == ON_ROBOT:
                events.append(FactoryEvent(SET_DOWN, carrier, x, y, p))
        return events

    def _match(self, state: Factory) -> Iterator[FactoryEvent]:
        """Calls for a team or for everybody."""
        for p, pallet in enumerate(state.pallets):
            if pallet.rush > self.rushes[p]:
                yield FactoryEvent(RUSH, None, *spot(state, p), p)
            elif self.rushes[p] == 1 and not pallet.rush and pallet.state != DELIVERED:
                yield FactoryEvent(EXPIRED, None, *spot(state, p), p, pallet.team)
        goal = state.rules.pallets
        for team in range(TEAMS):
            if goal and self.delivered[team] < state.delivered[team] == goal - 1:
                out = state.slots[first_slot(team, EXIT)]
                yield FactoryEvent(ONE_TO_GO, None, out.x, out.y, worth=team)
        for m in range(MACHINES):
            if state.machines[m].fast and not self.fast[m]:
                yield FactoryEvent(FAST, None, state.machines[m].x, state.machines[m].y, m)
        if state.rules.allies and stars_left(state) < self.stars:
            yield FactoryEvent(STAR_LOST, None, WIDTH / 2, 0.0)


def spot(state: Factory, p: int) -> tuple[float, float]:
    """Position of a pallet in arena px: its slot, its machine, the robot or worker carrying it, or where it waits."""
    pallet = state.pallets[p]
    places: dict[int, tuple[Any, int]] = {
        IN_SLOT: (state.slots, pallet.at),
        ON_ROBOT: (state.robots, pallet.at),
        IN_MACHINE: (state.machines, pallet.at),
        BY_WORKER: (state.workers, pallet.at),
        WAITING: (state.slots, SHARED_SLOTS if pallet.at == NOBODY else first_slot(pallet.at, ENTRY)),
        SHIPPED: (state.slots, first_slot(pallet.at, EXIT)),
    }
    owners, i = places[pallet.place]
    return owners[i].x, owners[i].y
