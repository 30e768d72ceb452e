"""Game state declared once, usable as plain objects (in the arcade) and as NumPy records (for training).

A record is a class of annotated fields: `float`, `int`, another record, or a list of fixed length,
`Annotated[list[Robot], 4]`. Lists of small whole numbers may name a narrower type: `Annotated[list[int], 576, "h"]`
or `Annotated[list[float], 64, "f"]` (whole numbers below 2**24, since plain records hold them unrounded).

    @record
    class Robot:
        x: float
        y: float
        gain: float = 1.0

A single number of a record may be LATE, `Annotated[float, LATE] = 36.0`: as long as it has its default, states have the
digests that they had before there was this field.

`Robot()` is a plain object; every number without a default is zero. `dtype(Robot)` is the same layout as a NumPy
record; `packed` and `unpack` copy between the two, and `digest` gives the same hash for both.
"""

import hashlib
import struct
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, get_args, get_origin, get_type_hints

if TYPE_CHECKING:
    import numpy as np

T = TypeVar("T")

LATE = "late"

_CODES = {float: "d", int: "q"}
_NUMPY = {"d": "<f8", "f": "<f4", "q": "<i8", "h": "<i2"}
_DTYPES: "dict[type, np.dtype[Any]]" = {}
_LAYOUTS: dict[type, struct.Struct] = {}


class Field:
    """One field of a record: name, type of an element, number of elements (None: a single one), default."""

    def __init__(self, name: str, hint: Any, default: Any = 0) -> None:
        self.name = name
        self.count: int | None = None
        self.late = getattr(hint, "__metadata__", ()) == (LATE,)
        code: str | None = None
        if self.late:
            hint = get_args(hint)[0]
        elif hasattr(hint, "__metadata__"):
            listed, (self.count, *narrow) = get_args(hint)[0], hint.__metadata__
            if get_origin(listed) is not list:
                raise TypeError(f"{name}: Annotated goes with list[...], not {listed}")
            hint, code = get_args(listed)[0], narrow[0] if narrow else None
        self.kind: type = hint
        self.code = code or _CODES.get(hint)
        if self.code is None and not hasattr(hint, "_fields"):
            raise TypeError(f"{name}: {hint} is not float, int or a record")
        if default and (self.code is None or self.count is not None):
            raise TypeError(f"{name}: only a single number has a default")
        self.default: float = default

    def fresh(self) -> Any:
        """The initial value of the field."""
        if self.default:
            return self.kind(self.default)
        if self.count is None:
            return self.kind()
        return [self.kind()] * self.count if self.code else [self.kind() for _ in range(self.count)]

    def elements(self, owner: object) -> Any:
        value = getattr(owner, self.name)
        return (value,) if self.count is None else value


def record(cls: type[T]) -> type[T]:
    """Make a class of annotated fields (its own and those of its base) a record."""
    hints = get_type_hints(cls, include_extras=True)
    base = getattr(cls, "_fields", ())
    inherited = {field.name: field.default for field in base}
    defaults = {**inherited, **vars(cls)}
    fields = tuple(Field(name, hint, defaults.get(name, 0)) for name, hint in hints.items())
    factories = tuple((field.name, field.fresh) for field in fields)

    def init(self: object) -> None:
        for name, factory in factories:
            setattr(self, name, factory())

    body = {
        "__slots__": tuple(field.name for field in fields),
        "__init__": init,
        "__setitem__": lambda self, name, value: setattr(self, name, value),  # as NumPy records have it
        "__annotations__": hints,
        "__doc__": cls.__doc__,
        "__module__": cls.__module__,
        "__qualname__": cls.__qualname__,
        "_fields": property(lambda self: fields),
    }
    result = type(cls.__name__, (), body)
    result._fields = fields  # type: ignore[attr-defined]
    return result


def fields_of(kind: type) -> tuple[Field, ...]:
    """The fields of a record, in memory order."""
    return kind._fields  # type: ignore[attr-defined, no-any-return]


