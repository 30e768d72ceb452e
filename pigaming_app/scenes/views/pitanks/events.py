"""Event detection for PiTanks, by comparing a match with its previous tick; read-only.

The engine emits no events: its state consists of numbers only, so that it can run inside a compiled rollout.
"""

import math
from typing import NamedTuple

from pigaming_app.games.pitanks.scoring import is_finale, is_overtime
from pigaming_app.games.pitanks.state import OWN_BULLETS, OWN_MINES, POWERS, RAPID, SHIELD, TRIPLE, Bullet, PiTanks
from pigaming_app.sim.world import HEIGHT, SOLID, WIDTH

NEAR = 20.0  # px, maximum distance between a bullet and the robot that stopped it


class PiTanksEvent(NamedTuple):
    """An event at (x, y), px; `angle`: its direction, rad.

    kind        player   number
    fire        shooter  -
    stopped     owner    -       a bullet ended on a wall or an invulnerable robot
    bounced     owner    -
    cracked     -        wall
    crumbled    -        wall
    hit         victim   count
    shielded    victim   -
    scored      scorer   points; by rules without penalty at the robot that was hit, else at the scorer
    lit         robot    -
    finale      -        -
    overtime    -        -
    pickup      robot    power
    power_end   robot    power
    mine_laid   owner    -
    mine_blown  owner    -
    """

    kind: str
    player: int | None
    x: float
    y: float
    angle: float = 0.0
    number: int = 0


class _Shot(NamedTuple):
    alive: int
    x: float
    y: float
    vx: float
    vy: float


class PiTanksEventDetector:
    """Keeps the previous tick of one match."""

    def __init__(self, state: PiTanks) -> None:
        self._store(state)

    def detect(self, state: PiTanks) -> list[PiTanksEvent]:
        """Events since the last call."""
        events = [
            *self._tanks(state),
            *self._bullets(state),
            *self._walls(state),
            *self._mines(state),
            *self._phases(state),
        ]
        self._store(state)
        return events

    def _store(self, state: PiTanks) -> None:
        self.tanks = [(t.shots, t.hits, t.taken, tuple(t.powers)) for t in state.tanks]
        self.lit = [tank.lit for tank in state.tanks]
        self.scores = [robot.score for robot in state.robots]
        self.finale, self.overtime = is_finale(state), is_overtime(state)
        self.shots = [_shot(bullet) for bullet in state.bullets]
        self.walls = [wall.health for wall in state.walls]
        self.mines = [(mine.alive, mine.x, mine.y) for mine in state.mines]
        self.places = [(robot.x, robot.y) for robot in state.robots]

    def _tanks(self, state: PiTanks) -> list[PiTanksEvent]:
        events = []
        for k, (tank, robot) in enumerate(zip(state.tanks, state.robots, strict=True)):
            shots, hits, taken, powers = self.tanks[k]
            x, y = robot.x, robot.y
            if tank.shots > shots:
                events.append(PiTanksEvent("fire", k, x, y, robot.heading))
            if tank.hits > hits:
                events += self._scored(state, k, tank.hits - hits)
            if tank.taken > taken:
                events.append(PiTanksEvent("hit", k, x, y, 0.0, tank.taken - taken))
            for power in range(len(POWERS)):
                before, now = powers[power], tank.powers[power]
                if now > before and not (is_overtime(state) and power in (RAPID, TRIPLE)):  # all have these there
                    events.append(PiTanksEvent("pickup", k, x, y, 0.0, power))
                elif power == SHIELD and before > 1 and not now:
                    events.append(PiTanksEvent("shielded", k, x, y))
                elif before == 1 and not now:
                    events.append(PiTanksEvent("power_end", k, x, y, 0.0, power))
        return events

    def _scored(self, state: PiTanks, k: int, hits: int) -> list[PiTanksEvent]:
        """The points of seat k. Of several hits in one tick only the last is shown where it happened."""
        scorer = state.robots[k]
        if state.rules.penalty:
            return [PiTanksEvent("scored", k, scorer.x, scorer.y, 0.0, hits)]
        at = state.robots[state.last_victim] if state.last_shooter == k else scorer
        points = scorer.score - self.scores[k]
        return [PiTanksEvent("scored", k, at.x, at.y, 0.0, points)] if points else []

    def _phases(self, state: PiTanks) -> list[PiTanksEvent]:
        """Lights that came on, and the beginning of the finale and of the overtime."""
        events = []
        for k, (tank, robot) in enumerate(zip(state.tanks, state.robots, strict=True)):
            if tank.lit > self.lit[k]:
                events.append(PiTanksEvent("lit", k, robot.x, robot.y))
        if is_finale(state) and not self.finale:
            events.append(PiTanksEvent("finale", None, WIDTH / 2, HEIGHT / 2))
        if is_overtime(state) and not self.overtime:
            events.append(PiTanksEvent("overtime", None, WIDTH / 2, HEIGHT / 2))
        return events

    def _bullets(self, state: PiTanks) -> list[PiTanksEvent]:
        events = []
        for i, bullet in enumerate(state.bullets):
            before, owner = self.shots[i], i // OWN_BULLETS
            if bullet.alive and before.alive and (bullet.vx != before.vx or bullet.vy != before.vy):
                events.append(PiTanksEvent("bounced", owner, bullet.x, bullet.y, math.atan2(bullet.vy, bullet.vx)))
            elif not bullet.alive and (before.alive or (bullet.x, bullet.y) != (before.x, before.y)):
                victim = self._stopped_by(state, bullet, owner)
                if victim is None or state.tanks[victim].taken == self.tanks[victim][2]:
                    angle = math.atan2(-bullet.vy, -bullet.vx)
                    events.append(PiTanksEvent("stopped", owner, bullet.x, bullet.y, angle))
        return events

    def _stopped_by(self, state: PiTanks, bullet: Bullet, owner: int) -> int | None:
        """The robot that stopped a bullet, by the positions of the previous tick, since robots have moved on."""
        for k, (x, y) in enumerate(self.places):
            robot = state.robots[k]
            if (
                robot.present
                and robot.team != state.robots[owner].team
                and math.dist((x, y), (bullet.x, bullet.y)) < state.radius + NEAR
            ):
                return k
        return None

    def _walls(self, state: PiTanks) -> list[PiTanksEvent]:
        events = []
        for i in range(state.wall_count):
            wall = state.walls[i]
            if wall.health != self.walls[i] and wall.initial_health != SOLID:  # not a real thing that was moved
                x, y, angle = (
                    (wall.ax + wall.bx) / 2,
                    (wall.ay + wall.by) / 2,
                    math.atan2(wall.by - wall.ay, wall.bx - wall.ax),
                )
                events.append(PiTanksEvent("cracked" if wall.health else "crumbled", None, x, y, angle, i))
        return events

    def _mines(self, state: PiTanks) -> list[PiTanksEvent]:
        events = []
        for i, mine in enumerate(state.mines):
            alive, _, _ = self.mines[i]
            if mine.alive > alive:
                events.append(PiTanksEvent("mine_laid", i // OWN_MINES, mine.x, mine.y))
            elif alive > 1 and not mine.alive:
                events.append(PiTanksEvent("mine_blown", i // OWN_MINES, mine.x, mine.y))
        return events


def _shot(bullet: Bullet) -> _Shot:
    return _Shot(bullet.alive, bullet.x, bullet.y, bullet.vx, bullet.vy)
