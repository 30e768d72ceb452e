"""The encodings of all games."""

from pigaming_app.ai.networks.encoding import Encoding
from pigaming_app.games.registry import OURS
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import Registry

ENCODINGS = Registry(
    {game: optional(f"ai.networks.{game}").ENCODING for game in OURS},
    "network",
    "ENCODING",
    Encoding,
)  # by game
