"""A lesson on the screen: its match in a loop, cut out round what it shows, and the keys that play it."""

import math
from typing import Any

import pygame
from pygame.typing import RectLike

from pigaming_app.ai.brain.steering import approach, bearing, turn_stick
from pigaming_app.ai.registry import make_brain
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.lesson import GO, TURN, Lesson, Step
from pigaming_app.sim.action import set_action
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.world import HEIGHT, HZ, ROBOTS, WIDTH, Action, Robot

NEAR, STRAIGHT = 24.0, 0.03  # px, rad: a point is reached
PERIOD = 8  # ticks within which a turn is made
SEED = 1
SCREEN = (1920, 1080)
MAT = pygame.Rect(LEFT - 24, TOP - 16, round(WIDTH) + 48, round(HEIGHT) + 48)  # the arena, on the canvas


class Script:
    """The driver of a robot that follows the steps of a lesson."""

    def __init__(self, steps: list[Step]) -> None:
        self.steps, self.ticks = steps, 0

    def think(self, state: Any, seat: int) -> None:
        """Act on the first step that is not done."""
        robot, action = state.robots[seat], state.actions[seat]
        while self.steps and self._done(robot):
            self.steps, self.ticks = self.steps[1:], 0
        self.ticks += 1
        if not self.steps:
            set_action(action, 0.0, 0.0, 0, 0)
            return
        step, linear, angle = self.steps[0], 0.0, 0.0
        if step.verb == GO:
            angle, linear = approach(bearing(robot, *step.numbers), math.dist((robot.x, robot.y), step.numbers))
        elif step.verb == TURN:
            angle = bearing(robot, *step.numbers)
        angular = turn_stick(angle, robot.angular, state.rules.turn_rate, PERIOD)
        set_action(action, linear, angular, step.fire, step.turbo)

    def _done(self, robot: Robot) -> bool:
        step = self.steps[0]
        if step.verb == GO:
            return math.dist((robot.x, robot.y), step.numbers) < NEAR
        if step.verb == TURN:
            return abs(bearing(robot, *step.numbers)) < STRAIGHT
        return self.ticks >= step.numbers[0] * HZ


def lesson_match(game: str, lesson: Lesson, variant: str) -> Match:
    """The match of a lesson, at its beginning."""
    rules = games()[game].variants[lesson.variant or variant]
    others = [actor.brain or "human" for actor in lesson.actors[1:]]
    names = ["human", *others, *["off"] * ROBOTS]
    one, two, three, four = (Seat(name, team) for name, team in zip(names, rules.teams, strict=False))
    arena = lesson.arena or arenas(game)[0]
    setup = Setup(game, arena, (one, two, three, four), rules.default_minutes, SEED, rules.name, rules.default_goal)
    match = Match(setup)
    for seat, actor in enumerate(lesson.actors):
        robot = match.state.robots[seat]
        robot.x, robot.y, robot.heading = actor.x, actor.y, math.radians(actor.heading)
        match.sit(seat, make_brain(game, actor.brain, SEED + seat) if actor.brain else Script(list(actor.steps())))
    lesson.prepare(match.state)
    match.plant = SimPlant(match.state)
    return match


class Cutout(pygame.Surface):
    """A canvas of which only a box is drawn."""

    box = pygame.Rect(0, 0, *SCREEN)

    def set_clip(self, rect: RectLike | None) -> None:
        """Clip to the box, too."""
        super().set_clip(self.box if rect is None else self.box.clip(rect))


class LessonClip:
    """The match of a lesson in a loop. `canvas`: may be shared with other clips."""

    def __init__(self, context: Context, game: str, name: str, lesson: Lesson, variant: str, canvas: Cutout) -> None:
        self.context, self.game, self.name, self.lesson, self.variant = context, game, name, lesson, variant
        self.canvas = canvas
        self.ready = False
        self.restart()

    @property
    def script(self) -> str:
        """What the robot does whose keys are shown."""
        return self.lesson.actors[0].does

    @property
    def action(self) -> Action:
        """What is pressed."""
        action: Action = self.runner.match.state.actions[0]
        return action

    def restart(self) -> None:
        """Begin anew."""
        match = lesson_match(self.game, self.lesson, self.variant)
        self.runner = MatchRunner(self.context, match, loud=False)
        self.start = match.state.tick

    def update(self, seconds: float) -> None:
        """Advance by `seconds`, once its background is there."""
        if not self.ready:
            return
        self.runner.advance(seconds)
        if self.runner.match.state.tick - self.start >= self.lesson.seconds * HZ:
            self.restart()

    def draw(self, screen: pygame.Surface, box: pygame.Rect) -> None:
        """Draw the picture into a box; nothing before its background is there."""
        area, lesson = pygame.Rect(0, 0, *box.size), self.lesson
        if lesson.middle:
            area.center = round(LEFT + lesson.middle[0]), round(TOP + lesson.middle[1])
            self.canvas.box = area.clamp(self.canvas.get_rect())
        else:
            x, y, _ = self.runner.view.pose(0, self.runner.timestep.blend)
            area.center = round(x), round(y)
            self.canvas.box = area.clamp(MAT)
        self.canvas.set_clip(None)
        self.runner.draw(self.canvas)
        screen.blit(self.canvas, box, self.canvas.box)
        self.ready = True
