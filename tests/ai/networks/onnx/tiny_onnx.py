"""Bytes of ONNX models that multiply their input by matrices, written without the package `onnx`.

Field numbers are those of onnx.proto3: https://github.com/onnx/onnx/blob/main/onnx/onnx.proto3
"""

import numpy as np

FLOAT, DOUBLE = 1, 11


def model(*matrices, batch=1, kind=FLOAT):
    """A model with one input (batch, rows of the matrices) and one output for each matrix."""
    dtype = "<f4" if kind == FLOAT else "<f8"
    nodes = tensors = outputs = b""
    for k, matrix in enumerate(matrices):
        names = field(1, b"x") + field(1, b"w%d" % k) + field(2, b"y%d" % k)
        nodes += field(1, names + field(4, b"MatMul"))
        shape = b"".join(field(1, size) for size in matrix.shape)
        data = np.ascontiguousarray(matrix, dtype).tobytes()
        tensors += field(5, shape + field(2, kind) + field(8, b"w%d" % k) + field(9, data))
        outputs += field(12, value(b"y%d" % k, kind, batch, matrix.shape[1]))
    graph = nodes + field(2, b"tiny") + tensors + field(11, value(b"x", kind, batch, len(matrices[0]))) + outputs
    return field(1, 8) + field(7, graph) + field(8, field(1, b"") + field(2, 13))


def troubled(matrix, *nodes, tensors=b""):
    """A model of one matrix, to whose output is added what these nodes make of its input: `trouble`, (1, 1)."""
    first = field(1, node("MatMul", ("x", "w"), ("y",)))
    last = field(1, node("Add", ("y", "trouble"), ("z",)))
    weights = field(5, tensor("w", matrix.astype("<f4")))
    ends = field(11, value(b"x", FLOAT, 1, len(matrix))) + field(12, value(b"z", FLOAT, 1, matrix.shape[1]))
    graph = first + b"".join(field(1, one) for one in nodes) + last + field(2, b"troubled") + weights + tensors + ends
    return field(1, 8) + field(7, graph) + field(8, field(1, b"") + field(2, 13))


def node(operator, inputs, outputs, **attributes):
    """A NodeProto. An attribute is a whole number, or the bytes of a graph."""
    names = b"".join(field(1, name.encode()) for name in inputs) + b"".join(field(2, name.encode()) for name in outputs)
    told = b""
    for name, content in attributes.items():
        kind, place = (2, 3) if isinstance(content, int) else (5, 6)
        told += field(5, field(1, name.encode()) + field(place, content) + field(20, kind))
    return names + field(4, operator.encode()) + told


def tensor(name, array):
    """A TensorProto of float32, int64 or bool."""
    kind = {"<f4": 1, "<i8": 7, "|b1": 9}[array.dtype.str]
    shape = b"".join(field(1, size) for size in array.shape)
    return shape + field(2, kind) + field(8, name.encode()) + field(9, array.tobytes())


def endless(rounds="rounds"):
    """A Loop over `rounds` that makes `trouble` of nothing."""
    again = field(1, node("Identity", ("on",), ("still",))) + field(1, node("Sin", ("sum",), ("next",)))
    ends = b"".join(field(11, value(*one)) for one in ((b"i", 7), (b"on", 9), (b"sum", FLOAT, 1, 1)))
    ends += b"".join(field(12, value(*one)) for one in ((b"still", 9), (b"next", FLOAT, 1, 1)))
    return node("Loop", (rounds, "yes", "zero"), ("trouble",), body=again + field(2, b"body") + ends)


def value(name, kind, *shape):
    """A ValueInfoProto; a text stands for any length."""
    sizes = b"".join(field(1, field(2, n.encode()) if isinstance(n, str) else field(1, n)) for n in shape)
    return field(1, name) + field(2, field(1, field(1, kind) + field(2, sizes)))


def field(number, content):
    """A field of a protobuf message: a whole number, or bytes."""
    if isinstance(content, int):
        return varint(number << 3) + varint(content)
    return varint(number << 3 | 2) + varint(len(content)) + content


def varint(n):
    low, high = n & 127, n >> 7
    return bytes([low | 128]) + varint(high) if high else bytes([low])
