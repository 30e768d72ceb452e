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
