"""Queued button edges, so that a tap shorter than a frame acts exactly once."""

from collections import deque

from pigaming_app.ui.input.events import Button, Device

MAX_EDGES = 8  # queued edges per button: four taps


class TapQueue:
    """One queue per button and device; `button` is Button.FIRE or None, the turbo."""

    def __init__(self) -> None:
        self._queues: dict[tuple[Device, Button | None], deque[bool]] = {}

    def note(self, device: Device, button: Button | None, down: bool) -> None:
        """Queue an edge; it is dropped if the queue is full."""
        queue = self._queues.setdefault((device, button), deque())
        if len(queue) < MAX_EDGES:
            queue.append(down)

    def read(self, device: Device, button: Button | None, held: bool) -> bool:
        """The state for this tick: the oldest queued edge, else `held`."""
        queue = self._queues.get((device, button))
        return queue.popleft() if queue else held

    def clear(self, kind: str | None = None, device: Device | None = None) -> None:
        """Drop the edges of one device, of all devices of a kind, or all."""
        for key in list(self._queues):
            if device in (None, key[0]) and kind in (None, key[0].kind):
                del self._queues[key]
