"""Tricks that a person might find, for `main.py exploits GAME`. No pygame."""

from pigaming_app.ai.brain.kind import NoWeights
from pigaming_app.ai.brain.traits import Traits
from pigaming_app.ai.exploits.trick import Playbook, Trick

__all__ = ["NoWeights", "Playbook", "Traits", "Trick"]
