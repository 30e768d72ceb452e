"""Start positions of real robots: targets, driving progress and instructions for manual help.

The mat is lit evenly until every robot has been seen; then it is dark except for outlines, arrows and discs.
"""

import math
from collections.abc import Callable

import pygame

from pigaming_app.hardware.control.homing import HomingProgress
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.safety import Fault
from pigaming_app.hardware.session.robot_session import cause_of
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.mat.robots.fault_page import fault_caption, fault_sentence
from pigaming_app.scenes.mat.robots.flood_light import UNSEEN as UNSEEN_AFTER
from pigaming_app.scenes.mat.robots.flood_light import FloodLight, hint_line, looking
from pigaming_app.scenes.mat.robots.marker_discs import MOAT, RING, pointer, tag
from pigaming_app.scenes.mat.things.outlines import frame
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.world import HEIGHT, RADIUS
from pigaming_app.ui.draw import (
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LABEL,
    LINE,
    MIST,
    PLAYERS,
    GlowCanvas,
    dim,
)
from pigaming_app.ui.draw.layers import LitImage, text
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, master, painted, step, turned
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.labels import blit_sprite

UNSEEN = 1e6  # px, distance of an unseen robot
DASH, MARCH = 40.0, 60.0  # px between dashes, px/s
TITLE_Y, HINTS_Y = 42, 102  # px
BESIDE = 150  # px from an outline to its caption
CARRIED = ("lost", "held", "outside")  # faults that are normal while robots are carried to their places
MISSING = 1.5  # s before a missing robot is reported
READ = 4.0  # s for which each of two sentences about stops is shown


