"""Many matches as one Gymnasium vector environment: opponents, ticks, rewards and observations in one compiled call."""

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from pigaming_app.gym.environment import SEEDS
from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import OptionError, action_space, number, observation_space, task_of
from pigaming_app.gym.picture import MatchCamera, checked_mode


class SeatVectorEnv(VectorEnv[Any, Any, Any]):
    """`num_envs` seats of learners, in matches of `agents` learners each; those of a match are neighbours.

    With one agent a match, environment i of `reset(seed=s)` plays the episodes of the single environment reset with
    seed s + i. Autoreset is NEXT_STEP: the step after the end of an episode ignores the action and returns the first
    observation of the next one, with reward 0. `max_episode_steps` truncates episodes.
    """

    metadata: ClassVar[dict[str, Any]] = {
        "render_modes": ["rgb_array"],
        "render_fps": 10,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        game: str,
        num_envs: int = 1,
        agents: int = 1,
        render_mode: str | None = None,
        max_episode_steps: int | None = None,
        **options: Any,
    ) -> None:
        """`options`: see `pigaming_app.gym`. Raises OptionError."""
        self.render_mode = checked_mode(render_mode)
        self.task = task_of(game, agents, **options)
        self.metadata = {**self.metadata, "render_fps": self.task.decisions_a_second}  # type: ignore[misc]
        number("num_envs", num_envs, least=1)
        if max_episode_steps is not None:
            number("max_episode_steps", max_episode_steps, least=1)
        if num_envs % agents:
            raise OptionError(f"num_envs: {num_envs} is no multiple of {agents} agents a match")
        self.num_envs, self.max_episode_steps = num_envs, max_episode_steps
        self.single_observation_space, self.single_action_space = observation_space(self.task), action_space(self.task)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.matches = Matches(self.task, num_envs // agents)
        self._seeded = False
        self._ended = np.zeros(self.matches.count, np.bool_)
        self._steps = np.zeros(self.matches.count, np.int64)  # of the present episode
        self._cameras: list[MatchCamera] = []

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin the next episode of every match. `seed` determines it and all that follow.

        `seed`: of the first match, the others count on from it; or a list with one for each match.
        """
        super().reset(seed=seed if isinstance(seed, int) else None)
        count = self.matches.count
        if seed is not None or not self._seeded:
            drawn = int(self.np_random.integers(SEEDS))
            seeds: Sequence[int | None] = [None] * count if seed is None else []
            seeds = [seed + i for i in range(count)] if isinstance(seed, int) else seed or seeds
            if len(seeds) != count:
                raise ValueError(f"{len(seeds)} seeds, but there are {count} matches")
            self.matches.seed([drawn + i if one is None else one for i, one in enumerate(seeds)])
            self._seeded = True
        self.matches.restart(np.ones(count, np.bool_))
        self._ended[:], self._steps[:] = False, 0
        observations, _, _ = self.matches.advance()
        return observations.reshape(self.observation_space.shape), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Play one decision of every seat. Raises ValueError for actions outside the action space."""
        actions = self.matches.checked(actions)
        if self._ended.any():
            self.matches.restart(self._ended)
            self._steps[self._ended] = -1
        observations, rewards, over = self.matches.advance(actions)
        self._steps += 1
        late = np.zeros_like(over)
        if self.max_episode_steps is not None:
            late = (self._steps >= self.max_episode_steps) & ~over
        self._ended = over | late
        for camera in self._cameras:
            camera.watch()
        seats = self.task.learners
        infos = self._results() if self._ended.any() else {}
        return (
            observations.reshape(self.observation_space.shape),
            rewards.reshape(self.num_envs),
            over.repeat(seats),
            late.repeat(seats),
            infos,
        )

    def _results(self) -> dict[str, Any]:
        """The tallies at the end, by name, with masks of the environments that they belong to."""
        infos: dict[str, Any] = {}
        for i in np.flatnonzero(self._ended).tolist():
            for seat in range(self.task.learners):
                infos = self._add_info(infos, self.matches.result(i, seat), i * self.task.learners + seat)
        return infos

    def render(self) -> tuple[Any, ...] | None:
        """The present picture of every match (height, width, 3), or None without a render mode."""
        if not self.render_mode:
            return None
        if not self._cameras:
            self._cameras = [MatchCamera(self.matches, i) for i in range(self.matches.count)]
        return tuple(camera.picture() for camera in self._cameras)

    def close_extras(self, **_: Any) -> None:
        for camera in self._cameras:
            camera.close()
