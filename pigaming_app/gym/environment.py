"""One seat of a match as a Gymnasium environment."""

from operator import index
from typing import Any, ClassVar

import gymnasium
import numpy as np

from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import action_space, observation_space, task_of
from pigaming_app.gym.picture import MatchCamera, checked_mode

SEEDS = 2**63  # seeds that are drawn lie below


def seed_of(seed: Any) -> int | None:
    """The seed of a match, a whole number from 0, as Python's; None stays. Raises ValueError."""
    try:
        found = None if seed is None else index(seed)
    except TypeError:
        found = -1
    if found is not None and found < 0:
        raise ValueError(f"seed: a whole number from 0 is needed, not {seed!r}")
    return found


class SeatEnv(gymnasium.Env[Any, Any]):
    """A match with one learner, on the first seat. `options`: see `pigaming_app.gym`.

    An episode is a match; it ends, terminated, when the match is over, or nothing more is at stake for the learner. The
    clock is part of the rules and of the observation, so that the end of the time also terminates. `info` has the
    tallies so far at every step, since `gymnasium.make(max_episode_steps=...)` truncates from outside.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(self, game: str, render_mode: str | None = None, **options: Any) -> None:
        """Raises OptionError."""
        self.render_mode = checked_mode(render_mode)
        self.task = task_of(game, 1, **options)
        self.metadata = {**self.metadata, "render_fps": self.task.decisions_a_second}  # type: ignore[misc]
        self.observation_space, self.action_space = observation_space(self.task), action_space(self.task)
        self.matches = Matches(self.task, 1)
        self._camera = MatchCamera(self.matches, 0)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin the next episode. `seed` determines it and all that follow; `options` is not used.

        Raises ValueError for a seed that is no whole number from 0.
        """
        seed = seed_of(seed)
        super().reset(seed=seed)
        if seed is None and not self.matches.seeded:
            seed = int(self.np_random.integers(SEEDS))
        self.matches.begin([seed], np.ones(1, np.bool_))
        observation = np.empty((1, 1, *self.observation_space.shape), np.float32)
        self.matches.observe(observation)
        return observation[0, 0], {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Play one decision. Raises ValueError for an action outside the action space, ResetNeeded before `reset`."""
        observations, rewards, over = self.matches.advance(self.matches.checked(action))
        self._camera.watch()
        return observations[0, 0], float(rewards[0, 0]), bool(over[0]), False, self.matches.result(0)

    def action_masks(self) -> Any:
        """Whether each choice of each head may have a use in the next decision: bool (choices,). Not for sticks."""
        return self.matches.masks()[0, 0]

    def render(self) -> Any:
        """The present picture (height, width, 3), or None without a render mode."""
        return self._camera.picture() if self.render_mode else None

    def close(self) -> None:
        self._camera.close()
