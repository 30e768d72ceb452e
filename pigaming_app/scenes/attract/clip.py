"""A highlight in attract mode: a few seconds of a match around a moment, which passes in slow motion."""

import pygame

from pigaming_app.games.moments import LAST
from pigaming_app.scenes.features.replays import timeline_of
from pigaming_app.scenes.flow.scene import Context, Home, StackOperation
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.recordings.store import Highlight
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ICE, LABEL, PLAYERS
from pigaming_app.ui.input.events import InputEvent
from pigaming_app.ui.widgets.caption import caption

BEFORE, AFTER = 5 * HZ, 2 * HZ  # ticks shown before and after the moment
SLOW_BEFORE, SLOW_AFTER = HZ // 2, HZ // 2  # ticks before and after it in slow motion
SLOW = 0.4  # times real time
EXPLORED = 40  # ticks played ahead per frame while the clip is prepared
END_SECONDS = 1.5  # s for which the last picture stays
CAPTION_Y = 206  # px


class Clip:
    """The clip of a highlight. Call `prepare` once per frame until it returns True."""

    def __init__(self, context: Context, highlight: Highlight) -> None:
        self.context, (self.replay, self.moment) = context, highlight
        self.timeline = timeline_of(self.replay)
        self.start = max(0, self.moment.tick - BEFORE)
        self.end = min(self.timeline.length, self.moment.tick + AFTER)
        self.runner: MatchRunner | None = None
        self.over = 0.0

    def prepare(self) -> bool:
        """A small step towards the first picture; True when it can be shown."""
        if self.timeline.explored < self.start:
            self.timeline.explore(min(EXPLORED, self.start - self.timeline.explored))
            return False
        if self.runner is None:
            self.runner = MatchRunner(self.context, self.timeline.match_at(self.start), loud=False)
        return self.runner.prewarm(3.0)

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        return None

    def update(self, seconds: float) -> StackOperation:
        """Play; end a moment after the last tick."""
        assert self.runner
        tick = self.runner.match.state.tick
        if tick < self.end and not self.runner.match.over:
            near = -SLOW_BEFORE <= tick - self.moment.tick <= SLOW_AFTER
            self.runner.advance(seconds, SLOW if near else 1.0)
        else:
            self.runner.wait(seconds)
            self.over += seconds
        return Home() if self.over > END_SECONDS else None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match and its caption."""
        assert self.runner
        self.runner.draw(screen)
        words, kind = self.context.words, self.moment.kind
        what = words(f"highlights.{kind}_{self.replay.setup.game}" if kind == LAST else f"highlights.{kind}")
        seat = self.moment.seat
        line = f"{words('highlights.tag')}  ·  {what}"
        caption(line, PLAYERS[seat], ICE, LABEL, player=seat, face="head").draw(screen, 960, CAPTION_Y)
