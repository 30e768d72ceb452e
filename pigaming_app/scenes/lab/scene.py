"""The Lab scene. Any device controls it: directions move the focus, FIRE selects; a held knob is turned by directions.

The robot learns with a table or with a network; each of them trains while the page shows it, and pauses otherwise,
as during a challenge match.
"""

import math
from dataclasses import replace

import pygame

from pigaming_app.ai.networks.files import TrainedNetwork
from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.qlearning.table_files import Trained
from pigaming_app.ai.reward_line import LineError
from pigaming_app.scenes.brain.rose import LEVELS, SIGNS
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.lab.host import dimmed_background
from pigaming_app.scenes.lab.knob import LIMIT
from pigaming_app.scenes.lab.layout import KNOB_NAMES, LINE, MATCH, PLAY, PROMPTS_Y, SIDES, SPEED, knob_rect
from pigaming_app.scenes.lab.learning_curve import EVEN
from pigaming_app.scenes.lab.network.fetch_page import FetchPage
from pigaming_app.scenes.lab.network.kind_switch import KINDS, NETWORK, TABLE, kind_at, kind_rect
from pigaming_app.scenes.lab.network.trainer import NetworkProgress, NetworkTrainer
from pigaming_app.scenes.lab.progress import TrainingProgress
from pigaming_app.scenes.lab.saved_robots import RobotFileError
from pigaming_app.scenes.lab.sides import LabSide
from pigaming_app.scenes.lab.trainer import Trainer
from pigaming_app.scenes.lab.view import SPEEDS, LabPage, LabState, notice, speed_at
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.ui.draw import FOCUS
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import caption
from pigaming_app.ui.widgets.focus import Focus, FocusSpot

FIRST = replace(RECIPES[1], behind_always=1)  # each knob affects every decision, so that a change shows quickly
INPUT_LOCKOUT = 0.35  # s during which input is ignored after entering
CONFIRM_SECONDS = 20.0  # s before the title returns at which a confirmation prompt appears
COMPILE_NOTICE = 2.0  # s of compiling before a notice is shown
MIN_SCALE = 2.0  # Q value that fills at least one petal
HINTS = (
    (Button.FIRE, "lab.hint_choose"),
    (Button.X, "lab.hint_play"),
    (Button.Y, "lab.hint_faster"),
    (Button.START, "lab.hint_more"),
    (Button.BACK, "lab.hint_leave"),
)
TURNING = ((Button.RIGHT, "lab.hint_turn"), (Button.FIRE, "lab.hint_done"))
TURNS = {Button.LEFT: -1, Button.DOWN: -1, Button.RIGHT: 1, Button.UP: 1}


