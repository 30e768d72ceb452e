"""The keys that each device has used since it took its seat."""

from collections.abc import Sequence

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.ui.input.events import Device, StickState

STEER, FIRE, TURBO = "drive", "fire", "turbo"
ENOUGH = 0.25  # deflection that counts as steering


class UsedKeys:
    """STEER, FIRE and TURBO by device; one object for all matches (see `Context.shared`)."""

    def __init__(self, _: Context) -> None:
        self.used: dict[Device, set[str]] = {}

    def note(self, device: Device, drive: StickState) -> None:
        """Note what is pressed on this tick."""
        steers = max(abs(drive.linear), abs(drive.angular)) > ENOUGH
        pressed = {STEER: steers, FIRE: drive.fire, TURBO: drive.turbo}
        self.used.setdefault(device, set()).update(key for key, on in pressed.items() if on)

    def forget(self, device: Device) -> None:
        """The device takes a seat: its player may be another."""
        self.used.pop(device, None)

    def next_of(self, device: Device, keys: Sequence[str]) -> str:
        """The first of these keys that the device has not used; empty: none."""
        return next((key for key in keys if key not in self.used.get(device, ())), "")
