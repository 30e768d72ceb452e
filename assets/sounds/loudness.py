"""Loudness by ITU-R BS.1770-5, in LUFS: K-weighting, blocks of 400 ms, two gates.

The coefficients are those of the two filters of the recommendation for any sample rate, derived from their frequency,
gain and quality as in libebur128.
"""

import math

import numpy as np
import numpy.typing as npt

from assets.sounds.synth import RATE, Samples

BLOCK, HOP = 0.4, 0.1  # s
OFFSET, ABSOLUTE, RELATIVE = -0.691, -70.0, -10.0  # LU, LUFS, LU
SHELF = 1681.974450955533, 3.999843853973347, 0.7071752369554196  # Hz, dB, quality: the head
HIGH_PASS = 38.13547087602444, 0.5003270373238773  # Hz, quality: low sounds


def loudness(samples: Samples) -> float:
    """Integrated loudness of mono samples, or of samples x 2; of at least 400 ms, silence appended."""
    power = blocks(samples)
    power = power[power > 10.0 ** ((ABSOLUTE - OFFSET) / 10.0)]
    if not power.size:
        return -math.inf
    return OFFSET + 10.0 * math.log10(power[power > power.mean() * 10.0 ** (RELATIVE / 10.0)].mean())


def blocks(samples: Samples) -> Samples:
    """The power of each block after K-weighting, of both sides together."""
    sides = samples.reshape(len(samples), -1)
    size, step = round(BLOCK * RATE), round(HOP * RATE)
    heard = weighted(np.pad(sides, ((0, max(0, size - len(sides))), (0, 0))))
    total = np.pad(np.cumsum((heard**2).sum(axis=1)), (1, 0))
    first = np.arange(0, len(heard) - size + 1, step)
    return np.asarray((total[first + size] - total[first]) / size)


def weighted(sides: Samples) -> Samples:
    """K-weighted: the answer of the filters is multiplied in the spectrum, beyond whose end silence lies."""
    size = 1 << (len(sides) + RATE // 5).bit_length()
    z = np.exp(-2j * np.pi * np.arange(size // 2 + 1) / size)
    answer = response(shelf(), z) * response(high_pass(), z)
    return np.asarray(np.fft.irfft(np.fft.rfft(sides, size, axis=0) * answer[:, None], size, axis=0)[: len(sides)])


Biquad = tuple[tuple[float, float, float], tuple[float, float, float]]  # numerator and denominator


def response(filter: Biquad, z: npt.NDArray[np.complex128]) -> npt.NDArray[np.complex128]:
    (b0, b1, b2), (a0, a1, a2) = filter
    return np.asarray((b0 + b1 * z + b2 * z * z) / (a0 + a1 * z + a2 * z * z))


def shelf() -> Biquad:
    hz, decibels, quality = SHELF
    k, high = math.tan(math.pi * hz / RATE), 10.0 ** (decibels / 20.0)
    band = high**0.4996667741545416
    top = high + band * k / quality + k * k, 2.0 * (k * k - high), high - band * k / quality + k * k
    return top, (1.0 + k / quality + k * k, 2.0 * (k * k - 1.0), 1.0 - k / quality + k * k)


def high_pass() -> Biquad:
    hz, quality = HIGH_PASS
    k = math.tan(math.pi * hz / RATE)
    whole = 1.0 + k / quality + k * k
    return (whole, -2.0 * whole, whole), (whole, 2.0 * (k * k - 1.0), 1.0 - k / quality + k * k)
