"""Event detection for races, by comparing a race with its previous tick; read-only."""

import math
from typing import NamedTuple

from pigaming_app.games.race.state import LINES, Race, Racer
from pigaming_app.sim.world import DT

JUMP, TURN = 16.0, 0.5  # px and rad in a tick, above which a robot was put somewhere
NEAR = 4.0  # px from the requested pose
SETTLE = 12  # ticks for which a new order must hold; otherwise robots side by side would swap constantly
SHOWN_FROM = 25  # ticks of driving the wrong way before it is reported


class RaceEvent(NamedTuple):
    """An event of a seat's robot.

    kind       number
    line       index of the line it has crossed in order
    lap        time of the completed lap, s
    best       the same, for its best lap so far
    last_lap   -          the last lap begins
    missed     line it must return to
    void       line it had missed when crossing its own
    wrong      -          drives the wrong way
    mud        -          has left the track
    finish     final place
    up, down   new place
    asked      -          the game asks for it to be put back on the track
    back       -          it is back

    Only in party (see party/events.py): item and used (the item), boost, spin, resisted (oil, by its shield), slip (a
    slipstream begins), final_lap (the first one begins its last lap), close (s behind the one that finished before it).
    """

    kind: str
    seat: int
    number: float = 0.0


class RaceEventDetector:
    """Keeps the previous tick of one race. `order`: seats in running order, leader first."""

    def __init__(self, state: Race) -> None:
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.order = self._running(state)
        self.candidate, self.since = self.order, state.tick
        self._store(state)

    def detect(self, state: Race) -> list[RaceEvent]:
        """Events since the last call."""
        events = [event for seat in self.seats for event in self._racer(state, seat)]
        events += self._order(state)
        self._store(state)
        return events

    def _store(self, state: Race) -> None:
        self.racers = [
            (r.passed, r.missed, r.void, drives_wrong(r), r.place.on, r.finished, r.best_lap) for r in state.racers
        ]
        self.asked = [bool(robot.recover) for robot in state.robots]
        self.poses = [(robot.x, robot.y, robot.heading) for robot in state.robots]

    def _racer(self, state: Race, seat: int) -> list[RaceEvent]:
        passed, missed, void, wrong, on, finished, best = self.racers[seat]
        racer = state.racers[seat]
        found = []
        if racer.passed > passed:
            found.append(RaceEvent("line", seat, (racer.line + racer.passed - 1) % LINES))
            found += self._lap(state, seat, best)
        if racer.void > void:
            found.append(RaceEvent("void", seat, racer.missed - 1))
        elif racer.missed and racer.missed != missed:
            found.append(RaceEvent("missed", seat, racer.missed - 1))
        if drives_wrong(racer) and not wrong and not racer.finished:
            found.append(RaceEvent("wrong", seat))
        if on and not racer.place.on and not racer.finished:
            found.append(RaceEvent("mud", seat))
        if racer.finished and not finished:
            found.append(RaceEvent("finish", seat, racer.rank))
        asked = bool(state.robots[seat].recover)
        if asked and not self.asked[seat]:
            found.append(RaceEvent("asked", seat))
        if not asked and (self.asked[seat] or was_put_back(state, seat, self.poses[seat])):
            found.append(RaceEvent("back", seat))
        return found

    def _lap(self, state: Race, seat: int, best: float) -> list[RaceEvent]:
        """Lap events after a robot crossed its own start line."""
        racer, laps = state.racers[seat], state.robots[seat].score
        if racer.passed % LINES != 1:
            return []
        found = []
        if racer.passed > 1:
            kind = "best" if racer.best_lap < best else "lap"
            found.append(RaceEvent(kind, seat, racer.last_lap * DT))
        if laps == state.rules.laps - 1 and laps > 0:
            found.append(RaceEvent("last_lap", seat))
        return found

    def _running(self, state: Race) -> list[int]:
        return sorted(self.seats, key=lambda seat: state.racers[seat].rank)

    def _order(self, state: Race) -> list[RaceEvent]:
        """Accept a new order after it has held for SETTLE ticks, or when a robot finishes."""
        running = self._running(state)
        if running != self.candidate:
            self.candidate, self.since = running, state.tick
        finished = any(state.racers[seat].finished > self.racers[seat][5] for seat in self.seats)
        if running == self.order or not (finished or state.tick - self.since >= SETTLE or state.over):
            return []
        before, self.order = self.order, running
        moved = [seat for seat in running if running.index(seat) != before.index(seat)]
        return [
            RaceEvent("up" if running.index(seat) < before.index(seat) else "down", seat, 1 + running.index(seat))
            for seat in moved
        ]


def drives_wrong(racer: Racer) -> bool:
    """True if driving the wrong way is shown; a spin is not."""
    return racer.wrong > SHOWN_FROM and not racer.spin


def was_put_back(state: Race, seat: int, before: tuple[float, float, float]) -> bool:
    """True if a simulated robot was put on the requested pose in this tick; `before`: its last pose, px, px, rad."""
    robot = state.robots[seat]
    turn = abs((robot.heading - before[2] + math.pi) % math.tau - math.pi)
    jumped = math.dist((robot.x, robot.y), before[:2]) > JUMP or turn > TURN
    return jumped and math.dist((robot.x, robot.y), (robot.recover_x, robot.recover_y)) < NEAR
