"""Projection below and around real robots: an even grey disc for the marker, and around it the player's symbols.

Discs are drawn last, at the pose predicted for the moment at which the light arrives, and cover everything the game has
drawn there: hard edges of light across a marker make it unreadable. The lid is 70 mm above the mat and the light falls
obliquely, hence discs wider than the robot by 36 px all round.
"""

import math
from collections.abc import Callable

import pygame

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.session.robot_session import LIGHT_AFTER
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.sim.plant import Sighting
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH
from pigaming_app.ui.draw import BLACK, GREY, LINE, PLAYERS, THIN, Color, GlowCanvas, badge, regular_polygon
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, master, painted, step, trim, turned
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.widgets.labels import blit_sprite

DISC = 72  # px: 95 mm; this and all below are those of a robot of the usual radius, a wider one shifts them out
MOAT = 77  # px, black margin around it
RING = 83  # px
BARREL, TIP = (92, 112), 132  # px: start and end of the barrel, tip of the arrow
ARM = 110  # px to the centre of both
TAG_R = 40.0  # px, radius of a tag
TAG = 122  # px from a robot to its trailing badge
TAG_OUT = 10  # px by which it may leave the arena: the corners of the picture hold markers
KNOWN = 1.0  # s after which the pose of an unseen robot is unknown


class MarkerDiscs:
    """Discs of a rig's robots; `printed`: robots instead, for a screen beside a printed floor."""

    def __init__(self, rig: Rig, printed: bool = False) -> None:
        self.rig, self.printed = rig, printed

    def circles(self, robots: set[int]) -> list[tuple[float, float, float]]:
        """Centres and radii of the areas covered by the light of these robots: rings, arrows, tags; canvas px."""
        areas = []
        for robot, at in self._visible(robots):
            x, y, wide = LEFT + at.x, TOP + at.y, self._wide(robot)
            dx, dy = _tag_offset(at, wide)
            arm = ARM + wide
            areas += [
                (x, y, RING + wide + 12.0),
                (x + arm * math.cos(at.heading), y + arm * math.sin(at.heading), TIP + 18.0 - ARM),
                (x + dx, y + dy, TAG_R),
            ]
        return areas

    def draw(
        self,
        screen: pygame.Surface,
        robots: set[int],
        cover: Callable[[pygame.Surface], None] | None = None,
        ring_color: Callable[[int], Color] = PLAYERS.__getitem__,
    ) -> None:
        """Draw the discs of the visible robots: all surrounding light first, then the discs.

        `cover`: called in between; keeps the surrounding light off real things. `ring_color`: of a robot.
        """
        visible = self._visible(robots)
        if self.printed:
            for robot, at in visible:
                sprite = tank(robot, step(at.heading, HEADINGS), scale=1.0 + self._wide(robot) / RADIUS)
                blit_sprite(screen, sprite, LEFT + at.x, TOP + at.y)
            return
        for robot, at in visible:
            x, y, wide = LEFT + at.x, TOP + at.y, self._wide(robot)
            for sprite, dx, dy in (
                (pointer(robot, step(at.heading, HEADINGS), wide), 0.0, 0.0),
                (tag(robot), *_tag_offset(at, wide)),
                (ring(ring_color(robot), wide), 0.0, 0.0),
            ):
                place = round(x + dx + sprite.dx), round(y + dy + sprite.dy)
                screen.blit(sprite.image, place, special_flags=pygame.BLEND_PREMULTIPLIED)
        if cover:
            cover(screen)
        for r, color in ((MOAT, BLACK), (DISC, GREY)):  # all margins first: none may cut into a neighbour's disc
            for robot, at in visible:
                half = r + self._wide(robot)
                screen.blit(disc(half, color), (round(LEFT + at.x) - half, round(TOP + at.y) - half))

    def _wide(self, robot: int) -> int:
        """Length by which a robot's radius exceeds the usual one, px."""
        return math.ceil(self.rig.margin(robot, RADIUS))

    def _visible(self, robots: set[int]) -> list[tuple[int, Sighting]]:
        """The visible robots with their predicted poses."""
        seen = self.rig.sense(LIGHT_AFTER)
        return [(robot, seen[robot]) for robot in sorted(robots) if seen[robot].age < KNOWN + LIGHT_AFTER]


def _tag_offset(at: Sighting, wide: int) -> tuple[float, float]:
    """Offset of the tag: behind the robot, or beside it where that would leave the arena."""
    for turn in (math.pi, 0.75 * math.pi, 1.25 * math.pi, 0.5 * math.pi, 1.5 * math.pi):
        dx, dy = (TAG + wide) * math.cos(at.heading + turn), (TAG + wide) * math.sin(at.heading + turn)
        if -TAG_OUT < at.x + dx < WIDTH + TAG_OUT and -TAG_OUT < at.y + dy < HEIGHT + TAG_OUT:
            break
    return dx, dy


@cached
def disc(r: int, color: Color) -> pygame.Surface:
    """Opaque disc of one colour, radius `r` px."""
    out = pygame.Surface((2 * r, 2 * r), pygame.SRCALPHA)
    pygame.draw.circle(out, (*color, 255), (r, r), r)
    return out


@cached
def ring(color: Color, wide: int = 0) -> Sprite:
    """Opaque ring of one colour, `wide` px wider than usual."""
    r = RING + wide
    half = r + 24
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    ink.solid(regular_polygon(64, r + 3)).ring(0, 0, r, color, LINE)
    return trim(ink.sprite(0.9), half, half)


@cached
def pointer(player: int, turn: int, wide: int = 0) -> Sprite:
    """Barrel and arrow of a robot at heading `turn` of HEADINGS, `wide` px farther out than usual."""
    return turned(painted(_pointer, (player,)), turn, HEADINGS, ARM + wide)


def _pointer(player: int) -> pygame.Surface:
    ink, color = master(48, ARM), PLAYERS[player]
    near, far = BARREL
    ink.solid([(near - 6, -18), (far, -18), (TIP + 8, 0), (far, 18), (near - 6, 18)])
    ink.line([(near - 6, -9), (far, -7)], color, THIN).line([(near - 6, 9), (far, 7)], color, THIN)
    return ink.neon([(far - 6, -15), (TIP, 0), (far - 6, 15)], color, LINE).sprite(0.8)


@cached
def tag(player: int) -> Sprite:
    """Badge of a player on black."""
    ink = GlowCanvas(96, 96).set_transform(48, 48)
    ink.solid(regular_polygon(40, 32))
    badge(ink, player, 0, -4 if player == 1 else 0, 24)
    return trim(ink.sprite(0.5), 48, 48)
