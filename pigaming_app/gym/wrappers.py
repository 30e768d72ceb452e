"""Wrappers of one seat: a reward as a Python function, and a lidar instead of the game's own observation.

    env = Lidar(FunctionReward(gymnasium.make("PiTanks-v0"), lambda before, after: after.tallies["hits"]))

Both read the whole match after each decision, in plain Python: with `compiled=False` it need not be unpacked first.
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
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import bounds_contact, disc_contact, wall_contact
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH

REACH = 1000.0  # px, of the lidar


@dataclass(frozen=True)
class SeatView:
    """What a reward may depend on: the game's `Observation` of the seat, without delay, and its tallies so far."""

    seen: Any
    tallies: Mapping[str, float]
    over: bool


Reward = Callable[[SeatView, SeatView], float]


class FunctionReward(gymnasium.Wrapper[Any, Any, Any, Any], RecordConstructorArgs):
    """The reward is `reward(before, after)`, of the views before and after the decision."""

    def __init__(self, env: Any, reward: Reward) -> None:
        RecordConstructorArgs.__init__(self, reward=reward)
        gymnasium.Wrapper.__init__(self, env)
        self.reward_of = reward
        self._before: Any = None  # SeatView, once an episode has begun

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        observation, info = self.env.reset(seed=seed, options=options)
        self._before = view_of(self.env.unwrapped.matches)
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        observation, _, terminated, truncated, info = self.env.step(action)
        before, self._before = self._before, view_of(self.env.unwrapped.matches)
        return observation, float(self.reward_of(before, self._before)), terminated, truncated, info


class Lidar(gymnasium.ObservationWrapper[Any, Any, Any], RecordConstructorArgs):
    """Distances to the nearest wall and the nearest robot on each ray, as shares of `reach` px: float32 (2, rays).

    Ray 0 points ahead, the others follow clockwise at equal angles; they begin at the robot's centre. 1: nothing is in
    reach. The outer walls count.
    """

    def __init__(self, env: Any, rays: int = 24, reach: float = REACH) -> None:
        """Raises OptionError."""
        RecordConstructorArgs.__init__(self, rays=rays, reach=reach)
        gymnasium.ObservationWrapper.__init__(self, env)
        number("rays", rays, least=1)
        number("reach", reach, (int, float), least=RADIUS)
        self.rays, self.reach = rays, float(reach)
        self.observation_space = Box(0.0, 1.0, (2, rays), np.float32)

    def observation(self, observation: Any) -> Any:
        return scan(self.env.unwrapped.matches.state(0), 0, self.rays, self.reach)


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
        found[1, ray] = min(1.0, 1.0, *(disc_contact(*way, other.x, other.y, RADIUS) for other in others))
    return found


def view_of(matches: Matches, i: int = 0, seat: int = 0) -> SeatView:
    """The view of a seat of match i."""
    game, state = games()[matches.task.game], matches.state(i)
    seen = game.observation()
    game.observe(state, seat, game.senses(), seen)
    return SeatView(seen, matches.result(i, seat), bool(state.over))
