"""The arcade application: runs the main loop until it is closed. `scenes/start.py` opens its window and devices.

An exception in a scene is logged and the title returns with one sentence: children never see a traceback.
"""

import gc
import logging
import math
import sys
from datetime import datetime
from pathlib import Path
from time import perf_counter

import pygame

from pigaming_app.ai.brain.archive import failed
from pigaming_app.ai.brain_files import display_name
from pigaming_app.ai.plugin_faults import blame, suspect
from pigaming_app.scenes.features.registry import corner_pin, features
from pigaming_app.scenes.flow.scene import Context, Push, Scene, Stack
from pigaming_app.scenes.guard import Guard
from pigaming_app.scenes.launch import Options
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.plugins.found import Plugin
from pigaming_app.storage.plugins.parts import is_running, stopped
from pigaming_app.storage.plugins.time_limit import TookTooLong, Watchdog
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui import memory as heap
from pigaming_app.ui.draw.frame_budget import Unfinished, budget, clock, drop_paused
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.pulse import Pulse
from pigaming_app.ui.widgets.notices import FrameMeter

FPS = 60  # frames per second
MAX_FRAME_GAP = 0.1  # s; longer gaps (a dragged window, a suspended machine) are cut to this
PREWARM_UNTIL = 0.012  # s into a frame after which no more missing sprites are built
MAX_UNFINISHED = 240  # frames after which a picture is completed without a budget
POINTER_IGNORED = 1.0  # s after the start during which pointer motion does not move the focus
MAX_FRAME = 3.0  # s in code of a plug-in until it is ended; the supervisor of a kiosk waits 5 s for a frame
MAX_FAILURES, FAILURE_WINDOW = 5, 10.0  # give up after this many failures, each within this many s of the last

log = logging.getLogger("pigaming")


