"""The real robots of a match: their plant, faults, batteries and lights, and what watches the mat below them."""

import logging
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import pygame

from pigaming_app.games.match import Match
from pigaming_app.hardware.control.match_recording import MatchRecorder
from pigaming_app.hardware.control.mixed_plant import MixedPlant
from pigaming_app.hardware.control.moving_things import MovingThings
from pigaming_app.hardware.control.safety import Fault, Response
from pigaming_app.hardware.scan.blocks import BlockWalls
from pigaming_app.hardware.session.robot_session import RobotSession, cause_of
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.scenes.flow.timestep import FixedTimestep
from pigaming_app.scenes.mat.calibration.corner_markers import draw_corners
from pigaming_app.scenes.mat.replays import reroute_of
from pigaming_app.scenes.mat.robots.fault_page import fault_sentence
from pigaming_app.scenes.mat.robots.marker_discs import MarkerDiscs
from pigaming_app.scenes.mat.things.match_watch import MatchWatch
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.storage.day_log import Battery, now
from pigaming_app.ui.draw import ALARM
from pigaming_app.ui.i18n import english
from pigaming_app.ui.widgets.caption import caption

FAULT_SECONDS = 6.0  # s for which a minor fault is shown
REPORTED_ONLY = ("low", "drifts", "deadman")  # faults that are only reported

log = logging.getLogger("pigaming")


class RealRobots:
    """The robots below the match of a scene. `items`: of its pause menu; `watchers`: get the state of the match."""

    def __init__(
        self,
        scene: MatchScene,
        session: RobotSession,
        things: Sequence[ThingSpec],
        items: Mapping[str, Callable[[Access], Scene]],
    ) -> None:
        plant = scene.match.plant
        assert isinstance(plant, MixedPlant)
        self.scene, self.session, self.things, self.items, self.plant = scene, session, things, items, plant
        rig = plant.rig
        plant.recorder = MatchRecorder(session.mm, session.emulated)
        rig.recorder = plant.recorder.run
        self.watch = MatchWatch(session, rig)
        self._discs = MarkerDiscs(rig, session.printed)
        plant.things = MovingThings(
            scene.match.state, len(scene.match.arena.walls), tuple(things), reroute_of(scene.match)
        )
        if scene.context.settings.blocks and session.ground is not None:
            rig.viewers.append(BlockWalls(session.ground, plant.things).process)
        self.watchers: Sequence[Callable[[dict[str, Any]], None]] = ()
        self.clock = FixedTimestep()  # while the match waits
        self.gathering = True  # they drive to their start positions
        self._logged: set[tuple[str, int | None]] = set()
        self.mark()

    @property
    def real(self) -> set[int]:
        """Seats with real robots, including those still driving to their start positions."""
        return self.plant.real | self.plant.arriving

    @property
    def kind(self) -> str:
        """What drives: simulated robots only, or emulated or real ones as well."""
        return "simulated" if not self.real else "emulated" if self.session.emulated else "real"

    @property
    def blocked(self) -> bool:
        """True if a robot has a fault."""
        return self.plant.safety.pauses

    def note(self) -> None:
        """Note the batteries."""
        for robot in sorted(self.real):
            report = self.plant.rig.telemetry(robot)
            if report and report.battery:
                self.scene.context.day_log.add(Battery(now(), robot + 1, round(report.battery, 2)))

    def mark(self) -> None:
        """Update view and tracker with the set of real robots."""
        self.scene.runner.view.real = frozenset() if self.session.printed else frozenset(self.real)
        self.plant.rig.tracker.expected = self.real

    def apply_pairing(self, channels: Sequence[int], turned: Collection[int]) -> None:
        """Apply a new pairing of radios and robots. `turned`: robots that turned as commanded."""
        self.plant.rig.channels = channels
        self.scene.context.settings.radios = [channel + 1 for channel in channels]
        for robot in turned:
            self.plant.clear_fault(robot)

    def advance(self, seconds: float) -> float:
        """Advance the session and whoever watches; returns the time that has passed in it, s."""
        self.watch.look()
        seconds = self.session.advance(seconds)
        self._publish()
        return seconds

    def stand_still(self, seconds: float) -> None:
        """Keep all robots still."""
        for _ in range(self.clock.due(seconds)):
            self.plant.watch()
        self.report()

    def advance_paused(self, seconds: float) -> None:
        """Advance below a page: all robots stand still, faults are updated."""
        self.watch.pause()
        self.stand_still(self.session.advance(seconds))
        self._publish()

    def advance_examined(self, seconds: float) -> None:
        """As `advance_paused`, while the watch examines the picture below it."""
        self.watch.look()
        self.stand_still(self.session.advance(seconds))
        self._publish()

    def draw_overlay(self, screen: pygame.Surface, cover: Callable[[pygame.Surface], None] | None = None) -> None:
        """Draw corner markers and discs on top of everything; `cover`: draws what stands on the mat.

        Over a printed floor the game shows the robots itself, once they stand on their places.
        """
        if self.session.printed and not self.gathering:
            return
        if self.real and not self.session.printed:
            draw_corners(screen)
        self._discs.draw(screen, self.real, cover, self.scene.runner.view.color)

    def report(self) -> None:
        """Log new faults; show the minor ones over the match."""
        scene, plant = self.scene, self.plant
        faults = {(fault.name, fault.robot): fault for fault in plant.faults if _reportable(fault)}
        if plant.recorder and not self.gathering and not scene.match.over:
            plant.recorder.record_faults(scene.match.state.tick, plant.rig.clock(), list(faults.values()))
        for key in faults.keys() - self._logged:
            fault, cause = faults[key], cause_of(plant.rig, faults[key].name)
            sentences = [fault_sentence(fault, english(), "FIRE"), *([english().long_sentence(cause)] if cause else [])]
            log.warning("%s", " ".join(sentences))
            if fault.name in REPORTED_ONLY:
                sentence = fault_sentence(fault, scene.context.words, "")
                scene.runner.notice.show(caption(sentence, ALARM, player=fault.robot), FAULT_SECONDS)
        self._logged = set(faults)

    def _publish(self) -> None:
        """Hand the state of the match to those who watch it."""
        if self.watchers:
            state = match_state(
                self.scene.match, self.plant.faults, self.blocked or self.scene.preparing or self.scene.held
            )
            for watch in self.watchers:
                watch(state)


