"""The encodings of all games."""

from pigaming_app.ai.networks import factory, pitanks, race
from pigaming_app.ai.networks.encoding import Encoding

ENCODINGS: dict[str, Encoding] = {
    encoding.game: encoding for encoding in (pitanks.ENCODING, factory.ENCODING, race.ENCODING)
}  # by game
