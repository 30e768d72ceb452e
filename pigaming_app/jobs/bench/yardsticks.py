"""Yardsticks for the speed of the simulator: the bare physics of the same scene in pymunk, and as a NumPy batch.

The scene is the arena `classic` with its outer walls, four robots with random sticks, and about ten bullets in flight,
which end at walls and robots. Neither yardstick has rules, scores, pick-ups, motor lag, observations or brains.
"""

from collections.abc import Callable, Mapping
from importlib.util import find_spec
from math import cos, sin
from random import Random
from time import process_time
from typing import Any, Protocol

import numpy as np

from pigaming_app.games.arenas import load
from pigaming_app.sim.world import DT, HEIGHT, RADIUS, ROBOTS, WIDTH

GAME, ARENA = "pitanks", "classic"
SPEED, TURN_RATE = 260.0, 3.0  # px/s, rad/s
BULLET_SPEED, BULLET_RADIUS, MUZZLE = 560.0, 6.0, 64.0  # px/s, px, px
HOLD = 25  # ticks between changes of the sticks
RELOAD = 9  # ticks between shots of a robot: about ten bullets are in flight
WARM_UP = 100  # ticks before the first measurement
ROUNDS = 10
MATCHES, BULLETS = 1024, 10  # of the NumPy batch, and in each of its matches
EDGE = 20.0  # px, half the thickness of the outer walls: thinner ones let bullets through
CORNERS = ((-EDGE, -EDGE), (WIDTH + EDGE, -EDGE), (WIDTH + EDGE, HEIGHT + EDGE), (-EDGE, HEIGHT + EDGE))


class Yardstick(Protocol):
    """A running scene."""

    matches: int

    def play(self, ticks: int) -> None:
        """Advance every match of the scene."""


def best_of(runs: Mapping[str, Callable[[], float]]) -> dict[str, float]:
    """The lowest result of each run in ROUNDS rounds. They take turns, so that a busy machine slows all of them."""
    rounds = [{name: run() for name, run in runs.items()} for _ in range(ROUNDS)]
    return {name: min(results[name] for results in rounds) for name in runs}


def runs() -> dict[str, Callable[[], float]]:
    """A run of each yardstick; those of pymunk only if it is installed (extra `bench`)."""
    found = {"numpy_batch": timed(NumpyBatch(), 5)}
    if find_spec("pymunk"):
        found |= {"pymunk_bodies": timed(BulletBodies(), 500), "pymunk_queries": timed(BulletQueries(), 500)}
    return found


def timed(yardstick: Yardstick, ticks: int) -> Callable[[], float]:
    """A run of `ticks` ticks that returns the CPU time, s, for a tick of a match."""
    yardstick.play(WARM_UP)

    def run() -> float:
        began = process_time()
        yardstick.play(ticks)
        return (process_time() - began) / (ticks * yardstick.matches)

    return run


