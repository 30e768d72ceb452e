"""The arcade itself: open everything, then events, presses, scenes, pictures, until somebody closes it.

A mistake in a scene is written to the log and the title comes back with one sentence: a child never sees a traceback.
"""

import faulthandler
import gc
import logging
import math
import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from time import perf_counter
from typing import IO, Any

import pygame

from pigaming_app.hardware.messages import OperatorError
from pigaming_app.hardware.session.emulated import EmulatedSession
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.camera_window import CameraWindow
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Push, Scene, Stack
from pigaming_app.storage.log import log_file, require_file
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui import memory as heap
from pigaming_app.ui.draw.frame_budget import Unfinished, budget, clock
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import Words, english
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.widgets.notices import FrameMeter, Notices
from pigaming_app.ui.window import Canvas

FRAMES = 60  # a second
SLOWEST = 0.1  # s; whatever took longer (a dragged window, a machine asleep) did not happen
PAINTING = 0.012  # s of a frame after which no missing piece is begun
LATEST = 240  # frames after which a picture is completed at once, however long that takes
SETTLING = 1.0  # s after the start in which a pointer that merely lies there does not take the focus
TROUBLES, QUIET = 5, 10.0  # so many failures, each within so many s of the one before: the arcade gives up

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Options:
    """What the command line may ask of the arcade. `frames`: close after so many; `shot`: a picture, taken when due."""

    first: Callable[[Context], Scene] | None = None  # a scene on top of the title
    alone: bool = False  # close when that scene has gone
    kiosk: bool = False
    display: int | None = None
    headless: bool = False
    frames: int | None = None
    shot: Path | None = None
    shot_due: Callable[[], bool] = lambda: True
    step: float | None = None  # s of made-up time for each frame, instead of real time
    over: Callable[[], bool] = lambda: False  # whether to close after this picture
    emulate: int | None = None  # the seed of an emulated arena that stands in for the mat
    chosen: Mapping[str, object] = field(default_factory=dict)  # settings, which are kept


def run(options: Options) -> int:
    """Open the arcade and stay until it is closed; the exit code. Raises NoDisplay."""
    with opened(options) as app:
        try:
            return app.loop()
        except KeyboardInterrupt:
            return 0


@contextmanager
def opened(options: Options) -> "Iterator[App]":
    """The arcade with its window and devices; afterwards all is closed and the settings are saved. Raises NoDisplay."""
    heap.return_large_blocks()
    where = folders()
    settings, said = Settings.load(where.config)
    scores, more = Scores.load(where.data)
    for name, value in options.chosen.items():
        settings.choose(name, value)
    windowed = options.headless or options.emulate is not None  # beside the window of the emulated camera
    canvas = Canvas.open(settings, options.display, False if windowed else None, options.headless)
    crash_file = _keep_log(where.data)
    pygame.font.init()
    context = Context(settings, scores, Words(settings.language), Controls(canvas.at), Sounds(), canvas, options.kiosk)
    context.sounds.volume(settings.music, settings.sounds)
    context.session = session = _session(options, settings, canvas)
    context.emergency_stops.append(session.close)
    context.preloader.then = context.compiler.start
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)  # a supervisor ends it as Ctrl+C does
    try:
        yield App(options, context, [*said, *more])
    finally:
        signal.signal(signal.SIGTERM, before)
        context.stop_all_robots()
        context.preloader.end()
        context.compiler.end()
        gc.unfreeze()
        session.end()
        context.sounds.close()
        _keep(settings, where.config)
        if scores.unsaved:
            _keep(scores, where.data)
        canvas.close()
        _close_log(crash_file)


