"""Voices: what the sounds and the themes are made of. Each gives mono samples, from a start to silence."""

from collections.abc import Callable
from functools import lru_cache
from zlib import crc32

import numpy as np
import numpy.typing as npt

Samples = npt.NDArray[np.float64]  # mono, in [-1, 1]
Notes = list[tuple[float, Samples]]  # when each one starts (s)

RATE = 44100  # samples in a second


def pitch(note: str) -> float:
    """The frequency (Hz) of a note such as A4 (440), F#3 or Bb2."""
    steps = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}[note[0]]
    steps += note.count("#") - note.count("b")
    return float(440.0 * 2.0 ** ((steps + 12 * int(note[-1]) - 57) / 12.0))


def times(seconds: float) -> Samples:
    return np.arange(round(seconds * RATE)) / RATE


def decay(seconds: float, half: float) -> Samples:
    """Falls to a half every `half` seconds, and is gone at the end."""
    t = times(seconds)
    falling: Samples = np.exp2(-t / half) * np.clip((seconds - t) / (0.25 * seconds), 0.0, 1.0)
    return falling


def pluck(hz: float, seconds: float, half: float = 0.05, bright: float = 0.5) -> Samples:
    """A dry string: the higher a partial, the weaker (`bright` to the power of its number) and the shorter."""
    t = times(seconds)
    partials = [
        bright ** (n - 1) * np.sin(2.0 * np.pi * n * hz * t) * np.exp2(-t * n**0.7 / half)
        for n in range(1, 9)
        if n * hz < 12000.0
    ]
    string: Samples = np.sum(partials, axis=0)
    return string * decay(seconds, 9.0) * np.clip(t / 0.002, 0.0, 1.0)


def sweep(start: float, end: float, seconds: float, half: float, glide: float = 0.03) -> Samples:
    """A sine that slides from one frequency (Hz) to another, most of the way in `glide` seconds."""
    hz = end + (start - end) * np.exp(-times(seconds) / glide)
    return np.sin(2.0 * np.pi * np.cumsum(hz) / RATE) * decay(seconds, half)


def burst(name: str, seconds: float, half: float, low: float, high: float) -> Samples:
    """Noise between two frequencies (Hz); the name seeds it."""
    noise = np.random.default_rng(crc32(name.encode())).standard_normal(round(seconds * RATE))
    spectrum, hz = np.fft.rfft(noise), np.fft.rfftfreq(noise.size, 1.0 / RATE)
    spectrum *= 1.0 / (1.0 + (low / np.maximum(hz, 1.0)) ** 4) / (1.0 + (hz / high) ** 4)
    shaped: Samples = np.fft.irfft(spectrum, noise.size)
    return shaped / float(np.abs(shaped).max()) * decay(seconds, half)


def together(notes: Notes) -> Samples:
    """Notes laid over each other."""
    placed = [(round(start * RATE), sound) for start, sound in notes]
    mixed = np.zeros(max(first + sound.size for first, sound in placed))
    for first, sound in placed:
        mixed[first : first + sound.size] += sound
    return mixed


def melody(notes: str, step: float, last: float = 0.3, half: float = 0.07, bright: float = 0.45) -> Samples:
    """Plucked notes, one each `step` seconds; the last one rings for `last` seconds."""
    names = notes.split()
    lengths = [step + 0.08] * (len(names) - 1) + [last]
    return together(
        [(i * step, pluck(pitch(name), lengths[i], half, bright)) for i, name in enumerate(names)],
    )


# Instruments of the themes: a frequency (Hz) and the written length of the note (s); they may ring on.


def held(seconds: float, attack: float, release: float) -> Samples:
    """The envelope of a note that is held and then let go."""
    t = times(seconds + release)
    envelope: Samples = np.clip(t / attack, 0.0, 1.0) * np.clip((seconds + release - t) / release, 0.0, 1.0)
    return envelope**1.5


def tone(hz: float, t: Samples, weights: list[float]) -> Samples:
    """Harmonics of these weights, none above 6 kHz."""
    parts = [w * np.sin(2.0 * np.pi * n * hz * t) for n, w in enumerate(weights, 1) if w and n * hz < 6000.0]
    return np.asarray(np.sum(parts, axis=0))


def lead(hz: float, seconds: float) -> Samples:
    """A reed: odd harmonics, and a vibrato once it has been held for a while."""
    t = times(seconds + 0.08)
    bent = t + 0.0003 / (hz / 440.0) * np.clip((t - 0.18) / 0.2, 0.0, 1.0) * np.sin(2.0 * np.pi * 5.3 * t)
    fading = 0.55 + 0.45 * np.exp2(-t / 0.18)
    return tone(hz, bent, [1.0, 0.22, 0.34, 0.08, 0.15, 0.0, 0.06]) * fading * held(seconds, 0.012, 0.08)


