"""Page over a match whose things were moved: it shows where, on the mat. Scan again, or go on as it is."""

import math
from collections.abc import Collection, Sequence
from typing import Protocol

import pygame

from pigaming_app.games.match import Match
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.scan.rig_scan import RigScan
from pigaming_app.hardware.scan.things import LayoutError, ThingLayout
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.hardware.session.things_on_mat import load_layout
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Home, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.mat.things.match_watch import MatchWatch
from pigaming_app.scenes.mat.things.sweep_page import SweepPage
from pigaming_app.scenes.play.pause import Pause, PausedMatch, Robots
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.draw import ALARM, BODY, ICE, LABEL, LINE, MIST, GlowCanvas
from pigaming_app.ui.draw.layers import text
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.labels import blit_sprite

IDLE = 600.0  # s without input until the title
TITLE_Y, HINTS_Y, FOOT_Y = 42, 102, 1060  # px, outside the arena
RADIUS = 76  # px of the rings
HEAD, BELOW = pygame.Rect(0, 0, 1920, 138), pygame.Rect(0, 138, 1920, 942)


class ExaminedRobots(Robots, Protocol):
    """Real robots, as the pages above their match need them."""

    def advance_examined(self, seconds: float) -> None:
        """As `advance_paused`, while the watch examines the picture below it."""

    def apply_pairing(self, channels: Sequence[int], turned: Collection[int]) -> None:
        """Apply a new pairing of radios and robots. `turned`: robots that turned as commanded."""


class InterruptedMatch(PausedMatch, Protocol):
    """A paused match with real robots."""

    match: Match
    access: Access
    plant: MixedPlant
    session: RobotSession
    watch: MatchWatch

    @property
    def robots(self) -> ExaminedRobots:
        """What drives."""

    @property
    def preparing(self) -> bool:
        """True while robots drive to their start positions, and while the countdown runs."""

    @property
    def real(self) -> set[int]:
        """Seats with real robots, including those still driving to their start positions."""

    def set_real(self, seat: int, real: bool) -> None:
        """Hand a seat over to its simulated or its real robot."""

    def rebuild(self, layout: ThingLayout) -> bool:
        """Go on among things that were scanned anew; false if that is impossible."""


class MovedPage:
    """The page. `places`: where things were moved, arena px."""

    def __init__(self, match: InterruptedMatch, places: Sequence[tuple[float, float]]) -> None:
        self.match, self.context, self.places = match, match.context, list(places)
        self.layout: ThingLayout | None = None  # of a new scan, until the match has taken it over
        self.sentence = ""
        self.clock = 0.0
        self.picture: pygame.Surface | None = None
        hints = [(Button.FIRE, "things.hint_again"), (Button.X, "things.hint_as_is"), (Button.START, "pause.hint_menu")]
        self.prompts = self.context.prompts(hints, HINTS_Y, 1600, device=lambda: match.access.hint_device)

    def on_enter(self) -> None:
        self.picture = None
        self.context.hush()
        if self.layout is None:
            self.context.sounds.play("error")

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE scans, X goes on as it is, START and BACK open the menu."""
        event = self.prompts.as_button(event)
        admitted = self.match.access.admit(event)
        if admitted is None:
            return None
        match admitted.button:
            case Button.FIRE:
                return self._scan()
            case Button.X:
                self.context.sounds.play("accept")
                self.match.watch.dismiss()
                return Pop()
            case Button.STOP:
                self.match.plant.safety.all_stop()
            case Button.START | Button.BACK:
                return Swap(Pause(self.match, admitted.device))
        return None

    def update(self, seconds: float) -> StackOperation:
        """Keep all robots still; take over a new scan."""
        self.match.robots.advance_paused(seconds)
        self.clock += seconds
        if self.layout is not None:
            layout, self.layout = self.layout, None
            if self.match.rebuild(layout):
                return Pop()
            self.sentence = self.context.words("things.blocked_match")
        if held := self.match.access.update(seconds):
            return Swap(Pause(self.match, held.device))
        return Home() if self.context.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        words = self.context.words
        if self.picture is None:
            self.picture = self.match.runner.picture()
            self.picture.fill("black", HEAD)
        screen.blit(self.picture, (0, 0))
        text(words("things.moved"), LABEL, ICE, "head", "l", 1600).draw(screen, 176, TITLE_Y)
        self.prompts.draw(screen)
        wave = round(4.0 + 4.0 * math.sin(math.tau * self.clock))
        screen.set_clip(BELOW)
        for x, y in self.places:
            blit_sprite(screen, ring(RADIUS + 2 * wave), LEFT + x, TOP + y)
        screen.set_clip(None)
        if self.sentence:
            caption(self.sentence, ALARM, size=BODY).draw(screen, 960, 540)
        text(words("things.put_back"), 34, MIST, "body", "c", 1600).draw(screen, 960, FOOT_Y)
        self.match.robots.draw_overlay(screen)

    # ---- inside

    def _scan(self) -> StackOperation:
        session, match = self.match.session, self.match
        try:
            before = load_layout(session)
        except LayoutError:
            before = ThingLayout()
        self.sentence = ""
        self.context.sounds.play("accept")
        wait = match.robots.advance_paused
        return Push(SweepPage(self.context, session, match.plant.rig, before, wait, self._scanned))

    def _scanned(self, work: RigScan, layout: ThingLayout | None) -> None:
        self.layout = layout
        if layout is None and work.scan.fault is not None:
            self.sentence = self.context.words.sentence(work.scan.fault)


@cached
def ring(radius: int) -> Sprite:
    """A ring of alarm round a place."""
    half = radius + 24
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    return trim(ink.ring(0, 0, radius, ALARM, LINE).sprite(0.8), half, half)
