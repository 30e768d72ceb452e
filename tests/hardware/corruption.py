"""Corrupt packets: wrong bits, other bytes, exchanged bytes, bytes lost and others inserted, a burst, bits out of step,
or the beginning of one valid packet with the end of another.
"""

import numpy as np

from pigaming_app.hardware.radio.packets import drive_packet
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.wire import ARENA

GOOD = 500  # different packets before corruption
BITS, EXCHANGE, LOSS, BURST, STEP, SPLICE = 0, 2, 3, 4, 5, 6  # ways; 1: another byte
WAYS = 7


def corrupt_packets(count, seed=1):
    """`count` drive packets of which each differs from the good one that it was, uint8 (count, 18)."""
    wheels = np.random.default_rng(seed).uniform(-1.0, 1.0, (GOOD, 4, 2)).tolist()
    good = [drive_packet(ARENA, i % 128, [WheelCommand(*pair) for pair in crew]) for i, crew in enumerate(wheels)]
    return corrupted(good, count, seed)


def corrupted(good, count, seed=1):
    """`count` times one of these packets of equal length, corrupted in one of the ways, uint8 (count, length)."""
    random = np.random.default_rng(seed)
    packets = np.frombuffer(b"".join(good), np.uint8).reshape(len(good), -1)
    chosen = random.integers(0, len(good), count)
    broken, rows, length = packets[chosen], np.arange(count), packets.shape[1]
    way, times = random.integers(0, WAYS, count), random.integers(1, 9, count)
    for change in range(8):
        kind = np.where(change < times, way, -1)
        at, other = random.integers(1, length, count), random.integers(1, length, count)
        flip, value = 1 << random.integers(0, 7, count), random.integers(0, 128, count)
        broken[rows, at] ^= np.where(kind == BITS, flip, 0).astype(np.uint8)
        broken[rows, at] = np.where(kind == 1, value, broken[rows, at])
        one, two = broken[rows, at], broken[rows, other]
        swapped = kind == EXCHANGE
        broken[rows, at], broken[rows, other] = np.where(swapped, two, one), np.where(swapped, one, two)
        shifted = np.where(np.arange(length) >= at[:, None], np.roll(broken, -1, axis=1), broken)
        shifted[:, -1] = value
        broken = np.where((kind == LOSS)[:, None], shifted, broken).astype(np.uint8)
    for number, spoilt in ((BURST, _burst), (STEP, _out_of_step)):
        broken[way == number] = spoilt(broken[way == number], random)
    end = packets[random.integers(0, len(good), count)]
    broken[way == SPLICE] = _spliced(broken[way == SPLICE], end[way == SPLICE], random)
    same = (broken == packets[chosen]).all(axis=1) | (broken == end).all(axis=1)
    broken[same, 5] ^= 1
    return broken


def _burst(packets, random):
    """Two to eight neighbouring bytes replaced by others."""
    count, length = packets.shape
    begin, size = random.integers(1, length - 1, (count, 1)), random.integers(2, 9, (count, 1))
    hit = (np.arange(length) >= begin) & (np.arange(length) < begin + size)
    return np.where(hit, random.integers(0, 128, packets.shape), packets)


def _out_of_step(packets, random):
    """From some byte on, every bit some places late."""
    count, length = packets.shape
    begin, bits = random.integers(1, length - 1, (count, 1)), random.integers(1, 7, (count, 1))
    late = (packets >> bits | np.roll(packets, 1, axis=1) << 7 - bits) & 0x7F
    return np.where(np.arange(length) >= begin, late, packets)


def _spliced(packets, others, random):
    """The beginning of one packet and the end of another, half of them with bytes lost or repeated between."""
    count, length = packets.shape
    begin, late = random.integers(1, length - 1, (count, 1)), random.integers(-3, 4, (count, 1))
    late[: count // 2] = 0
    end = np.take_along_axis(others, np.clip(np.arange(length) + late, 1, length - 1), axis=1)
    return np.where(np.arange(length) >= begin, end, packets)
