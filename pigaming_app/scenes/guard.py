"""The guard between devices and scenes: presses and steps for which a device lacks the right, see `flow/access.py`.

In a kiosk with a PIN it asks for the PIN first; phones are refused.
"""

from collections.abc import Sequence

from pigaming_app.scenes.flow.access import LOWEST, Right, Role, Roles, right_of
from pigaming_app.scenes.flow.scene import Context, Home, Push, Quit, Scene, StackOperation, Swap
from pigaming_app.ui.input.events import Button, Device, InputEvent

HARMLESS = (Button.POINT, Button.FOUND, Button.LOST, Button.STOP, Button.BRAIN)


class Guard:
    """Between the devices and the scenes of an arcade."""

    def __init__(self, context: Context) -> None:
        self.context, self.roles = context, context.shared(Roles)

    def handle(self, scenes: Sequence[Scene], event: InputEvent) -> StackOperation:
        """What follows from a press on the scene on top."""
        right = right_of(scenes)
        if right is not Right.PLAY and event.button not in HARMLESS:
            if self.roles.may(event.device, right):
                self.roles.used(event.device)
            elif self.roles.left_open and event.button is Button.BACK:
                pass
            elif event.device.kind == "phone" or self.roles.in_session:
                return self._refuse(event.device)
            else:
                return self._ask(None, scenes[-1])
        return self.checked(scenes[-1].handle(event), event.device)

    def advance(self, scenes: Sequence[Scene], seconds: float) -> StackOperation:
        """What follows from the passing of time on the scene on top. Nobody knows who waits at a visitors' scene."""
        at_work = self.roles.in_session and right_of(scenes) is not Right.PLAY
        operation = scenes[-1].update(seconds)
        right = _needed(operation)
        may = right is None or (LOWEST[right] < Role.OWNER and (at_work or not self.roles.guarded))
        return operation if may or not self.context.kiosk else self._ask(operation)

    def checked(self, operation: StackOperation, device: Device) -> StackOperation:
        """A step that a device has asked for."""
        right = _needed(operation)
        if right is None or self.roles.may(device, right):
            return operation
        return self._refuse(device) if device.kind == "phone" else self._ask(operation)

    # ---- inside

    def _ask(self, operation: StackOperation, below: Scene | None = None) -> StackOperation:
        from pigaming_app.scenes.pages.pin_page import PinPage  # late: the title does not wait for it

        return Push(PinPage(self.context, operation, below))

    def _refuse(self, device: Device) -> StackOperation:
        self.context.sounds.play("refused")
        if device.kind == "phone":
            self.context.notices.add(self.context.words("access.no_phone"))
        return None


def _needed(operation: StackOperation) -> Right | None:
    """The right that a step needs; None: none."""
    if isinstance(operation, Quit):
        return Right.CLOSE
    if isinstance(operation, Push | Swap | Home) and operation.scene:
        return getattr(operation.scene, "right", None)
    return None
