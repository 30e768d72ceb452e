"""The robots of a running arcade: real, emulated, or those of a ROS network."""

import logging
import sys
from collections.abc import Callable, Collection, Sequence
from functools import partial
from math import ceil
from typing import Any

import pygame

from pigaming_app.games.arenas import has_room, load, on_mat, widest
from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.hardware.drivers.ours import UDP
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable, settings_problem
from pigaming_app.hardware.session.ros import RosSession
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.launch import Options
from pigaming_app.sim.arena import Arena, ArenaError
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.world import WIDTH
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Device, StickState
from pigaming_app.ui.window import Canvas

log = logging.getLogger("pigaming")


class SessionMat:
    """A mat; see `RobotMat`. `watchers` get the state of each match with real robots."""

    def __init__(self, context: Context, session: RobotSession) -> None:
        self.context, self.session = context, session
        self.watchers: list[Callable[[dict[str, Any]], None]] = []
        if isinstance(session, RosSession):
            self.watchers.append(session.publish)

    @property
    def available(self) -> bool:
        return bool(self.session.emulated or not self.session.radio or self.context.settings.mat)

    @property
    def problem(self) -> OperatorMessage | None:
        return settings_problem(self.context.settings) if self.session.radio else None

    @property
    def scans(self) -> bool:
        return bool(self.session.radio)

    @property
    def things(self) -> tuple[ThingSpec, ...]:
        from pigaming_app.hardware.session.things_on_mat import things_in_play

        return () if self.context.settings.blocks else things_in_play(self.session)

    def stick(self, seat: int, first: bool) -> StickState | None:
        found = self.session.stick(seat, first) if isinstance(self.session, RosSession) else None
        return StickState(*found) if found else None

    def arena_page(self, devices: Callable[[], Sequence[Device | None]]) -> Scene:
        from pigaming_app.scenes.mat.things.arena_page import ArenaPage

        return ArenaPage(self.context, devices)

    def match(
        self,
        setup: Setup,
        devices: Sequence[Device | None],
        real: Collection[int],
        game_choice: Callable[..., Scene] | None = None,
        rounds: Rounds | None = None,
        things: Sequence[ThingSpec] | None = None,
        after: Callable[..., Any] | None = None,
    ) -> Scene:
        from pigaming_app.scenes.mat.before_match import UnavailablePage, UnplayablePage
        from pigaming_app.scenes.mat.robots.match_scene import RealMatch

        context, again = self.context, partial(self.match, game_choice=game_choice, after=after)
        real = [seat for seat in real if setup.seats[seat].brain != "off"]
        if not real:
            from pigaming_app.scenes.play.scene import MatchScene  # late: the title does not wait for it

            return MatchScene(context, setup, devices, game_choice=game_choice, rounds=rounds, after=after)
        try:
            if reason := self.problem:
                raise RobotsUnavailable(reason)
            if things is None:
                things = self.things
            self.session.open()
            arena = self._arena(setup, things, self.session.radius(real))
            match = RealMatch(context, setup, devices, real, self.session, again, game_choice, rounds, arena, after)
            match.robots.watchers = self.watchers
            return match
        except ArenaError as error:
            self.session.close()
            log.warning("%s", error)
            anew = partial(again, setup, devices, real, rounds=rounds)
            return UnplayablePage(context, setup, devices, anew, partial(anew, things=()))
        except RobotsUnavailable as error:
            self.session.close()
            log.warning("%s", english().long_sentence(error.message))
            return UnavailablePage(context, setup, devices, real, error.message, partial(again, rounds=rounds))

    def has_room(self, game: str, arena: str, robots: Collection[int]) -> bool:
        return has_room(game, load_cached(game, arena).source, self.session.radius(robots), SPARE)

    def _arena(self, setup: Setup, things: Sequence[ThingSpec], radius: float) -> Arena:
        """The arena of a match with robots of a radius, px. Raises ArenaError, RobotsUnavailable."""
        arena, mm = load(setup.game, setup.arena), self.session.mm
        if not has_room(setup.game, arena.source, radius, SPARE):
            least = WIDTH * mm * radius / widest(setup.game, arena.source, SPARE)
            about = {"size": f"{2 * radius * mm:.0f}", "width": f"{WIDTH * mm:.0f}", "least": f"{ceil(least)}"}
            title = arena_title(arena, self.context.words.language)
            raise RobotsUnavailable(OperatorMessage("tight", arena=title, **about))
        return on_mat(setup.game, arena, things, radius)

    def stop(self) -> None:
        self.session.close()

    def end(self) -> None:
        self.session.end()


def opened(context: Context, options: Options) -> SessionMat:
    """The robots that the options ask for. The emulator is imported late, so that the title appears at once."""
    settings, canvas = context.settings, context.canvas
    if options.ros_width is not None:
        network = RosSession(options.ros_width)
        _make_ready(network, context)
        return SessionMat(context, network)
    if options.emulator_seed is None:
        return SessionMat(context, RealSession(settings, lambda: canvas.projection))
    from pigaming_app.hardware.emulator.wifi.air import WifiChannel
    from pigaming_app.hardware.session.emulated import EmulatedSession

    wifi = WifiChannel() if settings.radio == UDP else None
    live, things = options.step is None, options.emulated_things
    session = EmulatedSession(options.emulator_seed, live, lambda: canvas.projection, wifi=wifi, things=things)
    canvas.watchers.append(lambda window: session.show(lambda: _projected(canvas, window)))
    print("PiGaming: the emulated arena is being set up.", file=sys.stderr)
    _make_ready(session, context)
    return SessionMat(context, session)


def _make_ready(session: RobotSession, context: Context) -> None:
    """Open a session whose robots every lobby offers, while no picture is waiting; the first match reopens it."""
    context.settings.real = context.settings.real or [1, 2, 3, 4]
    try:
        session.open()
        session.close()
    except RobotsUnavailable as trouble:
        print(f"PiGaming: {english().long_sentence(trouble.message)}", file=sys.stderr)


def _projected(canvas: Canvas, window: pygame.Surface) -> object:
    """The pixels projected onto the emulated mat: with bars cropped, or the whole window of a pinned picture."""
    from pigaming_app.ui.draw.pixels import pixels_of

    return pixels_of(window if canvas.corners else canvas.screen)
