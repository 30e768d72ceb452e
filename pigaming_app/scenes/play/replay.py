"""Replay viewer: pause, three speeds, restart, and captions."""

import pygame

from pigaming_app.games.replay import BYTES_PER_TICK, Replay, to_match
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.side_hints import SideHints, side_note
from pigaming_app.sim.world import DT
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, STEEL
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import caption

SPEEDS = (1, 2, 4)
HINTS_SECONDS = 4.0  # seconds for which the hints stay after an input
NOTICE, NOTICE_Y = 6.0, 990  # seconds of the match for which the other-engine notice is shown, and its y in px
LINE_Y, LINE_LEFT, LINE_RIGHT = 1060, 160, 1760  # px, of the timeline


class ReplayScene:
    """The screen of a replay."""

    def __init__(self, context: Context, replay: Replay) -> None:
        self.context, self.replay = context, replay
        self.length = len(replay.ticks) // BYTES_PER_TICK * DT
        self.speed, self.hints_left, self.playing = 0, HINTS_SECONDS, True
        self.runner, self.prewarmed = MatchRunner(context, to_match(replay)), False

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE pauses and resumes, LEFT and RIGHT change the speed, X restarts, BACK leaves."""
        event = self.hints.as_button(event)
        self.hints_left = HINTS_SECONDS
        match event.button:
            case Button.FIRE | Button.START:
                if self.ended:
                    self._begin()
                else:
                    self.playing = not self.playing
            case Button.LEFT:
                self.speed = max(0, self.speed - 1)
            case Button.RIGHT:
                self.speed = min(len(SPEEDS) - 1, self.speed + 1)
            case Button.X:
                self._begin()
            case Button.BACK:
                return Pop()
            case _:
                pass
        return None

    def update(self, seconds: float) -> StackOperation:
        self.hints_left -= seconds
        self.prewarmed = self.prewarmed or self.runner.prewarm(4.0)
        if self.playing and not self.ended:
            self.runner.advance(seconds, SPEEDS[self.speed])
        else:
            self.runner.wait(seconds)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match; in the margins the timeline, the speed and the hints."""
        self.runner.draw(screen)
        words, seconds = self.context.words, self.runner.match.seconds
        if seconds < HINTS_SECONDS or not self.playing:
            self.runner.draw_captions(screen, [None] * len(self.replay.setup.seats))
        x = LINE_LEFT + (LINE_RIGHT - LINE_LEFT) * min(1.0, seconds / max(DT, self.length))
        pygame.draw.line(screen, STEEL, (LINE_LEFT, LINE_Y), (LINE_RIGHT, LINE_Y), 4)
        pygame.draw.line(screen, ICE, (LINE_LEFT, LINE_Y), (x, LINE_Y), 6)
        pygame.draw.circle(screen, FOCUS, (x, LINE_Y), 9)
        if self.ended:
            caption(words("replay.over"), ALARM, ICE, LABEL, face="head").draw(screen, 960, 590)
        elif not self.playing or self.speed or seconds < HINTS_SECONDS:
            label = words("replay.title") if self.playing else words("replay.hint_pause")
            side_note(label, f"{SPEEDS[self.speed]}×").draw(screen)
        if self.replay.other_engine and seconds < NOTICE:
            caption(words("replay.other_engine"), FOCUS).draw(screen, 960, NOTICE_Y)
        if self.hints_left > 0.0 or not self.playing or self.ended:
            self.hints.draw(screen)

    @property
    def hints(self) -> SideHints:
        """The hints, in the margin."""
        return SideHints(self.prompts)

    @property
    def prompts(self) -> ButtonPrompts:
        """The current button prompts; at the end there is no pause or speed."""
        hints = [(Button.FIRE, "replay.hint_again"), (Button.BACK, "replay.hint_back")]
        if not self.ended:
            fire = "replay.hint_pause" if self.playing else "replay.hint_play"
            hints = [(Button.FIRE, fire), (Button.RIGHT, "replay.hint_speed"), (Button.X, hints[0][1]), hints[1]]
        return self.context.prompts(hints)

    @property
    def ended(self) -> bool:
        """True at the end of the recording."""
        match = self.runner.match
        return match.over or match.seconds >= self.length

    def _begin(self) -> None:
        self.runner, self.prewarmed, self.playing = MatchRunner(self.context, to_match(self.replay)), False, True
