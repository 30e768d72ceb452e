"""View of a game with walls, robots and points, for other games to extend."""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

import pygame

from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.film import Film
from pigaming_app.scenes.views.hud.ai_sign import name_of
from pigaming_app.scenes.views.hud.parts import Y as TOP_OF_PANELS
from pigaming_app.scenes.views.hud.parts import pulse
from pigaming_app.scenes.views.hud.score import ScoreHud
from pigaming_app.scenes.views.hud.team_score import TeamHud
from pigaming_app.scenes.views.particles import reel
from pigaming_app.scenes.views.rumble import GIVEN
from pigaming_app.scenes.views.sprites.effects import LIGHT_LEVELS, WAVE_STEPS, light, wave
from pigaming_app.scenes.views.sprites.floors import pattern_of
from pigaming_app.scenes.views.view import MatchView, Pose, SoundCue, ViewOptions
from pigaming_app.scenes.views.walled_background import Starts, WalledBackground, walled_floor
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import ROBOTS
from pigaming_app.ui.draw import HERO, ICE, PLAYERS, SUB, Color
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.layers import LitImage, fit_size, text
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step
from pigaming_app.ui.i18n import Words, signed

SAID, SAID_Y = 1.7, 190.0  # s for which a word is announced, and px from the top of the arena
NAMED = 150  # px from the word to a name below it
SKIP_AFTER = 0.5  # s of a ceremony after which FIRE ends it: shots are over by then
ABOVE = 66  # px from a robot up to the points that it has just made


