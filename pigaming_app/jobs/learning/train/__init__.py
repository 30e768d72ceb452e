"""Train an AI from nothing. Ctrl-C keeps what has been learned; --resume continues from there."""

from pigaming_app.jobs.learning.train import ppo, qlearning, task

WORDS = {"qlearning": qlearning, "ppo": ppo, "task": task}
