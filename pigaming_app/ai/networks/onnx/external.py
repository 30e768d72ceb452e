"""Tensors of an ONNX model that lie in other files. Field numbers are those of onnx.proto3."""

from collections.abc import Iterator

DEPTH = 32  # of subgraphs within subgraphs
LOCATION, EXTERNAL_DATA = 14, 13  # of a tensor
INSIDE = {  # messages in the fields of a message
    "model": {7: "graph", 25: "function"},
    "graph": {1: "node", 5: "tensor", 15: "sparse"},
    "function": {7: "node", 11: "attribute"},
    "node": {5: "attribute"},
    "attribute": {5: "tensor", 6: "graph", 10: "tensor", 11: "graph", 22: "sparse", 23: "sparse"},
    "sparse": {1: "tensor", 2: "tensor"},
    "tensor": {},
}


def has_external_data(model: bytes) -> bool:
    """Whether a tensor lies in another file. Raises ValueError for bytes that are no model."""
    return any(_externals(memoryview(model), "model", DEPTH))


def _externals(message: memoryview, kind: str, depth: int) -> Iterator[bool]:
    """True for each tensor in another file."""
    if not depth:
        raise ValueError("nested too deep")
    for number, value in _fields(message):
        if isinstance(value, memoryview):
            if kind == "tensor" and number == EXTERNAL_DATA:
                yield True
            elif number in INSIDE[kind]:
                yield from _externals(value, INSIDE[kind][number], depth - 1)
        elif kind == "tensor" and number == LOCATION and value:
            yield True


def _fields(message: memoryview) -> Iterator[tuple[int, int | memoryview]]:
    """Number and content of each field: a whole number, or bytes. Raises ValueError."""
    at = 0
    while at < len(message):
        key, at = _varint(message, at)
        wire = key & 7
        if wire == 0:
            value, at = _varint(message, at)
            yield key >> 3, value
            continue
        if wire not in (1, 2, 5):
            raise ValueError("no protocol buffer")
        length, at = _varint(message, at) if wire == 2 else (8 if wire == 1 else 4, at)
        if at + length > len(message):
            raise ValueError("cut off")
        if wire == 2:
            yield key >> 3, message[at : at + length]
        at += length


def _varint(message: memoryview, at: int) -> tuple[int, int]:
    """A whole number and the place after it. Raises ValueError."""
    value = 0
    for shift in range(0, 70, 7):
        if at >= len(message):
            break
        byte = message[at]
        at += 1
        value |= (byte & 127) << shift
        if byte < 128:
            return value, at
    raise ValueError("cut off")
