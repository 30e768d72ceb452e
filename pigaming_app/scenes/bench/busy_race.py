"""Synthetic race at peak load, for benchmarks and visual checks: every number changes.

Four robots drive, cut through mud, change places, miss lines, turn round, complete laps and finish at the same time. In
party they also draft, spin, hold shields and items, and oil lies everywhere.
"""

import math

from pigaming_app.games.arenas import load
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.race.course import locate, point_at
from pigaming_app.games.race.start import start
from pigaming_app.games.race.state import ITEMS, LINES, Race
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT, HZ, ROBOTS

LAP = 9.0  # s
PACES = (1.0, 0.95, 0.9, 0.85)  # relative speeds of the robots
SWAY = (40.0, 150.0, 60.0, 90.0)  # px, lateral amplitude around the centre line; one robot cuts through mud


class BusyRace:
    """A race without an engine. `seats`: number of drivers."""

    def __init__(
        self, seats: int = ROBOTS, arena: Arena | None = None, laps: int = 3, variant: str = "standard"
    ) -> None:
        self.arena = arena or load("race", "classic")
        self.state = state = Race()
        one, two, three, four = (Seat("level5" if i < seats else "off", i) for i in range(ROBOTS))
        start(state, self.arena, Setup("race", self.arena.name, (one, two, three, four), 10.0, 1, variant, laps))
        self.seats = range(seats)

    def tick(self) -> None:
        """Advance everything by 1/50 s."""
        state = self.state
        state.tick += 1
        for seat in self.seats:
            self._drive(seat)
        ahead = sorted(self.seats, key=lambda seat: (-state.racers[seat].finished, -state.racers[seat].progress))
        for place, seat in enumerate(ahead):
            state.racers[seat].rank = place + 1
        if state.rules.party:
            for seat in self.seats:
                self._play(seat)
            self._furnish()

    def _drive(self, seat: int) -> None:
        state, t = self.state, self.state.tick * DT
        robot, racer, course = state.robots[seat], state.racers[seat], state.course
        before = robot.x, robot.y
        racer.progress = t / LAP * PACES[seat] * course.length * (1 + 0.05 * math.sin(t * 1.3 + seat * 2))
        along = (state.lines[racer.line].along + racer.progress) % course.length
        robot.x, robot.y = point_at(course, along, SWAY[seat] * math.sin(t * 0.9 + seat))
        robot.heading = math.atan2(robot.y - before[1], robot.x - before[0])
        robot.linear = 300.0
        robot.turbo, robot.boosting = 0.5 + 0.5 * math.sin(t + seat), int(math.sin(t + seat) > 0.3)
        locate(course, robot.x, robot.y, racer.place)
        self._cross(seat)
        racer.missed = 1 + int(t) % LINES if seat == 1 and t % 4 > 2 else 0
        racer.void += int(seat == 1 and state.tick % (4 * HZ) == 2 * HZ)
        racer.wrong = 60 if seat == 3 and t % 3 > 1.5 else 0

    def _play(self, seat: int) -> None:
        """Items, shield, spin, surge and slipstream of a robot."""
        t, racer = self.state.tick * DT + seat, self.state.racers[seat]
        racer.item, racer.shield = int(t * 1.5) % len(ITEMS), HZ if t % 3 > 1.2 else 0
        racer.spin, racer.spin_way = (HZ if t % 4 > 2.5 else 0), 1
        racer.surge, racer.slip = (10 if t % 2 > 0.7 else 0), int(t % 2 > 0.5)

    def _furnish(self) -> None:
        """Oil in front of every robot, and boxes that come and go."""
        state = self.state
        for i, oil in enumerate(state.oils):
            oil.alive = 1 + (state.tick + 31 * i) % (3 * HZ)
            oil.x, oil.y = point_at(state.course, (i + 0.5) * state.course.length / len(state.oils), 40.0)
        for i, box in enumerate(state.boxes):
            box.pause = max(0, (state.tick + 40 * i) % (3 * HZ) - HZ)

    def _cross(self, seat: int) -> None:
        """Count the lines crossed since the last tick."""
        state = self.state
        racer, laps = state.racers[seat], state.rules.laps
        passed = min(1 + LINES * laps, 1 + int(LINES * max(0.0, racer.progress) / state.course.length))
        if passed <= racer.passed:
            return
        racer.passed, racer.delta, racer.delta_at = passed, 15.0 * math.sin(state.tick), state.tick
        if passed % LINES == 1:
            if passed > 1:
                racer.last_lap = state.tick - racer.lap_start
                racer.best_lap = min(racer.best_lap or 1e9, racer.last_lap)
                state.robots[seat].score += 1
            racer.lap_start = float(state.tick)
        if passed == 1 + LINES * laps:
            racer.finished, racer.finish = 1, float(state.tick)
            state.first = state.first or state.tick


BUSY = BusyRace