class App:
    """A running arcade; `troubles` are sentences about what was wrong with its files."""

    def __init__(self, options: Options, context: Context, troubles: list[str]) -> None:
        self.options, self.context = options, context
        self.notices, self.gauge = Notices(), FrameMeter()
        session = context.session
        self.window = CameraWindow(session) if isinstance(session, EmulatedSession) and session.live else None
        for line in troubles:
            log.warning(line)
            print(f"PiGaming: {line}", file=sys.stderr)
        if troubles:
            self.notices.say(context.words("app.settings"))
        self._pin()
        self.frames, self.seconds = 0, 0.0
        self.exempt = False  # whether what was loaded is left out by the garbage collector
        self.shown, self.unfinished = False, 0  # whether there was a picture; frames since in which there was none
        self.failures, self.failed_at = 0, -QUIET
        self.code = 0
        self.stack = self._begin()
        self.lying = self._lying()  # which scenes lay on the stack in the last frame
        self.left = False  # whether one that has left is still to be freed

    def loop(self) -> int:
        """Frame after frame, until no scene is left; the exit code."""
        ticker, last = pygame.time.Clock(), perf_counter()
        while self.stack.scenes:
            now = perf_counter()
            seconds = self.options.step or min(now - last, SLOWEST)
            last = now
            if self._failed(seconds) and not self._recovered():
                return 1
            self.frames += 1
            self.seconds += seconds
            if self.frames == 1 and not self.options.headless:
                self.context.sounds.open()
            if self.frames == self.options.frames:
                break
            if self.options.step is None:
                ticker.tick(FRAMES)
                self.gauge.fps = ticker.get_fps()
        return self.code

    def _begin(self) -> Stack:
        if self.options.first and self.options.alone:
            return Stack(self.options.first(self.context))
        stack = Stack(_title(self.context))
        if self.options.first:
            stack.turn(Push(self.options.first(self.context)))
        return stack

    def _pin(self) -> None:
        """Draw the picture into the corners that the operator has set."""
        corners = self.context.settings.corners
        if not corners:
            self.context.canvas.pin(None)
            return
        from pigaming_app.hardware.calibration.corner_pin import CornerPin

        try:
            self.context.canvas.pin(CornerPin(corners))
        except OperatorError as trouble:
            log.warning("%s", english().explained(trouble.message))
            self.notices.say(self.context.words("app.pin"))

    def _failed(self, seconds: float) -> bool:
        """Show one picture; whether a scene failed at it, which goes to the log."""
        try:
            self._frame(seconds)
        except Exception:
            log.exception("a scene failed")
            return True
        return False

    def compose(self, seconds: float) -> bool:
        """Handle events, let `seconds` pass and paint the next picture; false: there is no new one to show."""
        began, started = clock(), perf_counter()
        freed = self._free_scenes()
        events = pygame.event.get()
        if any(self._closes(event) for event in events) and not self.context.kiosk:
            self.stack.clear()
            return False
        for event in events:
            if event.type == pygame.KEYDOWN:
                self._function_key(event.key)
        first = not self.shown
        with budget.frame(self.unfinished > 0 or freed):
            self._play(events, seconds)
            played = perf_counter()
            if not self.stack.scenes or not self._paint(began):
                return False
        self._say(self.context.canvas.screen, seconds)
        if not first and len(self.stack.scenes) == 1 and not self.options.alone and self.options.step is None:
            self._prepare()
        self.gauge.note(seconds, played - started, perf_counter() - played)
        return True

    def _paint(self, began: float) -> bool:
        """Paint the top scene in what is left of a frame that has begun then; false: it is not complete yet."""
        screen = self.context.canvas.screen
        limited = self.options.step is None and self.shown and self.unfinished < LATEST
        try:
            with budget.until(began + PAINTING if limited else math.inf):
                if not self.unfinished and clock() >= began + PAINTING:
                    budget.note()  # the scene has used the frame: pieces can wait for the next one
                self.stack.top.draw(screen)
        except Unfinished:
            screen.set_clip(None)
            self.unfinished += 1
            return False
        self.shown, self.unfinished = True, 0
        return True

    def _prepare(self) -> None:
        """While the title is shown alone: begin the work behind it, and when that is done, exempt all that is there now
        from the collection of garbage. It stays, and looking through it would take 15 ms whenever a scene is freed."""
        preloader = self.context.preloader
        if not preloader.begun:
            preloader.start()
        elif not preloader.busy and not self.exempt:
            self.exempt = True
            gc.collect()
            gc.freeze()

    def _free_scenes(self) -> bool:
        """Free the scenes that have been taken off the stack, if there are any. Most are in reference cycles, whose
        canvases of 8 MB each would pile up: Python collects cycles by the number of objects."""
        before, self.lying = self.lying, self._lying()
        self.left = self.left or bool(before - self.lying)
        if not self.left or not heap.collect():
            return False
        self.left = False
        return True

    def _lying(self) -> frozenset[int]:
        return frozenset(map(id, self.stack.scenes))

    def _frame(self, seconds: float) -> None:
        """Compose one picture and show it."""
        painted = self.compose(seconds)
        if not self.stack.scenes:
            return
        if painted and self.options.shot and self.options.shot_due():
            self.code = self._shoot(self.options.shot)
            self.stack.clear()
            return
        if painted:
            self.context.canvas.flip()
        if self.window:
            self.window.update(seconds)
        if self.options.over():
            self.stack.clear()

    def _shoot(self, path: Path) -> int:
        """Save the picture that was asked for; the exit code."""
        try:
            self.context.canvas.screenshot(path)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            print(f"PiGaming: {trouble}", file=sys.stderr)
            return 2
        return 0

    def _closes(self, event: pygame.Event) -> bool:
        """Whether an event closes the arcade: with a second window, closing the first one no longer says QUIT."""
        if event.type == pygame.QUIT:
            return True
        if self.window is None or self.window.asked(event):
            return False
        return event.type == pygame.WINDOWCLOSE

    def _play(self, events: list[pygame.Event], seconds: float) -> None:
        """Let the scenes hear what was pressed, and let time pass for the top one."""
        controls, stack = self.context.controls, self.stack
        presses = [*controls.presses(events), *controls.repeats(seconds)]
        if self.seconds < SETTLING:
            presses = [press for press in presses if press.button is not Button.POINT]
        self.context.idle = 0.0 if presses else self.context.idle + seconds
        before = stack.scenes[-1:]
        for press in presses:
            if stack.scenes:
                stack.turn(stack.top.on(press))
        if stack.scenes:
            budget.behind = budget.behind or stack.scenes[-1:] != before  # what has just come is painted first
            stack.turn(stack.top.update(seconds))

    def _recovered(self) -> bool:
        """After a scene has failed: undo all that it may have left behind and begin again at the title; false: it is
        hopeless."""
        self.context.stop_all_robots()
        self.failures = self.failures + 1 if self.seconds - self.failed_at < QUIET else 1
        self.failed_at = self.seconds
        if self.failures >= TROUBLES or self.options.alone or not self.stack.scenes or not self._begun_again():
            print(f"PiGaming: it cannot go on; {folders().data / 'pigaming.log'} says why.", file=sys.stderr)
            return False
        self.notices.say(self.context.words("app.error"))
        return True

    def _begun_again(self) -> bool:
        """A new title on a clean screen; false if the title fails, too."""
        try:
            self.stack.clear()
        except Exception:
            log.exception("a scene failed when it was taken off the stack")
        surfaces.clear()  # any of them may have been painted on
        self.context.canvas.restore()
        self._pin()
        try:
            self.stack = Stack(_title(self.context))
        except Exception:
            log.exception("a scene failed")
            return False
        return True

    def _function_key(self, key: int) -> None:
        """F3 shows numbers; F11 and F12 change the window and take a picture, but not in a kiosk."""
        context = self.context
        if key == pygame.K_F3:
            self.gauge.visible = not self.gauge.visible
        elif key == pygame.K_F11 and not context.kiosk:
            context.settings.fullscreen = context.canvas.toggle_fullscreen()
        elif key == pygame.K_F12 and not context.kiosk:
            path = folders().data / "pictures" / f"pigaming-{datetime.now():%Y%m%d-%H%M%S}.png"
            try:
                context.canvas.screenshot(path)
                self.notices.say(f"{context.words('app.picture')}: {path.name}")
            except NotSaved as trouble:
                log.warning("%s", trouble)
                self.notices.say(context.words("app.unsaved"))

    def _say(self, screen: pygame.Surface, seconds: float) -> None:
        """Paint what has to be said over any scene."""
        if self.context.canvas.notices:
            for line in self.context.canvas.notices:
                log.warning(line)
            self.context.canvas.notices.clear()
            self.notices.say(self.context.words("app.display"))
        self.notices.draw(screen, seconds)
        self.gauge.draw(screen)


