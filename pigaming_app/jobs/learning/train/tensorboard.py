"""The course of a training as an event file of TensorBoard, without its library.

Records are framed as TensorFlow's `lib/io/record_writer.h` describes: length, its check sum, content, its check sum;
check sums are CRC-32C (RFC 3720, B.4), masked. The content is an `Event` of `tensorflow/core/util/event.proto` in the
wire format of protocol buffers.
"""

from collections.abc import Iterable, Mapping
from math import isfinite
from pathlib import Path
from struct import pack
from time import time

from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved

VERSION = b"brain.Event:2"  # of the file format
CASTAGNOLI = 0x82F63B78  # the polynomial, reversed
VARINT, DOUBLE, BYTES, FLOAT = 0, 1, 2, 5  # wire types
TIME, STEP, FILE_VERSION, SUMMARY, SESSION = 1, 2, 3, 5, 7  # fields of Event
VALUE, TAG, NUMBER, STATUS = 1, 1, 2, 1  # of Summary, of its Value twice, of SessionLog
START = 1  # SessionLog: what an older file has from this step on counts no longer


class TensorboardFile:
    """A new file in a folder, to which numbers are added while a training runs."""

    def __init__(self, folder: Path, step: int) -> None:
        """`step`: updates so far. Raises NotSaved."""
        began = time()
        self._path = folder / f"events.out.tfevents.{began:.6f}.pigaming"
        begin = [_field(FILE_VERSION, VERSION)]
        if step:
            begin.append(_field(STEP, step + 1) + _field(SESSION, _field(STATUS, START)))
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise NotSaved(f"{folder} was not made: {describe_error(error)}.") from None
        self._append(_field(TIME, began) + event for event in begin)

    def add(self, step: int, numbers: Mapping[str, float]) -> None:
        """Add finite numbers by tag. Raises NotSaved."""
        values = (
            _field(VALUE, _field(TAG, tag.encode()) + _key(NUMBER, FLOAT) + pack("<f", number))
            for tag, number in numbers.items()
            if isfinite(number)
        )
        self._append([_field(TIME, time()) + _field(STEP, step) + _field(SUMMARY, b"".join(values))])

    def _append(self, events: Iterable[bytes]) -> None:
        try:
            with self._path.open("ab") as file:
                file.write(b"".join(map(record_of, events)))
        except OSError as error:
            raise NotSaved(f"{self._path.name} was not written: {describe_error(error)}.") from None


def record_of(content: bytes) -> bytes:
    """Content with its length and check sums."""
    length = pack("<Q", len(content))
    return length + pack("<I", masked(crc32c(length))) + content + pack("<I", masked(crc32c(content)))


def crc32c(content: bytes) -> int:
    """CRC-32C."""
    crc = 0xFFFFFFFF
    for byte in content:
        crc = crc >> 8 ^ TABLE[(crc ^ byte) & 0xFF]
    return crc ^ 0xFFFFFFFF


def masked(crc: int) -> int:
    """A check sum as it is stored."""
    return ((crc >> 15 | crc << 17) + 0xA282EAD8) & 0xFFFFFFFF


def _entry(byte: int) -> int:
    for _ in range(8):
        byte = byte >> 1 ^ (CASTAGNOLI if byte & 1 else 0)
    return byte


TABLE = [_entry(byte) for byte in range(256)]


def _field(number: int, value: int | float | bytes) -> bytes:
    """A field: a whole number, a double, or bytes."""
    if isinstance(value, bytes):
        return _key(number, BYTES) + _varint(len(value)) + value
    if isinstance(value, float):
        return _key(number, DOUBLE) + pack("<d", value)
    return _key(number, VARINT) + _varint(value)


def _key(number: int, kind: int) -> bytes:
    return _varint(number << 3 | kind)


def _varint(value: int) -> bytes:
    """A whole number from 0 on, seven bits a byte, the lowest first."""
    parts = bytearray()
    while value > 0x7F:
        parts.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*parts, value])
