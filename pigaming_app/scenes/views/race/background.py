"""Background of a race: road and mud, rendered once per track and cached; lines, signs and start boxes of the race."""

import random
from functools import cached_property, partial

import numpy as np
import numpy.typing as npt
import pygame

from pigaming_app.games.race.course import Course
from pigaming_app.games.race.start import TrackPlan
from pigaming_app.games.race.state import Race
from pigaming_app.scenes.views.background import LEFT, TOP, Background
from pigaming_app.scenes.views.race.lines import (
    BADGE,
    frame,
    line_signs,
    line_sprite,
    post_sprite,
    sign_post,
    slot_sprite,
)
from pigaming_app.scenes.views.race.track import draw_track, edges
from pigaming_app.scenes.views.things.styles import MUD
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ADD, PRE, STEEL, WIDE, GlowCanvas
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.sprites import Batch, put
from pigaming_app.ui.draw.surface_cache import cached

GLOW = 0.75
CORNER = 44  # px, marks in the corners of the arena
GRID = 10  # px, spacing of the distance samples
FINE = 2  # arena px per picture px
APART = 34.0  # px between contour lines
CLODS = 420
ROWS = 50  # picture rows per step
Heights = npt.NDArray[np.float32]
Numbers = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]


class RaceBackground(Background):
    """The background of one race; after the first tick, `state` no longer shows where the start boxes are."""

    def __init__(self, track: TrackPlan, state: Race) -> None:
        super().__init__(partial(bare, track))
        self.track, self.signs = track, line_signs(state)
        numbered, present = bool(state.rules.party), [i for i, robot in enumerate(state.robots) if robot.present]
        starts = [(seat, state.robots[seat]) for seat in present if not state.tick]
        self.slots = [(seat, robot.x, robot.y, robot.heading, numbered) for seat, robot in starts]

    @cached_property
    def surface(self) -> pygame.Surface:
        """The canvas with everything baked in. The HUD is baked above the arena, so `bare` needs no lines."""
        lines, lights = self._marks()
        out = self.bare.copy()
        out.fblits(lines, PRE)
        out.fblits(lights, ADD)
        return out

    def _marks(self) -> tuple[Batch, Batch]:
        """Lines; start boxes and signs, as light."""
        lines: Batch = []
        lights: Batch = []
        for seat, x, y, heading, numbered in self.slots:
            put(lights, slot_sprite(seat, heading, numbered), LEFT + x, TOP + y)
        course = self.track.course
        for sign, along in zip(self.signs, self.track.lines, strict=True):
            line, (x, y) = frame(course, along), sign_post(course, along)
            put(lines, line_sprite(line, sign), LEFT + line.x, TOP + line.y)
            put(lights, post_sprite(sign), LEFT + x, TOP + y)
        return lines, lights


@cached
@resumable
def bare(track: TrackPlan) -> Steps[pygame.Surface]:
    """Road, mud, and black areas for the signs, without lines and HUD."""
    below = earth(track)
    glow, crisp = GlowCanvas(1920, 1080).set_transform(LEFT, TOP), GlowCanvas(1920, 1080).set_transform(LEFT, TOP)
    yield from draw_track(glow, crisp, track)
    for x, y, sx, sy in ((0, 0, 1, 1), (WIDTH, 0, -1, 1), (0, HEIGHT, 1, -1), (WIDTH, HEIGHT, -1, -1)):
        crisp.line([(x, y + CORNER * sy), (x, y), (x + CORNER * sx, y)], STEEL, 4)
    light = yield from glow.lit_steps(GLOW, WIDE)
    out = pygame.Surface((1920, 1080))
    out.blit(below, (LEFT, TOP))
    for x, y in (sign_post(track.course, along) for along in track.lines):
        pygame.draw.circle(out, (0, 0, 0), (LEFT + x, TOP + y), BADGE + 12)
    yield
    out.blit(light, (0, 0), special_flags=ADD)
    yield from crisp.downscale_onto(out)
    return out


@cached
@resumable
def earth(track: TrackPlan) -> Steps[pygame.Surface]:
    """The 1600 x 900 arena: mud, with a black area for the road."""
    from pigaming_app.scenes.views.race.mud import mud  # imports numpy, which must not delay the title screen

    out = mud(track.course).copy()
    yield
    left, right = edges(track.course)
    for i, (a, b) in enumerate(zip(left, right, strict=True)):
        pygame.draw.polygon(out, (0, 0, 0), [left[i - 1], a, b, right[i - 1]])
    return out


