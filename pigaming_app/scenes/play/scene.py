"""The match scene: countdown, driving, time up, results. Each of its collaborators has one job:

- `Drivers`: who drives which seat
- `Opening`: the countdown, and what is shown and prepared meanwhile
- `FirstKeys`: the keys that new players have not used yet
- `MatchRunner`: ticks, pictures, sounds
- `Ending`: from the last tick to the next scene
- `Sequel`: the note in the day log, and the scenes that follow
- `Robots`: what the pages above need of real ones
"""

from collections.abc import Callable, Collection, Sequence

import pygame

from pigaming_app.ai.registry import new_match
from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.scene import Context, Push, Scene, StackOperation, Swap
from pigaming_app.scenes.play.drivers import Drivers
from pigaming_app.scenes.play.ending import Ending
from pigaming_app.scenes.play.first_keys import FirstKeys
from pigaming_app.scenes.play.opening import Opening
from pigaming_app.scenes.play.pause import Pause, Robots, SimulatedRobots
from pigaming_app.scenes.play.reconnect import Reconnect, StillThere
from pigaming_app.scenes.play.round_break import draw_margin
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.sequel import Sequel
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.ui.input.events import Button, Device, InputEvent

HALT_AFTER = 60.0  # seconds without any input until the match is halted


class MatchScene:
    """One match, from its countdown to its results. `devices`: the device of each seat; None: an AI, or nobody yet.

    `game_choice`: see `Results`. `rounds`: the rounds before this one, in a match of several; None: it is the only
    one. `after`: makes the scene that follows in place of the results; nobody then joins the match or restarts it. It
    may have `names`, those of the entrants on the first seats. `make`: makes the match, where robots or arena are
    not those of the setup; `records`: its results may be records.
    """

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None] = (),
        speed: float = 1.0,
        game_choice: SceneFactory | None = None,
        rounds: Rounds | None = None,
        after: "Callable[[MatchScene], AfterMatch] | None" = None,
        make: Callable[[Setup], Match] = new_match,
        records: bool = True,
    ) -> None:
        self.context, self.setup, self.speed = context, setup, speed
        self.game_choice, self.rounds, self.after = game_choice, rounds, after
        self.make, self.records = make, records
        self.match = make(setup)
        self.runner = MatchRunner(
            context,
            self.match,
            rumble=lambda seat, felt: self.drivers.rumble(seat, felt),
            names=getattr(after, "names", ()),
        )
        self.runner.view.ceremonies = True
        self.drivers = Drivers(context, self.runner, devices, may_join=after is None)
        self.devices, self.access = self.drivers.devices, self.drivers.access
        self.robots: Robots = SimulatedRobots()
        self.opening = Opening(context, self.runner, self.devices)
        self.first_keys = FirstKeys(context, self.match, self.devices, rounds is not None)
        self.sequel = Sequel(self)
        self.ending = Ending(context, self.runner, rounds, self.sequel.scenes)
        self.restart_allowed = after is None
        self.begun = self.stop_requested = self.restart_requested = False

    def on_enter(self) -> None:
        """Start, or resume after an interruption."""
        self.context.sounds.music(self.setup.game)
        self.drivers.resume()
        if self.begun and not self.match.over:
            self.opening.restart()
        self.begun = True

    def on_leave(self) -> None:
        self.context.controls.stop_rumble()
        self.sequel.note()

    def handle(self, event: InputEvent) -> StackOperation:
        """START or Escape of a seated device pauses, FIRE ends a ceremony; a free one takes a seat driven by an AI."""
        self._skip(event)
        if self.match.over:
            self.ending.handle(event)
            if self.ending.round_break is None:
                return None
        if event.button is Button.LOST:
            self.drivers.idle.forget(event.device)
        admitted = None if self.drivers.give_back(event) else self.drivers.admit(event)
        if admitted is None:
            return None
        if event.button is Button.BRAIN:
            self.runner.next_brain()
        escapes = event.button is Button.BACK and self.drivers.escapes(admitted.device)
        return Push(Pause(self, admitted.device)) if escapes or event.button is Button.START else None

    def update(self, seconds: float) -> StackOperation:
        self.runner.notice.update(seconds)
        self.first_keys.update(seconds)
        if self.restart_requested:
            return Swap(self.sequel.rematch(self.context, self.setup, self.devices))
        if self.match.over and not self.ending.begun:
            self.ending.begin(self.sequel.without_records)
            self.sequel.note()
        if self.stop_requested:
            return self.ending.stop(seconds)
        if self.match.over and self.ending.round_break is None:
            return self.ending.update(seconds)
        if held := self.drivers.access.update(seconds):
            return Push(Pause(self, held.device))
        self.drivers.replace_locked()
        if lost := self.drivers.unplugged:
            return Push(Reconnect(self, lost[0]))
        self.drivers.join(seconds)
        if pause := self.ending.round_break:
            return self._begin_round() if self.ending.wait_for_round(pause, seconds) else None
        return None if self.opening.update(seconds) else self._play(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the arena, and the countdown, captions and notices over it; after the end the last hit again."""
        if self.ending.draw(screen, self.picture):
            if self.ending.round_break:
                self.runner.notice.draw(screen)
            return
        self.runner.draw(screen)
        if self.rounds:
            draw_margin(screen, self.context.words, self.rounds, self.runner.view.seats)
        if self.match.over and not self.stop_requested:
            self.ending.draw_sign(screen)
        else:
            self.opening.draw(screen)
            self.first_keys.draw(screen)
        if not (self.preparing or self.held or self.match.over):
            self.runner.draw_hints(screen, self.devices)
        self.drivers.draw(screen)
        self.runner.notice.draw(screen)

    @property
    def names(self) -> Sequence[str]:
        """Those on the seats, see `MatchRunner`."""
        return self.runner.names

    @property
    def preparing(self) -> bool:
        """True until the robots may drive."""
        return self.opening.countdown.locked

    @property
    def held(self) -> bool:
        """True while a ceremony holds the match."""
        return self.match.state.tick > 0 and self.runner.view.presenting

    def picture(self) -> pygame.Surface:
        """The match as drawn behind a page."""
        return self.runner.picture()

    def stop(self) -> None:
        """End the match now, with the current score."""
        self.stop_requested = True

    def restart(self) -> None:
        """Restart with another seed, and the music from its beginning."""
        self.context.sounds.music(None)
        self.restart_requested = True

    def again(self, setup: Setup, devices: Sequence[Device | None], rounds: Rounds | None) -> Scene:
        """The same match with another setup."""
        known = self.context, setup, devices, self.speed, self.game_choice, rounds
        return MatchScene(*known, make=self.make, records=self.records)

    def _skip(self, event: InputEvent) -> None:
        """End a ceremony on FIRE of a seated device."""
        view = self.runner.view
        if event.button is Button.FIRE and view.skippable and self.access.admit(event):
            view.skip()
            self.opening.countdown.skip_lead()

    def _play(self, seconds: float) -> StackOperation:
        """Advance the match, which a ceremony holds; halt it if nobody is there."""
        if self.held:
            self.context.controls.forget_taps()
            self.runner.wait(seconds)
            return None
        self.drivers.replace_idle(seconds)
        self.sequel.begin()
        self.runner.advance(seconds, self.speed)
        return Push(StillThere(self)) if self.drivers.people and self.drivers.quiet > HALT_AFTER else None

    def _begin_round(self) -> StackOperation:
        scene = self.sequel.next_round()
        if isinstance(scene, MatchScene):
            scene.drivers.idle.claims |= self.drivers.idle.claims
            scene.drivers.locked |= self.drivers.locked
            scene.runner.feats = self.runner.feats
        return Swap(scene)


def match_of(
    context: Context,
    setup: Setup,
    devices: Sequence[Device | None],
    real: Collection[int],
    speed: float = 1.0,
    game_choice: SceneFactory | None = None,
    rounds: Rounds | None = None,
    after: Callable[[MatchScene], AfterMatch] | None = None,
) -> Scene:
    """The match, or the page with the reason why the robots of the seats `real` are unavailable.

    `speed`: times real time, for a match without real robots. `game_choice`: see `Results`; `rounds` and `after`: see
    `MatchScene`.
    """
    real = [seat for seat in real if setup.seats[seat].brain != "off"]
    if real and context.mat:
        return context.mat.match(setup, devices, real, game_choice, rounds, after=after)
    return MatchScene(context, setup, devices, speed, game_choice=game_choice, rounds=rounds, after=after)
