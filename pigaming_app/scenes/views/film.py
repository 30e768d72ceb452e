"""The last ticks of a match, and any of them once more: for replays in a view, which never change the match."""

from collections import deque
from collections.abc import Sequence
from typing import Any

from pigaming_app.sim.record import from_bytes, to_bytes


class Footage:
    """Recorded states, tick by tick; one is unpacked when it is first shown."""

    def __init__(self, kind: type, frames: Sequence[bytes]) -> None:
        self.kind, self.frames = kind, frames
        self._states: dict[int, Any] = {}

    def __len__(self) -> int:
        return len(self.frames)

    def __getitem__(self, i: int) -> Any:
        """The state after the i-th of its ticks."""
        if i not in self._states:
            self._states[i] = from_bytes(self.kind, self.frames[i])
        return self._states[i]


class Film:
    """The states of the last `ticks` ticks, as bytes: 9 kB each."""

    def __init__(self, ticks: int) -> None:
        self.frames: deque[bytes] = deque(maxlen=ticks)

    def record(self, state: Any) -> None:
        """Keep the state after a tick."""
        if self.frames.maxlen:
            self.frames.append(to_bytes(state))

    def before(self, state: Any) -> Footage:
        """All that was kept before the last tick, which led to `state`."""
        return Footage(type(state), [*self.frames][:-1])
