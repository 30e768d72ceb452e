"""View of a game with walls, robots and points, for other games to extend."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import pygame

from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.hud.parts import Y as TOP_OF_PANELS
from pigaming_app.scenes.views.hud.score import ScoreHud, pulse
from pigaming_app.scenes.views.particles import reel
from pigaming_app.scenes.views.rumble import GIVEN
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.view import MatchView, Pose, SoundCue, ViewOptions
from pigaming_app.scenes.views.walled_background import Starts, WalledBackground, walled_floor
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.numbers import signed

ABOVE = 66  # px from a robot up to the points that it has just made


class SimpleView(MatchView):
    """Walls, robots, points. Subclasses override what differs: `starts`, `floor`, `make_hud`, called once; `marks`,
    `draw_robot` and `above`, called for every picture; `sprites` and `events`.
    """

    def __init__(
        self, arena: Arena, state: Any, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        self.walls = WalledBackground(len(arena.walls), self.floor(self.starts(arena, state), state))
        super().__init__(state, players, options, words, self.walls, arena.things)
        self.hud = self.make_hud(state)
        self.scores = [robot.score for robot in state.robots]
        self.add_prewarm_jobs(self.hud.jobs())
        self.add_prewarm_jobs(self.sprites())

    def starts(self, arena: Arena, state: Any) -> Starts:
        """Where the robots start."""
        return tuple((i, arena.starts[i].x, arena.starts[i].y) for i in range(ROBOTS) if state.robots[i].present)

    def floor(self, starts: Starts, state: Any) -> Callable[[], pygame.Surface]:
        """The renderer of all that lies under the walls, opaque: here grid, frame, and a mark at each start."""
        return partial(walled_floor, starts)

    def make_hud(self, state: Any) -> ScoreHud:
        """The HUD, on `background` for `players`."""
        return ScoreHud(self.background, state, self.players)

    def show_names(self, names: Sequence[str]) -> None:
        self.hud.names = names

    def sprites(self) -> Iterator[Job]:
        """Prewarm jobs for sprites of its own."""
        return iter(())

    def marks(self, under: Batch, over: Batch, state: Any, blend: float) -> None:
        """Append what lies on the floor, as light (`under` robots) or opaque sprites (`over` the light)."""

    def draw_robot(self, under: Batch, over: Batch, light: Batch, state: Any, seat: int, pose: Pose) -> None:
        """Append a robot: its light on the floor, the robot itself, light above it."""
        self.light_up(under, seat, pose, bool(state.robots[seat].boosting))
        put(over, tank.tank(seat, step(pose[2], HEADINGS)), pose[0], pose[1])

    def above(self, light: Batch, top: Batch, state: Any, blend: float) -> None:
        """Append what lies above the robots, as light, or as opaque sprites on top of all."""

    def events(self, state: Any) -> list[SoundCue]:
        """Particles and sounds of the last tick; here those of points."""
        cues: list[SoundCue] = []
        self.rumbles = {}
        for seat in self.seats:
            robot = state.robots[seat]
            if robot.score > self.scores[seat]:
                x, y, _ = self.current_poses[seat]
                self.particles.score(x, y - self.reach(seat, ABOVE), signed(robot.score - self.scores[seat]), seat)
                self.particles.burst(x, y, PLAYERS[seat], 16, 46, 60)
                self.rumbles[seat] = GIVEN
                cues.append(("pickup", seat, robot.x))
            self.scores[seat] = robot.score
        return cues

    def watch(self, state: Any) -> list[SoundCue]:
        self.record_poses(state)
        return self.events(state)

    def draw(self, screen: pygame.Surface, state: Any, blend: float, seconds: float) -> None:
        self.particles.advance(seconds)
        self.walls.show_walls(state)
        for slot in self.hud.show(state):
            if self.options.flashes != "off":
                self.particles.bloom(slot.x, TOP_OF_PANELS, 0.4, reel(pulse, slot.seat, slot.w))
        under: Batch = []
        over: Batch = []
        light: Batch = []
        top: Batch = []
        self.marks(under, over, state, blend)
        for seat in self.seats:
            self.draw_robot(under, over, light, state, seat, self.pose(seat, blend))
        self.above(light, top, state, blend)
        self.particles.draw_light(light)
        self.particles.draw_scores(top)
        self.paint(screen, under, over, light, top)


def on_canvas(x: float, y: float) -> tuple[float, float]:
    """Canvas px of a point in arena px."""
    return LEFT + x, TOP + y
