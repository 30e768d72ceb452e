"""Fault page: the match waits while a real robot has a fault; shows the fault in one sentence and the available
actions.

The page closes as soon as the fault is gone. While a robot is out of sight, floodlight takes its place now and then:
in a dark room nothing else lights a marker. The person who pressed the stop button holds FIRE to release it. If robots
do not follow their commands because a thing was pushed in their way, the page of moved things takes its place.
"""

import pygame

from pigaming_app.hardware.control.safety import Fault
from pigaming_app.hardware.session.robot_session import cause_of
from pigaming_app.scenes.flow.scene import Home, Pop, Push, StackOperation, Swap
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.fault_icons import sign
from pigaming_app.scenes.mat.robots.flood_light import FloodLight, hint_line
from pigaming_app.scenes.mat.robots.pair_again import PairAgain
from pigaming_app.scenes.mat.things.moved_page import InterruptedMatch, MovedPage
from pigaming_app.scenes.play.pause import Pause, sheet_title
from pigaming_app.scenes.views.sprites.effects import timer_ring
from pigaming_app.ui.draw import ALARM, BODY, FOCUS, ICE, LINE, MIST, PLAYERS, Color
from pigaming_app.ui.draw.layers import LINE_PITCH, SMALLEST, Layer, fit_lines, fit_paragraphs, fit_size
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import Caption, caption
from pigaming_app.ui.widgets.dialog import FOOT, HEAD, ICON, PROMPTS, ROOM, TEXT_X, W, X, overlay

IDLE = 600.0  # s without input before the return to the title
GAP = 8  # px between two sentences
HOLD = 1.0  # s, hold time of FIRE to release the stop
READ, SEARCH = 2.5, 1.5  # s for which the page is shown, then floodlight, while a robot is out of sight
RING = X + 150, FOOT - 96


