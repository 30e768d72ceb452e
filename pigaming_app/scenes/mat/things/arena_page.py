"""Build your arena: things are put on the mat and scanned; their outlines appear where they are.

The page lies on the mat: all texts are above and below the arena, or where no thing is.
"""

import logging
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.scan.rig_scan import RigScan
from pigaming_app.hardware.scan.things import LayoutError, Thing, ThingKind, ThingLayout
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.hardware.session.things_on_mat import load_layout, save_layout
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.mat.session import session_of
from pigaming_app.scenes.mat.things.outlines import COLORS, HALO, draw_thing, frame
from pigaming_app.scenes.mat.things.playable import PlayableArenas
from pigaming_app.scenes.mat.things.steps import draw_steps
from pigaming_app.scenes.mat.things.sweep_page import SweepPage
from pigaming_app.scenes.pages.page import NOWHERE, Hints, Page
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.things.spec import MOST
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LABEL, MIST
from pigaming_app.ui.draw.layers import text, wrap
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.focus import FocusSpot

TITLE_Y, HINTS_Y, FOOT_Y, FOOT_SIZE = 42, 102, 1054, 30  # px, outside the arena
LINE_W, PITCH = 1180, 56  # px, of the sentences on the mat

log = logging.getLogger("pigaming")


class ArenaPage(Page):
    """The page. `devices`: those of the seats, which may act on it; nobody seated: all."""

    idle = 600.0
    prompts_y, prompts_room = HINTS_Y, 1600

    def __init__(self, context: Context, devices: Callable[[], Sequence[Device | None]] = lambda: ()) -> None:
        self.session = session_of(context)
        self.access = Access(context, devices)
        super().__init__(context, gate=self.access)
        self.rig: Rig | None = None
        self.layout, self.changed = ThingLayout(), False
        self.fault: OperatorMessage | None = None
        self.arenas: PlayableArenas | None = None

    def on_enter(self) -> None:
        """Open the camera; also after a scan."""
        if self.rig is not None:
            return
        self.context.sounds.music(None)
        try:
            self.rig = self.session.open()
            self.session.furnish()
            if self.session.ground is None:
                self.fault = OperatorMessage("ros_site")
            elif self.session.printed:
                self.fault = OperatorMessage("printed_scan")
            self._take(load_layout(self.session), False)
        except (RobotsUnavailable, LayoutError) as error:
            log.warning("%s", english().long_sentence(error.message))
            self.fault = error.message

    def on_leave(self) -> None:
        """Save the things; release camera and radio."""
        if self.arenas is not None:
            self.arenas.end()
        self.rig = None
        self.session.close()
        if not self.changed:
            return
        try:
            save_layout(self.session, self.layout)
        except NotSaved as error:
            log.warning("%s", error)
            self.context.sounds.play("error")

    def press(self, event: InputEvent) -> StackOperation:
        """Directions and the mouse select a thing, X removes it, Y changes a flat one; FIRE scans."""
        thing = self.selected
        match event.button:
            case Button.FIRE | Button.START:
                return self._scan()
            case Button.X if thing:
                self._take(self.layout.without(thing), True)
                self.context.sounds.play("back")
            case Button.Y if thing and thing.kind is ThingKind.FLAT:
                self._take(self.layout.replaced(thing, thing.as_mud(not thing.mud)), True)
                self.context.sounds.play("accept")
            case _ if self.focus.handle(event):
                self.context.sounds.play("move")
        return None

    def advance(self, seconds: float) -> StackOperation:
        if self.rig is not None:
            self.session.advance(seconds)
        return None

    def show(self, screen: pygame.Surface) -> None:
        """Draw the arena on black, as it lies on the mat."""
        words, things = self.context.words, self.layout.things
        screen.fill((0, 0, 0))
        frame().draw(screen)
        text(words("things.title"), LABEL, ICE, "head", "l", 1000).draw(screen, 176, TITLE_Y)
        count = words("things.one" if len(things) == 1 else "things.count", count=len(things))
        text(count, LABEL, FOCUS, "head", "r", 560).draw(screen, 1744, TITLE_Y)
        self._draw_things(screen)
        self._draw_lines(screen)
        if thing := self.selected:
            blocks = int(self.focus.name) in self._culprits
            line, color = ("things.blocking_line", ALARM) if blocks else (f"things.{thing.use}_line", MIST)
            text(words(line), FOOT_SIZE, color, "body", "c", 1600).draw(screen, 960, FOOT_Y)
        elif things:
            text(words("things.select"), FOOT_SIZE, MIST, "body", "c", 1600).draw(screen, 960, FOOT_Y)

    @property
    def selected(self) -> Thing | None:
        """The selected thing."""
        return self.layout.things[int(self.focus.name)] if self.layout.things else None

    # ---- inside

    @property
    def _culprits(self) -> set[int]:
        """Indices of the things that are in the way in an arena."""
        return self.arenas.culprits if self.arenas else set()

    @property
    def hints(self) -> Hints:
        thing = self.selected
        change = [] if thing is None else [REMOVE, TURN] if thing.kind is ThingKind.FLAT else [REMOVE]
        return [SCAN, *change, LEAVE]

    def _scan(self) -> StackOperation:
        """Begin a scan, if there is a camera; else try to open it again."""
        if self.rig is None or self.session.ground is None:
            self.on_enter()
        if self.rig is None or self.session.ground is None:
            self.context.sounds.play("error")
            return None
        self.fault = None
        self.context.sounds.play("accept")
        return Push(SweepPage(self.context, self.session, self.rig, self.layout, self.session.advance, self._scanned))

    def _scanned(self, work: RigScan, layout: ThingLayout | None) -> None:
        """Take over the result of a scan."""
        self.fault = work.scan.fault
        if work.scan.left_out:
            self.fault = OperatorMessage("scan_many", count=MOST)
        if layout is not None:
            self._take(layout, True)

    def _take(self, layout: ThingLayout, changed: bool) -> None:
        """Show a layout, and try all arenas with it."""
        self.layout, self.changed = layout, self.changed or changed
        spots = [FocusSpot(str(i), _box(thing)) for i, thing in enumerate(layout.things)]
        self.focus.set_spots(spots or [NOWHERE])
        if self.arenas is not None:
            self.arenas.end()
        radius = self.session.radius(range(ROBOTS))
        self.arenas = PlayableArenas([thing.spec for thing in layout.things], radius) if spots else None

    def _draw_things(self, screen: pygame.Surface) -> None:
        culprits, selected = self._culprits, self.selected
        for i, thing in enumerate(self.layout.things):
            color = FOCUS if thing is selected else ALARM if i in culprits else COLORS[thing.use]
            draw_thing(screen, thing.spec, color, thing is selected)

    def _draw_lines(self, screen: pygame.Surface) -> None:
        """The instructions or a fault, and the games that cannot be played, where no thing is."""
        words, lines = self.context.words, list[tuple[str, tuple[int, int, int]]]()
        if self.fault is not None:
            lines += [(line, ALARM) for line in wrap(words.sentence(self.fault), BODY, LINE_W)]
        elif not self.layout.things:
            draw_steps(screen, words)
        for game, names in self.arenas.blocked.items() if self.arenas else ():
            titles = ", ".join(arena_title(load_cached(game, name), words.language) for name in names)
            sentence = words("things.blocked", game=words(f"games.{game}"), arenas=titles)
            lines += [(line, MIST) for line in wrap(sentence, 34, LINE_W)[:2]]
        if not lines:
            return
        home = pygame.Rect(960 - LINE_W // 2, 0, LINE_W, PITCH * len(lines))
        home.centery = 590
        boxes = [_box(thing) for thing in self.layout.things]
        places = (home.move(dx, dy) for dx in (0, -210, 210) for dy in range(0, 400, 20) for dy in (dy, -dy))
        x, y = next((place for place in places if place.collidelist(boxes) < 0), home).topleft
        for i, (line, color) in enumerate(lines):
            size = BODY if color != MIST else 34
            text(line, size, color, "body", "c", LINE_W).draw(screen, x + LINE_W // 2, y + PITCH * i + PITCH // 2)


SCAN, LEAVE = (Button.FIRE, "things.hint_scan"), (Button.BACK, "things.hint_leave")
REMOVE, TURN = (Button.X, "things.hint_remove"), (Button.Y, "things.hint_turn")


def _box(thing: Thing) -> pygame.Rect:
    """The box of a thing with its halo, on the canvas."""
    outline = thing.grown(thing.margin_px + HALO)
    left, top = outline.min(axis=0).tolist()
    right, bottom = outline.max(axis=0).tolist()
    return pygame.Rect(round(LEFT + left), round(TOP + top), round(right - left), round(bottom - top))
