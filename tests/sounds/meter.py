"""A second meter of loudness, from the tables of ITU-R BS.1770-5 for 48 kHz, to which samples are converted."""

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pygame

Samples = npt.NDArray[np.float64]  # samples x sides

RATE = 44100
HEAD = (1.53512485958697, -2.69169618940638, 1.19839281085285), (1.0, -1.69065929318241, 0.73248077421585)  # table 1
LOW = (1.0, -2.0, 1.0), (1.0, -1.99004745483398, 0.99007225036621)  # table 2


def measured(samples: Samples) -> float:
    """Integrated loudness, LUFS. Silence is appended up to 400 ms."""
    heard = k_weighted(np.pad(samples, ((0, max(0, 17640 - len(samples))), (0, 0))))
    power = np.array([(heard[i : i + 19200] ** 2).mean(axis=0).sum() for i in range(0, len(heard) - 19199, 4800)])
    audible = power[10.0 * np.log10(power + 1e-30) - 0.691 > -70.0]
    gate = 10.0 * math.log10(audible.mean()) - 10.0
    return float(-0.691 + 10.0 * math.log10(audible[10.0 * np.log10(audible) > gate].mean()))


def k_weighted(samples: Samples) -> Samples:
    """At 48 kHz, by multiplication of the spectra; 147 samples at 44.1 kHz are 160 of them."""
    ticks = 1 << (-(-(len(samples) + RATE // 4) // 147) - 1).bit_length()
    spectrum = np.fft.rfft(samples, 147 * ticks, axis=0)
    z = np.exp(-2j * np.pi * np.arange(len(spectrum)) / (160 * ticks))
    for above, below in (HEAD, LOW):
        spectrum *= (np.polyval(above[::-1], z) / np.polyval(below[::-1], z))[:, None]
    return np.fft.irfft(spectrum, 160 * ticks, axis=0)[: len(samples) * 160 // 147] * (160 / 147)


def decoded(path: Path) -> Samples:
    """The samples of a file as the mixer has them, in [-1, 1]: both sides, which are equal in a mono file."""
    return pygame.sndarray.array(pygame.mixer.Sound(str(path))).astype(float) / 32768.0
