"""The training match at reduced scale: walls, robots, shots and trails.

It is updated at the rate at which the training publishes states. Robots are interpolated between two states; where they
jump, because training runs faster than real time, they leave fading shadows.
"""

import math
from collections import deque
from collections.abc import Iterator
from functools import partial
from typing import Any

import pygame

from pigaming_app.games.pitanks.state import OWN_BULLETS
from pigaming_app.scenes.lab.layout import ARENA, MATCH, SCALE
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.scenes.views.walled_background import wall_sprite
from pigaming_app.sim.world import SOLID
from pigaming_app.ui.draw import ADD, PLAYERS, PRE, GlowCanvas, dim
from pigaming_app.ui.draw.frame_budget import Job, PrewarmQueue
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, Sprite, faded, put, step
from pigaming_app.ui.draw.surface_cache import cached

JUMP = 150.0  # arena px between two states: too far for visible driving
SHADOWS = 4  # states for which a jump stays visible
DOTS, DOT_EVERY = 14, 0.05  # number of trail dots; s between them
MAX_GLIDE = 0.12  # s, maximum interpolation interval
WAVE = 0.45  # s, shock wave
Pose = tuple[float, float, float]  # arena px, arena px, rad
Wall = tuple[float, float, float, float, float, int, int]  # both ends, half the width (px), initial and current health