class TakePlaces:
    """Display while the robots of a plant drive to their start positions."""

    INPUT_LOCKOUT = 0.6  # s during which a start is ignored, because the previous press may be hammered

    def __init__(self, context: Context, plant: MixedPlant, device: Callable[[], Device]) -> None:
        self.context, self.plant = context, plant
        self.clock = 0.0
        self.flood = FloodLight(context)
        self.prompts = context.prompts(
            [(Button.START, "mat.hint_begin"), (Button.X, "mat.hint_missing"), (Button.BACK, "mat.hint_leave")],
            HINTS_Y, 1560, device=device,
        )  # fmt: skip

    def update(self, seconds: float) -> None:
        self.clock += seconds
        self.flood.update(seconds, bool(self.missing))

    @property
    def missing(self) -> list[int]:
        """Participating robots that are not visible."""
        seen = self.plant.rig.sense()
        return [robot for robot in sorted(self.plant.real | self.plant.arriving) if seen[robot].age > UNSEEN_AFTER]

    @property
    def stuck(self) -> list[int]:
        """Robots that cannot reach their start positions on their own."""
        troubled = {fault.robot for fault in self.plant.faults if fault.pauses}
        late = [place for place in self.plant.places if not place.arrived]
        return [place.robot for place in late if not place.moving or {None, place.robot} & troubled]

    def draw(self, screen: pygame.Surface) -> None:
        """Draw outlines, paths and captions; the discs are drawn on top by the caller."""
        words, places = self.context.words, self.plant.places
        if self.flood.full:
            hints = hint_line(self.prompts.labels)
            faults = [fault_sentence(fault, words, "") for fault in self._faults()]
            self.flood.draw(screen, " ".join(faults[:1]) or looking(words, self.missing), hints)
            return
        screen.fill((0, 0, 0))
        frame().draw(screen)
        seen = self.plant.rig.sense()
        for place in places:
            self._outline(screen, place)
            if not place.arrived and place.distance < UNSEEN:
                self._draw_path(screen, place, (LEFT + seen[place.robot].x, TOP + seen[place.robot].y))
        for place in places:
            self._caption(screen, place)
        there = sum(place.arrived for place in places)
        text(words("mat.places"), LABEL, ICE, "head", "l", 900).draw(screen, 176, TITLE_Y)
        if places:
            progress = words("mat.there", there=there, all=len(places))
            text(progress, LABEL, FOCUS, "head", "r", 560).draw(screen, 1744, TITLE_Y)
        self.prompts.draw(screen)
        stops = "mat.all_stop" if self.clock % (2.0 * READ) < READ else "mat.switches"
        text(words(stops), 34, MIST, "body", "c", 1500).draw(screen, 960, 1060)
        for i, fault in enumerate(self._faults()[:2]):
            cause = cause_of(self.plant.rig, fault.name)
            sentence = words.sentence(cause) if cause else fault_sentence(fault, words, "")
            fault_caption(sentence, ALARM).draw(screen, 960, 540 + 90 * i)
        self.flood.draw(screen, "")

    def _faults(self) -> list[Fault]:
        """Current faults, except those that are normal while robots are carried."""
        return [fault for fault in self.plant.faults if fault.pauses and fault.name not in CARRIED]

    def _outline(self, screen: pygame.Surface, place: HomingProgress) -> None:
        x, y, heading = place.pose
        color = place.robot
        level = 8 if place.arrived else round(6 + 2 * math.cos(math.tau * self.clock))
        wide = round(self.plant.world.radius - RADIUS)
        outline(color, place.arrived, wide).draw(screen, LEFT + x, TOP + y, 1.0 if level > 0 else 0.0)
        blit_sprite(screen, pointer(color, step(heading, HEADINGS), wide), LEFT + x, TOP + y)
        if place.distance > 2 * MOAT:
            blit_sprite(screen, tag(color), LEFT + x, TOP + y)

    def _draw_path(self, screen: pygame.Surface, place: HomingProgress, at: tuple[float, float]) -> None:
        """Draw moving dashes from a robot to its place."""
        goal = LEFT + place.pose[0], TOP + place.pose[1]
        turn = math.atan2(goal[1] - at[1], goal[0] - at[0])
        along, end = RING + 20.0 + self.clock * MARCH % DASH, math.dist(at, goal) - RING - 16.0
        while along < end:
            blit_sprite(
                screen,
                dash(place.robot, step(turn, HEADINGS), place.moving),
                at[0] + along * math.cos(turn),
                at[1] + along * math.sin(turn),
            )
            along += DASH

    def _caption(self, screen: pygame.Surface, place: HomingProgress) -> None:
        """Caption with the manual action for a robot that cannot drive there itself."""
        words, robot = self.context.words, place.robot
        if place.arrived or place.moving or self.clock < MISSING:
            return
        key = "mat.carry" if place.distance > UNSEEN else "mat.waits"
        sheet = caption(words(key, robot=robot + 1), PLAYERS[robot], size=BODY, player=robot)
        margin = LEFT + 12 + sheet.width / 2
        x = min(max(LEFT + place.pose[0], margin), 1920 - margin)
        y = TOP + place.pose[1]
        sheet.draw(screen, x, y + (BESIDE if y < TOP + HEIGHT / 2 else -BESIDE))


@cached
def outline(player: int, there: bool, wide: int = 0) -> LitImage:
    """Target outline, centred on (0, 0): dashed, solid once the robot is there; `wide` px wider than usual."""
    r = RING + wide
    half = r + 24
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    if there:
        ink.ring(0, 0, r, PLAYERS[player], LINE)
    else:
        points = [(r * math.cos(i * math.tau / 64), r * math.sin(i * math.tau / 64)) for i in range(64)]
        ink.dashes(points, PLAYERS[player], LINE, 24, 16)
    return LitImage(ink.lit(0.8), (-half, -half))


@cached
def dash(player: int, turn: int, moving: bool) -> Sprite:
    """Arrowhead at heading `turn` of HEADINGS."""
    return turned(painted(_dash, (player, moving)), turn, HEADINGS)


def _dash(player: int, moving: bool) -> pygame.Surface:
    color = PLAYERS[player] if moving else dim(MIST, 0.7)
    return master(24).line([(-8, -12), (6, 0), (-8, 12)], color, LINE).sprite(0.5)
