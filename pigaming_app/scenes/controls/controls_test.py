"""Controls test: every pad, key cluster and the mouse, live, with pressed buttons highlighted.

Each device drives a small robot in its driving style. Escape or the prompt leaves the page; on a pad B is held for a
second, because short presses are being tested.
"""

import math
from types import SimpleNamespace

import pygame

from pigaming_app.ai.registry import AIS
from pigaming_app.scenes.controls import pictures as gadgets
from pigaming_app.scenes.flow.access import Right
from pigaming_app.scenes.flow.driving import PICTURES
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import tank
from pigaming_app.sim.robot import GAIN, integrate
from pigaming_app.sim.world import Robot
from pigaming_app.ui.draw import ADD, ICE
from pigaming_app.ui.draw.layers import span
from pigaming_app.ui.draw.sprites import HEADINGS, Sprite, step
from pigaming_app.ui.input.events import Button, Device, InputEvent, StickState
from pigaming_app.ui.input.keyboard import NUM
from pigaming_app.ui.widgets.labels import black_out, blit_sprite

PLACES = 4
PADS_Y, KEYS_Y = 216, 580
HOLD = 0.8  # seconds
LIT = 0.25  # seconds for which a short press stays highlighted
SPEED, TURN_RATE = 60.0, 3.0  # px/s and rad/s of the small robots
TETHER = 0.94  # share of its distance from the middle that a robot keeps in a tick
GAME = "pitanks"  # whose driving styles are tried
BUTTONS = (Button.FIRE, Button.BACK, Button.X, Button.Y, Button.START)


