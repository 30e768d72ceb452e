"""Match with real robots: they drive to their start positions, the match waits while one has a fault, and each can be
handed over to a simulated robot and back.
"""

import logging
from collections.abc import Callable, Collection, Sequence
from functools import partial
from typing import Any

import pygame

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import load, on_mat
from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.moving_things import same_mud
from pigaming_app.hardware.scan.things import ThingLayout
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.hardware.session.things_on_mat import save_layout
from pigaming_app.scenes.flow.scene import Context, Home, Pop, Push, Scene, StackOperation
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.robots.fault_page import FaultPage
from pigaming_app.scenes.mat.robots.real_robots import RealRobots
from pigaming_app.scenes.mat.robots.swap_page import SwapPage
from pigaming_app.scenes.mat.robots.take_places import TakePlaces
from pigaming_app.scenes.mat.things.moved_page import MovedPage
from pigaming_app.scenes.mat.things.outlines import draw_things
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.input.events import Button, Device, InputEvent

IDLE = 180.0  # s without input while robots take their places, before the return to the title

log = logging.getLogger("pigaming")


class RealMatch(MatchScene):
    """A match with real robots on the seats `real`. Raises RobotsUnavailable.

    `match_of`: factory of the rematch. `gathering`: while robots drive to their start positions.
    """

    robots: RealRobots

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        session: RobotSession,
        match_of: Callable[..., Scene],
        game_choice: SceneFactory | None = None,
        rounds: Rounds | None = None,
        arena: Arena | None = None,
        after: Callable[[MatchScene], AfterMatch] | None = None,
    ) -> None:
        rig = session.open()
        chosen = {seat for seat in real if setup.seats[seat].brain != "off"}
        make = partial(new_match, plant=lambda world: MixedPlant(world, rig, chosen), arena=arena)
        super().__init__(context, setup, devices, 1.0, game_choice, rounds, after, make, not arena or not arena.things)
        items = {"robots": lambda access: SwapPage(self, access)}
        self.robots = RealRobots(self, session, arena.things if arena else (), items)
        self.plant, self.session, self.watch = self.robots.plant, session, self.robots.watch
        self.match_of, self.released = match_of, False
        self._gather()

    @property
    def real(self) -> set[int]:
        """Seats with real robots, including those still driving to their start positions."""
        return self.robots.real

    @property
    def camera_image(self) -> Any:
        """The newest picture of the camera, grey, (height, width); None without one."""
        return self.plant.rig.image

    @property
    def preparing(self) -> bool:
        """True while robots drive to their start positions, and while the countdown runs."""
        return self.gathering is not None or super().preparing

    def on_enter(self) -> None:
        if self.gathering is None:
            super().on_enter()
            self.watch.resume()
        else:
            self.context.sounds.music(self.setup.game)
            self.begun = True

    def on_leave(self) -> None:
        """Stop the robots; release camera and radio, unless the next match already uses them."""
        super().on_leave()
        self.watch.pause()
        if not self.released:
            self.released = True
            self.session.close()

    def handle(self, event: InputEvent) -> StackOperation:
        """As in every match; STOP stops all robots. While robots take their places, START begins from the current
        positions, X replaces missing robots with simulated ones, BACK leaves.
        """
        if event.button is Button.STOP and (not self.match.over or self.ending.round_break):
            self.plant.safety.all_stop()
            self.plant.watch()
            return Push(FaultPage(self, event.device))
        if self.gathering is None:
            return super().handle(event)
        admitted = self.access.admit(self.gathering.prompts.as_button(event))
        if admitted is None:
            return None
        if admitted.button is Button.START and self.gathering.clock > self.gathering.INPUT_LOCKOUT:
            self.plant.start_from_here()
            self._begin()
        elif admitted.button is Button.X:
            for seat in self.gathering.stuck:
                self.set_real(seat, False)
            self.context.sounds.play("accept")
        elif admitted.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Advance the match, unless a robot in it has a fault."""
        if self.restart_requested or self.stop_requested:
            return super().update(seconds)
        seconds = self.robots.advance(seconds)
        if self.gathering is not None:
            return self._take_places(self.gathering, seconds)
        if self.robots.blocked and not self.match.over:
            return Push(FaultPage(self))
        if places := self.watch.places if not self.match.over else []:
            return Push(MovedPage(self, places))
        if self.preparing or self.held or self.match.over:
            self.robots.stand_still(seconds)
        turn = super().update(seconds)
        self.robots.report()
        return turn

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match or the start positions; the discs last."""
        if self.gathering is None:
            super().draw(screen)
            self.robots.draw_overlay(screen, self.runner.view.things.cover)
            if not self.match.over:
                self.watch.note(screen)
            return
        self.gathering.draw(screen)
        if self.gathering.flood.full:
            draw_corners(screen)
        else:
            draw_things(screen, self.plant.shown_things or ())
            self.robots.draw_overlay(screen)

    def set_real(self, seat: int, real: bool) -> None:
        """Hand a seat over to its simulated or its real robot, which first drives to its position."""
        if real == (seat in self.real):
            return
        self.plant.swap(seat, real)
        if self.plant.arriving:
            self._gather()
        self.robots.mark()

    def rebuild(self, layout: ThingLayout) -> bool:
        """Go on among things that were scanned anew: walls are moved; for other mud the match starts again.

        False if the arena cannot be played with them.
        """
        specs = tuple(thing.spec for thing in layout.things)
        try:
            save_layout(self.session, layout)
            arena = load(self.setup.game, self.setup.arena)
            on_mat(self.setup.game, arena, specs, self.match.state.radius)
        except ArenaError as error:
            log.warning("%s", error)
            return False
        except NotSaved as error:
            log.warning("%s", error)
        assert self.plant.things is not None
        if not same_mud(specs, self.robots.things):
            self.restart()
        self.robots.things, self.plant.things.wanted, self.sequel.records = specs, specs, False
        return True

    def again(self, setup: Setup, devices: Sequence[Device | None], rounds: Rounds | None) -> Scene:
        """The same match, for which the robots drive to their places."""
        self.on_leave()
        return self.match_of(setup, devices, self.real, rounds=rounds, things=self.robots.things)

    def _gather(self) -> None:
        """Let the robots drive to their start positions."""
        self.gathering: TakePlaces | None = TakePlaces(self.context, self.plant, lambda: self.access.hint_device)
        self.robots.gathering = True

    def _take_places(self, gathering: TakePlaces, seconds: float) -> StackOperation:
        """Drive the robots to their start positions."""
        self.drivers.replace_locked()
        if lost := self.drivers.unplugged:
            return Push(Reconnect(self, lost[0]))
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        gathering.update(seconds)
        self.opening.signs.work(0.0)
        self.runner.prewarm(4.0)
        for _ in range(self.robots.clock.due(seconds)):
            if self.plant.take_places():
                self._begin()
                break
        self.robots.report()
        if self.plant.safety.stopped or self.plant.safety.latched:
            return Push(FaultPage(self))
        return Home() if self.context.idle > IDLE else None

    def _begin(self) -> None:
        """Start the match from the robots' current positions."""
        self.gathering, self.robots.gathering = None, False
        self.watch.resume()
        self.opening.begin()
        self.drivers.quiet = 0.0
        self.context.sounds.play("ready", 0)
        self.robots.mark()