class SimpleView(MatchView):
    """Walls, robots, points. A game overrides what differs: `begin`, `start_order`, `floor_marks` and `samples`, called
    once; `events`, called after every tick; `clock_words`, `moment`, `marks`, `draw_robot` and `above`, called for a
    picture; `open`, called before the countdown.

    Of use to these: `pose`, `on_canvas`, `announce`, `present`, `rumble`, `word`, `name`; `particles` (`burst`,
    `shock`, `glow`, `shake`); `seats`, those that play; `options`, the effects that people want to see.

    `wears_teams = True`: rings and HUD have the colours of the teams, whose points are the largest figures.
    `memory = 60`: `film` keeps the states of the last 60 ticks.
    """

    shocks: Sequence[Color] = ()  # colours of `particles.shock`
    glows: Sequence[Color] = ()  # colours of `particles.glow`
    memory = 0

    def __init__(
        self, arena: Arena, state: Any, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        self.words = words
        floor = partial(walled_floor, pattern_of(arena), *self.floor_marks(state))
        self.walls = WalledBackground(len(arena.walls), floor, self.starts(arena, state))
        super().__init__(state, players, options, words, self.walls, arena.things)
        self.hud = self.make_hud(state)
        self.said: tuple[str, Color, float, str] = "", ICE, 0.0, ""  # announcement, colour, when it began; a name below
        self.film = Film(self.memory)
        self.ceremony = 0.0, 0.0  # when it began, and how long it lasts, s
        self.begin(state)
        self.scores = [robot.score for robot in state.robots]
        self.add_prewarm_jobs(self.hud.jobs())
        self.add_prewarm_jobs(partial(wave, color, stage) for color in self.shocks for stage in range(WAVE_STEPS))
        self.add_prewarm_jobs(
            partial(light, color, level) for color in self.glows for level in range(LIGHT_LEVELS, 0, -1)
        )
        self.add_prewarm_jobs(self.samples())

    def begin(self, state: Any) -> None:
        """Set up what the view remembers of a match that begins, or goes on."""

    def start_order(self, state: Any) -> Sequence[int]:
        """The start, 0 to 3, on which each seat begins."""
        return state.starts  # type: ignore[no-any-return]

    def starts(self, arena: Arena, state: Any) -> Starts:
        """Where the robots of the seats that play begin."""
        poses = [arena.starts[k] for k in self.start_order(state)]
        return tuple((i, poses[i].x, poses[i].y) for i in range(ROBOTS) if state.robots[i].present)

    def floor_marks(self, state: Any) -> tuple[Any, ...]:
        """A function that draws on the floor, in px of the arena, and its arguments after the canvas, all hashable."""
        return ()

    def clock_words(self, state: Any) -> str:
        """Words that stand in place of the clock, lines parted by |; empty: the clock."""
        return ""

    def make_hud(self, state: Any) -> ScoreHud:
        """The HUD, on `background` for `players`."""
        return (TeamHud if self.wears_teams else ScoreHud)(self.background, state, self.players)

    def show_names(self, names: Sequence[str]) -> None:
        self.hud.names = names

    def samples(self) -> Iterator[Job]:
        """Functions that make its sprites, which are called before the match, a few in a frame."""
        return iter(())

    def word(self, key: str) -> str:
        """A text in the language of the screen; empty where there is none, as in a benchmark."""
        return self.words(key) if self.words else ""

    def name(self, seat: int) -> str:
        """Who plays on a seat: the entrant of an event, or "Player 2"."""
        return name_of(self.hud.names, seat) or (self.words("match.player", player=seat + 1) if self.words else "")

    def announce(self, word: str, color: Color, name: str = "") -> None:
        """Show a word in the middle for 1.7 s, and a name below it. It is made at once; `announcement` makes it before
        the match.
        """
        self.said = word, color, self.particles.clock, name

    def present(self, seconds: float) -> None:
        """Begin a ceremony. From half a second on, FIRE ends it; `since` is its age."""
        if self.ceremonies:
            self.ceremony = self.particles.clock + self.undrawn, seconds

    @property
    def since(self) -> float:
        """The age of the last ceremony, s."""
        return self.particles.clock + self.undrawn - self.ceremony[0]

    @property
    def presenting(self) -> bool:
        return self.since < self.ceremony[1]

    @property
    def skippable(self) -> bool:
        return SKIP_AFTER <= self.since < self.ceremony[1]

    def skip(self) -> None:
        self.present(0.0)
        self.said = "", ICE, 0.0, ""

    def announcement(self, word: str, color: Color) -> LitImage:
        """The picture of an announced word."""
        return text(word, fit_size(word, HERO, 1000), color, "head")

    def rumble(self, seat: int) -> None:
        """Rumble the pad of a seat a little, after this tick."""
        self.rumbles[seat] = GIVEN

    def moment(self, state: Any, blend: float) -> tuple[Any, float]:
        """The state to draw, and the share of the way to it: of the present, or of the past in a replay. HUD and walls
        show the present.
        """
        return state, blend

    def marks(self, under: Batch, over: Batch, state: Any, blend: float) -> None:
        """Append what lies on the floor, as light (`under` robots) or opaque sprites (`over` the light)."""

    def draw_robot(self, under: Batch, over: Batch, light: Batch, state: Any, seat: int, pose: Pose) -> None:
        """Append a robot: its light on the floor, the robot itself, light above it."""
        self.light_up(under, seat, pose, bool(state.robots[seat].boosting))
        put(over, self.body(seat, step(pose[2], HEADINGS)), pose[0], pose[1])

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
                self.rumble(seat)
                cues.append(("pickup", seat, robot.x))
            self.scores[seat] = robot.score
        return cues

    def watch(self, state: Any) -> list[SoundCue]:
        self.record_poses(state)
        self.film.record(state)
        if state.tick == 1 and self.presenting:  # the one before the match
            self.skip()
        return self.events(state)

    def draw(self, screen: pygame.Surface, state: Any, blend: float, seconds: float) -> None:
        self.particles.advance(seconds)
        self.walls.show_walls(state)
        self.hud.clock_words = self.clock_words(state)
        for slot in self.hud.show(state):
            if self.options.flashes != "off":
                self.particles.bloom(slot.x, TOP_OF_PANELS, 0.4, reel(pulse, self.color(slot.seat), slot.w))
        state, blend = self.moment(state, blend)
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
        self.draw_announcement(screen)

    def draw_announcement(self, screen: pygame.Surface) -> None:
        """Draw what was announced, which rises into its place."""
        word, color, begin, name = self.said
        since = self.particles.clock - begin
        if word and since < SAID:
            y = TOP + SAID_Y + 40 * (1.0 - min(1.0, since / 0.25)) ** 3
            self.announcement(word, color).draw(screen, 960, y)
            if name:
                text(name, fit_size(name, SUB, 1000), color, "head").draw(screen, 960, y + NAMED)

    @staticmethod
    def on_canvas(x: float, y: float) -> tuple[float, float]:
        """Canvas px of a point in arena px."""
        return LEFT + x, TOP + y
