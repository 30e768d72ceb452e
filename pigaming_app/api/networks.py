"""Networks as brains: what they see and what they do. No pygame."""

from pigaming_app.ai.networks.encoding import (
    ANYWHERE,
    UNIT,
    Encoding,
    NetworkSenses,
    encode_room,
    nearest_robot,
    saturating,
    whole,
)
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.networks.subject import At, Found, Subject, distance_of

__all__ = [
    "ANYWHERE",
    "UNIT",
    "At",
    "Encoding",
    "Found",
    "Handicap",
    "NetworkSenses",
    "Subject",
    "distance_of",
    "encode_room",
    "nearest_robot",
    "saturating",
    "shipped_brain",
    "whole",
]
