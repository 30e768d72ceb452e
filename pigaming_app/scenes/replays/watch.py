"""Replay viewer: pause, jumps of five seconds, four speeds, a timeline to click on, restart, and captions."""

import pygame

from pigaming_app.games.replay import Replay
from pigaming_app.scenes.features.replays import marks_of, timeline_of
from pigaming_app.scenes.flow.scene import Context, Home, Pop, StackOperation
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.side_hints import SideHints, side_note
from pigaming_app.sim.world import DT, HZ
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, STEEL
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import ButtonPrompts
from pigaming_app.ui.widgets.caption import caption

SPEEDS = {1.0: "1×", 2.0: "2×", 4.0: "4×", 0.5: "½×"}
JUMP = 5 * HZ  # ticks
EXPLORED = 40  # ticks played ahead per frame, for later jumps
IDLE = 60.0  # s without input before the return to the title
HINTS_SECONDS = 4.0  # seconds for which the hints stay after an input
NOTICE, NOTICE_Y = 6.0, 990  # seconds of the match for which the other-engine notice is shown, and its y in px
LINE_Y, LINE_LEFT, LINE_RIGHT = 1060, 160, 1760  # px, of the timeline
REACH = 20  # px above the timeline in which a click counts
MARK = 7  # px, half of the mark of a moment


class ReplayScene:
    """The screen of a replay."""

    def __init__(self, context: Context, replay: Replay) -> None:
        self.context, self.replay = context, replay
        self.timeline = timeline_of(replay)
        self.marks = marks_of(replay, context.words)
        self.speed, self.hints_left, self.playing = 1.0, HINTS_SECONDS, True
        self.runner, self.prewarmed = MatchRunner(context, self.timeline.match_at(0)), False

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE pauses and resumes, LEFT and RIGHT jump, Y changes the speed, X restarts, BACK leaves, and a click on
        the timeline jumps there.
        """
        if event.button is Button.CLICK and event.at and event.at[1] >= LINE_Y - REACH:
            self.jump(round((event.at[0] - LINE_LEFT) / (LINE_RIGHT - LINE_LEFT) * self.timeline.length))
        event = self.hints.as_button(event)
        self.hints_left = HINTS_SECONDS
        match event.button:
            case Button.FIRE | Button.START:
                if self.ended:
                    self._begin()
                else:
                    self.playing = not self.playing
            case Button.LEFT:
                self.jump(self.tick - JUMP)
            case Button.RIGHT:
                self.jump(self.tick + JUMP)
            case Button.Y:
                speeds = list(SPEEDS)
                self.speed = speeds[(speeds.index(self.speed) + 1) % len(speeds)]
            case Button.X:
                self._begin()
            case Button.BACK:
                return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Play; return to the title when a replay that stands still is abandoned."""
        self.hints_left -= seconds
        self.prewarmed = self.prewarmed or self.runner.prewarm(7.0)
        self.timeline.explore(EXPLORED)
        if self.playing and not self.ended:
            self.runner.advance(seconds, self.speed)
        else:
            self.runner.wait(seconds)
            if self.context.idle > IDLE:
                return Home()
        return None

    def jump(self, tick: int) -> None:
        """Continue from another tick, cut to the length of the replay."""
        tick = max(0, min(tick, self.timeline.length))
        self.runner = MatchRunner(self.context, self.timeline.match_at(tick - 1))
        if tick:
            self.runner.tick()  # the view derives flying bullets from two ticks

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match; in the margins the timeline, the speed and the hints."""
        self.runner.draw(screen)
        if self.hints_left > 0.0 or not self.playing or self.ended:
            self.hints.draw(screen)
        words, seconds = self.context.words, self.runner.match.seconds
        if seconds < HINTS_SECONDS or not self.playing:
            self.runner.draw_captions(screen, [None] * len(self.replay.setup.seats))
        self._draw_timeline(screen)
        for marks in self.marks:
            marks.draw(screen, self.tick)
        if self.ended:
            caption(words("replay.over"), ALARM, ICE, LABEL, face="head").draw(screen, 960, 590)
        elif not self.playing or self.speed != 1.0 or seconds < HINTS_SECONDS:
            label = words("replay.title") if self.playing else words("replay.hint_pause")
            side_note(label, SPEEDS[self.speed]).draw(screen)
        if self.replay.other_engine and seconds < NOTICE:
            caption(words("replay.other_engine"), FOCUS).draw(screen, 960, NOTICE_Y)

    def _draw_timeline(self, screen: pygame.Surface) -> None:
        """The line below the arena with the present tick, and marks for moments and faults."""
        now = self._x(self.tick)
        pygame.draw.line(screen, STEEL, (LINE_LEFT, LINE_Y), (LINE_RIGHT, LINE_Y), 4)
        pygame.draw.line(screen, ICE, (LINE_LEFT, LINE_Y), (now, LINE_Y), 6)
        for moment in self.replay.moments:
            x = self._x(moment.tick)
            diamond = [(x - MARK, LINE_Y), (x, LINE_Y - MARK), (x + MARK, LINE_Y), (x, LINE_Y + MARK)]
            pygame.draw.polygon(screen, ICE, diamond)
        for marks in self.marks:
            marks.draw_marks(screen, self._x, LINE_Y)
        pygame.draw.circle(screen, FOCUS, (now, LINE_Y), 9)

    def _x(self, tick: int) -> float:
        """A tick's place on the timeline, px."""
        return LINE_LEFT + (LINE_RIGHT - LINE_LEFT) * min(1.0, tick / max(1, self.timeline.length))

    @property
    def tick(self) -> int:
        """The present tick."""
        return int(self.runner.match.state.tick)

    @property
    def hints(self) -> SideHints:
        """The hints, in the margin."""
        return SideHints(self.prompts)

    @property
    def prompts(self) -> ButtonPrompts:
        """The current button prompts; at the end there is no pause or speed."""
        jump, back = (Button.RIGHT, "replay.hint_jump"), (Button.BACK, "replay.hint_back")
        if self.ended:
            return self.context.prompts([(Button.FIRE, "replay.hint_again"), jump, back])
        fire = "replay.hint_pause" if self.playing else "replay.hint_play"
        speed, again = (Button.Y, "replay.hint_speed"), (Button.X, "replay.hint_again")
        return self.context.prompts([(Button.FIRE, fire), jump, speed, again, back])

    @property
    def ended(self) -> bool:
        """True at the end of the recording."""
        return self.runner.match.over or self.runner.match.seconds >= self.timeline.length * DT

    def _begin(self) -> None:
        self.jump(0)
        self.playing = True
