"""A match as a PettingZoo environment: all learners decide at the same time."""

from typing import Any, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pettingzoo import ParallelEnv

from pigaming_app.gym.environment import SEEDS, seed_of
from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import action_space, number, observation_space, task_of
from pigaming_app.gym.picture import MatchCamera, checked_mode


class MatchEnv(ParallelEnv[str, Any, Any]):
    """A match whose agents `player_0`, `player_1`, ... sit on the first seats. `options`: see `pigaming_app.gym`.

    All agents stay until the match is over, or nothing more is at stake for any of them; then all are terminated.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": ["rgb_array"], "is_parallelizable": True}

    def __init__(
        self,
        game: str,
        agents: int = 2,
        render_mode: str | None = None,
        max_episode_steps: int | None = None,
        **options: Any,
    ) -> None:
        """Raises OptionError."""
        self.render_mode = checked_mode(render_mode)
        self.task = task_of(game, agents, **options)
        agents = self.task.learners
        if max_episode_steps is not None:
            max_episode_steps = number("max_episode_steps", max_episode_steps, least=1)
        self.max_episode_steps, self._steps = max_episode_steps, 0
        self.metadata = {**self.metadata, "name": f"{game}_v0", "render_fps": self.task.decisions_a_second}  # type: ignore[misc]
        self.possible_agents = [f"player_{seat}" for seat in range(agents)]
        self.agents: list[str] = []
        self.observation_spaces = {agent: observation_space(self.task) for agent in self.possible_agents}
        self.action_spaces = {agent: action_space(self.task) for agent in self.possible_agents}
        self.matches = Matches(self.task, 1)
        self.state_space = Box(-1.0, 1.0, (agents * self.matches.encoding.size,), np.float32)
        self._observations = np.zeros((1, agents, self.matches.encoding.size), np.float32)
        self._camera = MatchCamera(self.matches, 0)

    def observation_space(self, agent: str) -> Any:
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begin the next episode. `seed` determines it and all that follow; `options` is not used.

        Raises ValueError for a seed that is no whole number from 0.
        """
        seed = seed_of(seed)
        if seed is None and not self.matches.seeded:
            seed = int(np.random.default_rng().integers(SEEDS))
        self.matches.begin([seed], np.ones(1, np.bool_))
        self._observations = np.empty_like(self._observations)
        self.matches.observe(self._observations)
        self.agents, self._steps = list(self.possible_agents), 0
        return self._by_agent(self._observations[0]), {agent: {} for agent in self.agents}

    def step(self, actions: dict[str, Any]) -> tuple[dict[str, Any], ...]:
        """Play one decision of all agents.

        Raises ValueError for actions outside the action space, or missing, and ResetNeeded before `reset`.
        """
        self.matches.require_begun("step")
        if not self.agents:
            return {}, {}, {}, {}, {}
        if missing := [agent for agent in self.agents if agent not in actions]:
            raise ValueError(f"no action for {', '.join(missing)}")
        chosen = self.matches.checked([[actions[agent] for agent in self.possible_agents]])
        self._observations, rewards, over = self.matches.advance(chosen)
        self._camera.watch()
        self._steps += 1
        late = self.max_episode_steps is not None and self._steps >= self.max_episode_steps and not over[0]
        ended = bool(over[0]) or late
        results = [self.matches.result(0, seat) if ended else {} for seat in range(self.task.learners)]
        if ended:
            self.agents = []
        return (
            self._by_agent(self._observations[0]),
            self._by_agent(rewards[0].tolist()),
            dict.fromkeys(self.possible_agents, bool(over[0])),
            dict.fromkeys(self.possible_agents, bool(late)),
            self._by_agent(results),
        )

    def state(self) -> Any:
        """The observations of all agents, one after the other: of a critic that they share."""
        return self._observations.reshape(-1).copy()

    def action_masks(self) -> dict[str, Any]:
        """For each agent, whether each choice of each head may have a use in the next decision: bool (choices,)."""
        return self._by_agent(self.matches.masks()[0])

    def _by_agent(self, values: Any) -> dict[str, Any]:
        return dict(zip(self.possible_agents, values, strict=True))

    def render(self) -> Any:
        """The present picture (height, width, 3), or None without a render mode."""
        return self._camera.picture() if self.render_mode else None

    def close(self) -> None:
        self._camera.close()
