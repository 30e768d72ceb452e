"""Proximal policy optimisation in TorchRL, on hundreds of matches at once.

    pip install '.[gym,train]' torch torchrl
    python3 examples/torchrl_ppo.py --env PiTanks-v0 --minutes 5 --opponents level3

It prints the share of matches won lately. RobotRace-v0 and RobotFactory-v0 learn likewise.
"""

import argparse
import time
from collections import deque
from typing import Any, ClassVar

import gymnasium
import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from tensordict import TensorDict
from tensordict.nn import InteractionType, TensorDictModule
from torch.distributions import Categorical, Distribution
from torchrl.modules import MLP, ProbabilisticActor, ValueOperator
from torchrl.objectives import ClipPPOLoss
from torchrl.objectives.value import GAE

import pigaming_app.api.environments  # noqa: F401  # registers the environments

STEPS, EPOCHS, MINIBATCH, RATE = 60, 2, 2048, 1e-3


class Heads(Distribution):
    """One choice of each head; `logits` (..., choices of all heads)."""

    arg_constraints: ClassVar[dict[str, Any]] = {}

    def __init__(self, logits: Any, choices: list[int]) -> None:
        self.heads = [Categorical(logits=part) for part in logits.split(choices, dim=-1)]
        super().__init__(logits.shape[:-1], torch.Size([len(choices)]), validate_args=False)

    def sample(self, sample_shape: Any = ()) -> Any:
        return torch.stack([head.sample(sample_shape) for head in self.heads], -1)

    def log_prob(self, value: Any) -> Any:
        return sum(head.log_prob(choice) for head, choice in zip(self.heads, value.unbind(-1), strict=True))

    def entropy(self) -> Any:
        return sum(head.entropy() for head in self.heads)


def train(env: str, opponents: list[str], minutes: float, num_envs: int, seed: int) -> list[float]:
    """Train an agent; prints its progress, and returns the mean reward of a decision, update by update."""
    torch.manual_seed(seed)
    torch.set_num_threads(1)  # the layers are too small to be shared out
    mode = AutoresetMode.SAME_STEP
    envs = gymnasium.make_vec(env, num_envs=num_envs, opponents=opponents, autoreset_mode=mode, stagger=True)
    (size,), choices = envs.single_observation_space.shape, envs.single_action_space.nvec.tolist()
    shape: dict[str, Any] = {"num_cells": [64, 64], "activation_class": torch.nn.Tanh}
    logits = TensorDictModule(MLP(size, sum(choices), **shape), in_keys=["observation"], out_keys=["logits"])
    actor = ProbabilisticActor(
        logits,
        ["logits"],
        distribution_class=Heads,
        distribution_kwargs={"choices": choices},
        default_interaction_type=InteractionType.RANDOM,
        return_log_prob=True,
    )
    critic = ValueOperator(MLP(size, 1, **shape), in_keys=["observation"])
    advantage = GAE(gamma=0.99, lmbda=0.95, value_network=critic)
    loss = ClipPPOLoss(actor, critic, entropy_coeff=0.01, normalize_advantage=True, loss_critic_type="l2")
    adam = torch.optim.Adam(loss.parameters(), RATE, eps=1e-5)
    seen, means = torch.from_numpy(envs.reset(seed=seed)[0]), list[float]()
    results, began, decisions = deque(maxlen=1000), time.time(), 0
    while (share := (time.time() - began) / (60.0 * minutes)) < 1.0:
        adam.param_groups[0]["lr"] = RATE * (1.0 - 0.9 * share)
        steps = []
        for _ in range(STEPS):
            with torch.no_grad():
                step = actor(TensorDict({"observation": seen.clone()}, [num_envs]))
            observation, reward, terminated, truncated, infos = envs.step(step["action"].numpy())
            seen = torch.from_numpy(observation)  # after an end the first one of the next match, which counts nothing
            ends = {"done": terminated | truncated, "terminated": terminated, "reward": reward.astype(np.float32)}
            ends = {name: torch.from_numpy(column).unsqueeze(-1) for name, column in ends.items()}
            steps.append(step.set("next", TensorDict({"observation": seen.clone(), **ends}, [num_envs])))
            results.extend(infos["final_info"]["win"][infos["final_info"]["_win"]] if "final_info" in infos else ())
        batch = torch.stack(steps, 1)
        with torch.no_grad():
            advantage(batch)
        flat = batch.flatten()
        decisions += len(flat)
        for _ in range(EPOCHS):
            for rows in torch.randperm(len(flat)).split(MINIBATCH):
                losses = loss(flat[rows])
                adam.zero_grad()
                (losses["loss_objective"] + 0.5 * losses["loss_critic"] + losses["loss_entropy"]).backward()
                torch.nn.utils.clip_grad_norm_(loss.parameters(), 0.5)
                adam.step()
        means.append(flat["next", "reward"].mean().item())
        won = np.mean(np.array(results or [np.nan]) > 0.0)
        print(f"{time.time() - began:5.0f} s, {decisions:>10,} decisions, reward {means[-1]:.4f}, won {won:.0%}")
    return means


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in {"env": "PiTanks-v0", "minutes": 5.0, "num-envs": 256, "seed": 1}.items():
        parser.add_argument(f"--{name}", default=default, type=type(default))
    parser.add_argument("--opponents", default=["level3"], nargs="*")
    train(**vars(parser.parse_args()))
