"""Proximal policy optimisation in RLlib, on the PettingZoo environment: a pair of robots against a pair of level3.

    pip install '.[gym,train]' "ray[rllib]" torch
    python3 examples/rllib_ppo.py --game pitanks --minutes 5 --workers 2

Both agents share one policy. The games race and factory learn likewise; those without pairs take --alone.
"""

import argparse
import time
from typing import Any

from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
from ray.rllib.env.wrappers.pettingzoo_env import ParallelPettingZooEnv
from ray.tune.registry import register_env

PAIRS = {"agents": 2, "teams": (0, 0, 1, 1), "opponents": ("level3", "level3")}
ALONE = {"agents": 1, "opponents": ("level3",)}


def make(options: dict[str, Any]) -> ParallelPettingZooEnv:
    """The environment, in a worker of RLlib."""
    from pigaming_app.api.environments import parallel_env

    return ParallelPettingZooEnv(parallel_env(**options))


def config(game: str, alone: bool, workers: int) -> PPOConfig:
    """The algorithm's settings."""
    register_env("pigaming", make)
    return (
        PPOConfig()
        .environment("pigaming", env_config={"game": game, **(ALONE if alone else PAIRS)})
        .multi_agent(policies={"tank"}, policy_mapping_fn=lambda agent, episode, **_: "tank")
        .env_runners(num_env_runners=workers, rollout_fragment_length="auto")
        .training(train_batch_size_per_learner=4000, minibatch_size=500, num_epochs=4, lr=5e-4, gamma=0.99)
        .training(lambda_=0.95, clip_param=0.2, entropy_coeff=0.01, grad_clip=0.5, vf_clip_param=100.0)
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[64, 64], fcnet_activation="tanh"))
    )


def train(game: str, alone: bool, workers: int, minutes: float) -> None:
    """Train, and print the mean return of an episode as it grows."""
    algorithm, began = config(game, alone, workers).build_algo(), time.time()
    while time.time() - began < 60.0 * minutes:
        found = algorithm.train()["env_runners"]
        steps, returned = found["num_env_steps_sampled_lifetime"], found.get("episode_return_mean", float("nan"))
        print(f"{time.time() - began:5.0f} s, {steps:>9,.0f} decisions, return of an episode {returned:.1f}")
    algorithm.stop()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in {"game": "pitanks", "workers": 1, "minutes": 5.0}.items():
        parser.add_argument(f"--{name}", default=default, type=type(default))
    parser.add_argument("--alone", action="store_true", help="one robot against one level3")
    train(**vars(parser.parse_args()))