class Lab(Page):
    """Two robots that know nothing at first. `fast`: the table's kernels are compiled; None: if numba is available."""

    idle = 300.0  # then the title returns, and the table is reset for the next visitors
    prompts_y = PROMPTS_Y

    def __init__(self, context: Context, fast: bool | None = None) -> None:
        super().__init__(context, Focus(self._spots(context.words), "speed"))
        self._fast, self._background = fast, context.shared(LabBackground)
        self.sides = [self._new_side(new_seed())]
        self.shown_side = 0
        self.kind = TABLE
        self.shown = LabState()
        self.page: LabPage | None = None
        self.seen = -1  # number of the last frame shown
        self.held = ""  # knob being adjusted
        self.compiling = 0.0

    @property
    def hints(self) -> Hints:
        return TURNING if self.held else HINTS

    # ---- scene

    def on_enter(self) -> None:
        self.age, self.held = 0.0, ""
        self.context.sounds.music("title")
        if self.page and self.page.language != self.context.words.language:
            self.page = None
            self.focus.set_spots(self._spots(self.context.words))

    def handle(self, event: InputEvent) -> StackOperation:
        """While a knob is held, BACK lets go of it."""
        pressed = self.prompts.as_button(event)
        if self.held and pressed.button not in (Button.X, Button.Y):
            return self._turn(pressed)
        return super().handle(event)

    def press(self, event: InputEvent) -> StackOperation:
        """Select, play, change speed, open the menu."""
        self.held = ""
        match event.button:
            case Button.X:
                return self.play(event.device)
            case Button.Y:
                self._next_speed((self.trainer.speed + 1) % len(SPEEDS))
            case Button.START:
                return self._menu()
            case Button.FIRE | Button.CLICK:
                self.focus.handle(event)
                return self._choose(event) if self.age > INPUT_LOCKOUT else None
            case _:
                if self.focus.handle(event):
                    self.context.sounds.play("move")
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Feed the trainer and update the page."""
        for side in self.sides:
            side.table.share = 1.0 / len(self.sides)
            side.trainer(self.kind).feed(seconds)
            side.follow(self.kind, seconds)
        self.compiling = self.compiling + seconds if self.trainer.compiling else 0.0
        if self.trainer.trouble:
            self._report_trouble()
        self._follow(seconds)
        if self.context.idle > self.idle:
            self._reset()
        return None

    def show(self, screen: pygame.Surface) -> None:
        """Draw the match, the knobs and the curve; without a heading."""
        if self.page is None:
            self.page, self.seen = LabPage(self.context), -1
        self.page.draw(screen, self.shown)
        if not self.held:
            self.focus.draw(screen)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the question whether anybody is still there, too."""
        super().draw_foot(screen)
        words = self.context.words
        if self.context.idle > self.idle - CONFIRM_SECONDS:
            caption(words("pause.still"), FOCUS, sign="clock").draw(screen, MATCH.centerx, MATCH.top + 60)
        elif (seconds := self.trainer.first_point) is not None:
            notice(words("lab.first", seconds=seconds)).draw(screen)
        elif self.compiling > COMPILE_NOTICE:
            notice(words("lab.warming" if self.kind == TABLE else "lab.preparing")).draw(screen)

    def on_leave(self) -> None:
        """Pause the training when the scene is removed, and release its pictures, 13 MB: the title keeps the Lab."""
        self._pause()
        self.page = None

    # ---- interface for the pages above

    def show_message(self, message: str, wrong: bool = False) -> None:
        """Show a message for a few seconds, with its sound."""
        super().show_message(message, wrong)
        self.context.sounds.play("error" if wrong else "accept")

    def play(self, device: Device) -> StackOperation:
        """A challenge match against the robot as trained so far."""
        from pigaming_app.scenes.lab.pages.challenge import Challenge

        self.context.sounds.play("accept")
        driver = self.context.controls.driver(device)
        robot = self.trainer.checkpoint(self.name or self.context.words("lab.robot"))
        self._pause()
        return Push(Challenge(self.context, robot.kind, driver, self.trainer.arena))

    @property
    def side(self) -> LabSide:
        """The robot that is shown."""
        return self.sides[self.shown_side]

    @property
    def table(self) -> Trainer:
        return self.side.table

    @property
    def network(self) -> NetworkTrainer:
        return self.side.network

    @property
    def trainer(self) -> Trainer | NetworkTrainer:
        """The training that is shown."""
        return self.side.trainer(self.kind)

    @property
    def name(self) -> str:
        """Name under which the robot was saved or opened, or ""."""
        return self.side.names[self.kind]

    @name.setter
    def name(self, name: str) -> None:
        self.side.names[self.kind] = name

    def begin(self) -> None:
        """Start again with robots that know nothing, from the same seed."""
        seed = new_seed()
        for side in self.sides:
            side.trainer(self.kind).begin(seed)
            side.names[self.kind] = ""
        self.seen = -1

    def reward_by(self, line: str) -> str:
        """Reward the robot by a line from now on. Returns the sentence why not, if it is none."""
        try:
            self.trainer.reward_by(line)
        except LineError as error:
            return self.context.words(f"lab.line_{error.reason}", **error.values)
        self.side.note_change(self.kind)
        return ""

    def open(self, robot: Trained | TrainedNetwork, name: str) -> None:
        """Continue with a saved robot, of whatever kind. Raises RobotFileError."""
        if isinstance(robot, Trained):
            self.table.open(robot)
            self.show_kind(TABLE)
        elif not self.network.available:
            raise RobotFileError(self.network.refusal)
        else:
            self.network.open(robot)
            self.show_kind(NETWORK)
        self.name, self.page = name, None  # the old curve is not this robot's

    def show_kind(self, kind: str) -> None:
        """Show the robot of this kind."""
        if kind != self.kind:
            self._pause()
            self.kind, self.page, self.held = kind, None, ""

    def show_side(self, number: int) -> None:
        """Show A (0) or B (1). B begins with the reward of A, and with nothing learned."""
        if number == len(self.sides):
            one, other = self.side, self._new_side(new_seed())
            other.table.recipe, other.network.recipe = one.table.recipe, one.network.recipe
            other.table.speed, other.network.speed = one.table.speed, one.network.speed
            self.sides.append(other)
            self.show_message(self.context.words("lab.side_how"))
        self.shown_side, self.page, self.held = number, None, ""

    def leave(self) -> StackOperation:
        return self._paused(super().leave())

    def _paused(self, operation: StackOperation) -> StackOperation:
        """Pause the training and return `operation`."""
        self._pause()
        return operation

    # ---- inside

    def _new_side(self, seed: int) -> LabSide:
        compilers = self._background.compiler, self._background.network_compiler
        return LabSide(Trainer(FIRST, seed, self._fast, compilers[0]), NetworkTrainer(seed, compilers[1]))

    def _pause(self) -> None:
        for side in self.sides:
            side.close()

    def _choose(self, event: InputEvent) -> StackOperation:
        chosen = self.focus.activated(event)
        if chosen == "play":
            return self.play(event.device)
        if chosen == "speed":
            at = event.at
            here = self.trainer.speed
            self._next_speed(speed_at(at[0] - SPEED.left) if at else (here + 1) % len(SPEEDS))
        elif chosen == "kind":
            other = KINDS[1 - KINDS.index(self.kind)]
            return self._change_kind(kind_at(event.at[0], self.context.words) if event.at else other)
        elif chosen == "sides":
            self.context.sounds.play("accept")
            self.show_side(int(event.at[0] > SIDES.centerx) if event.at else 1 - self.shown_side)
        elif chosen == "line":
            return self._write_line()
        elif chosen and event.at:
            self._turn_knob(chosen, 1 if event.at[0] > self.focus.rect(chosen).centerx else -1)
        elif chosen:
            self.held = chosen
            self.context.sounds.play("lift")
        return None

    def _turn(self, event: InputEvent) -> StackOperation:
        """Handle input while a knob is held."""
        if event.button in TURNS:
            self._turn_knob(self.held, TURNS[event.button])
        elif event.button in (Button.FIRE, Button.BACK, Button.START, Button.CLICK):
            self.held = ""
            self.context.sounds.play("set_down")
        return None

    def _write_line(self) -> StackOperation:
        from pigaming_app.scenes.lab.pages.line_page import LinePage

        self.context.sounds.play("accept")
        return self._paused(Push(LinePage(self.context, self.trainer.line, self.reward_by)))

    def _next_speed(self, speed: int) -> None:
        """The same for both robots."""
        for side in self.sides:
            side.trainer(self.kind).speed = speed
        self.context.sounds.play("move")

    def _change_kind(self, kind: str) -> StackOperation:
        """Change to the other kind, if it can learn here, and explain it in one sentence; first fetch what it needs."""
        self.network.enable()
        if kind == NETWORK and self.network.fetchable:
            self.context.sounds.play("accept")
            return self._paused(
                Push(FetchPage(self.context, lambda: dimmed_background(self), self._networks_are_ready))
            )
        if kind == NETWORK and not self.network.available:
            self.show_message(self.context.words(self.network.refusal), wrong=True)
        elif kind != self.kind:
            self.show_kind(kind)
            self.show_message(self.context.words(f"lab.{kind}_how"))
        return None

    def _networks_are_ready(self) -> None:
        self.network.enable()
        if self.network.available:
            self._change_kind(NETWORK)

    def _report_trouble(self) -> None:
        """Show what has happened to the process of the network; without it, only the table is left."""
        self.show_message(self.context.words(self.trainer.trouble), wrong=True)
        self.trainer.trouble = ""
        if not self.trainer.available:
            self.show_kind(TABLE)

    def _reset(self) -> None:
        """Prepare the page for the next visitors."""
        for side in self.sides[1:]:
            side.close()
            side.network.end()
        del self.sides[1:]
        self.show_side(0)
        for trainer in (self.table, self.network):
            trainer.reset(new_seed())
        self.show_kind(TABLE)
        self.side.names, self.seen = dict.fromkeys(KINDS, ""), -1

    @staticmethod
    def _spots(words: Words) -> list[FocusSpot]:
        knobs = [FocusSpot(name, knob_rect(i)) for i, name in enumerate(KNOB_NAMES)]
        kind = FocusSpot("kind", kind_rect(words))
        code = [FocusSpot("sides", SIDES), FocusSpot("line", LINE)]
        return [kind, FocusSpot("speed", SPEED), FocusSpot("play", PLAY), *code, *knobs]

    def _menu(self) -> StackOperation:
        from pigaming_app.scenes.lab.pages.menu import LabMenu

        self.context.sounds.play("accept")
        return self._paused(Push(LabMenu(self)))

    def _turn_knob(self, knob: str, by: int) -> None:
        """Turn a knob to the next whole number within its range; `by`: 1 or -1."""
        before = float(getattr(self.trainer.recipe, knob))
        value = max(-LIMIT, min(LIMIT, math.floor(before) + 1 if by > 0 else math.ceil(before) - 1))
        if value != before:
            self.trainer.turn(knob, value)
            self.side.note_change(self.kind)
            self.context.sounds.play("tick")

    def _follow(self, seconds: float) -> None:
        """Update the page state."""
        trainer, now, moment = self.trainer, self.shown, self.trainer.snapshot
        if self.page and moment.number != self.seen:
            self.seen = moment.number
            self.page.watch(moment.state)
        if self.page:
            self.page.update(seconds)
        now.matches, now.knowing, now.rate = moment.matches, moment.knowing, round(self.side.rate)
        now.courses, now.side, now.line = [side.course(self.kind) for side in self.sides], self.shown_side, trainer.line
        self._celebrate(trainer.progress)
        now.kind, now.networks = self.kind, self.network.available or self.network.fetchable
        now.speed, now.focus, now.held = trainer.speed, self.focus.name, self.held
        now.values = {name: getattr(trainer.recipe, name) for name in KNOB_NAMES}
        plan = trainer.progress.plan
        scale = max([MIN_SCALE] + [abs(entry.value) for entry in plan if entry])
        now.levels = [level(entry.value / scale) if entry else 0 for entry in plan]
        now.signs = [entry.action if entry else SIGNS[-1] for entry in plan]

    def _celebrate(self, progress: TrainingProgress | NetworkProgress) -> None:
        """Celebrate once per training that it overtook the hand-made robot."""
        shares, side = self.page.curve.shares if self.page else [], self.side
        share = shares[self.shown_side] if self.shown_side < len(shares) else None
        if share is not None and share < EVEN:
            side.was_behind = progress
        elif share is not None and share > EVEN and side.was_behind is progress is not side.celebrated:
            side.celebrated = progress
            self.show_message(self.context.words("lab.outdone"))
            self.context.sounds.play("win")


def level(share: float) -> int:
    """Petal length for a value relative to the largest, -1..1; square root, so that small values stay visible."""
    return round(math.copysign(LEVELS * math.sqrt(abs(share)), share))
