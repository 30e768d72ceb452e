"""Background of a race: road, mud, lines and their badges; rendered once per track and cached."""

from functools import partial

import pygame

from pigaming_app.games.race.start import TrackPlan
from pigaming_app.scenes.views.background import LEFT, TOP, Background
from pigaming_app.scenes.views.race.track import BADGE, draw_track, edges, sign_post
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ADD, STEEL, WIDE, GlowCanvas
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.surface_cache import cached

GLOW = 0.75
CORNER = 44  # px, marks in the corners of the arena


class RaceBackground(Background):
    """The background of one race."""

    def __init__(self, track: TrackPlan) -> None:
        super().__init__(partial(bare, track))


@cached
@resumable
def bare(track: TrackPlan) -> Steps[pygame.Surface]:
    """Static canvas without HUD."""
    below = earth(track)
    glow, crisp = GlowCanvas(1920, 1080).set_transform(LEFT, TOP), GlowCanvas(1920, 1080).set_transform(LEFT, TOP)
    yield from draw_track(glow, crisp, track)
    for x, y, sx, sy in ((0, 0, 1, 1), (WIDTH, 0, -1, 1), (0, HEIGHT, 1, -1), (WIDTH, HEIGHT, -1, -1)):
        crisp.line([(x, y + CORNER * sy), (x, y), (x + CORNER * sx, y)], STEEL, 4)
    light = yield from glow.lit_steps(GLOW, WIDE)
    out = pygame.Surface((1920, 1080))
    out.blit(below, (LEFT, TOP))
    yield
    out.blit(light, (0, 0), special_flags=ADD)
    yield from crisp.downscale_onto(out)
    return out


@cached
@resumable
def earth(track: TrackPlan) -> Steps[pygame.Surface]:
    """The 1600 x 900 arena: mud, with black areas for the road and the badges."""
    from pigaming_app.scenes.views.race.mud import mud  # imports numpy, which must not delay the title screen

    out = mud(track.course).copy()
    yield
    left, right = edges(track.course)
    for i, (a, b) in enumerate(zip(left, right, strict=True)):
        pygame.draw.polygon(out, (0, 0, 0), [left[i - 1], a, b, right[i - 1]])
    for along in track.lines:
        pygame.draw.circle(out, (0, 0, 0), sign_post(track.course, along), BADGE + 12)
    return out
