"""Runs a match on the screen: real time in, ticks, pictures and sounds out.

Shared by matches, demonstrations and replays; input and drivers belong to the scene.
"""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager

import pygame

from pigaming_app.ai.game_ai import TURN
from pigaming_app.games.match import Match
from pigaming_app.scenes.features.registry import match_overlay
from pigaming_app.scenes.flow.driving import PICTURES
from pigaming_app.scenes.flow.match_words import brain_name, steering
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.play.last_hit import LastHit
from pigaming_app.scenes.results.awards.feats import FeatRecorder
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.hud.ai_sign import name_of
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.rumble import Rumble
from pigaming_app.scenes.views.view import ShownEffects, SoundCue
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH
from pigaming_app.ui.draw import BODY, PLAYERS
from pigaming_app.ui.draw.layers import fit_text
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.keyboard import NUM
from pigaming_app.ui.widgets.caption import Caption, Notice, caption

PAUSED_BRIGHTNESS = 72  # of 255: brightness of a match behind a page
TICK_SOUNDS = 10  # seconds at the end with a tick sound each
FINALE = 20.0  # seconds at the end with the finale of the theme
NOTICE_AT = (960, 206)  # centre of a notice, on the canvas
NAME_ROOM = 300  # px, of a name in a caption
CAPTION_GAP = 104  # px from a robot to its caption
HINT_ROOM = 140.0  # px below a robot that a hint needs
TOP_SIGNS, SIGN_ROOM = 260.0, 110  # px from the upper edge, above which signs are below a robot; px that they take
ARENA = pygame.Rect(LEFT + 24, TOP, int(WIDTH) - 48, int(HEIGHT))
GAP = 8  # px between a robot and its box


