"""Match with real robots: they drive to their start positions, the match waits while one has a fault, and each can be
handed over to a simulated robot and back.
"""

import logging
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import partial
from typing import Any

import pygame

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import load, with_things
from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.hardware.control.match_recording import MatchRecorder
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.moving_things import MovingThings, same_mud
from pigaming_app.hardware.control.safety import Fault, Response
from pigaming_app.hardware.scan.block_walls import BlockWalls
from pigaming_app.hardware.scan.things import ThingLayout
from pigaming_app.hardware.session.robot_session import RobotSession, cause_of
from pigaming_app.hardware.session.things_on_mat import save_layout
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Pop, Push, Scene, StackOperation
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.replays import reroute_of
from pigaming_app.scenes.mat.robots.fault_page import FaultPage, fault_sentence
from pigaming_app.scenes.mat.robots.interrupted import MatchOf
from pigaming_app.scenes.mat.robots.marker_discs import MarkerDiscs
from pigaming_app.scenes.mat.robots.match_state import match_state
from pigaming_app.scenes.mat.robots.swap_page import SwapPage
from pigaming_app.scenes.mat.robots.take_places import TakePlaces
from pigaming_app.scenes.mat.things.match_watch import MatchWatch
from pigaming_app.scenes.mat.things.moved_page import MovedPage
from pigaming_app.scenes.mat.things.outlines import draw_things
from pigaming_app.scenes.play.opening import LEAD_SECONDS
from pigaming_app.scenes.play.reconnect import Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.storage.day_log import Battery, now
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.draw import ALARM
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.caption import caption

IDLE = 180.0  # s without input while robots take their places, before the return to the title
FAULT_SECONDS = 6.0  # s for which a minor fault is shown
REPORTED_ONLY = ("low", "drifts", "deadman")  # faults that are only reported

log = logging.getLogger("pigaming")


