"""The encodings of all games."""

from pigaming_app.ai.networks import factory, pitanks, race
from pigaming_app.ai.networks.encoding import Encoding
from pigaming_app.storage.plugins.parts import Registry

ENCODINGS = Registry(
    {encoding.game: encoding for encoding in (pitanks.ENCODING, factory.ENCODING, race.ENCODING)},
    "network",
    "ENCODING",
    Encoding,
)  # by game
