"""Corrupt packets: wrong bits, other bytes, exchanged bytes, bytes lost and others inserted, a burst, bits out of step,
or the beginning of one valid packet with the end of another.
"""

import numpy as np

from pigaming_app.hardware.radio.packets import drive_packet
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.robot_packets import ARENA

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
    places, begin = np.arange(length), random.integers(1, length - 1, count)[:, None]
    after = places >= begin
    burst = after & (places < begin + random.integers(2, 9, count)[:, None])
    broken = np.where((way == BURST)[:, None] & burst, random.integers(0, 128, broken.shape), broken)
    bits = random.integers(1, 7, count)[:, None]
    slipped = (broken >> bits | np.roll(broken, 1, axis=1) << 7 - bits) & 0x7F
    broken = np.where((way == STEP)[:, None] & after, slipped, broken)
    end = packets[random.integers(0, len(good), count)]
    late = np.where(random.random((count, 1)) < 0.5, 0, random.integers(-3, 4, (count, 1)))  # bytes lost between them
    joined = np.take_along_axis(end, np.clip(places + late, 1, length - 1), axis=1)
    broken = np.where((way == SPLICE)[:, None] & after, joined, broken).astype(np.uint8)
    same = (broken == packets[chosen]).all(axis=1) | (broken == end).all(axis=1)
    broken[same, 5] ^= 1
    return broken
