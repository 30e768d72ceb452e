"""Base class of all match views: an opaque background and four sprite batches, interpolated between two ticks.

A view is read-only: it detects events by comparing states, and has its own random generator.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import pygame

from pigaming_app.scenes.views.background import HUD_HEIGHT, LEFT, TOP, Background
from pigaming_app.scenes.views.particles import Particles
from pigaming_app.scenes.views.rumble import Rumble
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.scenes.views.things.on_mat import ThingsOnMat
from pigaming_app.scenes.views.things.styles import NEON
from pigaming_app.scenes.views.tread_marks import TreadMarks
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.world import HEIGHT, RADIUS, WIDTH
from pigaming_app.ui.draw import ADD, PLAYERS, PRE, Color
from pigaming_app.ui.draw.frame_budget import Job, PrewarmQueue
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, Sprite, put, step
from pigaming_app.ui.i18n import Words

REAL_WIDER = 42  # px, extra radius around a real robot
JUMP = 100.0  # px per tick: above it a robot was placed, not driven
Pose = tuple[float, float, float]  # canvas px, canvas px, rad
SoundCue = tuple[str, int | None, float]  # sound name, player for the pitch, x in arena px


class ViewOptions(Protocol):
    """Settings used by a view."""

    @property
    def flashes(self) -> str:
        """off, soft (no screen shake, no light on the ground) or full."""

    @property
    def shake(self) -> bool:
        """True if the screen shakes on hits."""

    @property
    def calm(self) -> bool:
        """True if nothing may flash more than three times a second."""


class ShownEffects:
    """The effects that a match shows by the settings. Calm mode takes precedence: no flashes, no shake."""

    def __init__(self, settings: ViewOptions) -> None:
        self.settings = settings

    @property
    def flashes(self) -> str:
        return "off" if self.calm else self.settings.flashes

    @property
    def shake(self) -> bool:
        return self.settings.shake and not self.calm

    @property
    def calm(self) -> bool:
        return self.settings.calm


class MatchView:
    """View of one match. `players`: for each seat "human" or the name of the AI; may change during the match.

    Subclasses take arena, state, players, options and words, and override `watch` and `draw`. `clock`: the part of the
    HUD between the panels. `style`: of real things. `wears_teams`: robots and HUD have the teams' colours. `opening`: s
    that `open` takes. `ceremonies`: they are shown, since the scene holds the match meanwhile.
    """

    clock = pygame.Rect(820, 0, 280, HUD_HEIGHT)
    style = NEON
    wears_teams = False
    opening = 0.0
    ceremonies = False

    def __init__(
        self,
        state: Any,
        players: list[str],
        options: ViewOptions,
        words: Words | None,
        background: Background,
        things: Sequence[ThingSpec] = (),
    ) -> None:
        self.players, self.options, self.words, self.background = players, options, words, background
        self.real: frozenset[int] = frozenset()  # seats with real robots, which are lit instead of drawn
        self.scale: float = round(state.radius) / RADIUS  # of robots
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.undrawn = 0.0  # s since the last picture
        self.teams = [robot.team % len(TEAMS) for robot in state.robots]
        self.hints: dict[int, str] = {}  # text key of a hint about FIRE, by seat
        self.rumbles: dict[int, Rumble] = {}  # of the last tick, by seat
        self.particles = Particles(options.calm)
        self.treads = [TreadMarks(i) for i in range(len(state.robots))]
        self.previous_poses = self.current_poses = _poses(state)
        self.things = ThingsOnMat(self.style, things)
        self.jobs = PrewarmQueue([lambda: background.surface])
        self.jobs.append(self.things.jobs())
        self.jobs.append(driving(self.seats, self.body))

    def enable_persistence(self, folder: Path) -> None:
        """Called for matches with people: persistent data, such as a best lap, is saved in this data folder."""

    def show_things(self, things: Sequence[ThingSpec]) -> None:
        """Show these real things from now on; marker blocks move up to 30 times a second."""
        self.things.show(things)

    def show_names(self, names: Sequence[str]) -> None:
        """Called before the match for those of an event: show the names of the first seats in the HUD."""

    def watch(self, state: Any) -> list[SoundCue]:
        """Process the last tick; returns its sounds."""
        raise NotImplementedError

    def draw(self, screen: pygame.Surface, state: Any, blend: float, seconds: float) -> None:
        """Draw the canvas, interpolated by `blend` between the last two ticks, `seconds` after the last frame."""
        raise NotImplementedError

    def pose(self, seat: int, blend: float) -> Pose:
        """Canvas pose of a robot, interpolated by `blend` between two ticks, turning the short way."""
        old, new = self.previous_poses[seat], self.current_poses[seat]
        turn = (new[2] - old[2] + math.pi) % math.tau - math.pi
        return old[0] + (new[0] - old[0]) * blend, old[1] + (new[1] - old[1]) * blend, old[2] + turn * blend

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm sprites for at most this many milliseconds; True when complete."""
        return self.jobs.work(milliseconds)

    def open(self) -> None:
        """Begin the ceremony before the countdown."""

    @property
    def presenting(self) -> bool:
        """True during a ceremony, such as that of a goal."""
        return False

    @property
    def skippable(self) -> bool:
        """True if `skip` ends the ceremony."""
        return False

    def skip(self) -> None:
        """End the ceremony: somebody pressed FIRE."""

    def color(self, seat: int) -> Color:
        """The colour of a robot's ring and of its box: that of its player, or of its team."""
        return TEAMS[self.teams[seat]] if self.wears_teams else PLAYERS[seat]

    def body(self, seat: int, turn: int) -> Sprite:
        """The robot of a seat at heading `turn` of HEADINGS."""
        rim = self.color(seat) if self.wears_teams else None
        if self.scale == 1.0:  # as others call it, so that sprites are cached once
            return tank.tank(seat, turn, rim) if rim else tank.tank(seat, turn)
        return tank.tank(seat, turn, rim, self.scale)

    # ---- for subclasses

    def add_prewarm_jobs(self, jobs: Iterator[Job]) -> None:
        """Append prewarm jobs after those of driving robots."""
        self.jobs.append(jobs)

    def record_poses(self, state: Any) -> None:
        """Record the robot poses after this tick."""
        self.previous_poses, self.current_poses = self.current_poses, _poses(state)
        for i, (new, old) in enumerate(zip(self.current_poses, self.previous_poses, strict=True)):
            if abs(new[0] - old[0]) + abs(new[1] - old[1]) > JUMP:
                self.previous_poses = [*self.previous_poses[:i], new, *self.previous_poses[i + 1 :]]

    def show_between(self, one: Any, other: Any) -> None:
        """Show the robots between their poses in two states of the past, until the next tick."""
        self.previous_poses, self.current_poses = _poses(one), _poses(other)

    def reach(self, seat: int, usual: int) -> int:
        """Radius in px of a ring around a robot, enlarged for a wide one and for a real one, which stands in a disc."""
        wide = usual + round(RADIUS * (self.scale - 1.0))
        return wide + REAL_WIDER if seat in self.real else wide

    def light_up(self, under: Batch, seat: int, pose: Pose, fast: bool) -> None:
        """Draw treads, headlights and, if `fast`, the flame of a robot."""
        x, y, heading = pose
        now, marks = self.particles.clock, self.treads[seat]
        marks.add(x, y, heading, now)
        marks.draw(under, now)
        put(under, effects.beam(seat, step(heading, effects.BEAM_TURNS)), x, y)
        if fast:
            put(
                under,
                effects.flame(seat, step(heading, effects.TURNS), 0 if self.options.calm else int(now * 30) % 2),
                x,
                y,
            )

    def paint(self, screen: pygame.Surface, under: Batch, over: Batch, light: Batch, top: Batch) -> None:
        """Draw background and batches: light below robots (clipped to the arena), opaque sprites, light, topmost
        sprites. Real things stay dark below all but the topmost.
        """
        shaken = self.particles.offset
        if shaken == (0, 0):
            screen.blit(self.background.surface, (0, 0))
        else:
            screen.fill((0, 0, 0))
            screen.blit(self.background.surface, shaken)
        self.things.lights(under)
        self.things.clear(screen)
        screen.set_clip((LEFT, TOP, WIDTH, HEIGHT))
        screen.fblits(under, ADD)
        screen.set_clip(None)
        screen.fblits(over, PRE)
        screen.fblits(light, ADD)
        self.things.cover(screen)
        screen.fblits(top, PRE)


def decimal(words: Words | None, number: str) -> str:
    """A number with the decimal sign of the language."""
    return words.decimal(number) if words else number


def _poses(state: Any) -> Sequence[Pose]:
    """Canvas poses of the robots."""
    return [(LEFT + robot.x, TOP + robot.y, robot.heading) for robot in state.robots]


def driving(seats: Sequence[int], body: Callable[[int, int], Sprite]) -> Iterator[Job]:
    """Jobs for driving robots: headings, headlights, treads, flames. `body`: see `MatchView.body`."""
    for turn in range(HEADINGS):
        for seat in seats:
            yield partial(body, seat, turn)
    for seat in seats:
        for turn in range(effects.BEAM_TURNS):
            yield partial(effects.beam, seat, turn)
        for turn in range(effects.TURNS):
            for level in range(effects.TREAD_LEVELS, 0, -1):
                yield partial(effects.tread, seat, turn, level)
        for turn in range(effects.TURNS):
            for flicker in (0, 1):
                yield partial(effects.flame, seat, turn, flicker)