class ArenaView:
    """Live view of a training match. `ground`: the background of the whole page."""

    def __init__(self, ground: pygame.Surface) -> None:
        self.bare = ground.subsurface(MATCH).copy()
        self.floor = self.bare.copy()
        self.walls: list[Wall] = []
        self.painted: list[Wall] = []  # walls baked into the floor
        self.before: list[Pose] = []
        self.now: list[Pose] = []
        self.seats: list[int] = []
        self.shots: list[tuple[int, float, float, float]] = []  # seat, px, px, rad
        self.taken: list[int] = []
        self.shadows: deque[list[Pose]] = deque(maxlen=SHADOWS)
        self.trails: deque[list[Pose]] = deque(maxlen=DOTS)
        self.waves: list[tuple[float, float, int, float]] = []  # px, px, seat, age in s
        self.age, self.glide, self.since_dot = 0.0, MAX_GLIDE, 0.0
        self.jobs = PrewarmQueue()

    def show(self, state: Any) -> None:
        """Take over a new match state."""
        if not self.seats:
            self.jobs = PrewarmQueue(jobs(state))
        walls = (state.walls[i] for i in range(state.wall_count))
        self.walls = [
            (wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.initial_health, wall.health) for wall in walls
        ]
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        poses = [(robot.x, robot.y, robot.heading) for robot in state.robots]
        self.before = self.blended() or poses
        self.now = poses
        if self._jumped():
            self.shadows.append(self.before)
            self.trails.clear()
            self.before = poses
        elif self.shadows:
            self.shadows.popleft()
        self.glide = min(MAX_GLIDE, max(0.01, 0.8 * self.glide + 0.2 * self.age))
        self.age = 0.0
        self._hits(state)
        self.shots = [
            (i // OWN_BULLETS, bullet.x, bullet.y, math.atan2(bullet.vy, bullet.vx))
            for i, bullet in enumerate(state.bullets)
            if bullet.alive
        ]

    def prewarm(self, milliseconds: float) -> None:
        """Prewarm sprites for at most this many milliseconds."""
        self.jobs.work(milliseconds)

    def update(self, seconds: float) -> None:
        self.age += seconds
        self.waves = [(x, y, seat, age + seconds) for x, y, seat, age in self.waves if age + seconds < WAVE]
        self.since_dot += seconds
        if self.since_dot >= DOT_EVERY and self.now:
            self.since_dot = 0.0
            self.trails.append(self.blended())

    def blended(self) -> list[Pose]:
        """Robot poses interpolated between the last two states."""
        share = min(1.0, self.age / self.glide)
        out = []
        for old, new in zip(self.before, self.now, strict=True):
            turn = (new[2] - old[2] + math.pi) % math.tau - math.pi
            out.append((old[0] + (new[0] - old[0]) * share, old[1] + (new[1] - old[1]) * share, old[2] + turn * share))
        return out

    def draw(self, screen: pygame.Surface) -> None:
        self._paint_walls()
        screen.blit(self.floor, MATCH)
        under: Batch = []
        over: Batch = []
        light: Batch = []
        for i, poses in enumerate(self.trails):
            for seat in self.seats:
                put(under, dot(seat, i * effects.TREAD_LEVELS // DOTS), *_at(*poses[seat][:2]))
        for i, poses in enumerate(self.shadows):
            for seat in self.seats:
                put(under, shadow(seat, step(poses[seat][2], HEADINGS // 4), i + 1), *_at(*poses[seat][:2]))
        poses = self.blended()
        for seat in self.seats:
            put(over, small_tank(seat, step(poses[seat][2], HEADINGS)), *_at(*poses[seat][:2]))
        for seat, x, y, angle in self.shots:
            put(light, small_bullet(seat, step(angle, effects.TURNS)), *_at(x, y))
        for x, y, seat, age in self.waves:
            put(light, small_wave(seat, int(age / WAVE * effects.WAVE_STEPS)), *_at(x, y))
        screen.set_clip(ARENA)
        screen.fblits(under, ADD)
        screen.fblits(over, PRE)
        screen.fblits(light, ADD)
        screen.set_clip(None)

    # ---- inside

    def _jumped(self) -> bool:
        pairs = zip(self.before, self.now, strict=True)
        return any(abs(new[0] - old[0]) + abs(new[1] - old[1]) > JUMP for old, new in pairs)

    def _hits(self, state: Any) -> None:
        """Start a shock wave where a robot was hit since the last state."""
        taken = [tank_state.taken for tank_state in state.tanks]
        for seat, (before, after) in enumerate(zip(self.taken, taken, strict=False)):
            if after == before + 1:
                x, y, _ = self.now[seat]
                self.waves.append((x, y, seat, 0.0))
        self.taken = taken

    def _paint_walls(self) -> None:
        """Repaint the walls if any changed."""
        if self.walls == self.painted:
            return
        batch: Batch = []
        for wall in self.walls:
            put(batch, small_wall(*wall), *_at((wall[0] + wall[2]) / 2, (wall[1] + wall[3]) / 2))
        self.floor.blit(self.bare, (0, 0))
        self.floor.fblits([(image, (x - MATCH.x, y - MATCH.y)) for image, (x, y) in batch], PRE)
        self.painted = self.walls


def jobs(state: Any) -> Iterator[Job]:
    """Prewarm jobs: wall damage states, robots and shots in every heading."""
    for health in range(max(wall.initial_health for wall in state.walls), -1, -1):
        for i in range(state.wall_count):
            wall = state.walls[i]
            if wall.initial_health != SOLID:
                yield partial(small_wall, wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.initial_health, health)
    for seat in (0, 1):
        for turn in range(HEADINGS):
            yield partial(small_tank, seat, turn)
        for turn in range(effects.TURNS):
            yield partial(small_bullet, seat, turn)
        for turn in range(HEADINGS // 4):
            for level in range(1, SHADOWS + 1):
                yield partial(shadow, seat, turn, level)


def _at(x: float, y: float) -> tuple[float, float]:
    """Arena to canvas coordinates, px."""
    return ARENA.x + SCALE * x, ARENA.y + SCALE * y


def scaled(sprite: Sprite) -> Sprite:
    """Scale an arena sprite down to this view."""
    w, h = sprite.image.get_size()
    size = max(1, round(w * SCALE)), max(1, round(h * SCALE))
    return Sprite(pygame.transform.smoothscale(sprite.image, size), round(sprite.dx * SCALE), round(sprite.dy * SCALE))


@cached
def small_tank(player: int, turn: int) -> Sprite:
    """Robot at heading `turn` of HEADINGS."""
    return scaled(tank(player, turn))


@cached
def shadow(player: int, turn: int, level: int) -> Sprite:
    """Shadow of a robot at heading `turn` of HEADINGS / 4, brightness `level` of SHADOWS."""
    sprite = small_tank(player, 4 * turn)
    flat = pygame.Surface(sprite.image.get_size())
    flat.blit(sprite.image, (0, 0), special_flags=PRE)
    return faded(Sprite(flat, sprite.dx, sprite.dy), 0.45 * level / SHADOWS)


@cached
def small_bullet(player: int, turn: int) -> Sprite:
    """Shot at heading `turn` of TURNS."""
    return scaled(effects.bullet(player, turn * HEADINGS // effects.TURNS))


@cached
def small_wave(player: int, stage: int) -> Sprite:
    """Shock wave of a hit, `stage` of WAVE_STEPS."""
    return scaled(effects.wave(PLAYERS[player], stage))


@cached
def dot(player: int, level: int) -> Sprite:
    """Trail dot, brightness `level` of TREAD_LEVELS."""
    ink = GlowCanvas(28, 28).disc(14, 14, 5, dim(PLAYERS[player], 0.08 + 0.07 * level))
    return Sprite(ink.lit(0.5), -14, -14)


class _Wall:
    """Wall in the form `wall_sprite` needs."""

    def __init__(self, ax: float, ay: float, bx: float, by: float, half: float, whole: int) -> None:
        self.ax, self.ay, self.bx, self.by, self.half, self.initial_health = ax, ay, bx, by, half, whole


@cached
def small_wall(ax: float, ay: float, bx: float, by: float, half: float, whole: int, health: int) -> Sprite:
    return scaled(wall_sprite(_Wall(ax, ay, bx, by, half, whole), health))