def dtype(kind: type) -> "np.dtype[Any]":
    """The NumPy record type of a record: packed, little-endian, every number aligned to its size. Raises TypeError."""
    import numpy as np

    if kind in _DTYPES:
        return _DTYPES[kind]
    parts: list[tuple[Any, ...]] = []
    for field in fields_of(kind):
        element = _NUMPY[field.code] if field.code else dtype(field.kind)
        parts.append((field.name, element) if field.count is None else (field.name, element, (field.count,)))
    result = np.dtype(parts)
    if result.itemsize % 8:
        raise TypeError(f"{kind.__name__}: {result.itemsize} bytes; lists of narrow numbers must fill whole 8 bytes")
    _DTYPES[kind] = result
    return result


def numbers(state: object) -> Iterator[float]:
    """Every number of a plain record, in memory order."""
    for field in fields_of(type(state)):
        if field.code:
            yield from field.elements(state)
        else:
            for element in field.elements(state):
                yield from numbers(element)


def _layout(kind: type) -> struct.Struct:
    def codes(kind: type) -> str:
        parts = []
        for field in fields_of(kind):
            element = field.code or codes(field.kind)
            parts.append(element * (1 if field.count is None else field.count))
        return "".join(parts)

    if kind not in _LAYOUTS:
        _LAYOUTS[kind] = struct.Struct("<" + codes(kind))
    return _LAYOUTS[kind]


def to_bytes(state: object) -> bytes:
    """The bytes of the equivalent NumPy record."""
    return _layout(type(state)).pack(*numbers(state))


def packed(states: Sequence[Any]) -> Any:
    """Plain records of one type as a NumPy array (n,)."""
    import numpy as np

    kind = dtype(type(states[0]))
    return np.frombuffer(bytearray(b"".join(to_bytes(state) for state in states)), kind)


def unpack(kind: type[T], row: Any) -> T:
    """A plain record from one element of a NumPy array of `dtype(kind)`."""
    return from_bytes(kind, row.tobytes())


def from_bytes(kind: type[T], raw: bytes) -> T:
    """A plain record from the result of `to_bytes`."""
    state = kind()
    _fill(state, iter(_layout(kind).unpack(raw)))
    return state


def _fill(state: object, stream: Iterator[float]) -> None:
    for field in fields_of(type(state)):
        if not field.code:
            for element in field.elements(state):
                _fill(element, stream)
        elif field.count is None:
            setattr(state, field.name, next(stream))
        else:
            getattr(state, field.name)[:] = [next(stream) for _ in range(field.count)]


def copy(state: T) -> T:
    """A deep copy of a plain record."""
    twin = type(state)()
    for field in fields_of(type(state)):
        value = getattr(state, field.name)
        if field.code:
            setattr(twin, field.name, value if field.count is None else list(value))
        else:
            setattr(twin, field.name, copy(value) if field.count is None else [copy(element) for element in value])
    return twin


def digest(state: Any) -> str:
    """SHA-256 of a plain record or of one element of a NumPy array; equal for equal states."""
    if hasattr(state, "_fields"):
        return hashlib.sha256(hashed(type(state), to_bytes(state))).hexdigest()
    kind = next(kind for kind, made in _DTYPES.items() if made == state.dtype)
    return hashlib.sha256(hashed(kind, state.tobytes())).hexdigest()


def hashed(kind: type, raw: bytes) -> bytes:
    """The part of a record's bytes that counts in its digest: without LATE numbers that have their defaults."""
    parts, at = [], 0
    for field in fields_of(kind):
        part = raw[at : at + _size(field)]
        at += len(part)
        if not field.late or part != struct.pack(f"<{field.code}", field.default):
            parts.append(part)
    return b"".join(parts)


def _size(field: Field) -> int:
    """Bytes of a field of a record."""
    one = struct.calcsize(f"<{field.code}") if field.code else _layout(field.kind).size
    return one * (1 if field.count is None else field.count)
