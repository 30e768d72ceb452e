"""Proximal policy optimisation in PyTorch, in one file in the style of CleanRL, on thousands of matches at once.

    pip install '.[gym,train]' torch
    python3 examples/ppo_torch.py --env PiTanks-v0 --decisions 10000000 --opponents level3

It prints the share of matches won lately. RobotRace-v0 and RobotFactory-v0 learn likewise. With `pip install onnx`,
--out agent.onnx writes a player for the arcade: python3 main.py play pitanks --seats human,agent.onnx
"""

import argparse
import time
from collections import deque
from typing import Any

import gymnasium
import numpy as np
import torch
from torch import nn
from torch.distributions import Categorical

import pigaming_app.api.environments  # noqa: F401  # registers the environments

STEPS, EPOCHS, MINIBATCH = 60, 2, 2048
DISCOUNT, TRACE, CLIP, ENTROPY, STEEPEST, RATE = 0.99, 0.95, 0.2, 0.01, 0.5, 1e-3


class Agent(nn.Module):
    """A policy with a distribution for each head, and a value function."""

    def __init__(self, inputs: int, choices: list[int]) -> None:
        super().__init__()
        self.choices = choices
        self.policy, self.value = network(inputs, sum(choices), 0.01), network(inputs, 1, 1.0)

    def heads(self, seen: Any) -> list[Categorical]:
        return [Categorical(logits=logits) for logits in self.policy(seen).split(self.choices, dim=-1)]


def network(inputs: int, outputs: int, gain: float) -> nn.Module:
    """Two hidden layers; `gain`: of the last layer."""
    layers = [nn.Linear(inputs, 64), nn.Linear(64, 64), nn.Linear(64, outputs)]
    for made, scale in zip(layers, (2**0.5, 2**0.5, gain), strict=True):
        nn.init.orthogonal_(made.weight, scale)
        nn.init.zeros_(made.bias)
    return nn.Sequential(layers[0], nn.Tanh(), layers[1], nn.Tanh(), layers[2])


def log_probability(heads: list[Categorical], action: Any) -> Any:
    return sum(head.log_prob(choice) for head, choice in zip(heads, action.unbind(-1), strict=True))


def advantages(rewards: Any, values: Any, ends: Any) -> Any:
    """Generalised advantages (STEPS, n), from `values` (STEPS + 1, n) and the ends of episodes."""
    found, last = torch.zeros_like(rewards), torch.zeros_like(rewards[0])
    for t in reversed(range(STEPS)):
        going_on = 1.0 - ends[t]
        error = rewards[t] + DISCOUNT * values[t + 1] * going_on - values[t]
        found[t] = last = error + DISCOUNT * TRACE * going_on * last
    return found


def train(
    env: str, opponents: list[str], decisions: int, num_envs: int, seed: int, **options: Any
) -> tuple[Agent, int]:
    """An agent and the decisions that it learned from, at most `decisions`; prints its progress."""
    torch.manual_seed(seed)
    torch.set_num_threads(1)  # the layers are too small to be shared out
    envs = gymnasium.make_vec(env, num_envs=num_envs, opponents=opponents, **options)
    (size,), choices = envs.single_observation_space.shape, envs.single_action_space.nvec.tolist()
    agent = Agent(size, choices)
    adam = torch.optim.Adam(agent.parameters(), RATE, eps=1e-5)
    seen, actions = torch.zeros(STEPS + 1, num_envs, size), torch.zeros(STEPS, num_envs, len(choices), dtype=torch.long)
    odds, rewards, ends, played = (torch.zeros(STEPS, num_envs) for _ in range(4))
    seen[STEPS] = torch.from_numpy(envs.reset(seed=seed)[0])
    ended, results, began, used = np.zeros(num_envs, bool), deque(maxlen=1000), time.time(), 0
    while used + STEPS * num_envs <= decisions:
        adam.param_groups[0]["lr"] = RATE * (1.0 - 0.9 * used / decisions)
        seen[0] = seen[STEPS]
        for t in range(STEPS):
            with torch.no_grad():
                heads = agent.heads(seen[t])
            actions[t] = torch.stack([head.sample() for head in heads], -1)
            odds[t] = log_probability(heads, actions[t])
            played[t] = torch.from_numpy(~ended).float()  # after an end the action only begins the next match
            observation, reward, terminated, truncated, infos = envs.step(actions[t].numpy())
            ended = terminated | truncated
            seen[t + 1], rewards[t], ends[t] = (torch.from_numpy(x) for x in (observation, reward, ended))
            results.extend(infos["win"][infos["_win"]] if infos else ())
        values = agent.value(seen).squeeze(-1).detach()
        gains = advantages(rewards, values, ends)
        scaled, returns = (gains - gains.mean()) / (gains.std() + 1e-8), gains + values[:-1]
        chosen = played.flatten().nonzero().squeeze(-1)
        used += len(chosen)
        flat = [x.flatten(0, 1) for x in (seen[:-1], actions, odds, scaled, returns)]
        for _ in range(EPOCHS):
            for rows in chosen[torch.randperm(len(chosen))].split(MINIBATCH):
                inputs, action, old, gain, target = (x[rows] for x in flat)
                heads = agent.heads(inputs)
                ratio = (log_probability(heads, action) - old).exp()
                gained = torch.min(ratio * gain, ratio.clamp(1.0 - CLIP, 1.0 + CLIP) * gain).mean()
                entropy = sum(head.entropy().mean() for head in heads)
                error = (agent.value(inputs).squeeze(-1) - target).square().mean()
                adam.zero_grad()
                (0.5 * error - gained - ENTROPY * entropy).backward()
                nn.utils.clip_grad_norm_(agent.parameters(), STEEPEST)
                adam.step()
        won = np.mean(np.array(results or [np.nan]) > 0.0)
        print(f"{time.time() - began:5.0f} s, {used:>10,} decisions, reward {rewards.mean():.4f}, won {won:.0%}")
    return agent, used


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in {"env": "PiTanks-v0", "decisions": 10_000_000, "num-envs": 256, "seed": 1, "out": ""}.items():
        parser.add_argument(f"--{name}", default=default, type=type(default))
    parser.add_argument("--opponents", default=["level3"], nargs="*")
    words = vars(parser.parse_args())
    out = words.pop("out")
    agent, _ = train(**words)
    if out:
        torch.onnx.export(agent.policy, (torch.zeros(1, agent.policy[0].in_features),), out, dynamo=False)
