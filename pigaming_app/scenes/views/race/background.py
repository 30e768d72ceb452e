"""Background of a race: road and mud, rendered once per track and cached; lines, signs and start boxes of the race."""

from functools import cached_property, partial

import pygame

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
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ADD, PRE, STEEL, WIDE, GlowCanvas
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.sprites import Batch, put
from pigaming_app.ui.draw.surface_cache import cached

GLOW = 0.75
CORNER = 44  # px, marks in the corners of the arena


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
