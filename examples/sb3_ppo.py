"""PPO of Stable-Baselines3 on hundreds of matches at once, in one process.

    pip install '.[gym,train]' stable-baselines3
    python3 examples/sb3_ppo.py --env PiTanks-v0 --decisions 2000000 --opponents level1

It prints the share of matches won, of the last hundred, after each round of 60 decisions of every seat.
"""

import argparse
from typing import Any

import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecMonitor

from pigaming_app.gym.sb3 import SeatVecEnv


class Progress(BaseCallback):
    """A line after each round."""

    def _on_step(self) -> bool:
        return True

    def _on_rollout_end(self) -> None:
        ended: Any = self.model.ep_info_buffer
        won = np.mean([episode["win"] > 0.0 for episode in ended]) if ended else np.nan
        print(f"{self.num_timesteps:>10,} decisions, won {won:.0%}", flush=True)


def train(env: str, opponents: list[str], decisions: int, num_envs: int, seed: int) -> PPO:
    """A trained model."""
    torch.set_num_threads(1)  # the layers are too small to be shared out
    envs = VecMonitor(SeatVecEnv(env, num_envs, opponents=opponents, stagger=True), info_keywords=("win",))
    model = PPO(
        "MlpPolicy",
        envs,
        n_steps=60,
        batch_size=2048,
        n_epochs=2,
        learning_rate=lambda left: 1e-3 * (0.1 + 0.9 * left),
        ent_coef=0.01,
        gae_lambda=0.95,
        seed=seed,
        device="cpu",
    )
    return model.learn(decisions, Progress())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for name, default in {"env": "PiTanks-v0", "decisions": 2_000_000, "num-envs": 256, "seed": 1, "out": ""}.items():
        parser.add_argument(f"--{name}", default=default, type=type(default))
    parser.add_argument("--opponents", default=["level1"], nargs="*")
    words = vars(parser.parse_args())
    out = words.pop("out")
    model = train(**words)
    if out:
        model.save(out)
