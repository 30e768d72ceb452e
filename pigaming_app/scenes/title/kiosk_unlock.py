"""The hidden combination that opens a kiosk's operator page, unlikely to be held by a child.

On the title, one device is held straight ahead with its turbo button (a shoulder button of a pad; a cluster's turbo
key) and without fire for five seconds. Nothing on the screen mentions it.
"""

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.keyboard import CLUSTERS

HOLD = 5.0  # seconds
AHEAD = 0.9


class KioskUnlock:
    """Watches all devices; inactive outside a kiosk."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.held_for = 0.0

    def unlocked(self, seconds: float) -> bool:
        """Advance by `seconds`; true at the moment the combination has been held long enough."""
        if not self.context.kiosk:
            return False
        self.held_for = self.held_for + seconds if any(map(self._holds, self._devices())) else 0.0
        if self.held_for < HOLD:
            return False
        self.held_for = 0.0
        return True

    def _devices(self) -> list[Device]:
        return [*self.context.controls.pads(), *(Device("keys", number) for number in range(len(CLUSTERS)))]

    def _holds(self, device: Device) -> bool:
        drive = self.context.controls.drive(device)
        return drive.linear > AHEAD and drive.turbo and not drive.fire