class RealMatch(MatchScene):
    """A match with real robots on the seats `real`. Raises RobotsUnavailable.

    `match_of`: factory of the rematch.
    """

    def __init__(
        self,
        context: Context,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        session: RobotSession,
        match_of: MatchOf,
        game_choice: SceneFactory | None = None,
        rounds: Rounds | None = None,
        arena: Arena | None = None,
        after: Callable[[MatchScene], AfterMatch] | None = None,
    ) -> None:
        rig = session.open()
        chosen = {seat for seat in real if setup.seats[seat].brain != "off"}
        self.session, self.match_of = session, match_of
        super().__init__(
            context,
            setup,
            devices,
            game_choice=game_choice,
            rounds=rounds,
            after=after,
            make=partial(new_match, plant=lambda world: MixedPlant(world, rig, chosen), arena=arena),
            records=arena is None,
        )
        self.robots, self.things = self, arena.things if arena else ()
        plant = self.match.plant
        assert isinstance(plant, MixedPlant)
        self.plant = plant
        plant.recorder = MatchRecorder(session.mm, session.emulated)
        rig.recorder = plant.recorder.run
        self.discs = MarkerDiscs(rig)
        self.gathering: TakePlaces | None = TakePlaces(context, plant, lambda: self.access.hint_device)
        self.watch = MatchWatch(session, rig)
        walls, reroute = len(self.match.arena.walls), reroute_of(self.match)
        plant.things = MovingThings(self.match.state, walls, self.things, reroute)
        if context.settings.blocks and session.ground is not None:
            rig.viewers.append(BlockWalls(session.ground, plant.things).process)
        self.released = False  # rig released
        self.watchers: Sequence[Callable[[dict[str, Any]], None]] = ()  # get its state
        self.waiting = FixedTimestep()  # clock while the match waits
        self.logged: set[tuple[str, int | None]] = set()
        self._mark_real()

    @property
    def real(self) -> set[int]:
        """Seats with real robots, including those still driving to their start positions."""
        return self.plant.real | self.plant.arriving

    def on_enter(self) -> None:
        if self.gathering is None:
            super().on_enter()
            self.watch.resume()
        else:
            self.context.sounds.music(True)
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
        event = admitted
        if event.button is Button.START and self.gathering.clock > self.gathering.INPUT_LOCKOUT:
            self.plant.start_from_here()
            self._begin()
        elif event.button is Button.X:
            for seat in self._missing():
                self.set_real(seat, False)
            self.context.sounds.play("accept")
        elif event.button is Button.BACK:
            self.context.sounds.play("back")
            return Pop()
        return None

    def update(self, seconds: float) -> StackOperation:
        """Advance the match, unless a robot in it has a fault."""
        if self.restart_requested or self.stop_requested:
            return super().update(seconds)
        self.watch.look()
        seconds = self.session.advance(seconds)
        self._publish()
        if self.gathering is not None:
            return self._take_places(self.gathering, seconds)
        if self.plant.safety.pauses and not self.match.over:
            return Push(FaultPage(self))
        if places := self.watch.places if not self.match.over else []:
            return Push(MovedPage(self, places))
        if self.opening.countdown.locked or self.match.over:
            self._stand_still(seconds)
        turn = super().update(seconds)
        self._report_faults()
        return turn

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the match or the start positions; the discs last."""
        if self.gathering is None:
            super().draw(screen)
            self._draw_lights(screen, self.runner.view.things.cover)
        else:
            self.gathering.draw(screen)
            if self.gathering.flood.full:
                draw_corners(screen)
            else:
                draw_things(screen, self.plant.shown_things or ())
                self.draw_overlay(screen)
        if self.gathering is None and not self.match.over:
            self.watch.note(screen)

    # ---- interface for the pages above

    @property
    def items(self) -> Mapping[str, Callable[[Access], Scene]]:
        """Adds the robot swap page to the pause menu."""
        return {"robots": lambda access: SwapPage(self, access)}

    @property
    def preparing(self) -> bool:
        """True while robots drive to their start positions, and while the countdown runs."""
        return self.gathering is not None or super().preparing

    @property
    def kind(self) -> str:
        """What drives: simulated robots only, or emulated or real ones as well."""
        return "simulated" if not self.real else "emulated" if self.session.emulated else "real"

    @property
    def camera_image(self) -> Any:
        """The newest picture of the camera, grey, (height, width); None without one."""
        return self.plant.rig.image

    @property
    def blocked(self) -> bool:
        """True if a robot has a fault."""
        return self.plant.safety.pauses

    def advance_paused(self, seconds: float) -> None:
        """Advance below a page: all robots stand still, faults are updated."""
        self.watch.pause()
        self._stand_still(self.session.advance(seconds))
        self._publish()

    def advance_examined(self, seconds: float) -> None:
        """As `advance_paused`, while the watch examines the picture below it."""
        self.watch.look()
        self._stand_still(self.session.advance(seconds))
        self._publish()

    def draw_overlay(self, screen: pygame.Surface) -> None:
        """Draw the corner markers and the discs on top of everything."""
        self._draw_lights(screen)

    def _draw_lights(self, screen: pygame.Surface, cover: Callable[[pygame.Surface], None] | None = None) -> None:
        if self.real:
            draw_corners(screen)
        self.discs.draw(screen, self.real, cover)

    def apply_pairing(self, channels: Sequence[int], turned: Collection[int]) -> None:
        """Apply a new pairing of radios and robots. `turned`: robots that turned as commanded."""
        self.plant.rig.channels = channels
        self.context.settings.radios = [channel + 1 for channel in channels]
        for robot in turned:
            self.plant.clear_fault(robot)

    def set_real(self, seat: int, real: bool) -> None:
        """Hand a seat over to its simulated or its real robot, which first drives to its position."""
        if real == (seat in self.real):
            return
        self.plant.swap(seat, real)
        if self.plant.arriving:
            self.gathering = TakePlaces(self.context, self.plant, lambda: self.access.hint_device)
        self._mark_real()

    def rebuild(self, layout: ThingLayout) -> bool:
        """Go on among things that were scanned anew: walls are moved; for other mud the match starts again.

        False if the arena cannot be played with them.
        """
        specs = tuple(thing.spec for thing in layout.things)
        try:
            save_layout(self.session, layout)
            with_things(self.setup.game, load(self.setup.game, self.setup.arena), specs)
        except ArenaError as error:
            log.warning("%s", error)
            return False
        except NotSaved as error:
            log.warning("%s", error)
        assert self.plant.things is not None
        if not same_mud(specs, self.things):
            self.restart()
        self.things, self.plant.things.wanted, self.sequel.records = specs, specs, False
        return True

    def again(self, setup: Setup, devices: Sequence[Device | None], rounds: Rounds | None) -> Scene:
        """The same match, for which the robots drive to their places."""
        self.on_leave()
        return self.match_of(setup, devices, self.real, rounds=rounds, things=self.things)

    def note(self) -> None:
        """Note the batteries of the robots."""
        for robot in sorted(self.real):
            report = self.plant.rig.telemetry(robot)
            if report and report.battery:
                self.context.day_log.add(Battery(now(), robot + 1, round(report.battery, 2)))

    # ---- inside

    def _take_places(self, gathering: TakePlaces, seconds: float) -> StackOperation:
        """Drive the robots to their start positions."""
        if lost := self.drivers.unplugged:
            return Push(Reconnect(self, lost[0]))
        if self.access.update(seconds):
            self.context.sounds.play("back")
            return Pop()
        gathering.update(seconds)
        self.opening.signs.work(0.0)
        self.runner.prewarm(4.0)
        for _ in range(self.waiting.due(seconds)):
            if self.plant.take_places():
                self._begin()
                break
        self._report_faults()
        if self.plant.safety.stopped or self.plant.safety.latched:
            return Push(FaultPage(self))
        return Home() if self.context.idle > IDLE else None

    def _missing(self) -> list[int]:
        """Robots that cannot reach their start positions on their own."""
        troubled = {fault.robot for fault in self.plant.faults if fault.pauses}
        late = [place for place in self.plant.places if not place.arrived]
        return [place.robot for place in late if not place.moving or {None, place.robot} & troubled]

    def _begin(self) -> None:
        """Start the match from the robots' current positions."""
        self.gathering = None
        self.watch.resume()
        self.opening.countdown.restart(1.0, LEAD_SECONDS)
        self.drivers.quiet = 0.0
        self.context.sounds.play("ready", 0)
        self._mark_real()

    def _stand_still(self, seconds: float) -> None:
        """Keep all robots still."""
        for _ in range(self.waiting.due(seconds)):
            self.plant.watch()
        self._report_faults()

    def _mark_real(self) -> None:
        """Update view and tracker with the set of real robots."""
        self.runner.view.real = frozenset(self.real)
        self.plant.rig.tracker.expected = self.real

    def _report_faults(self) -> None:
        """Log new faults; show the minor ones over the match."""
        now = {(fault.name, fault.robot): fault for fault in self.plant.faults if self._reportable(fault)}
        if self.plant.recorder and self.gathering is None and not self.match.over:
            self.plant.recorder.record_faults(self.match.state.tick, self.plant.rig.clock(), list(now.values()))
        for key in now.keys() - self.logged:
            cause = cause_of(self.plant.rig, now[key].name)
            sentences = [
                fault_sentence(now[key], english(), "FIRE"),
                *([english().long_sentence(cause)] if cause else []),
            ]
            log.warning("%s", " ".join(sentences))
            if now[key].name in REPORTED_ONLY:
                sentence = fault_sentence(now[key], self.context.words, "")
                self.runner.notice.show(caption(sentence, ALARM, player=now[key].robot), FAULT_SECONDS)
        self.logged = set(now)

    def _publish(self) -> None:
        """Hand the state of the match to those who watch it."""
        if self.watchers:
            waiting = self.gathering is not None or self.blocked or self.opening.countdown.locked
            state = match_state(self.match, self.plant.faults, waiting)
            for watch in self.watchers:
                watch(state)

    def _reportable(self, fault: Fault) -> bool:
        """False for a robot that is only briefly hard to see."""
        return fault.response is not Response.HALF and (fault.pauses or fault.name in REPORTED_ONLY)