class PymunkScene:
    """The scene in pymunk, in the usual way: robots are driven by velocity. Raises ImportError without pymunk."""

    matches = 1

    def __init__(self) -> None:
        import pymunk

        self.pymunk, self.random, self.tick = pymunk, Random(1), 0
        self.space = pymunk.Space()
        edges = [(*a, *b, EDGE) for a, b in zip(CORNERS, CORNERS[1:] + CORNERS[:1], strict=True)]
        arena = load(GAME, ARENA)
        for ax, ay, bx, by, half in [*edges, *((w.ax, w.ay, w.bx, w.by, w.half) for w in arena.walls)]:
            self.space.add(pymunk.Segment(self.space.static_body, (ax, ay), (bx, by), half))
        self.robots = []
        self.sticks = [(0.0, 0.0)] * ROBOTS
        for seat, start in enumerate(arena.starts):
            body = pymunk.Body(1.0, pymunk.moment_for_circle(1.0, 0.0, RADIUS))
            body.position, body.angle = (start.x, start.y), start.heading
            circle = pymunk.Circle(body, RADIUS)
            circle.filter = pymunk.ShapeFilter(group=1 + seat)
            self.space.add(body, circle)
            self.robots.append(body)

    def play(self, ticks: int) -> None:
        for _ in range(ticks):
            if self.tick % HOLD == 0:
                self.sticks = [(SPEED * self._stick(), TURN_RATE * self._stick()) for _ in range(ROBOTS)]
            for seat, (body, (speed, turn)) in enumerate(zip(self.robots, self.sticks, strict=True)):
                angle = body.angle
                way = cos(angle), sin(angle)
                body.velocity, body.angular_velocity = (speed * way[0], speed * way[1]), turn
                if (self.tick + seat * RELOAD // ROBOTS) % RELOAD == 0:
                    x, y = body.position[0] + MUZZLE * way[0], body.position[1] + MUZZLE * way[1]
                    if 0.0 < x < WIDTH and 0.0 < y < HEIGHT:
                        self.fire(seat, x, y, *way)
            self.space.step(DT)
            self.end_bullets()
            self.tick += 1

    def fire(self, seat: int, x: float, y: float, along: float, across: float) -> None:
        """Launch a bullet of robot `seat` from (x, y) in the direction of a unit vector."""
        raise NotImplementedError

    def end_bullets(self) -> None:
        """Remove the bullets that have hit in this tick."""
        raise NotImplementedError

    def _stick(self) -> float:
        return self.random.uniform(-1.0, 1.0)


class BulletBodies(PymunkScene):
    """Bullets are bodies with a collision handler."""

    def __init__(self) -> None:
        super().__init__()
        self.ended: list[Any] = []
        self.space.on_collision(1, None, begin=self._hit)

    def fire(self, seat: int, x: float, y: float, along: float, across: float) -> None:
        body = self.pymunk.Body(0.01, float("inf"))
        body.position, body.velocity = (x, y), (BULLET_SPEED * along, BULLET_SPEED * across)
        circle = self.pymunk.Circle(body, BULLET_RADIUS)
        circle.collision_type, circle.sensor = 1, True
        circle.filter = self.pymunk.ShapeFilter(group=1 + seat)
        self.space.add(body, circle)

    def end_bullets(self) -> None:
        for circle in {*self.ended}:
            self.space.remove(circle, circle.body)
        self.ended.clear()

    def _hit(self, arbiter: Any, space: Any, data: Any) -> None:
        self.ended += [shape for shape in arbiter.shapes if shape.collision_type]


class BulletQueries(PymunkScene):
    """Bullets are points, whose step is a query for the first shape on its way."""

    def __init__(self) -> None:
        super().__init__()
        self.bullets: list[tuple[float, float, float, float, Any]] = []
        self.filters = [self.pymunk.ShapeFilter(group=1 + seat) for seat in range(ROBOTS)]

    def fire(self, seat: int, x: float, y: float, along: float, across: float) -> None:
        step = BULLET_SPEED * DT
        self.bullets.append((x, y, step * along, step * across, self.filters[seat]))

    def end_bullets(self) -> None:
        kept = []
        for x, y, dx, dy, others in self.bullets:
            to = x + dx, y + dy
            if self.space.segment_query_first((x, y), to, BULLET_RADIUS, others) is None:
                kept.append((*to, dx, dy, others))
        self.bullets = kept


class NumpyBatch:
    """MATCHES scenes at once in NumPy: robots' motion, their contact with walls and each other, bullets."""

    matches = MATCHES

    def __init__(self) -> None:
        arena = load(GAME, ARENA)
        self.random, self.tick = np.random.default_rng(1), 0
        starts = np.array([(start.x, start.y, start.heading) for start in arena.starts])
        self.x, self.y, self.heading = np.repeat(starts.T[:, None], MATCHES, axis=1)  # (matches, robots)
        walls = np.array([(w.ax, w.ay, w.bx - w.ax, w.by - w.ay, w.half) for w in arena.walls])
        self.wall_x, self.wall_y, self.along_x, self.along_y, self.half = walls.T
        self.length2 = self.along_x**2 + self.along_y**2
        self.owner = np.arange(BULLETS) % ROBOTS
        self.bullet_x, self.bullet_y = self.x[:, self.owner], self.y[:, self.owner]  # (matches, bullets)
        self.step_x, self.step_y = np.zeros((2, MATCHES, BULLETS))

    def play(self, ticks: int) -> None:
        for _ in range(ticks):
            if self.tick % HOLD == 0:
                self.speed = self.random.uniform(-SPEED, SPEED, (MATCHES, ROBOTS))
                self.turn = self.random.uniform(-TURN_RATE, TURN_RATE, (MATCHES, ROBOTS))
            self.heading += DT * self.turn
            self.cos, self.sin = np.cos(self.heading), np.sin(self.heading)
            self.x += DT * self.speed * self.cos
            self.y += DT * self.speed * self.sin
            self._separate()
            self._leave_walls()
            self._move_bullets()
            self.tick += 1

    def _separate(self) -> None:
        """Push robots that overlap apart, half the overlap each."""
        x, y = self.x, self.y
        for i in range(ROBOTS - 1):
            for j in range(i + 1, ROBOTS):
                dx, dy = x[:, j] - x[:, i], y[:, j] - y[:, i]
                distance = np.sqrt(dx * dx + dy * dy) + 1e-9
                share = 0.5 * np.maximum(0.0, 2.0 * RADIUS - distance) / distance
                x[:, i] -= share * dx
                y[:, i] -= share * dy
                x[:, j] += share * dx
                y[:, j] += share * dy

    def _leave_walls(self) -> None:
        """Push robots out of walls, the outer ones last."""
        gap_x, gap_y, distance = self._from_walls(self.x, self.y)
        share = np.maximum(0.0, self.half + RADIUS - distance) / (distance + 1e-9)
        self.x += (share * gap_x).sum(-1)
        self.y += (share * gap_y).sum(-1)
        np.clip(self.x, RADIUS, WIDTH - RADIUS, out=self.x)
        np.clip(self.y, RADIUS, HEIGHT - RADIUS, out=self.y)

    def _move_bullets(self) -> None:
        """Move bullets; those that touch a wall or another robot start again at their owners' muzzles."""
        self.bullet_x += self.step_x
        self.bullet_y += self.step_y
        hit = (self._from_walls(self.bullet_x, self.bullet_y)[2] < self.half + BULLET_RADIUS).any(-1)
        hit |= (self.bullet_x < BULLET_RADIUS) | (self.bullet_x > WIDTH - BULLET_RADIUS)
        hit |= (self.bullet_y < BULLET_RADIUS) | (self.bullet_y > HEIGHT - BULLET_RADIUS)
        for k in range(ROBOTS):
            dx, dy = self.bullet_x - self.x[:, k, None], self.bullet_y - self.y[:, k, None]
            hit |= (dx * dx + dy * dy < (RADIUS + BULLET_RADIUS) ** 2) & (self.owner != k)
        hit |= self.step_x**2 + self.step_y**2 == 0.0  # not yet fired
        match, i = np.nonzero(hit)
        own = match, self.owner[i]
        along, across = self.cos[own], self.sin[own]
        self.bullet_x[match, i], self.step_x[match, i] = self.x[own] + MUZZLE * along, BULLET_SPEED * DT * along
        self.bullet_y[match, i], self.step_y[match, i] = self.y[own] + MUZZLE * across, BULLET_SPEED * DT * across

    def _from_walls(self, x: Any, y: Any) -> tuple[Any, Any, Any]:
        """Vectors (gap_x, gap_y) and distances from every wall's centre line to points, px."""
        off_x, off_y = x[..., None] - self.wall_x, y[..., None] - self.wall_y
        share = np.clip((off_x * self.along_x + off_y * self.along_y) / self.length2, 0.0, 1.0)
        gap_x, gap_y = off_x - share * self.along_x, off_y - share * self.along_y
        return gap_x, gap_y, np.sqrt(gap_x * gap_x + gap_y * gap_y)
