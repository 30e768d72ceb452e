"""Themes: a score, a file of text, becomes a loop of music, and the finale that joins it for the end of a match.

tempo = 126                    quarter notes in a minute; a bar has four
chords = ["E3 G3 B3", ...]     one for each bar; their number is the length of the theme

[[part]]
voice = "lead"                 of `synth.VOICES`, or a drum
level = 0.2                    amplitude
notes = "E4 - G4 . | ..."      bars of equal steps: a note, "-" holds the last one, "." rests, "E4+G4" sounds both;
                               1 to 4 are tones of the bar's chord, 1' an octave above, 1, one below.
                               Drums: "x..o", a stroke, a soft one. Fewer bars than the theme has are repeated
bars = "....xxxx"              where the part plays; repeated likewise. Default: everywhere
pan = 0.3                      from -1 (left) to 1 (right); default 0
room = 0.2                     share of reverberation; default 0
finale = true                  it belongs to the finale; default false
"""

import re
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from assets.sounds.synth import RATE, VOICES, Samples, burst, drum, pitch

SOFT = 0.4  # amplitude of a soft stroke of a drum
DEGREE = re.compile(r"([1-4])([',]*)")
REVERBERATION, HALF = 1.1, 0.14  # s, length and time to a half


@dataclass(frozen=True)
class Part:
    """One instrument."""

    voice: str
    level: float
    notes: str
    bars: str = "x"
    pan: float = 0.0
    room: float = 0.0
    finale: bool = False

    @cached_property
    def written(self) -> list[list[str]]:
        """The steps of each written bar."""
        return [list(bar) if self.is_drum else bar.split() for bar in re.sub(r"\s+", " ", self.notes).split("|")]

    @property
    def is_drum(self) -> bool:
        return self.voice not in VOICES

    def steps(self, bars: int) -> Iterator[tuple[float, float, str]]:
        """What sounds, in bars: when, for how long, and what."""
        plays = re.sub(r"\s", "", self.bars)
        sounding: tuple[float, float, str] | None = None
        for bar in range(bars):
            steps = [s for s in self.written[bar % len(self.written)] if s != " "]
            for i, step in enumerate(steps):
                if step == "-":
                    sounding = sounding and (sounding[0], sounding[1] + 1 / len(steps), sounding[2])
                    continue
                if sounding:
                    yield sounding
                sounding = (bar + i / len(steps), 1 / len(steps), step) if step != "." else None
                if plays[bar % len(plays)] == ".":
                    sounding = None
        if sounding:
            yield sounding


@dataclass(frozen=True)
class Score:
    """A theme as it is written."""

    tempo: float
    chords: Sequence[Sequence[float]]  # Hz, of each bar
    parts: Sequence[Part]

    @property
    def bar(self) -> float:
        """Seconds."""
        return 240.0 / self.tempo

    @property
    def size(self) -> int:
        """Samples of the loop."""
        return round(len(self.chords) * self.bar * RATE)

    def loop(self, finale: bool) -> Samples:
        """The theme, or its finale, as samples x 2: what rings on beyond the end sounds at the beginning."""
        dry, room = np.zeros((2, self.size)), np.zeros(self.size)
        for part in self.parts:
            if part.finale == finale:
                line = self.line(part)
                room += part.room * line
                for side, gain in zip(dry, (1.0 - part.pan, 1.0 + part.pan), strict=True):
                    side += min(1.0, gain) * line
        wet = [reverberated(room, side) for side in ("left", "right")] if room.any() else 0.0
        return np.asarray((dry + wet).T)

    def line(self, part: Part) -> Samples:
        """One part alone."""
        mixed = np.zeros(self.size)
        for start, length, step in part.steps(len(self.chords)):
            sound = self.stroke(part.voice, step) if part.is_drum else self.sound(part.voice, start, length, step)
            add_round(mixed, round(start * self.bar * RATE), part.level * sound)
        return mixed

    def stroke(self, name: str, step: str) -> Samples:
        return drum(name) * (1.0 if step == "x" else SOFT)

    def sound(self, voice: str, start: float, length: float, step: str) -> Samples:
        return sum(played(voice, self.hz(name, int(start + 1e-9)), length * self.bar) for name in step.split("+"))  # type: ignore[return-value]

    def hz(self, name: str, bar: int) -> float:
        """The frequency of a note or of a tone of the bar's chord."""
        if degree := DEGREE.fullmatch(name):
            octaves = degree[2].count("'") - degree[2].count(",")
            return self.chords[bar][int(degree[1]) - 1] * 2.0**octaves
        return pitch(name)


def read(path: Path) -> Score:
    """The score in a file."""
    written = tomllib.loads(path.read_text(encoding="utf-8"))
    chords = [[pitch(note) for note in chord.split()] for chord in written["chords"]]
    return Score(written["tempo"], chords, [Part(**part) for part in written["part"]])


@cache
def played(voice: str, hz: float, seconds: float) -> Samples:
    return VOICES[voice](hz, seconds)


def add_round(mixed: Samples, first: int, sound: Samples) -> None:
    """Add a sound to a loop from a sample on, beyond its end at its beginning."""
    for start in range(0, sound.size, mixed.size):
        piece = sound[start : start + mixed.size]
        at = (first + start) % mixed.size
        before = min(piece.size, mixed.size - at)
        mixed[at : at + before] += piece[:before]
        mixed[: piece.size - before] += piece[before:]


def reverberated(loop: Samples, side: str) -> Samples:
    """The answer of a room to a loop; each side of the room answers differently."""
    answer = burst(f"room {side}", REVERBERATION, HALF, 250.0, 4000.0)
    answer /= float(np.sqrt((answer**2).sum()))
    size = 1 << (loop.size + answer.size - 1).bit_length()
    wet = np.fft.irfft(np.fft.rfft(loop, size) * np.fft.rfft(answer, size), size)[: loop.size + answer.size]
    out = np.zeros_like(loop)
    add_round(out, 0, wet)
    return out
