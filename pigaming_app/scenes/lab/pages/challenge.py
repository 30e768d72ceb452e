"""Challenge match against the robot as trained so far: one minute by the training rules, then back to the Lab."""

import pygame

from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer
from pigaming_app.ai.learning.training import ARENA, GAME, VARIANT
from pigaming_app.games.game import Seat, Setup
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation, Swap
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import LATE, LEAVE, hold_bar
from pigaming_app.ui.draw import HERO, ICE, MIST, PLAYERS, Color, badge
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.i18n import numeral
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.input.hold import HoldTimers
from pigaming_app.ui.widgets.dialog import FOOT, HEAD

MINUTES = 1.0
ROBOT = 1  # seat of the trained robot; the person has seat 0
INPUT_LOCKOUT = 1.0  # s during which input is ignored
IDLE = 60.0  # s without input before the return to the Lab


class Challenge:
    """A match of one person against the trained robot."""

    def __init__(self, context: Context, kind: BrainKind, device: Device, arena: str = ARENA) -> None:
        self.context, self.kind, self.device, self.arena = context, kind, device, arena
        off = Seat("off", 2), Seat("off", 3)
        setup = Setup(GAME, arena, (Seat("human", 0), Seat("learned", 1), *off), MINUTES, new_seed(), VARIANT)
        self.inner = MatchScene(context, setup, [device])
        self.inner.drivers.may_join = False  # the robot's seat cannot be taken over
        self.inner.match.sit(ROBOT, BrainPlayer(kind, setup.seed))
        self.inner.runner.players[ROBOT] = kind.name

    def on_enter(self) -> None:
        self.inner.on_enter()

    def handle(self, event: InputEvent) -> StackOperation:
        return self.inner.handle(event)

    def update(self, seconds: float) -> StackOperation:
        """Advance the match; stopped by hand, it returns to the Lab at once."""
        inner = self.inner
        if inner.restart_requested:
            return Swap(self.rematch(inner.devices[0]))
        if inner.stop_requested:
            return Pop()
        if inner.match.over:
            return Swap(ChallengeResult(self)) if inner.ending.hold(seconds) else None
        return inner.update(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        self.inner.draw(screen)

    def rematch(self, device: Device | None) -> "Challenge":
        """A rematch, driven by `device`, or by the same device if None."""
        return Challenge(self.context, self.kind, device or self.device, self.arena)


class ChallengeResult(Sheet):
    """Result of a challenge, with a rematch prompt."""

    idle, when_idle = IDLE, Pop()
    hints = ((Button.FIRE, "results.again"), (Button.BACK, "lab.hint_lab"))

    def __init__(self, fight: Challenge) -> None:
        self.fight = fight
        self.scores = [robot.score for robot in fight.inner.match.state.robots][:2]
        self.access = Access(fight.context, lambda: [fight.inner.devices[0]])
        self.leaving = HoldTimers(fight.context.controls, LEAVE)
        super().__init__(fight.context, gate=self.access)

    def on_enter(self) -> None:
        own, theirs = self.scores
        self.context.sounds.play("win" if own > theirs else "lose" if own < theirs else "tie", 0)

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE starts a rematch with the device that pressed it; BACK, held, returns to the Lab."""
        event = self.prompts.as_button(event)
        admitted = self.access.admit(event)
        if admitted is None and event.button not in (Button.FIRE, Button.START):
            return None
        self.untouched = 0.0
        if self.age < INPUT_LOCKOUT:
            return None
        if event.button in (Button.FIRE, Button.START):
            self.context.sounds.play("accept")
            return Swap(self.fight.rematch(None if event.device.kind == "mouse" else event.device))
        if admitted and event.button is Button.BACK:
            if event.device.kind == "mouse":
                return self.leave()
            if self.age >= LATE:
                self.leaving.begin(admitted)
        return None

    @property
    def resting(self) -> float:
        return self.untouched

    def advance(self, seconds: float) -> StackOperation:
        return self.leave() if self.leaving.update(seconds) else None

    @property
    def behind(self) -> pygame.Surface:
        """The last frame of the match."""
        return self.fight.inner.picture()

    @property
    def color(self) -> Color:
        own, theirs = self.scores
        return PLAYERS[0] if own > theirs else PLAYERS[ROBOT] if theirs > own else ICE

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the progress of leaving, too."""
        super().draw_foot(screen)
        if self.leaving.share:
            hold_bar(screen, self.leaving.share)

    def paint_sheet(self, layer: Layer) -> None:
        words = self.context.words
        own, theirs = self.scores
        name = self.fight.kind.name.upper()
        if own == theirs:
            sheet_title(layer, None, words("results.tie"), ICE)
        else:
            seat = 0 if own > theirs else ROBOT
            yours = words("lab.you_win") if self.fight.inner.devices[0] else words("results.stand_in_wins", player=1)
            sheet_title(layer, seat, yours if seat == 0 else words("lab.it_wins", name=name), PLAYERS[seat])
        middle = (HEAD + FOOT) / 2
        for seat, side, score, player_name in ((0, -1, own, words("lab.you")), (ROBOT, 1, theirs, name)):
            layer.canvas.text(numeral(score), HERO - 70, 960 + side * 210, middle, PLAYERS[seat], "hero", "c")
            badge(layer.glow, seat, 960 + side * 430, middle - 28, 44)
            layer.canvas.body(player_name, 960 + side * 430, middle + 66, MIST, "c")
        layer.canvas.text(":", HERO - 90, 960, middle - 8, MIST, "hero", "c")
