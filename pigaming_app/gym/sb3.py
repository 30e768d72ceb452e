"""Many matches as a vector environment of Stable-Baselines3, whose algorithms take nothing else.

from stable_baselines3 import PPO
from pigaming_app.gym.sb3 import SeatVecEnv

PPO("MlpPolicy", SeatVecEnv("PiTanks-v0", 256, opponents=("level3",))).learn(1_000_000)
"""

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

try:
    from stable_baselines3.common.vec_env import VecEnv
except ImportError:
    raise ImportError("pigaming_app.gym.sb3 needs Stable-Baselines3: pip install stable-baselines3") from None


class SeatVecEnv(VecEnv):
    """`num_envs` seats of learners, as `gymnasium.make_vec` makes them. `options`: see `pigaming_app.gym`.

    Observations are the arrays that the compiled loop filled; only the last one of an episode is copied, into
    `terminal_observation`. There as well `info` has the tallies, which `VecMonitor(env, info_keywords=("win",))` writes
    down. `seed(s)` makes the next reset that of `make_vec(...).reset(seed=s)`.
    """

    def __init__(self, name: str, num_envs: int = 1, **options: Any) -> None:
        """`name`: of the environment, such as PiTanks-v0. Raises OptionError."""
        made = gymnasium.make_vec(name, num_envs, autoreset_mode=AutoresetMode.SAME_STEP, **options)
        self.envs: Any = made
        self._actions: Any = None
        super().__init__(num_envs, made.single_observation_space, made.single_action_space)

    def reset(self) -> Any:
        """Begin the next episode of every match; observations (num_envs, inputs)."""
        seeds: Sequence[int | None] = self._seeds[: self.envs.unwrapped.matches.count]
        observations, _ = self.envs.reset(seed=seeds)
        self._reset_seeds()
        self._reset_options()
        return observations

    def step_async(self, actions: Any) -> None:
        self._actions = actions

    def step_wait(self) -> tuple[Any, Any, Any, list[dict[str, Any]]]:
        """Play the decision of `step_async`. Raises ValueError for actions outside the action space."""
        observations, rewards, terminated, truncated, found = self.envs.step(self._actions)
        infos: list[dict[str, Any]] = [{"TimeLimit.truncated": cut} for cut in truncated.tolist()]
        ended = terminated | truncated
        for i in np.flatnonzero(ended).tolist():
            tallies = {name: float(row[i]) for name, row in found["final_info"].items() if not name.startswith("_")}
            infos[i] |= {**tallies, "terminal_observation": found["final_obs"][i]}
        return observations, rewards.astype(np.float32), ended, infos

    def close(self) -> None:
        self.envs.close()

    def get_images(self) -> Sequence[Any]:
        """The picture of every match."""
        return self.envs.render() or ()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute, once for each of the environments, which have all in common."""
        return [getattr(self.envs, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Set an attribute of all environments, which have all in common. Raises ValueError for some of them."""
        if len({*self._get_indices(indices)}) < self.num_envs:
            raise ValueError("attributes of single matches cannot be set: they are one environment")
        setattr(self.envs, attr_name, value)

    def env_method(self, method_name: str, *method_args: Any, indices: Any = None, **method_kwargs: Any) -> list[Any]:
        """The values for some environments of a method that returns one for each, such as `action_masks`."""
        found = getattr(self.envs, method_name)(*method_args, **method_kwargs)
        return [found[i] for i in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        """Never: nothing lies around single matches."""
        return [False for _ in self._get_indices(indices)]
