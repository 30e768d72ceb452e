"""Encodings by game: the games that networks can play."""

from pigaming_app.ai.networks import pitanks
from pigaming_app.ai.networks.encoding import Encoding

ENCODINGS: dict[str, Encoding] = {encoding.game: encoding for encoding in (pitanks.ENCODING,)}
