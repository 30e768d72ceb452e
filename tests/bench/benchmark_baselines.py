"""Baselines of PiGaming-Bench: an agent of each method, from a million decisions, as docs/benchmark.md lists them.

python -m tests.bench.benchmark_baselines search --seed 1 --out search-1.npz     random search, NumPy alone
python -m tests.bench.benchmark_baselines clone --seed 1 --out clone-1.npz       needs PyTorch
python -m tests.bench.benchmark_baselines cleanrl --seed 1 --out cleanrl-1.npz   needs PyTorch
python -m tests.bench.benchmark_baselines sb3 --seed 1 --out sb3-1.npz           needs Stable-Baselines3
python -m tests.bench.benchmark_baselines dqn --seed 1 --out dqn-1.npz           needs Stable-Baselines3
"""

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import pigaming_app.api.environments  # noqa: F401  # registers the environments
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.networks.encoding import PERIOD, UNIT
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.setup import make_setup
from pigaming_app.gym.benchmark.agent_file import save_agent
from pigaming_app.gym.benchmark.tasks import SHIPPED
from pigaming_app.sim.rng import training_seed

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples"))  # ppo_torch.py
GAME, NAME, HEADS = "pitanks", "PiTanks-v0", (3, 7, 2, 2)
ARENAS = SHIPPED[GAME]
Layers = list[tuple[Any, Any]]


def search(seed: int, decisions: int) -> tuple[Layers, int]:
    """Augmented random search (Mania, Guy and Recht, NeurIPS 2018) of a linear policy within bounds."""
    directions, best, noise, rate, steps = 32, 16, 0.1, 0.1, 300
    random, weights, used = np.random.default_rng(seed), np.zeros((128, 16)), 0
    envs = gymnasium.make_vec(NAME, 2 * directions, opponents=("level1",), minutes=0.5, arena=ARENAS, starts=512)
    while used + 2 * directions * steps <= decisions:
        deltas = random.normal(size=(directions, *weights.shape))
        tried = np.concatenate([weights + noise * deltas, weights - noise * deltas])
        starts = random.integers(2**31, size=directions).tolist()
        seen, total = envs.reset(seed=starts + starts)[0], np.zeros(2 * directions)
        for _ in range(steps):
            logits = 8.0 * np.tanh(np.tanh(np.einsum("ni,nij->nj", seen, tried)))[:, :14] + random.gumbel(
                size=(2 * directions, 14)
            )
            heads = np.split(logits, np.cumsum(HEADS)[:-1], axis=1)
            seen, rewards, *_ = envs.step(np.stack([head.argmax(1) for head in heads], 1))
            total += rewards
        used += 2 * directions * steps
        up, down = total[:directions], total[directions:]
        chosen = np.argsort(-np.maximum(up, down))[:best]
        spread = np.concatenate([up[chosen], down[chosen]]).std() + 1e-8
        weights += rate / (best * spread) * np.tensordot(up[chosen] - down[chosen], deltas[chosen], 1)
    zeros = np.zeros(16)
    return [(weights, zeros), (np.eye(16), zeros), (8.0 * np.eye(16)[:, :14], zeros[:14])], used