class App:
    """A running arcade; `troubles` are sentences about damaged files."""

    def __init__(self, options: Options, context: Context, troubles: list[str]) -> None:
        self.options, self.context = options, context
        self.notices, self.meter = context.notices, FrameMeter()
        self.guard = Guard(context)
        self.pulse = Pulse(options.heartbeat) if options.heartbeat else None
        made = (feature.service(context, options) for feature in features() if feature.service)
        self.services = [service for service in made if service]
        context.preloader.on_done = self._preloaded
        for line in troubles:
            log.warning(line)
            print(f"PiGaming: {line}", file=sys.stderr)
        if troubles:
            self.notices.add(context.words("app.settings"))
        self._pin()
        self.frames, self.seconds = 0, 0.0
        self.frozen = False  # whether loaded objects are exempt from garbage collection
        self.shown, self.unfinished = False, 0  # whether a picture was shown yet; frames since the last one
        self.put_off = False  # whether the last frame was spent on the update
        self.failures, self.failed_at = 0, -FAILURE_WINDOW
        self.blamed: Plugin | None = None  # for the last failure
        self.watchdog = Watchdog(MAX_FRAME, is_running)
        self.code = 0
        self.stack = self._first_stack()
        self.previous_ids = self._scene_ids()  # ids of the scenes on the stack in the last frame
        self.to_free = False  # a removed scene is still to be freed

    def loop(self) -> int:
        """The main loop, until the stack is empty. Returns the exit code."""
        with self.watchdog:
            return self._loop()

    def _loop(self) -> int:
        ticker, last = pygame.time.Clock(), perf_counter()
        while self.stack.scenes:
            now = perf_counter()
            seconds = self.options.step or min(now - last, MAX_FRAME_GAP)
            last = now
            if self._frame_failed(seconds) and not self._recover():
                return 1
            if self.pulse:
                self.pulse.beat(self.context.canvas.screen)
            self.frames += 1
            self.seconds += seconds
            if self.frames == 1 and not self.options.headless:
                self.context.sounds.open()
            if self.frames == self.options.frames:
                break
            if self.options.step is None:
                ticker.tick(FPS)
                self.meter.fps = ticker.get_fps()
        return self.code

    def _first_stack(self) -> Stack:
        if self.options.first_scene and self.options.without_title:
            return Stack(self.options.first_scene(self.context))
        stack = Stack(_title(self.context))
        if self.options.first_scene:
            stack.apply(Push(self.options.first_scene(self.context)))
        else:
            self._resume(stack)
        return stack

    def _resume(self, stack: Stack) -> None:
        """Show what was open before a crash, a hang or a power cut."""
        for service in self.services:
            if page := service.first_page():
                stack.apply(Push(page))

    def _preloaded(self) -> None:
        for service in self.services:
            service.preloaded()

    def _pin(self) -> None:
        """Apply the corner pin of the settings."""
        corners = self.context.settings.corners
        try:
            self.context.canvas.pin(corner_pin(corners) if corners else None)
        except OperatorError as trouble:
            log.warning("%s", english().long_sentence(trouble.message))
            self.notices.add(self.context.words("app.pin"))

    def _frame_failed(self, seconds: float) -> bool:
        """Run one frame; true if a scene failed, which is logged."""
        try:
            self.watchdog.beat()
            self._frame(seconds)
        except (Exception, SystemExit, TookTooLong) as error:  # the latter two: by a plug-in
            log.exception("a scene failed")
            before = len(stopped())
            self.blamed = blame(error) or suspect(error)
            self.failures -= len(stopped()) - before  # a plug-in fails once
            return True
        return False

    def compose(self, seconds: float) -> bool:
        """Handle events, advance by `seconds` and draw the next picture; false if there is no new one to show."""
        cpu_start, start = clock(), perf_counter()
        freed = self._free_scenes()
        events = pygame.event.get()
        if any(self._is_close_event(event) for event in events) and not self.context.kiosk:
            self.stack.clear()
            return False
        for service in self.services:
            events = service.filter(events, self.stack.scenes)
        for event in events:
            if event.type == pygame.KEYDOWN:
                self._function_key(event.key)
            elif event.type == pygame.DROPFILE:
                self.context.dropped.append(Path(event.file))
        first = not self.shown
        end = cpu_start + PREWARM_UNTIL if self.options.step is None else math.inf
        with budget.frame(self.unfinished > 0 or freed, end):
            self._dispatch(events, seconds)
            updated = perf_counter()
            if not self.stack.scenes or not self._paint(end):
                return False
        for service in self.services:
            service.draw(self.context.canvas.screen)
        self._draw_notices(self.context.canvas.screen, seconds)
        if not first and not self.options.without_title and self.options.step is None:
            self._preload()
        self.meter.note(seconds, updated - start, perf_counter() - updated)
        return True

    def _paint(self, end: float) -> bool:
        """Draw the top scene; false if it is incomplete at `end`, after which no more missing sprites are built."""
        screen = self.context.canvas.screen
        limited = self.shown and self.unfinished < MAX_UNFINISHED
        try:
            with budget.until(end if limited else math.inf):
                self.put_off = clock() >= end and not self.put_off
                if self.put_off:
                    budget.note()  # the update took the whole frame: build missing sprites in the next one
                self.stack.top.draw(screen)
        except Unfinished:
            screen.set_clip(None)
            self.unfinished += 1
            return False
        self.shown, self.unfinished = True, 0
        return True

    def _preload(self) -> None:
        """Start the preloader while only the title is shown; exempt what it has loaded from garbage collection at once,
        as the title does with all later.
        """
        preloader = self.context.preloader
        if not preloader.begun and len(self.stack.scenes) == 1:
            preloader.start()
        elif preloader.begun and not preloader.busy and not self.frozen:
            self.frozen = True
            gc.freeze()

    def _free_scenes(self) -> bool:
        """Free the scenes removed from the stack, if any. Returns true if garbage was collected.

        Most are in reference cycles, and their canvases of 8 MB each would pile up: Python triggers the collection of
        cycles by the number of objects.
        """
        before, self.previous_ids = self.previous_ids, self._scene_ids()
        if before != self.previous_ids:
            drop_paused()  # what another scene has begun may hold 100 MB
        self.to_free = self.to_free or bool(before - self.previous_ids)
        if not self.to_free or not heap.collect():
            return False
        self.to_free = False
        return True

    def _scene_ids(self) -> frozenset[int]:
        return frozenset(map(id, self.stack.scenes))

    def _frame(self, seconds: float) -> None:
        """Compose one picture and show it."""
        began = perf_counter()
        painted = self.compose(seconds)
        if not self.stack.scenes:
            return
        if painted and self.options.screenshot and self.options.screenshot_due():
            self.code = self._save_screenshot(self.options.screenshot)
            self.stack.clear()
            return
        if painted:
            self.context.canvas.flip()
        for service in self.services:
            service.show(seconds, 1.0 / FPS - (perf_counter() - began), self.stack.scenes)
        if self.options.should_close():
            self.stack.clear()

    def _save_screenshot(self, path: Path) -> int:
        """Save the screenshot. Returns the exit code."""
        try:
            self.context.canvas.screenshot(path)
        except NotSaved as trouble:
            log.warning("%s", trouble)
            print(f"PiGaming: {trouble}", file=sys.stderr)
            return 2
        return 0

    def _is_close_event(self, event: pygame.Event) -> bool:
        """True if an event closes the arcade: with two windows open, SDL sends no QUIT for the first."""
        if event.type == pygame.QUIT:
            return True
        if event.type != pygame.WINDOWCLOSE:
            return False
        services = [service for service in self.services if service.has_window]
        return bool(services) and not any(service.close_if_requested(event) for service in services)

    def _dispatch(self, events: list[pygame.Event], seconds: float) -> None:
        """Dispatch input to the top scene and update it."""
        controls, stack = self.context.controls, self.stack
        presses = [*controls.presses(events), *controls.repeats(seconds)]
        if self.seconds < POINTER_IGNORED:
            presses = [press for press in presses if press.button is not Button.POINT]
        self.context.idle = 0.0 if presses else self.context.idle + seconds
        self.context.settings.keypad = controls.has_keypad
        before = stack.scenes[-1:]
        for press in presses:
            if stack.scenes:
                stack.apply(self.guard.handle(stack.scenes, press))
        if stack.scenes:
            budget.behind = budget.behind or stack.scenes[-1:] != before  # draw a new scene before prewarming
            stack.apply(self.guard.advance(stack.scenes, seconds))
        self.guard.roles.update(seconds, stack.scenes)
        for service in self.services:
            service.update(seconds, stack)

    def _recover(self) -> bool:
        """After a scene has failed: clean up and restart at the title, in a kiosk at the running event. False if that
        is impossible.
        """
        self.context.day_log.note("failure")
        self.context.stop_all_robots()
        self.failures = self.failures + 1 if self.seconds - self.failed_at < FAILURE_WINDOW else 1
        self.failed_at = self.seconds
        if self.failures >= MAX_FAILURES or self.options.without_title or not self.stack.scenes or not self._restart():
            print(f"PiGaming: it cannot go on; {folders().data / 'pigaming.log'} says why.", file=sys.stderr)
            return False
        self.notices.add(self._excuse())
        return True

    def _excuse(self) -> str:
        """The sentence about a failure: which game is left out, or that something went wrong."""
        from pigaming_app.scenes.options.games_page import game_name  # late: the title does not wait for it

        words, plugin = self.context.words, self.blamed
        return words("app.game_failed", game=game_name(words, plugin)) if plugin else words("app.error")

    def _restart(self) -> bool:
        """Reset the canvas and show a new title; false if the title fails, too."""
        try:
            self.stack.clear()
        except Exception:
            log.exception("a scene failed when it was taken off the stack")
        surfaces.clear()  # the failed scene may have drawn on any of them
        self.context.canvas.restore()
        self._pin()
        try:
            self.stack = Stack(_title(self.context))
            if self.failures == 1:
                self._resume(self.stack)
        except Exception:
            log.exception("a scene failed")
            return False
        return True

    def _function_key(self, key: int) -> None:
        """F3 toggles the frame meter; F11 (full screen) and F12 (screenshot) are disabled in a kiosk."""
        context = self.context
        if key == pygame.K_F3:
            self.meter.visible = not self.meter.visible
        elif key == pygame.K_F11 and not context.kiosk:
            context.settings.fullscreen = context.canvas.toggle_fullscreen()
        elif key == pygame.K_F12 and not context.kiosk:
            path = folders().data / "pictures" / f"pigaming-{datetime.now():%Y%m%d-%H%M%S}.png"
            try:
                context.canvas.screenshot(path)
                self.notices.add(f"{context.words('app.picture')}: {path.name}")
            except NotSaved as trouble:
                log.warning("%s", trouble)
                self.notices.add(context.words("app.unsaved"))

    def _draw_notices(self, screen: pygame.Surface, seconds: float) -> None:
        """Draw notices and the frame meter over the scene."""
        if self.context.canvas.notices:
            for line in self.context.canvas.notices:
                log.warning(line)
            self.context.canvas.notices.clear()
            self.notices.add(self.context.words("app.display"))
        while failed:
            self.notices.add(self.context.words("app.brain_failed", brain=display_name(failed.pop())))
        self.notices.draw(screen, seconds)
        self.meter.draw(screen)


def _title(context: Context) -> Scene:
    from pigaming_app.scenes.title.scene import Title  # late: the first picture of `play` and `replay` needs no title

    return Title(context)