def brass(hz: float, seconds: float) -> Samples:
    """Horns: two of them, slightly apart, that brighten as they are blown."""
    t = times(seconds + 0.09)
    soft = sum(tone(hz * off, t, [1.0, 0.45, 0.2]) for off in (0.998, 1.002))
    sharp = sum(tone(hz * off, t, [0.0, 0.1, 0.3, 0.3, 0.2, 0.14, 0.09]) for off in (0.998, 1.002))
    blown = np.clip(t / 0.06, 0.0, 1.0) * (0.5 + 0.5 * np.exp2(-t / 0.22))
    return np.asarray(0.55 * (soft + blown * sharp) * held(seconds, 0.025, 0.09))


def bell(hz: float, seconds: float) -> Samples:
    """An electric piano: a sine whose phase another one shakes, less and less."""
    t = times(max(seconds, 0.9) + 0.5)
    shake = 0.9 * np.exp2(-t / 0.12) + 0.25 * np.exp2(-t / 0.6)
    ringing = np.sin(2.0 * np.pi * hz * t + shake * np.sin(2.0 * np.pi * 2.0 * hz * t))
    return np.asarray((ringing + 0.12 * np.sin(2.0 * np.pi * 4.0 * hz * t) * np.exp2(-t / 0.05)) * struck(t, 0.42))


def marimba(hz: float, seconds: float) -> Samples:
    """Wood: the fundamental, and a partial two octaves above that is soon gone."""
    t = times(0.6)
    wood = np.sin(2.0 * np.pi * hz * t) * np.exp2(-t / 0.09)
    return np.asarray((wood + 0.3 * np.sin(2.0 * np.pi * 3.93 * hz * t) * np.exp2(-t / 0.02)) * struck(t, 0.3))


def string(hz: float, seconds: float) -> Samples:
    """A plucked string that rings a little longer than it is written."""
    return pluck(hz, seconds + 0.25, 0.1, 0.48)


def pulse(hz: float, seconds: float) -> Samples:
    """Short and bright, for runs of sixteenths."""
    return pluck(hz, min(seconds, 0.2) + 0.08, 0.055, 0.62)


def bass(hz: float, seconds: float) -> Samples:
    t = times(seconds + 0.05)
    warm = tone(hz, t, [1.0, 0.5, 0.28, 0.16, 0.09, 0.05]) * (0.45 + 0.55 * np.exp2(-t / 0.14))
    return np.asarray(warm * held(seconds, 0.006, 0.05))


def pad(hz: float, seconds: float) -> Samples:
    """A soft tone: two strings slightly apart that swell and fade."""
    t = times(seconds + 0.4)
    soft = sum(tone(hz * detune, t, [1.0, 0.25, 0.11]) for detune in (0.998, 1.002))
    return np.asarray(soft * np.sin(np.pi * t / (seconds + 0.4)) ** 0.7)


def struck(t: Samples, half: float) -> Samples:
    """The envelope of what is struck: 3 ms to its top, silent at the end."""
    ringing: Samples = np.exp2(-t / half) * np.clip(t / 0.003, 0.0, 1.0) * np.clip((t[-1] - t) / 0.05, 0.0, 1.0)
    return ringing


VOICES: dict[str, Callable[[float, float], Samples]] = {
    "lead": lead,
    "brass": brass,
    "bell": bell,
    "marimba": marimba,
    "string": string,
    "pulse": pulse,
    "bass": bass,
    "pad": pad,
}


# Drums.


@lru_cache
def drum(name: str) -> Samples:
    """One stroke, which takes a millisecond to begin."""
    stroke = drum_noise(name)
    return stroke * np.clip(times(stroke.size / RATE) / 0.001, 0.0, 1.0)


def drum_noise(name: str) -> Samples:
    match name:
        case "kick":
            return sweep(130.0, 46.0, 0.24, 0.06, glide=0.025)
        case "snare":
            rattle = 0.6 * burst("snare", 0.18, 0.03, 900.0, 5000.0)
            return together([(0.0, rattle), (0.0, 0.5 * sweep(260.0, 180.0, 0.12, 0.03))])
        case "hat":
            return burst("hat", 0.05, 0.009, 5000.0, 9000.0)
        case "open":
            return burst("open", 0.25, 0.06, 5000.0, 9000.0)
        case "shaker":
            return burst("shaker", 0.09, 0.02, 3500.0, 7500.0) * np.clip(times(0.09) / 0.02, 0.0, 1.0)
        case "clap":
            return together([(at, burst(f"clap{at}", 0.16, 0.022, 800.0, 3500.0)) for at in (0.0, 0.011, 0.023)])
        case "rim":
            return together([(0.0, pluck(820.0, 0.06, 0.01, 0.7)), (0.0, 0.5 * burst("rim", 0.04, 0.006, 1500.0, 5e3))])
        case "clank":
            return together([(0.0, pluck(hz, 0.2, 0.03, 0.3)) for hz in (640.0, 973.0, 1512.0)])
        case "low":
            return sweep(150.0, 82.0, 0.3, 0.08, glide=0.05)
        case "high":
            return sweep(230.0, 140.0, 0.24, 0.06, glide=0.04)
        case "crash":
            return burst("crash", 1.4, 0.22, 2500.0, 8000.0)
    raise KeyError(name)
