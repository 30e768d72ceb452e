"""Synthetic PiTanks match at peak load, for benchmarks and visual checks: every number changes.

Four robots, thirty bullets, powers, pick-ups, mines, breaking walls and a changing HUD; by the party rules also lights,
bounties, stars and the banner.
"""

import math
import random

from pigaming_app.games.arenas import load
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.pitanks.start import set_rules
from pigaming_app.games.pitanks.state import OWN_BULLETS, PICKUPS, PiTanks
from pigaming_app.sim.arena import Arena, build
from pigaming_app.sim.world import DT, HZ

BULLETS = 30


class BusyPiTanks:
    """A match without an engine. `teams`: team of each seat, -1 for an empty seat."""

    def __init__(
        self, teams: tuple[int, ...] = (0, 1, 2, 3), arena: Arena | None = None, variant: str = "pickups"
    ) -> None:
        self.arena = arena or load("pitanks", "classic")
        self.random = random.Random(4)
        self.state = state = PiTanks()
        build(state, self.arena)
        one, two, three, four = (Seat("hand2", team) for team in teams)
        set_rules(state.rules, Setup("pitanks", self.arena.name, (one, two, three, four), 2.0, 1, variant))
        if state.rules.finale:
            state.rules.finale = state.rules.ticks
        for seat, robot in enumerate(state.robots):
            robot.present, robot.team = int(teams[seat] >= 0), teams[seat]
            robot.x, robot.y = 400 + 800 * (seat % 2), 250 + 400 * (seat // 2)
            robot.turbo = 0.3 + 0.2 * seat
        self.seats = [i for i in range(4) if teams[i] >= 0]

    def tick(self) -> None:
        """Advance everything by 1/50 s."""
        state, t = self.state, self.state.tick * DT
        state.tick += 1
        for seat in self.seats:
            robot, tank = state.robots[seat], state.tanks[seat]
            robot.heading = (1.3 * seat + (0.9, -0.7, 1.4, -1.1)[seat] * t) % math.tau
            robot.linear = (-1) ** (state.tick // 150) * 240.0
            robot.x = min(1550.0, max(50.0, robot.x + robot.linear * DT * math.cos(robot.heading)))
            robot.y = min(850.0, max(50.0, robot.y + robot.linear * DT * math.sin(robot.heading)))
            robot.turbo, robot.boosting = 0.5 + 0.5 * math.sin(t + seat), int(math.sin(t + seat) > 0.3)
            tank.protected = max(0, tank.protected - 1)
            tank.spent = (state.tick + 90 * seat) % max(1, state.rules.magazine * state.rules.loading)
            tank.powers = [max(0, left - 1) for left in tank.powers]
            if state.rules.knockout:
                tank.knocked_out = state.rules.knockout - (state.tick + 10 * seat) % state.rules.knockout
                tank.camp_x, tank.camp_y, tank.lit, tank.bounty = robot.x, robot.y, 1, 1
        self._shoot()
        if state.tick % 15 == 0:
            self._hit()
        self._scatter_items()

    def _shoot(self) -> None:
        state = self.state
        alive = 0
        for i, bullet in enumerate(state.bullets):
            seat = i // OWN_BULLETS
            robot = state.robots[seat]
            if bullet.alive:
                bullet.x, bullet.y = bullet.x + bullet.vx * DT, bullet.y + bullet.vy * DT
                bullet.alive = int(6 < bullet.x < 1594 and 6 < bullet.y < 894)
                alive += bullet.alive
            elif robot.present and alive < BULLETS and self.random.random() < 0.2:
                a = self.random.uniform(0, math.tau)
                bullet.alive, bullet.x, bullet.y = 1, robot.x, robot.y
                bullet.vx, bullet.vy = 560 * math.cos(a), 560 * math.sin(a)
                state.tanks[seat].shots += 1

    def _hit(self) -> None:
        state = self.state
        maker, victim = self.random.sample(self.seats, 2)
        state.tanks[maker].hits += 1
        state.robots[maker].score += 1
        state.tanks[victim].taken += 1
        state.robots[victim].score -= state.rules.penalty
        state.last_hit, state.last_shooter, state.last_victim = state.tick, maker, victim
        state.tanks[victim].protected = 38
        state.tanks[maker].powers[self.random.randrange(6)] = 8 * HZ
        standing = [wall for wall in state.walls[: state.wall_count] if wall.health]
        if standing:
            self.random.choice(standing).health -= 1

    def _scatter_items(self) -> None:
        state = self.state
        for i in range(PICKUPS):
            pickup = state.pickups[i]
            pickup.alive -= 1
            if pickup.alive <= 0:
                pickup.alive, pickup.kind = 12 * HZ - 150 * i, self.random.randrange(6)
                pickup.x, pickup.y = self.random.uniform(100, 1500), self.random.uniform(100, 800)
        for i in range(0, len(state.mines), 3):
            mine = state.mines[i]
            mine.alive, mine.age = 30 * HZ, state.tick
            mine.x, mine.y = 200.0 + 160 * i, 820.0 - 90 * i


BUSY = BusyPiTanks
