"""Brains: hand-written opponents. No pygame."""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.steering import follow, turn_stick
from pigaming_app.ai.brain.thoughts import Percept, Thoughts
from pigaming_app.ai.brain.unstick import escape, ticks_stuck
from pigaming_app.ai.game_ai import GameAI, levels
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route, corner_after, update_route

__all__ = [
    "BrainKind",
    "GameAI",
    "Percept",
    "Route",
    "Thoughts",
    "corner_after",
    "escape",
    "follow",
    "levels",
    "set_action",
    "ticks_stuck",
    "turn_stick",
    "update_route",
]
