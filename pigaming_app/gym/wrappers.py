"""Wrappers of one seat: a reward as a Python function, and a lidar or a picture instead of the game's own observation.

    env = Lidar(FunctionReward(gymnasium.make("PiTanks-v0"), lambda before, after: after.tallies["hits"]))

They read the whole match after each decision, in plain Python: with `compiled=False` it need not be unpacked first.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from gymnasium.utils import RecordConstructorArgs

from pigaming_app.games.registry import games
from pigaming_app.games.simple import MatchState
from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import number
from pigaming_app.gym.rewards import require_finite
from pigaming_app.sim.sweep import bounds_contact, disc_contact, wall_contact
from pigaming_app.sim.world import HEIGHT, RADIUS, ROBOTS, WIDTH

REACH = 1000.0  # px, of the lidar


@dataclass(frozen=True)
class RewardView:
    """What a reward may depend on: the game's `Observation` of the seat, without delay, and its tallies so far."""

    seen: Any
    tallies: Mapping[str, float]
    over: bool


Reward = Callable[[RewardView, RewardView], float]


class FunctionReward(gymnasium.Wrapper[Any, Any, Any, Any], RecordConstructorArgs):
    """The reward is `reward(before, after)`, of the views before and after the decision: a finite number."""

    def __init__(self, env: Any, reward: Reward) -> None:
        RecordConstructorArgs.__init__(self, reward=reward)
        gymnasium.Wrapper.__init__(self, env)
        self.reward_of = reward
        self._before: Any = None  # RewardView, once an episode has begun

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        observation, info = self.env.reset(seed=seed, options=options)
        self._before = view_of(self.env.unwrapped.matches)
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        observation, _, terminated, truncated, info = self.env.step(action)
        before, self._before = self._before, view_of(self.env.unwrapped.matches)
        reward = np.float64(self.reward_of(before, self._before))  # None becomes NaN
        require_finite(self.reward_of, reward)
        return observation, float(reward), terminated, truncated, info


class Lidar(gymnasium.ObservationWrapper[Any, Any, Any], RecordConstructorArgs):
    """Distances to the nearest wall and the nearest robot on each ray, as shares of `reach` px: float32 (2, rays).

    Ray 0 points ahead, the others follow clockwise at equal angles; they begin at the robot's centre. 1: nothing is in
    reach. The outer walls count.
    """

    def __init__(self, env: Any, rays: int = 24, reach: float = REACH) -> None:
        """Raises OptionError."""
        RecordConstructorArgs.__init__(self, rays=rays, reach=reach)
        gymnasium.ObservationWrapper.__init__(self, env)
        self.rays = number("rays", rays, least=1)
        self.reach = float(number("reach", reach, (int, float), least=RADIUS))
        self.observation_space = Box(0.0, 1.0, (2, self.rays), np.float32)

    def observation(self, observation: Any) -> Any:
        return scan(self.env.unwrapped.matches.state(0), 0, self.rays, self.reach)


class OwnPicture(gymnasium.ObservationWrapper[Any, Any, Any], RecordConstructorArgs):
    """A picture of the surroundings, which turns with the robot: uint8 (4, pixels, pixels), 255 where something is.

    The robot is in the middle and looks up. Channels: walls, and all beyond the outer ones; mates; opponents; bullets,
    in a game that has some. A pixel is `scale` px of the arena wide; its centre decides.
    """

    def __init__(self, env: Any, pixels: int = 64, scale: float = 16.0) -> None:
        """Raises OptionError."""
        RecordConstructorArgs.__init__(self, pixels=pixels, scale=scale)
        gymnasium.ObservationWrapper.__init__(self, env)
        self.pixels = number("pixels", pixels, least=2)
        self.scale = float(number("scale", scale, (int, float), least=1))
        self.observation_space = Box(0, 255, (4, self.pixels, self.pixels), np.uint8)

    def observation(self, observation: Any) -> Any:
        return picture_of(self.env.unwrapped.matches.state(0), 0, self.pixels, self.scale)


def picture_of(match: MatchState, seat: int, pixels: int, scale: float) -> Any:
    """What a seat sees from above: see `OwnPicture`."""
    me, found = match.robots[seat], np.zeros((4, pixels, pixels), np.bool_)
    middle = 0.5 * (pixels - 1)
    steps = scale * (np.arange(pixels) - middle)
    c, s = cos(me.heading), sin(me.heading)
    ahead, aside = -steps[:, None], steps[None, :]  # rows from above, columns from the left
    x, y = me.x + c * ahead - s * aside, me.y + s * ahead + c * aside
    found[0] = (x <= 0.0) | (y <= 0.0) | (x >= WIDTH) | (y >= HEIGHT)
    for i in range(match.wall_count):
        if (wall := match.walls[i]).health:
            ex, ey = wall.bx - wall.ax, wall.by - wall.ay
            along = ((x - wall.ax) * ex + (y - wall.ay) * ey) / (ex * ex + ey * ey or 1.0)
            along = along.clip(0.0, 1.0)
            found[0] |= (x - wall.ax - along * ex) ** 2 + (y - wall.ay - along * ey) ** 2 < wall.half**2
    for k in range(ROBOTS):
        if k != seat and (other := match.robots[k]).present:
            found[1 if other.team == me.team else 2] |= (x - other.x) ** 2 + (y - other.y) ** 2 < match.radius**2
    for bullet in getattr(match, "bullets", ()):
        dx, dy = (bullet.x - me.x) / scale, (bullet.y - me.y) / scale
        row, column = round(middle - c * dx - s * dy), round(middle + c * dy - s * dx)
        if bullet.alive and 0 <= row < pixels and 0 <= column < pixels:  # one pixel, however small it is
            found[3, row, column] = True
    return found * np.uint8(255)


def scan(match: MatchState, seat: int, rays: int, reach: float) -> Any:
    """What the lidar of a seat measures: see `Lidar`."""
    me, found = match.robots[seat], np.ones((2, rays), np.float32)
    walls = [match.walls[i] for i in range(match.wall_count) if match.walls[i].health]
    others = [match.robots[k] for k in range(ROBOTS) if k != seat and match.robots[k].present]
    for ray in range(rays):
        angle = me.heading + 2.0 * pi * ray / rays
        way = me.x, me.y, reach * cos(angle), reach * sin(angle)
        times = [wall_contact(*way, wall, 0.0) for wall in walls]
        found[0, ray] = min(1.0, bounds_contact(*way, WIDTH, HEIGHT, 0.0), *times)
        found[1, ray] = min(1.0, 1.0, *(disc_contact(*way, other.x, other.y, match.radius) for other in others))
    return found


def view_of(matches: Matches, i: int = 0, seat: int = 0) -> RewardView:
    """The view of a seat of match i."""
    game, state = games()[matches.task.game], matches.state(i)
    seen = game.observation()
    game.observe(state, seat, game.senses(), seen)
    return RewardView(seen, matches.result(i, seat), bool(state.over))
