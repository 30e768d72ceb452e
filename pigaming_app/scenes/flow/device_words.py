"""What people steer with, in words."""

from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device


def steering(words: Words, controls: Controls, device: Device) -> str:
    """The signs on the steering keys; of a number pad or a pad its name; of a phone that of its owner, if known."""
    if own := controls.owner(device):
        return own
    name = controls.name(device)
    return controls.moves(device) if name == "Keyboard" else words(f"devices.{name}")
