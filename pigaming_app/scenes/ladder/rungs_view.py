"""Drawing of the ladder: rungs with the stars of their robots, the climber, and the robot on the next rung."""

import math

import pygame

from pigaming_app.events.ladder import LEVELS, NEEDED, Climb
from pigaming_app.scenes.flow.match_words import LIT
from pigaming_app.scenes.views.sprites.robot import seat_robot
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite, dimmed
from pigaming_app.ui.widgets.pips import pips

GROUND, PITCH = 922, 122  # px: y of the floor, from rung to rung
RAILS = (212, 548)  # px
STARS_X, STARS = 604, 64  # px: left edge and type size
ROBOT_X, RIVAL_X, STANDS = 302, 458, 52  # px: where the robots are, and how far above their rung
SCALE = 0.9
CLIMB_SECONDS = 0.9  # s from one rung to the next
UP = -math.pi / 2
PAST, HERE, AHEAD = "past", "here", "ahead"  # of a rung


def rung_y(rung: int) -> int:
    """y of a rung, px; 0 is the floor."""
    return GROUND - PITCH * rung


def draw_ladder(screen: pygame.Surface, climb: Climb, moved: float, clock: float) -> None:
    """The ladder of a climb. `moved`: share of the way from the rung below, 1: arrived; `clock`: s, for the pulse."""
    rails().draw(screen)
    for rung in range(1, LEVELS + 1):
        stars(climb.level_on(rung), state_of(climb, rung)).draw(screen, 0, rung_y(rung))
    if not climb.at_top:
        hop = 5 * abs(math.sin(2.4 * clock))
        blit_sprite(screen, seat_robot(1, UP, SCALE), RIVAL_X, rung_y(climb.rung) - STANDS - hop)
    passed = climb.rung - 1
    way = 1.0 - (1.0 - min(1.0, max(0.0, moved))) ** 3
    y = rung_y(passed) + (1.0 - way) * PITCH
    blit_sprite(screen, seat_robot(0, UP, SCALE), ROBOT_X, y - STANDS)


def state_of(climb: Climb, rung: int) -> str:
    """PAST, HERE or AHEAD."""
    return PAST if rung < climb.rung else HERE if rung == climb.rung else AHEAD


@cached
@resumable
def rails() -> Steps[LitImage]:
    """The two rails and the floor."""
    left, right = RAILS
    layer = Layer(left - 60, rung_y(LEVELS) - 90, right - left + 120, GROUND - rung_y(LEVELS) + 130)
    for x in RAILS:
        layer.glow.neon([(x, rung_y(LEVELS) - 72), (x, GROUND)], kit.STEEL, kit.LINE)
    layer.glow.line([(left - 52, GROUND), (right + 52, GROUND)], kit.MIST, kit.THIN)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def stars(level: int, state: str) -> Steps[LitImage]:
    """A rung at y = 0 and the stars of its robot beside it; those passed have a tick."""
    left, right = RAILS
    layer = Layer(left - 10, -60, STARS_X + 420 - left, 120)
    color = {PAST: kit.FOCUS, HERE: kit.ICE, AHEAD: kit.STEEL}[state]
    layer.glow.neon([(left, 0), (right, 0)], color, kit.BOLD if state == HERE else kit.LINE)
    if state == PAST:
        kit.icon(layer.glow, "check", STARS_X + 4, -STANDS, 20, kit.FOCUS, kit.LINE)
    layer.canvas.text(LIT * level, STARS, STARS_X + 44, -STANDS, kit.ICE, "head")
    yield
    lit = yield from layer.render_steps()
    return dimmed(lit, 0.5) if state == AHEAD else lit


@cached
def standing(wins: int, losses: int) -> LitImage:
    """Wins of both on this rung, as badges with pips; left end at (0, 0)."""
    layer = Layer(0, -50, 560, 100)
    for seat, won, x in ((0, wins, 40), (1, losses, 330)):
        kit.badge(layer.glow, seat, x, 0, 34)
        pips(layer, x + 76, 0, won, NEEDED, kit.PLAYERS[seat], 17)
    layer.glow.line([(246, 0), (274, 0)], kit.dim(kit.MIST, 0.8), kit.THIN)
    return layer.render()
