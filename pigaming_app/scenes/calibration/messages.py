"""What the hardware says, in the language of the screen."""

from pigaming_app.hardware.messages import Said
from pigaming_app.ui.i18n import Words


def tell(words: Words, sentence: str) -> str:
    """A sentence of the hardware; one without a key stays as it is."""
    return words(f"vision.{sentence.key}", **sentence.values) if isinstance(sentence, Said) else sentence