class ControlsTest(Page):
    """The page. `lit`: remaining seconds of each highlighted button."""

    right = Right.PLAY
    title, idle = "padtest.title", 120.0

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.holding: Device | None = None
        self.held = 0.0
        self.lit: dict[tuple[Device, Button], float] = {}
        self.driven: dict[Device, SimpleNamespace] = {}  # the small robot of each device, as in a match
        self.timestep = FixedTimestep()
        self.clicks: list[tuple[float, float, float]] = []  # x, y, age in seconds

    def handle(self, event: InputEvent) -> StackOperation:
        """Highlight the button; Escape, the prompt, and B held, leave."""
        action = self.prompts.as_button(event)
        if action.button is Button.BACK and not action.device.has_stick:
            return self.leave()
        if action.button is Button.BACK:
            self.holding, self.held = action.device, 0.0
        if event.button is Button.CLICK and event.at:
            self.clicks = [*self.clicks[-5:], (*event.at, 0.0)]
        if event.button is Button.LOST:
            self.lit = {key: left for key, left in self.lit.items() if key[0] != event.device}
        self.lit[event.device, event.button] = LIT
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Turn the robots, fade highlights, check for B held."""
        controls = self.context.controls
        self.lit = {key: left - seconds for key, left in self.lit.items() if left > seconds}
        self.clicks = [(x, y, age + seconds) for x, y, age in self.clicks if age < 0.45]
        for _ in range(self.timestep.due(seconds)):
            for device in controls.players():
                self._drive(device)
        if self.holding and controls.drive(self.holding).turbo:
            self.held += seconds
            if self.held > HOLD:
                return self.leave()
        else:
            self.holding = None
        return None

    @property
    def subtitle(self) -> str:
        return self.context.words("padtest.line")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the current state of every device."""
        words = self.context.words
        pads = self.context.controls.handhelds()[:PLACES]
        for i in range(PLACES):
            x = span(3 * i, 3)[0]
            black_out(screen, *(pygame.Rect(x, y, gadgets.W, gadgets.H) for y in (PADS_Y, KEYS_Y)))
            if i < len(pads):
                self._pad(screen, x, PADS_Y, pads[i])
            else:
                gadgets.no_pad(words("padtest.none"), words("padtest.plug")).draw(screen, x, PADS_Y)
            self._cluster(screen, x, KEYS_Y, i)
        for x_, y_, age in self.clicks:
            wave = effects.wave(ICE, min(effects.WAVE_STEPS - 1, int(age / 0.45 * effects.WAVE_STEPS)))
            screen.blit(wave.image, (round(x_ + wave.dx), round(y_ + wave.dy)), special_flags=ADD)

    @property
    def hints(self) -> Hints:
        return [(Button.BACK, "padtest.hint_hold" if self.context.controls.last.has_stick else "padtest.hint_back")]

    def _pad(self, screen: pygame.Surface, x: int, y: int, device: Device) -> None:
        controls, words = self.context.controls, self.context.words
        labels = tuple(controls.label(device, button) for button in BUTTONS)
        gadgets.pad(words(f"devices.{controls.name(device)}"), labels).draw(screen, x, y)
        drive = controls.drive(device)
        sx, sy = gadgets.STICK
        gadgets.knob().draw(screen, x + sx + gadgets.REACH * drive.angular, y + sy - gadgets.REACH * drive.linear)
        self._robot(screen, x + gadgets.PAD_ROBOT[0], y + gadgets.PAD_ROBOT[1], device, drive)
        self._style(screen, x + gadgets.PAD_STYLE[0], y + gadgets.PAD_STYLE[1], device)
        now = {Button.FIRE: drive.fire, Button.BACK: drive.turbo}
        for button, label in zip(BUTTONS, labels, strict=True):
            if now.get(button) or (device, button) in self.lit:
                gadgets.pad_light(button, label).draw(screen, x, y)

    def _cluster(self, screen: pygame.Surface, x: int, y: int, number: int) -> None:
        device = Device("keys", number)
        controls = self.context.controls
        drive, labels = controls.drive(device), {button: controls.label(device, button) for button in gadgets.KEYS}
        for button, box in gadgets.KEYS.items():
            label = self.context.words.key_name(labels[button].removeprefix(NUM))
            gadgets.cap(label, *box.size, _down(drive, button)).draw(screen, x + box.x, y + box.y)
        if controls.name(device) == "Keypad":
            gadgets.keypad(self.context.words("devices.Keypad")).draw(screen, x, y)
        self._robot(screen, x + gadgets.ROBOT[0], y + gadgets.ROBOT[1], device, drive)
        self._style(screen, x + gadgets.STYLE[0], y + gadgets.STYLE[1], device)

    def _style_of(self, device: Device) -> str:
        return self.context.driving.of(device, GAME)

    def _style(self, screen: pygame.Surface, x: float, y: float, device: Device) -> None:
        style = self._style_of(device)
        gadgets.style(self.context.words(f"lobby.drive_{style}"), PICTURES[style]).draw(screen, x, y)

    def _drive(self, device: Device) -> None:
        """One tick of a device's robot, which a tether pulls back to its place."""
        state = self.driven.setdefault(device, _new_robot())
        linear, angular = AIS[GAME].driving[self._style_of(device)](state, 0, self.context.controls.drive(device))
        robot = state.robots[0]
        robot.requested_linear, robot.requested_angular = linear * SPEED, angular * TURN_RATE
        integrate(robot)
        robot.x, robot.y = TETHER * robot.x, TETHER * robot.y

    def _robot(self, screen: pygame.Surface, x: float, y: float, device: Device, drive: StickState) -> None:
        """Draw a device's robot, at home at (x, y)."""
        robot = self.driven.get(device, _new_robot()).robots[0]
        heading, rx, ry = robot.heading, x + robot.x, y + robot.y
        number = device.number if device.kind == "keys" else self.context.controls.handhelds().index(device)
        if drive.turbo:
            _add(screen, effects.flame(number, step(heading, effects.TURNS), pygame.time.get_ticks() // 60 % 2), rx, ry)
        blit_sprite(screen, tank(number, step(heading, HEADINGS)), rx, ry)
        if drive.fire or (device, Button.FIRE) in self.lit:
            muzzle = rx + 70 * math.cos(heading), ry + 70 * math.sin(heading)
            _add(screen, effects.flash(number, step(heading, effects.TURNS)), *muzzle)


def _new_robot() -> SimpleNamespace:
    """The part of a match's state that a driving style reads: one robot, and its turn rate."""
    robot = Robot()
    robot.gain, robot.heading = GAIN, 1.5 * math.pi
    return SimpleNamespace(robots=[robot], rules=SimpleNamespace(turn_rate=TURN_RATE))


def _down(drive: StickState, button: Button) -> bool:
    """True if the key of a cluster is held."""
    return {
        Button.UP: drive.linear > 0,
        Button.DOWN: drive.linear < 0,
        Button.LEFT: drive.angular < 0,
        Button.RIGHT: drive.angular > 0,
        Button.FIRE: drive.fire,
        Button.LEAVE_SEAT: drive.turbo,
    }[button]


def _add(screen: pygame.Surface, sprite: Sprite, x: float, y: float) -> None:
    screen.blit(sprite.image, (round(x + sprite.dx), round(y + sprite.dy)), special_flags=ADD)
