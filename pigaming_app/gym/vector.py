"""Many matches as one Gymnasium vector environment: opponents, ticks, rewards and observations in one compiled call."""

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from pigaming_app.gym.environment import SEEDS, seed_of
from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import OptionError, action_space, boolean, number, observation_space, task_of
from pigaming_app.gym.picture import MatchCamera, checked_mode
from pigaming_app.gym.rewards import TALLIES

ENDLESS = 2**62  # decisions: no episode is truncated


def mode_of(mode: AutoresetMode | str) -> AutoresetMode:
    """An autoreset mode, also by its value. Raises OptionError."""
    try:
        return AutoresetMode(mode)
    except ValueError:
        known = ", ".join(one.value for one in AutoresetMode)
        raise OptionError(f"no autoreset mode {mode!r}; there are {known}") from None


class SeatVectorEnv(VectorEnv[Any, Any, Any]):
    """`num_envs` seats of learners, in matches of `agents` learners each; those of a match are neighbours.

    With one agent a match, environment i of `reset(seed=s)` plays the episodes of the single environment reset with
    seed s + i, as a SyncVectorEnv has them. `autoreset_mode`, an AutoresetMode or its value:

    - NEXT_STEP: the step after the end of an episode ignores the action and returns the first observation of the next
      one, with reward 0.
    - SAME_STEP: that first observation takes the place of the last one, which `info["final_obs"]` has;
      `info["final_info"]` has the tallies.
    - DISABLED: whoever ended needs `reset(options={"reset_mask": ended})`, a mask (num_envs,).

    `max_episode_steps` truncates episodes. With `stagger` the first episode of each match after a reset of all is
    truncated after a number of decisions, drawn by its seed from 1 to a whole episode, so that ends spread over time.
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
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        stagger: bool = False,
        **options: Any,
    ) -> None:
        """`options`: see `pigaming_app.gym`. Raises OptionError."""
        self.render_mode = checked_mode(render_mode)
        self.task = task_of(game, agents, **options)
        self.autoreset_mode = mode_of(autoreset_mode)
        described = {"render_fps": self.task.decisions_a_second, "autoreset_mode": self.autoreset_mode}
        self.metadata = {**self.metadata, **described}  # type: ignore[misc]
        num_envs, agents = number("num_envs", num_envs, least=1), self.task.learners
        if max_episode_steps is not None:
            max_episode_steps = number("max_episode_steps", max_episode_steps, least=1)
        if num_envs % agents:
            raise OptionError(f"num_envs: {num_envs} is no multiple of {agents} agents a match")
        self.num_envs, self.max_episode_steps = num_envs, max_episode_steps
        self.stagger = boolean("stagger", stagger)
        self.single_observation_space, self.single_action_space = observation_space(self.task), action_space(self.task)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.matches = Matches(self.task, num_envs // agents)
        count = self.matches.count
        self._ended = np.zeros(count, np.bool_)
        self._steps = np.zeros(count, np.int64)  # of the present episode
        self._limit = np.full(count, max_episode_steps or ENDLESS)  # of the present episode
        self._seen = np.zeros((count, agents, self.matches.encoding.size), np.float32)  # last observations
        self._cameras: list[MatchCamera] = []

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin the next episode of every match, or of those that `options["reset_mask"]` selects.

        `seed` determines it and all that follow: of the first match, the others count on from it; or a list with one
        for each match, None where it goes on with its own. Raises ValueError.
        """
        seed = seed if np.ndim(seed) else seed_of(seed)  # type: ignore[arg-type]
        super().reset(seed=seed if isinstance(seed, int) else None)
        mask = (options or {}).get("reset_mask")
        which = np.ones(self.matches.count, np.bool_) if mask is None else self._matches_of(mask)
        self.matches.begin(self._seeds(seed), which)
        self._steps[which], self._limit[which], self._ended[which] = 0, self.max_episode_steps or ENDLESS, False
        if self.stagger and mask is None:
            self._limit = self.matches.phases(min(self.task.decisions, self.max_episode_steps or ENDLESS))
        self._seen = self._seen.copy()
        self.matches.observe(self._seen)
        return self._handed_out(), {}

    def _seeds(self, seed: int | Sequence[int | None] | None) -> Sequence[int | None]:
        """The seed of each match; None: it goes on with its episodes. Raises ValueError."""
        count = self.matches.count
        if isinstance(seed, int):
            return range(seed, seed + count)
        seeds = [None] * count if seed is None else [seed_of(one) for one in seed]
        if len(seeds) != count:
            raise ValueError(f"{len(seeds)} seeds, but there are {count} matches")
        if self.matches.seeded:
            return seeds
        drawn = int(self.np_random.integers(SEEDS))
        return [drawn + i if one is None else one for i, one in enumerate(seeds)]

    def _matches_of(self, mask: Any) -> Any:
        """The matches (count,) that a mask of environments (num_envs,) selects. Raises ValueError, ResetNeeded."""
        if not self.matches.seeded:
            raise ResetNeeded("the first reset has no reset_mask: all matches begin with it")
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (self.num_envs,):
            raise ValueError(f"reset_mask: an array of {self.num_envs} bools is needed")
        by_match = mask.reshape(self.matches.count, -1)
        if (by_match.any(1) != by_match.all(1)).any():
            raise ValueError("reset_mask: agents of a match begin the next one together")
        if not mask.any():
            raise ValueError("reset_mask: no environment is selected")
        return by_match.all(1)

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Play one decision of every seat.

        Raises ValueError for actions outside the action space, and ResetNeeded before `reset` or, without autoreset,
        while an environment has ended.
        """
        actions, mode = self.matches.checked(actions), self.autoreset_mode
        if self._ended.any():
            if mode is AutoresetMode.DISABLED:
                ended = np.flatnonzero(self._ended.repeat(self.task.learners)).tolist()
                raise ResetNeeded(f"environments that have ended need reset(options={{'reset_mask': ...}}): {ended}")
            self._restart()
            self._steps[self._ended] = -1
        self._seen, rewards, over = self.matches.advance(actions)
        self._steps += 1
        late = (self._steps >= self._limit) & ~over
        self._ended = over | late
        for camera in self._cameras:
            camera.watch()
        infos = self._results() if self._ended.any() else {}
        if infos and mode is AutoresetMode.SAME_STEP:
            infos = self._final(infos)
            self._restart()
            self.matches.observe(self._seen)
            self._ended = np.zeros_like(over)
        seats = self.task.learners
        return self._handed_out(), rewards.reshape(self.num_envs), over.repeat(seats), late.repeat(seats), infos

    def _restart(self) -> None:
        self.matches.restart(self._ended)
        self._steps[self._ended], self._limit[self._ended] = 0, self.max_episode_steps or ENDLESS

    def _handed_out(self) -> Any:
        """The last observations. Without autoreset a copy, since a partial reset returns the others once more."""
        seen = self._seen.reshape(self.observation_space.shape)
        return seen.copy() if self.autoreset_mode is AutoresetMode.DISABLED else seen

    def _results(self) -> dict[str, Any]:
        """The tallies at the end, by name, with masks of the environments that they belong to."""
        mask, infos = self._ended.repeat(self.task.learners), {}
        for k, name in enumerate(TALLIES[self.task.game].names):
            infos[name] = np.where(mask, self.matches.totals[:, :, k].reshape(-1), 0.0)
            infos[f"_{name}"] = mask.copy()
        return infos

    def _final(self, results: dict[str, Any]) -> dict[str, Any]:
        """Tallies and last observations of episodes that make room for the next ones in the same step."""
        mask = self._ended.repeat(self.task.learners)
        last, seen = np.full(self.num_envs, None, object), self._seen.reshape(self.observation_space.shape)
        for i in np.flatnonzero(mask).tolist():
            last[i] = seen[i].copy()
        return {"final_info": results, "_final_info": mask, "final_obs": last, "_final_obs": mask.copy()}

    def action_masks(self) -> Any:
        """Whether each choice of each head may have a use in the next decision: bool (num_envs, choices)."""
        return self.matches.masks().reshape(self.num_envs, -1)

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