class MatchRunner:
    """A match and its view. `loud`: play its sounds. `rumble`: called for each seat whose player feels an event.

    `names`: of the entrants on the first seats, in an event; else those that people have given their phones.
    """

    def __init__(
        self,
        context: Context,
        match: Match,
        loud: bool = True,
        rumble: Callable[[int, Rumble], None] = lambda seat, rumble: None,
        names: Sequence[str] = (),
    ) -> None:
        self.context, self.match, self.loud, self.rumble = context, match, loud, rumble
        self.names, self._entrants = names, bool(names)
        self.players = [seat.brain for seat in match.setup.seats]  # the driver of each seat; may be changed
        kind = SCREENS[match.setup.game].view
        with self._tag_sprites():
            self.view = kind(match.arena, match.state, self.players, ShownEffects(context.settings), context.words)
        if names:
            self.view.show_names(names)
        self.notice = Notice(NOTICE_AT)
        self.brain = match_overlay(match, self.view, context.words)
        self.timestep = FixedTimestep()
        self.feats = FeatRecorder()
        self.things: Sequence[ThingSpec] = match.arena.things  # in the view
        self.second = TICK_SOUNDS + 1
        self.last_lap = False  # of the first in a race, whose end no clock tells
        self.last_hit: LastHit | None = None  # recorder, if the scene repeats the last hit

    def sit(self, seat: int, device: Device | None) -> None:
        """Show the name of who drives a seat from now on; entrants keep theirs."""
        name = self.context.controls.owner(device)
        if not self._entrants and name != name_of(self.names, seat):
            self.names = [name if i == seat else name_of(self.names, i) for i in range(len(self.players))]
            self.view.show_names(self.names)

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm sprites for up to `milliseconds`; true when done."""
        with self._tag_sprites():
            return bool(self.view.prewarm(milliseconds))

    def advance(self, seconds: float, speed: float = 1.0) -> None:
        """Advance the match by `seconds` of real time."""
        self.view.undrawn += seconds
        for _ in range(self.timestep.due(seconds, speed)):
            if self.match.over:
                break
            for name, player, x in self.tick():
                if self.loud:
                    self.context.sounds.play(name, player, max(-1.0, min(1.0, 2.0 * x / WIDTH - 1.0)))
                    self.last_lap = self.last_lap or (name == "last_lap" and self.match.game.timed)
            for seat, rumble in self.view.rumbles.items():
                self.rumble(seat, rumble)
        self._count_down()

    def tick(self) -> list[SoundCue]:
        """Play one tick; returns its sounds."""
        self.match.tick()
        self.feats.watch(self.match)
        if self.last_hit:
            self.last_hit.record(self.match.state)
        with self._tag_sprites():
            return list(self.view.watch(self.match.state))

    def wait(self, seconds: float) -> None:
        """Advance only the effects of the view: the match is halted."""
        self.view.undrawn += seconds

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match, interpolated between its last two ticks."""
        things: Sequence[ThingSpec] | None = getattr(self.match.plant, "shown_things", None)  # that may move
        if things is not None and things is not self.things:
            self.things = things
            self.view.show_things(things)
        blend = 1.0 if self.match.over else self.timestep.blend
        undrawn, self.view.undrawn = self.view.undrawn, 0.0
        with self._tag_sprites():
            self.view.draw(screen, self.match.state, blend, undrawn)
            if self.brain:
                self.brain.draw(screen, blend, undrawn)

    def picture(self) -> pygame.Surface:
        """The current match, darkened, as drawn behind a page."""
        canvas = pygame.Surface((1920, 1080))
        self.draw(canvas)
        canvas.fill((PAUSED_BRIGHTNESS, PAUSED_BRIGHTNESS, PAUSED_BRIGHTNESS), special_flags=pygame.BLEND_RGB_MULT)
        return canvas

    def next_brain(self) -> None:
        """Show the thoughts of the next AI, after the last none; show a notice if there is no AI."""
        if self.brain and not self.brain.seats:
            self.notice.show(caption(self.context.words("brain.nobody"), sign="ai"))
        elif self.brain:
            self.brain.next()

    def robots(self) -> list[tuple[float, float]]:
        """Positions of the robots on the canvas."""
        return [(LEFT + robot.x, TOP + robot.y) for robot in self.match.state.robots if robot.present]

    def draw_captions(self, screen: pygame.Surface, devices: Sequence[Device | None]) -> None:
        """Draw the driver's caption beside each robot."""
        for sheet, box in self._captions(devices):
            sheet.draw(screen, *box.center)

    def occupied(self, devices: Sequence[Device | None]) -> list[pygame.Rect]:
        """The boxes of the robots and their captions, on the canvas."""
        return [*robot_boxes(self.robots(), self.match.state.radius), *(box for _, box in self._captions(devices))]

    def _captions(self, devices: Sequence[Device | None]) -> list[tuple[Caption, pygame.Rect]]:
        """The driver's caption of each robot, and its box."""
        seats = [seat for seat, robot in enumerate(self.match.state.robots) if robot.present]
        captions = [self._caption(seat, devices[seat]) for seat in seats]
        sizes = [(sheet.width, sheet.height) for sheet in captions]
        reach = [self.view.reach(seat, CAPTION_GAP) for seat in seats]
        return list(zip(captions, caption_boxes(self.robots(), sizes, reach, self.match.state.radius), strict=True))

    def _caption(self, seat: int, device: Device | None) -> Caption:
        """Who drives: the name of an entrant, for a person with the device."""
        driver, sign = self.driver(seat, device)
        if name := name_of(self.names, seat):
            name = fit_text(name, BODY, NAME_ROOM, "body", BODY)[0]
            driver = f"{name}  ·  {driver}" if device and self._entrants else name
        return caption(driver, PLAYERS[seat], sign=sign)

    def draw_beside(self, screen: pygame.Surface, seat: int, sheet: Caption) -> None:
        """Draw a caption above or below a robot, where the arena has more room."""
        robot = self.match.state.robots[seat]
        margin = LEFT + 24 + sheet.width / 2
        x = min(max(LEFT + robot.x, margin), 1920 - margin)
        offset = self.view.reach(seat, CAPTION_GAP)
        sheet.draw(screen, x, TOP + robot.y + (offset if robot.y < HEIGHT / 2 else -offset))

    def draw_hints(self, screen: pygame.Surface, devices: Sequence[Device | None]) -> None:
        """Draw hints of the view for seats of people, with the name of their button, clear of the signs over robots."""
        words, controls = self.context.words, self.context.controls
        for seat, key in self.view.hints.items():
            if device := devices[seat]:
                label = words.key_name(controls.label(device, Button.FIRE))
                sheet = caption(words(key, button=label), PLAYERS[seat], player=seat, face="head")
                robot, gap = self.match.state.robots[seat], self.view.reach(seat, CAPTION_GAP)
                margin = LEFT + 24 + sheet.width / 2
                x = min(max(LEFT + robot.x, margin), 1920 - margin)
                if robot.y > HEIGHT - HINT_ROOM:
                    gap = -gap - SIGN_ROOM
                elif robot.y < TOP_SIGNS:
                    gap += SIGN_ROOM
                sheet.draw(screen, x, TOP + robot.y + gap)

    def driver(self, seat: int, device: Device | None) -> tuple[str, str]:
        """Name and icon of a seat's driver; the icon of a person who does not steer is that of the driving style."""
        words = self.context.words
        if device:
            style = self.context.driving.of(device, self.match.setup.game)
            controls = self.context.controls
            sign = controls.sign(device) if style == TURN else PICTURES[style]
            moves = steering(words, controls, device)
            if device.has_stick:
                return moves, sign
            steer = words("match.arrows") if "←" in moves else moves
            return f"{steer} + {words.key_name(controls.label(device, Button.FIRE).removeprefix(NUM))}", sign
        brain = self.players[seat]
        if brain == "human":
            return words("match.player", player=seat + 1), "pad"
        return brain_name(words, self.match.setup.game, brain), "ai"

    def _tag_sprites(self) -> AbstractContextManager[None]:
        """Tag new sprites with the game, to release them when the title returns."""
        return surfaces.made_for(self.match.setup.game)

    def _count_down(self) -> None:
        if self.loud and (self.last_lap or self.match.seconds_left <= FINALE):
            self.context.sounds.finale()
        second = int(self.match.seconds_left) + 1
        if second < self.second and second <= TICK_SOUNDS and not self.match.over and self.loud:
            self.context.sounds.play("tick")
        self.second = second


