"""Training of networks: what they play, against whom, and what is rewarded. No pygame."""

from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.task import LEARNER, OFF, POOL, LineUp, Task
from pigaming_app.ai.tallies import Tallies, is_over, sign

__all__ = ["LEARNER", "OFF", "POOL", "Hyper", "LineUp", "Tallies", "Task", "is_over", "sign"]