class FaultPage:
    """Page over a match that waits for its robots. `stopper`: the device that pressed stop, if any."""

    def __init__(self, match: InterruptedMatch, stopper: Device | None = None) -> None:
        self.match, self.context, self.stopper = match, match.context, stopper
        self.faults: list[Fault] = []
        self.picture: pygame.Surface | None = None
        self.held = 0.0
        self.flood, self.searched = FloodLight(self.context), 0.0  # s for which a robot has been out of sight
        hints = [(Button.X, "mat.hint_simulate"), (Button.START, "pause.hint_menu")]
        self.prompts = self.context.prompts(hints, PROMPTS, W - 80, device=lambda: match.access.hint_device)
        repair_prompts = [(Button.FIRE, "mat.hint_pair"), (Button.Y, "mat.hint_retry")]
        self.repair_prompts = self.context.prompts(
            repair_prompts, FOOT - 44, W - 80, device=lambda: match.access.hint_device
        )

    def on_enter(self) -> None:
        """Play the alert."""
        self.context.hush()
        self.context.sounds.play("error")
        self.held, self.picture, self.faults = 0.0, None, []
        self.flood.level = self.searched = 0.0

    def handle(self, event: InputEvent) -> StackOperation:
        """X replaces the robots concerned with simulated ones; START and BACK open the menu. After disobedience, FIRE
        starts a new pairing and Y retries.
        """
        admitted = self.match.access.admit(event)
        if admitted is None:
            return None
        event = admitted
        latched = self.match.plant.safety.latched
        event = self.prompts.as_button(self.repair_prompts.as_button(event) if latched else event)
        if event.button is Button.X:
            self._simulate()
        elif latched and event.button is Button.FIRE and not self.match.plant.safety.stopped:
            self.match.watch.pause()
            return Push(PairAgain(self.match))
        elif latched and event.button is Button.Y:
            for robot in latched:
                self.match.plant.clear_fault(robot)
            self.context.sounds.play("accept")
        elif event.button is Button.STOP:
            self.match.plant.safety.all_stop()
            self.stopper = event.device
        elif event.button in (Button.START, Button.BACK):
            return Swap(Pause(self.match, event.device))
        return None

    def update(self, seconds: float) -> StackOperation:
        """Close once the fault is gone, or explained by a moved thing."""
        safety = self.match.plant.safety
        if not self._blocked:
            self.match.robots.advance_paused(seconds)
        elif places := self._examine(seconds):
            for robot in safety.latched:
                self.match.plant.clear_fault(robot)
            return Swap(MovedPage(self.match, places))
        if held := self.match.access.update(seconds):
            return Swap(Pause(self.match, held.device))
        controls = self.context.controls
        firing = safety.stopped and any(controls.drive(device).fire for device in self._stoppers())
        self.held = self.held + seconds if firing else 0.0
        if self.held >= HOLD:
            safety.release()
        now = [fault for fault in self.match.plant.faults if fault.pauses]
        if [(fault.name, fault.robot) for fault in now] != [(fault.name, fault.robot) for fault in self.faults]:
            self.faults, self.picture = now, None
            if self._blocked:
                self.match.watch.examine()
        lost = any(fault.name == "lost" for fault in now)
        self.searched = self.searched + seconds if lost else 0.0
        self.flood.update(seconds, self.searched % (READ + SEARCH) > READ)
        if self.context.idle > IDLE:
            return Home()
        return None if now or safety.stopped else Pop()

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the page, then the discs on top, so that the markers stay visible; or the floodlight."""
        if self.flood.full and self.faults:
            sentence = fault_sentence(self.faults[0], self.context.words, "")
            self.flood.draw(screen, sentence, hint_line(self.prompts.labels))
            draw_corners(screen)
            return
        if self.picture is None:
            robot = self.faults[0].robot if self.faults else None
            color = ALARM if robot is None else PLAYERS[robot]
            fault_caption = tuple((fault.name, fault.robot) for fault in self.faults)
            self.picture = overlay(self.match.runner.picture(), color, self._paint, fault_caption)
        screen.blit(self.picture, (0, 0))
        if self.match.plant.safety.stopped:
            image, dx, dy = timer_ring(FOCUS, min(48, round(48 * self.held / HOLD)), 40, LINE)
            screen.blit(image, (RING[0] + dx, RING[1] + dy), special_flags=pygame.BLEND_RGB_ADD)
        self.prompts.draw(screen)
        if self.match.plant.safety.latched:
            self.repair_prompts.draw(screen)
        self.flood.draw(screen, "")
        self.match.robots.draw_overlay(screen)
        self.match.watch.note(screen)

    # ---- inside

    @property
    def _blocked(self) -> bool:
        """True if a moved thing may explain all faults: robots of a running match do not follow their commands."""
        disobey = self.faults and all(fault.name == "disobeys" for fault in self.faults)
        return bool(disobey) and not self.match.plant.safety.stopped and not self.match.preparing

    def _examine(self, seconds: float) -> list[tuple[float, float]]:
        """Advance while the watch compares this page's picture with the camera's; places of moved things, arena px."""
        self.match.robots.advance_examined(seconds)
        return self.match.watch.places

    def _stoppers(self) -> list[Device]:
        """Devices whose FIRE releases the stop: the seated ones and the one that pressed it."""
        players, stopper = self.context.controls.players(), self.stopper
        by_keys = stopper is not None and stopper.kind == "keys"
        stoppers = [device for device in players if device == stopper or (by_keys and device.kind == "keys")]
        return [*self.match.access.seated, *stoppers] or players

    def _simulate(self) -> None:
        """Replace the robots with faults by simulated ones."""
        self.match.plant.safety.release()
        for fault in self.faults:
            for seat in [*self.match.real] if fault.robot is None else [fault.robot]:
                self.match.set_real(seat, False)
        self.context.sounds.play("accept")

    def _paint(self, layer: Layer) -> None:
        """Draw the first fault, the camera's or radio's own message, and the number of other faults."""
        words = self.context.words
        if not self.faults:
            sheet_title(layer, None, words("mat.stand"), ICE)
            return
        first = self.faults[0]
        title = words("mat.stand") if first.robot is None else words("mat.robot", robot=first.robot + 1)
        sheet_title(layer, first.robot, title, ICE)
        sign(layer.glow, first.name, *ICON, 76, ALARM)
        if not self.match.plant.safety.latched and not cause_of(self.match.plant.rig, first.name):
            ending = words("mat.goes_on")
            layer.canvas.body(ending, TEXT_X, FOOT - 40, MIST, "l", fit_size(ending, 36, ROOM, "body"))
        y = HEAD + 56.0
        size, paragraphs = self._paragraphs(first)
        for i, lines in enumerate(paragraphs):
            for line in lines:
                layer.canvas.body(line, TEXT_X, y, MIST if i else ICE, "l", size)
                y += LINE_PITCH * size
            y += GAP

    def _paragraphs(self, first: Fault) -> tuple[int, list[list[str]]]:
        """A fault, its cause and another fault, as far as there is room: size in px, and the lines of each."""
        words, latched = self.context.words, self.match.plant.safety.latched
        fire = words.key_name(self.context.controls.label(self.match.access.hint_device, Button.FIRE))
        cause = cause_of(self.match.plant.rig, first.name)
        others = [fault for fault in self.faults[1:] if fault.name != first.name or fault.robot != first.robot]
        said = [fault_sentence(first, words, fire)]
        said += [words.sentence(cause)] if cause else []
        more = [words("mat.also", other=fault_sentence(others[0], words, ""))] if others else []
        height = FOOT - HEAD - 56 - (72 if latched else 20 if cause else 60)  # above the prompts, or the last sentence
        for sentences, smallest in (([*said, *more], 36), (said, SMALLEST), (said[:1], SMALLEST)):
            if fitting := fit_paragraphs(sentences, ROOM, height, GAP, range(BODY, smallest - 1, -2)):
                return fitting
        size, lines = fit_lines(said[0], ROOM, 3)
        return size, [lines]


def fault_sentence(fault: Fault, words: Words, button: str) -> str:
    """Description of a fault in one sentence."""
    return words(f"faults.{fault.name}", robot=1 if fault.robot is None else fault.robot + 1, button=button)


def fault_caption(sentence: str, color: Color) -> Caption:
    """A sentence on a plate, at most as wide as the arena."""
    return caption(sentence, color, ICE, fit_size(sentence, BODY, 1480, "body"))