def _reportable(fault: Fault) -> bool:
    """False for a robot that is only briefly hard to see."""
    return fault.response is not Response.HALF and (fault.pauses or fault.name in REPORTED_ONLY)


def match_state(match: Match, faults: Sequence[Fault], waiting: bool) -> dict[str, Any]:
    """The state of a match for programs that watch it, as values for JSON.

    Lengths are arena px, y down; headings rad, clockwise; robots and seats count from 1.
    """
    state, setup = match.state, match.setup
    return {
        "game": setup.game,
        "variant": setup.variant,
        "arena": setup.arena,
        "tick": int(state.tick),
        "seconds": round(match.seconds, 2),
        "seconds_left": round(match.seconds_left, 2),
        "waiting": waiting,
        "over": match.over,
        "faults": [{"name": one.name, "robot": None if one.robot is None else one.robot + 1} for one in faults],
        "robots": [
            {
                "robot": seat + 1,
                "brain": setup.seats[seat].brain,
                "team": int(robot.team),
                "score": int(robot.score),
                "x": round(robot.x, 2),
                "y": round(robot.y, 2),
                "heading": round(robot.heading, 4),
            }
            for seat, robot in enumerate(state.robots)
            if robot.present
        ],
        "walls": [
            [round(number, 1) for number in (wall.ax, wall.ay, wall.bx, wall.by, wall.half)]
            for wall in state.walls[: state.wall_count]
            if wall.health
        ],
    }
