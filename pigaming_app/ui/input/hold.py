"""Hold-to-confirm timers, one per device."""

from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Device, InputEvent


class HoldTimers:
    """Buttons being held. `needed`: seconds until one counts."""

    def __init__(self, controls: Controls, needed: float) -> None:
        self.controls, self.needed = controls, needed
        self._held: dict[Device, tuple[InputEvent, float]] = {}

    def begin(self, event: InputEvent) -> None:
        self._held[event.device] = (event, 0.0)

    def update(self, seconds: float) -> list[InputEvent]:
        """Advance all timers; returns the events held long enough. Released buttons are dropped."""
        done = []
        for device, (event, elapsed) in list(self._held.items()):
            self._held[device] = (event, elapsed + seconds)
            if not self.controls.holds(device, event.button):
                del self._held[device]
            elif elapsed + seconds >= self.needed:
                del self._held[device]
                done.append(event)
        return done

    def clear(self) -> None:
        self._held.clear()

    @property
    def shares(self) -> dict[Device, float]:
        """Elapsed share of the time for each device that holds a button, 0..1."""
        return {device: min(1.0, elapsed / self.needed) for device, (_, elapsed) in self._held.items()}

    @property
    def share(self) -> float:
        """The largest share, 0 if nothing is held."""
        return max(self.shares.values(), default=0.0)
