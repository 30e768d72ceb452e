"""Buttons that went down or up since they were last read, so that a tap shorter than a frame acts exactly once."""

from collections import deque

from pigaming_app.ui.input.events import Button, Device

MOST = 8  # edges kept for a button: four taps


class TapQueue:
    """A queue for each button of each device; `button` is Button.FIRE or None, the turbo."""

    def __init__(self) -> None:
        self._queues: dict[tuple[Device, Button | None], deque[bool]] = {}

    def note(self, device: Device, button: Button | None, down: bool) -> None:
        """A button went down or up. What exceeds the queue is dropped."""
        queue = self._queues.setdefault((device, button), deque())
        if len(queue) < MOST:
            queue.append(down)

    def read(self, device: Device, button: Button | None, held: bool) -> bool:
        """Whether the button counts as down on this tick: its oldest unread edge; without one, how it is held."""
        queue = self._queues.get((device, button))
        return queue.popleft() if queue else held

    def clear(self, kind: str | None = None, device: Device | None = None) -> None:
        """Forget the edges of one device, of all devices of a kind, or all."""
        for key in list(self._queues):
            if device in (None, key[0]) and kind in (None, key[0].kind):
                del self._queues[key]
