"""Networks as brains: what they see and what they do. No pygame."""

from pigaming_app.ai.networks.encoding import UNIT, Encoding, NetworkSenses, encode_room, nearest_robot, whole
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.networks.subject import Sight, Subject, distance_of

__all__ = [
    "UNIT",
    "Encoding",
    "Handicap",
    "NetworkSenses",
    "Sight",
    "Subject",
    "distance_of",
    "encode_room",
    "nearest_robot",
    "shipped_brain",
    "whole",
]
