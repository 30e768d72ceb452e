"""Brains: hand-written opponents. No pygame."""

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.brain.steering import follow, turn_stick
from pigaming_app.ai.brain.thoughts import GOAL, MATE, OPPONENT, PRIZE, Percept, Thoughts, clamp, towards
from pigaming_app.ai.brain.unstick import choose_escape, escape, ticks_stuck
from pigaming_app.ai.game_ai import LEVELS, GameAI, every_level
from pigaming_app.games.simple import Senses
from pigaming_app.sim.action import set_action
from pigaming_app.sim.flow_field import Route, descend, update_route

__all__ = [
    "GOAL",
    "LEVELS",
    "MATE",
    "OPPONENT",
    "PRIZE",
    "BrainKind",
    "GameAI",
    "Percept",
    "Route",
    "Senses",
    "Thoughts",
    "choose_escape",
    "clamp",
    "descend",
    "escape",
    "every_level",
    "follow",
    "set_action",
    "ticks_stuck",
    "towards",
    "turn_stick",
    "update_route",
]
