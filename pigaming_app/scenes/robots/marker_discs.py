"""What is projected under and round real robots: an even grey disc for the marker, round it what shows whose it is.

Discs are drawn last, at the pose predicted for the moment at which the light lands, and hide all that a game has drawn
there: hard edges of light across a marker make it unreadable (HARDWARE.md). The lid is 70 mm up and the light comes
aslant, hence discs twice as wide as the robot.
"""

import math

import pygame

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.session.real import LIGHT_AFTER
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import BLACK, GREY, LINE, PLAYERS, THIN, Color, GlowCanvas, badge, regular_polygon
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, master, painted, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached

DISC = 72  # px: 95 mm
MOAT = 77  # px of black round it
RING = 83  # px
BARREL, TIP = (92, 112), 132  # px: from where to where, and the end of the arrow
ARM = 110  # px to the middle of both
TAG_R = 40.0  # px: radius of a tag
TAG = 122  # px from a robot to the badge that trails it
TAG_OUT = 10  # px that it may be outside of the arena: in the corners of the picture are markers
KNOWN = 1.0  # s after which nobody knows where an unseen robot is


class MarkerDiscs:
    """The discs of a rig's robots."""

    def __init__(self, rig: Rig) -> None:
        self.rig = rig

    def circles(self, robots: set[int]) -> list[tuple[float, float, float]]:
        """What the light of these robots hides: the middles and radii of rings, arrows and tags, px on the canvas."""
        found = []
        for _, at in self._there(robots):
            x, y = LEFT + at.x, TOP + at.y
            dx, dy = _behind(at)
            found += [
                (x, y, RING + 12.0),
                (x + ARM * math.cos(at.heading), y + ARM * math.sin(at.heading), TIP + 18.0 - ARM),
                (x + dx, y + dy, TAG_R),
            ]
        return found

    def draw(self, screen: pygame.Surface, robots: set[int]) -> None:
        """Paint the discs of these robots, as far as they are seen; all light round them first, then the discs."""
        there = self._there(robots)
        for robot, at in there:
            x, y = LEFT + at.x, TOP + at.y
            for sprite, dx, dy in (
                (pointer(robot, step(at.heading, HEADINGS)), 0.0, 0.0),
                (tag(robot), *_behind(at)),
                (ring(robot), 0.0, 0.0),
            ):
                place = round(x + dx + sprite.dx), round(y + dy + sprite.dy)
                screen.blit(sprite.image, place, special_flags=pygame.BLEND_PREMULTIPLIED)
        for r, color in ((MOAT, BLACK), (DISC, GREY)):  # all moats first: none may cut into the disc of a neighbour
            for _, at in there:
                screen.blit(disc(r, color), (round(LEFT + at.x) - r, round(TOP + at.y) - r))

    def _there(self, robots: set[int]) -> list[tuple[int, Sighting]]:
        """Those of the robots that are seen, and where they will be when the light is there."""
        seen = self.rig.sense(LIGHT_AFTER)
        return [(robot, seen[robot]) for robot in sorted(robots) if seen[robot].age < KNOWN + LIGHT_AFTER]


def _behind(at: Sighting) -> tuple[float, float]:
    """Where the tag is, from the robot: behind it, or beside it where that would be off the arena and its rim."""
    for turn in (math.pi, 0.75 * math.pi, 1.25 * math.pi, 0.5 * math.pi, 1.5 * math.pi):
        dx, dy = TAG * math.cos(at.heading + turn), TAG * math.sin(at.heading + turn)
        if -TAG_OUT < at.x + dx < WIDTH + TAG_OUT and -TAG_OUT < at.y + dy < HEIGHT + TAG_OUT:
            break
    return dx, dy


@cached
def disc(r: int, color: Color) -> pygame.Surface:
    """A disc of one colour, of `r` px; nothing shines through."""
    out = pygame.Surface((2 * r, 2 * r), pygame.SRCALPHA)
    pygame.draw.circle(out, (*color, 255), (r, r), r)
    return out


@cached
def ring(player: int) -> Sprite:
    """The ring in the player's colour, which hides the ground."""
    half = RING + 24
    ink = GlowCanvas(2 * half, 2 * half).to(half, half)
    ink.solid(regular_polygon(64, RING + 3)).ring(0, 0, RING, PLAYERS[player], LINE)
    return trim(ink.sprite(0.9), half, half)


@cached
def pointer(player: int, turn: int) -> Sprite:
    """Barrel and arrow ahead of a robot at heading `turn` of HEADINGS."""
    return turned(painted(_pointer, (player,)), turn, HEADINGS, ARM)


def _pointer(player: int) -> pygame.Surface:
    ink, color = master(48, ARM), PLAYERS[player]
    near, far = BARREL
    ink.solid([(near - 6, -18), (far, -18), (TIP + 8, 0), (far, 18), (near - 6, 18)])
    ink.line([(near - 6, -9), (far, -7)], color, THIN).line([(near - 6, 9), (far, 7)], color, THIN)
    return ink.neon([(far - 6, -15), (TIP, 0), (far - 6, 15)], color, LINE).sprite(0.8)


@cached
def tag(player: int) -> Sprite:
    """The badge of a player on black."""
    ink = GlowCanvas(96, 96).to(48, 48)
    ink.solid(regular_polygon(40, 32))
    badge(ink, player, 0, -4 if player == 1 else 0, 24)
    return trim(ink.sprite(0.5), 48, 48)