def robot_boxes(robots: Sequence[tuple[float, float]], radius: float = RADIUS) -> list[pygame.Rect]:
    """The box of each robot. `robots`: positions on the canvas, px."""
    half = round(radius) + GAP
    return [pygame.Rect(round(x) - half, round(y) - half, 2 * half, 2 * half) for x, y in robots]


def caption_boxes(
    robots: Sequence[tuple[float, float]],
    sizes: Sequence[tuple[int, int]],
    reach: Sequence[float],
    radius: float = RADIUS,
) -> list[pygame.Rect]:
    """The box of each robot's caption, on the canvas, px.

    `robots`: positions on the canvas; `sizes`: width and height of each caption; `reach`: vertical distance of each
    caption from its robot. A caption is above or below its robot, where the arena has more room, unless it would cover
    another caption or robot there and less of them at another side.
    """
    bodies = robot_boxes(robots, radius)
    placed: list[pygame.Rect] = []
    for (x, y), size, offset in zip(robots, sizes, reach, strict=True):
        near = offset if y < TOP + HEIGHT / 2 else -offset
        beside = round(radius) + GAP + 12 + size[0] / 2
        side = beside if x < LEFT + WIDTH / 2 else -beside
        shifts = ((0, near), (0, -near), (side, 0), (-side, 0), (0, near + near / abs(near) * size[1]))
        boxes = []
        for dx, dy in shifts:
            box = pygame.Rect((0, 0), size)
            box.center = round(x + dx), round(y + dy)
            boxes.append(box.clamp(ARENA))
        placed.append(min(boxes, key=lambda box: sum(_overlap(box, other) for other in (*placed, *bodies))))
    return placed


def _overlap(box: pygame.Rect, other: pygame.Rect) -> int:
    common = box.clip(other)
    return common.w * common.h