@cached
@resumable
def mud(course: Course) -> Steps[pygame.Surface]:
    """The 1600 x 900 arena with mud outside the track, as additive light."""
    coarse = yield from _distances(course)
    distance = _upsampled(_upsampled(coarse, 0), 1)
    h, w = distance.shape
    yield
    clods = _clods(h, w)
    yield
    rgb = np.empty((w, h, 3), np.uint8)
    for top in range(0, h, ROWS):
        rows = slice(top, top + ROWS)
        rgb[:, rows] = _rows(distance[rows], clods[rows], top).swapaxes(0, 1)
        yield
    small = pygame.surfarray.make_surface(rgb)
    yield
    return pygame.transform.smoothscale(small, (int(WIDTH), int(HEIGHT)))


def _rows(distance: Heights, clods: Heights, top: int) -> npt.NDArray[np.uint8]:
    """Pixels of a block of picture rows starting at `top`."""
    h, w = distance.shape
    ys, xs = np.mgrid[top : top + h, 0:w].astype(np.float32) * FINE
    waves = 9 * np.sin(xs / 61 + 2 * np.sin(ys / 83)) + 9 * np.sin(ys / 47 - 1.7 * np.sin(xs / 71))
    heights = distance + (waves + 5 * np.sin((xs + ys) / 23)) * np.clip(distance / 40, 0, 1)
    line = np.clip(2.5 - np.abs(heights % APART - APART / 2), 0, 1)
    fade = np.clip(1.0 - distance / 420, 0.5, 1) * np.clip((distance - 14) / 10, 0, 1)
    bright = np.maximum(line, clods) * fade * 0.80 + 0.12 * np.clip((distance - 12) / 16, 0, 1)
    return np.asarray((bright[..., None] * np.array(MUD, np.float32)).clip(0, 255), np.uint8)


def _distances(course: Course) -> Steps[Heights]:
    """Distance outside the track's edge on a coarse grid, px; negative on the track."""
    centre = np.array([course.xs[: course.count], course.ys[: course.count]]).T
    half = np.array(course.half[: course.count])
    rows = []
    for y in range(0, int(HEIGHT) + 1, GRID):
        xs = np.arange(0.0, WIDTH + 1.0, GRID)
        points = np.stack([xs, np.full_like(xs, y)], 1)
        nearest = ((centre**2).sum(1) - 2 * points @ centre.T).argmin(1)
        after, before = (nearest + 1) % course.count, (nearest - 1) % course.count
        gap, half_width = _on_leg(points, centre, half, nearest, after)
        gap_before, wide_before = _on_leg(points, centre, half, before, nearest)
        rows.append(np.where(gap_before < gap, gap_before - wide_before, gap - half_width))
        yield
    return np.array(rows, np.float32)


def _on_leg(points: Numbers, centre: Numbers, half: Numbers, a: Indices, b: Indices) -> tuple[Numbers, Numbers]:
    """Distance of each point to its leg, from course point a to b, and half the track width there; px."""
    leg, distance = centre[b] - centre[a], points - centre[a]
    share = np.clip((leg * distance).sum(1) / (leg**2).sum(1), 0.0, 1.0)
    gap = np.linalg.norm(distance - share[:, None] * leg, axis=1)
    return gap, half[a] + share * (half[b] - half[a])


def _upsampled(coarse: Heights, axis: int) -> Heights:
    """Interpolate a grid along one axis."""
    at = np.arange((coarse.shape[axis] - 1) * GRID // FINE, dtype=np.float32) * FINE / GRID
    first = at.astype(int)
    shape = (-1, 1) if axis == 0 else (1, -1)
    share = (at - first).reshape(shape)
    low, high = np.take(coarse, first, axis), np.take(coarse, first + 1, axis)
    return np.asarray(low + (high - low) * share, np.float32)


def _clods(h: int, w: int) -> Heights:
    """Random dots that give the ground a texture."""
    rng, clods = random.Random(3), np.zeros((h, w), np.float32)
    ys, xs = np.mgrid[-4:5, -4:5]
    distance = np.sqrt(xs * xs + ys * ys)
    for _ in range(CLODS):
        x, y, r = rng.randrange(8, w - 8), rng.randrange(8, h - 8), rng.choice((1.2, 1.6, 2.2))
        patch = clods[y - 4 : y + 5, x - 4 : x + 5]
        np.maximum(patch, np.clip(r + 0.5 - distance, 0, 1), out=patch)
    return clods
