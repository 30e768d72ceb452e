"""Training of networks: what they play, against whom, and what is rewarded. No pygame."""

from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.task import LineUp, Task
from pigaming_app.ai.tallies import Tallies

__all__ = ["Hyper", "LineUp", "Tallies", "Task"]
