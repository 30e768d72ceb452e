"""The last ticks of a match, and any of them once more: for replays in a view, which never change the match."""

import struct
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any

from pigaming_app.sim.record import dtype, fields_of, from_bytes


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


def to_bytes(state: object) -> bytes:
    """As `record.to_bytes`, in a tenth of the time: a film packs every tick."""
    kind: Any = type(state)
    return _packer(kind)(state)


@cache
def _packer(kind: type) -> Callable[[object], bytes]:
    """A function that packs a record by one expression without loops, generated once for its type."""
    codes = [{"<f8": "d", "<f4": "f", "<i8": "q", "<i2": "h"}[code] for code in _codes(dtype(kind))]
    names = {"pack": struct.Struct(f"<{''.join(codes)}").pack}
    packer: Callable[[object], bytes] = eval(f"lambda state: pack({', '.join(_terms(kind, 'state'))})", names)
    return packer


def _codes(kind: Any) -> Iterator[str]:
    """NumPy's code of each number of a record type, in memory order."""
    base, shape = (kind.base, kind.shape)
    for _ in range(shape[0] if shape else 1):
        if base.fields is None:
            yield base.str
        else:
            for name in base.names:
                yield from _codes(base.fields[name][0])


def _terms(kind: type, owner: str) -> Iterator[str]:
    """Expressions for the numbers of a plain record, in memory order; `owner`: the expression of the record."""
    for field in fields_of(kind):
        place = f"{owner}.{field.name}"
        if field.code:
            yield place if field.count is None else f"*{place}"
        else:
            for element in [place] if field.count is None else [f"{place}[{i}]" for i in range(field.count)]:
                yield from _terms(field.kind, element)


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
