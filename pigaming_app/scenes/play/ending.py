"""The end of a match: its last picture, then the break before the next round, or the last hit again and the winner."""

from collections.abc import Callable, Collection

import pygame

from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.features.replays import replay_of
from pigaming_app.scenes.flow.scene import Context, StackOperation, Swap
from pigaming_app.scenes.play.countdown import popped, show
from pigaming_app.scenes.play.last_hit import LastHit, SlowMotion, repeats_last_hit, slow_motion
from pigaming_app.scenes.play.round_break import RoundBreak
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.recordings.store import highlights
from pigaming_app.scenes.results.headline import EndedMatch
from pigaming_app.scenes.results.winner import AfterMatch, WinnersMoment
from pigaming_app.ui.draw import ALARM
from pigaming_app.ui.input.events import InputEvent

FREEZE_SECONDS = 1.5  # seconds between the last tick and the scene that follows
PREWARM_MS = 7.0  # ms per frame for preparing it


class Ending:
    """The time from the last tick to the next scene. `make_next` is called once, when the whole match is over."""

    def __init__(
        self,
        context: Context,
        runner: MatchRunner,
        rounds: Rounds | None,
        make_next: Callable[[], tuple[EndedMatch, AfterMatch]],
    ) -> None:
        self.context, self.runner, self.rounds, self.make_next = context, runner, rounds, make_next
        self.match = runner.match
        self.age = 0.0  # s since the last tick
        self.begun = False
        self.round_break: RoundBreak | None = None
        self.next: AfterMatch | None = None
        self.moment: WinnersMoment | None = None
        self.again: SlowMotion | None = None
        if repeats_last_hit(self.match):
            runner.last_hit = LastHit()

    def begin(self, assisted: Collection[int]) -> None:
        """Fade the music out, keep the match for attract mode, and count the round.

        `assisted`: seats whose results are no records.
        """
        self.begun = True
        self.context.sounds.music(None)
        if replay := replay_of(self.match):
            self.context.shared(highlights).add(replay)
        self.context.sounds.play("go")
        self.again = slow_motion(self.context, self.match, self.runner.view, self.runner.last_hit)
        if self.rounds:
            self.rounds.add(self.match.outcome(), assisted)
            if not self.rounds.done:
                self.round_break = RoundBreak(self.context.words, self.rounds, tuple(self.runner.players))

    def handle(self, event: InputEvent) -> None:
        """Skip the slow motion on a press."""
        if self.again:
            self.again.handle(event)

    def hold(self, seconds: float) -> bool:
        """Hold the last picture for `seconds`, after a ceremony; true when it has been shown long enough."""
        self.runner.wait(seconds)
        if not self.runner.view.presenting:
            self.age += seconds
        return self.age >= FREEZE_SECONDS

    def update(self, seconds: float) -> StackOperation:
        """Show the last hit again, if the rules do so; then swap to the winner's moment."""
        if self.moment is None:
            ended, self.next = self.make_next()
            self.moment = WinnersMoment(self.context, ended, self.next)
        repeated = self.repeat(seconds)
        return Swap(self.moment) if self.moment.prewarm(PREWARM_MS) and repeated else None

    def repeat(self, seconds: float) -> bool:
        """Show the last picture, then the last hit again if the rules do so; true when it has been shown."""
        held = self.hold(seconds)
        if self.again is None:
            return held
        if self.again.prewarm(PREWARM_MS) and held and not self.again.over:
            self.again.update(seconds)
        return self.again.over

    def stop(self, seconds: float) -> StackOperation:
        """Swap to the next scene as soon as it is rendered: the match was ended by hand."""
        self.next = self.next or self.make_next()[1]
        self.hold(seconds)
        return Swap(self.next) if self.next.prewarm(PREWARM_MS) else None

    def wait_for_round(self, pause: RoundBreak, seconds: float) -> bool:
        """Show the end of the round, then the standings; true when the next round begins."""
        if self.repeat(seconds):
            pause.update(seconds)
        return pause.over

    def draw(self, screen: pygame.Surface, behind: Callable[[], pygame.Surface]) -> bool:
        """Draw the last hit or the round break; false if it is not its time yet. `behind`: the darkened match."""
        if self.round_break and (self.again.over if self.again else self.age >= FREEZE_SECONDS):
            self.round_break.draw(screen, behind)
        elif self.again and self.again.seconds:
            self.again.draw(screen)
        else:
            return False
        return True

    def draw_sign(self, screen: pygame.Surface) -> None:
        """Draw over the last picture that the time is up, or that the goal is reached."""
        if self.runner.view.presenting:
            return
        name = "time" if self.match.seconds_left <= 0.0 else "finish"
        show(screen, popped(self.context.words(f"match.{name}"), ALARM, min(4, int(self.age / 0.04))))