def clone(seed: int, decisions: int) -> tuple[Layers, int]:
    """Behaviour cloning of `net`: what it chose in matches with all levels, seeds of trainings only."""
    import torch
    from ppo_torch import Agent, log_probability

    torch.manual_seed(seed)
    torch.set_num_threads(1)
    inputs, choices = demonstrations(seed, decisions)
    agent, epochs, rows = Agent(128, [*HEADS]), 8, 4096
    adam = torch.optim.Adam(agent.policy.parameters(), 2e-3)
    slower = torch.optim.lr_scheduler.LinearLR(adam, 1.0, 0.05, epochs * -(-len(inputs) // rows))
    for _ in range(epochs):
        for some in torch.randperm(len(inputs)).split(rows):
            seen = torch.from_numpy(inputs[some].astype(np.float32) / np.float32(UNIT))
            error = -log_probability(agent.heads(seen), torch.from_numpy(choices[some].astype(np.int64))).mean()
            adam.zero_grad()
            error.backward()
            adam.step()
            slower.step()
    print(f"cross entropy {error.item():.3f}")
    return layers_of(agent.policy), len(inputs)


def demonstrations(seed: int, decisions: int) -> tuple[Any, Any]:
    """Inputs (n, 128) and choices (n, 4) of `net` on the first seat."""
    inputs, choices, each = [], [], decisions // 5 // 1200
    for level in range(1, 6):
        seats = ["net", f"level{level}"]
        first = make_setup(GAME, seats, ARENAS[0], 2.0, 0, "party", None, seats)
        numbers = range(each * (5 * seed + level), each * (5 * seed + level + 1))
        setups = [replace(first, arena=ARENAS[k % len(ARENAS)], seed=training_seed(k)) for k in numbers]
        batch = Batch(setups, [find_brain(GAME, name) for name in seats], fast=True)
        for _ in range(1200):
            batch.play(PERIOD)
            mind = batch.minds[f"mind{batch.minds['family'][0, 0]}"][:, 0]
            playing = ~batch.matches["over"].astype(bool)
            inputs.append(mind["inputs"][playing].astype(np.int16))
            choices.append(mind["choices"][playing].astype(np.int8))
    return np.concatenate(inputs), np.concatenate(choices)


def cleanrl(seed: int, decisions: int) -> tuple[Layers, int]:
    """The PPO of ppo_torch.py."""
    from ppo_torch import train

    agent, used = train(NAME, ["level3"], decisions, 256, seed, arena=ARENAS)
    return layers_of(agent.policy), used


def sb3(seed: int, decisions: int) -> tuple[Layers, int]:
    """PPO of Stable-Baselines3 with its own network, which has the same shape."""
    import torch
    from stable_baselines3 import PPO

    from pigaming_app.gym.sb3 import SeatVecEnv

    torch.set_num_threads(1)
    envs = SeatVecEnv(NAME, 256, opponents=("level3",), arena=ARENAS, stagger=True)
    model = PPO("MlpPolicy", envs, 1e-3, 60, 2048, 4, 0.99, 0.95, ent_coef=0.01, seed=seed, device="cpu")
    model.learn(decisions // (60 * 256) * (60 * 256))
    policy = model.policy
    return layers_of([*policy.mlp_extractor.policy_net, policy.action_net]), model.num_timesteps


def dqn(seed: int, decisions: int) -> tuple[Layers, int]:
    """DQN of Stable-Baselines3, which knows one discrete action only: all 84 joint choices.

    The value of a joint choice is the sum of a value for each head, as in branching Q-learning (Tavakoli, Pardo and
    Kormushev, AAAI 2018), so the best one is the best of each head. The agent draws by exp(50 value).
    """
    import torch
    from stable_baselines3 import DQN
    from stable_baselines3.common.vec_env import VecEnvWrapper

    from pigaming_app.gym.sb3 import SeatVecEnv

    joint = np.stack(np.unravel_index(np.arange(np.prod(HEADS)), HEADS), 1)  # (84, heads)
    parts = np.concatenate([np.eye(count)[joint[:, head]] for head, count in enumerate(HEADS)], 1)  # (84, 14)

    class Joint(VecEnvWrapper):  # type: ignore[misc]
        def reset(self) -> Any:
            return self.venv.reset()

        def step_async(self, actions: Any) -> None:
            self.venv.step_async(joint[actions])

        def step_wait(self) -> Any:
            return self.venv.step_wait()

    class Sum(torch.nn.Module):  # type: ignore[misc]
        def forward(self, values: Any) -> Any:
            return values @ torch.from_numpy(parts.T.astype(np.float32))

    torch.set_num_threads(1)
    torch.manual_seed(seed)
    envs = SeatVecEnv(NAME, 256, opponents=("level3",), arena=ARENAS, stagger=True)
    wrapped = Joint(envs, action_space=gymnasium.spaces.Discrete(len(joint)))
    shape = {"net_arch": [64, 64], "activation_fn": torch.nn.Tanh}
    model = DQN(
        "MlpPolicy", wrapped, 5e-4, 300_000, 20_000, 512, gamma=0.99, train_freq=1, gradient_steps=2,
        target_update_interval=256 * 100, exploration_fraction=0.5, policy_kwargs=shape, seed=seed, device="cpu",
    )  # fmt: skip
    policy = model.policy
    for network in (policy.q_net.q_net, policy.q_net_target.q_net):
        network[-1] = torch.nn.Sequential(torch.nn.Linear(64, sum(HEADS)), Sum())
    policy.q_net_target.load_state_dict(policy.q_net.state_dict())
    policy.optimizer = torch.optim.Adam(policy.q_net.parameters(), 5e-4)
    model.learn(decisions // 256 * 256)
    *hidden, (last, _) = [layer for layer in policy.q_net.q_net if not isinstance(layer, torch.nn.Tanh)]
    *layers, (matrix, bias) = layers_of([*hidden, last])
    return [*layers, (50.0 * matrix, 50.0 * bias)], model.num_timesteps


def layers_of(modules: Any) -> Layers:
    """Matrices and biases of PyTorch's linear layers."""
    return [(one.weight.detach().numpy().T, one.bias.detach().numpy()) for one in modules if hasattr(one, "weight")]


if __name__ == "__main__":
    methods = {method.__name__: method for method in (search, clone, cleanrl, sb3, dqn)}
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("method", choices=methods)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--decisions", type=int, default=1_000_000)
    parser.add_argument("--out", type=Path, required=True)
    words = parser.parse_args()
    layers, used = methods[words.method](words.seed, words.decisions)
    save_agent(words.out, GAME, layers, words.method, words.seed, used)
    print(f"{words.out}: {used:,} decisions")
