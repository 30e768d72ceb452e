"""Networks as brains: what they see and what they do. No pygame."""

from pigaming_app.ai.networks.encoding import Encoding, NetworkSenses, encode_room, nearest_robot, whole
from pigaming_app.ai.networks.files import shipped_brain
from pigaming_app.ai.networks.subject import Sight, Subject

__all__ = ["Encoding", "NetworkSenses", "Sight", "Subject", "encode_room", "nearest_robot", "shipped_brain", "whole"]