def _session(options: Options, settings: Settings, canvas: Canvas) -> EmulatedSession | RealSession:
    """Where real robots drive."""
    if options.emulate is None:
        return RealSession(settings, lambda: canvas.projection)
    session = EmulatedSession(options.emulate, options.step is None, lambda: canvas.projection)
    canvas.watchers.append(lambda window: session.show(lambda: _projected(canvas, window)))
    print("PiGaming: the emulated arena is being set up.", file=sys.stderr)
    settings.real = settings.real or [1, 2, 3, 4]
    try:
        session.open()  # now, while nobody waits for a picture; it is closed until somebody plays
        session.close()
    except RobotsUnavailable as trouble:
        print(f"PiGaming: {english().explained(trouble.message)}", file=sys.stderr)
    return session


def _projected(canvas: Canvas, window: pygame.Surface) -> object:
    """The pixels that fall on the emulated mat: bars beside the picture do not, but a pinned picture has its own."""
    from pigaming_app.ui.draw.pixels import pixels_of

    return pixels_of(window if canvas.corners else canvas.screen)


def _title(context: Context) -> Scene:
    from pigaming_app.scenes.title.scene import Title  # what `play` and `replay` show first need not wait for it

    return Title(context)


def _keep(kept: Settings | Scores, folder: Path) -> None:
    try:
        kept.save(folder)
    except NotSaved as trouble:
        log.warning("%s", trouble)
        print(f"PiGaming: {trouble}", file=sys.stderr)


def _keep_log(data: Path) -> "IO[Any] | None":
    """Write a log into the data folder, and where the interpreter itself crashes, where it was; none if that fails."""
    try:
        log.handlers[:] = [log_file(data)]
        log.propagate = False
        require_file(data / "crash.log")
        crash_file = (data / "crash.log").open("a", encoding="utf-8")
    except OSError as trouble:
        print(f"PiGaming: {data} cannot be written: {describe_error(trouble)}. There is no log.", file=sys.stderr)
        return None
    faulthandler.enable(crash_file)
    return crash_file


def _close_log(crash_file: "IO[Any] | None") -> None:
    for handler in log.handlers:
        handler.close()
    log.handlers.clear()
    log.propagate = True
    if crash_file:
        faulthandler.disable()
        crash_file.close()
