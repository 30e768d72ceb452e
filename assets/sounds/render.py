"""Renders every sound of the arcade: `python assets/sounds/render.py` writes the OGG files beside this file.

Everything is computed from a few plucks, sweeps and bursts of noise; the same script always gives the same samples.
`SOUNDS` lists what there is. Needs numpy, and soundfile (the extra `sounds`) to write the files.
"""

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from zlib import crc32

import numpy as np
import numpy.typing as npt

Samples = npt.NDArray[np.float64]  # mono, in [-1, 1]
Notes = list[tuple[float, Samples]]  # when each one starts (s)

RATE = 44100  # samples in a second
PLAYERS = ("E4", "G4", "B4", "D5")  # each player's own pitch: together they are the chord of the music
BEAT = 0.6  # seconds: 100 beats a minute
BARS = 12  # of four beats: 28.8 s of music


def pitch(note: str) -> float:
    """The frequency (Hz) of a note such as A4 (440), F#3 or Bb2."""
    steps = {"C": 0, "D": 2, "E": 4, "F": 5, "G": 7, "A": 9, "B": 11}[note[0]]
    steps += note.count("#") - note.count("b")
    return float(440.0 * 2.0 ** ((steps + 12 * int(note[-1]) - 57) / 12.0))


# Voices: each gives samples from a start to silence.


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


# The sounds of the game.


def fire(player: int) -> Samples:
    hz = pitch(PLAYERS[player]) / 2.0
    return together(
        [
            (0.0, sweep(4.0 * hz, hz, 0.16, 0.03, glide=0.012)),
            (0.0, 0.5 * pluck(2.0 * hz, 0.16, 0.03)),
            (0.0, 0.35 * burst(f"fire{player}", 0.05, 0.008, 800.0, 6000.0)),
        ]
    )


def hit() -> Samples:
    boom = sweep(190.0, 58.0, 0.32, 0.06, glide=0.04)
    return np.tanh(1.6 * together([(0.0, boom), (0.0, 0.9 * burst("hit", 0.28, 0.035, 250.0, 3200.0))]))


def wall() -> Samples:
    return together(
        [
            (0.0, 0.8 * burst("wall", 0.06, 0.007, 1200.0, 5500.0)),
            (0.0, 0.6 * pluck(pitch("A5"), 0.1, 0.014, 0.7)),
            (0.018, 0.3 * burst("grit", 0.05, 0.006, 2500.0, 7000.0)),
        ]
    )


def crumble() -> Samples:
    """Breaking glass: a crack, then splinters that ring at odd pitches, ever rarer and weaker."""
    chance = np.random.default_rng(crc32(b"splinters"))
    when = np.sort(chance.exponential(0.13, 26).clip(0.0, 0.5))
    splinters = [
        (float(start), float(0.34 * np.exp(-3.0 * start)) * pluck(float(hz), 0.16, 0.025, 0.25))
        for start, hz in zip(when, chance.uniform(1900.0, 5200.0, when.size), strict=True)
    ]
    crack = burst("crack", 0.2, 0.02, 700.0, 5500.0)
    return together([(0.0, crack), (0.0, 0.5 * sweep(420.0, 130.0, 0.14, 0.03)), *splinters])


def mine() -> Samples:
    boom = together([(0.0, sweep(130.0, 38.0, 0.65, 0.13, glide=0.09)), (0.0, burst("mine", 0.6, 0.07, 60.0, 1400.0))])
    return np.tanh(2.0 * boom)


def shield() -> Samples:
    return together([(0.0, 0.7 * pluck(hz, 0.35, 0.06, 0.3)) for hz in (1320.0, 1873.0, 2671.0)])


def mud() -> Samples:
    return together(
        [(0.0, burst("mud", 0.22, 0.05, 90.0, 900.0)), (0.05, 0.6 * burst("clod", 0.16, 0.03, 140.0, 700.0))]
    )


def boost() -> Samples:
    """A rush of air that rises, over two rising plucks."""
    rush = sweep(260.0, 1150.0, 0.34, 0.14, glide=0.12)
    air = burst("boost", 0.34, 0.12, 700.0, 5200.0)
    return together([(0.0, 0.5 * rush), (0.0, 0.5 * air), (0.0, 0.7 * melody("E4 B4", 0.06))])


def oil() -> Samples:
    """A squeal that winds down, and a splash."""
    squeal = sweep(1250.0, 320.0, 0.5, 0.2, glide=0.22)
    wobble: Samples = squeal * (0.65 + 0.35 * np.sin(2.0 * np.pi * 17.0 * times(0.5)))
    return together([(0.0, 0.5 * wobble), (0.0, 0.8 * burst("oil", 0.2, 0.04, 150.0, 1500.0))])


def slipstream() -> Samples:
    """Air that swells and fades."""
    air = burst("slipstream", 0.5, 0.4, 500.0, 2600.0)
    return np.asarray(air * np.sin(np.pi * times(0.5) / 0.5) ** 2)


def back_on_track() -> Samples:
    """A shimmer that falls, and the robot's touch-down."""
    shimmer = [(0.035 * i, 0.5 * pluck(hz, 0.2, 0.04, 0.3)) for i, hz in enumerate((2637.0, 1975.5, 1318.5, 987.8))]
    return together([*shimmer, (0.15, sweep(170.0, 80.0, 0.16, 0.05))])


def photo_finish() -> Samples:
    """A shutter, then a bright chord."""
    shutter = [(start, 0.7 * burst(f"shutter{start}", 0.05, 0.008, 1500.0, 7000.0)) for start in (0.0, 0.07)]
    return together([*shutter, *((0.16, pluck(pitch(note), 0.6, 0.13, 0.5)) for note in ("E5", "G#5", "B5", "E6"))])


def finish() -> Samples:
    """A run up to a chord, shorter than that of the winner."""
    chord = [(0.24, pluck(pitch(note), 0.6, 0.14, 0.5)) for note in ("E4", "B4", "G#5")]
    return together([(0.0, melody("E4 G#4 B4", 0.08, half=0.06)), *chord])


def lift() -> Samples:
    return together([(0.0, sweep(220.0, 520.0, 0.14, 0.06, glide=0.06)), (0.1, 0.5 * pluck(pitch("E5"), 0.1, 0.02))])


def set_down() -> Samples:
    return together([(0.0, sweep(180.0, 90.0, 0.16, 0.04)), (0.0, 0.5 * burst("set_down", 0.08, 0.012, 300.0, 2500.0))])


def machine_done() -> Samples:
    return together([(0.0, pluck(pitch("B5"), 0.3, 0.08, 0.3)), (0.1, pluck(pitch("E6"), 0.35, 0.09, 0.3))])


def spoiled() -> Samples:
    crash = together([(0.0, burst("spoiled", 0.3, 0.05, 300.0, 4500.0)), (0.0, sweep(300.0, 70.0, 0.4, 0.1))])
    return together([(0.0, np.tanh(1.5 * crash)), (0.25, 0.6 * melody("C4 F#3", 0.12, half=0.08, bright=0.7))])


def delivered_ice() -> Samples:
    """Ice's jingle: bells that run up to a high, glassy chord."""
    bells = melody("E5 G#5 B5", 0.07, half=0.07, bright=0.25)
    chord = [(0.21, 0.7 * pluck(pitch(note), 0.6, 0.15, 0.2)) for note in ("E6", "G#6", "B6")]
    return together([(0.0, bells), *chord])


def delivered_fire() -> Samples:
    """Fire's jingle: two blows of a brassy horn, the second one higher and longer."""
    calls = ((0.0, 0.16, ("E4", "B4")), (0.17, 0.6, ("A3", "A4", "C#5", "E5")))
    return together(
        [(start, pluck(pitch(note), seconds, 0.16, 0.8)) for start, seconds, notes in calls for note in notes]
    )


def one_to_go() -> Samples:
    """A rising call that is held: something is about to happen."""
    return together([(0.0, melody("B4 E5 B4 E5", 0.08, half=0.06)), (0.32, melody("G#5 B5", 0.1, last=0.6, half=0.16))])


def warning(last: bool) -> Samples:
    """Two knocks on metal; the `last` ones are higher."""
    hz = pitch("G#5" if last else "E5")
    return together([(start, pluck(factor * hz, 0.1, 0.02, 0.7)) for start in (0.0, 0.07) for factor in (1.0, 1.52)])


def stolen() -> Samples:
    """A swoop down, and a cheeky answer."""
    return together([(0.0, sweep(1100.0, 240.0, 0.25, 0.12, glide=0.09)), (0.17, melody("F4 E4 D#5", 0.09, last=0.3))])


def freeze() -> Samples:
    return together(
        [(0.05 * i, 0.8 * pluck(hz, 0.4, 0.07, 0.2)) for i, hz in enumerate((2671.0, 1873.0, 1320.0, 660.0))]
    )


def join(player: int) -> Samples:
    hz = pitch(PLAYERS[player])
    return together([(0.0, pluck(hz, 0.25)), (0.07, pluck(2.0 * hz, 0.3, 0.06))])


def ready(player: int) -> Samples:
    hz = pitch(PLAYERS[player])
    return together([(0.06 * i, pluck(factor * hz, 0.36, 0.08)) for i, factor in enumerate((1.0, 1.5, 2.0))])


def go() -> Samples:
    return together([(0.0, pluck(pitch(note), 0.5, 0.11)) for note in ("E5", "B5", "E6")])


def win() -> Samples:
    """A short fanfare that ends on a broad chord."""
    run = melody("E4 G4 B4 E5 B4", 0.11, half=0.09, bright=0.6)
    chord = [(0.6, pluck(pitch(note), 0.8, 0.17, 0.6)) for note in ("E3", "E4", "B4", "E5", "G#5")]
    return together([(0.0, 1.3 * run), *chord])


def fanfare() -> Samples:
    """The winner's moment: a run up to a chord as the robot arrives, an answer, and a broad final chord."""
    run = melody("E4 G#4 B4 E5", 0.12, half=0.09, bright=0.6)
    chords = ((0.5, "E3 B4 E5 G#5", 0.6), (1.0, "A3 A4 C#5 E5", 0.35), (1.25, "B3 B4 D#5 F#5", 0.35))
    struck = [(start, pluck(pitch(note), ring, 0.13, 0.6)) for start, notes, ring in chords for note in notes.split()]
    last = [(1.5, pluck(pitch(note), 1.2, 0.26, 0.6)) for note in ["E2", "E3", "B3", "E4", "G#4", "B4", "E5", "G#5"]]
    return together([(0.0, 1.3 * run), *struck, *last])


def error() -> Samples:
    return together([(start, pluck(pitch("A3"), 0.13, 0.08, 0.8)) for start in (0.0, 0.14)])


# The music: a quiet groove in E minor, twelve bars that run into each other.

CHORDS = ("E3 G3 B3 D4", "C3 G3 B3 E4", "A2 G3 C4 E4", "B2 F#3 A3 D4") * 2 + (
    "C3 E3 G3 B3",
    "D3 F#3 A3 E4",
    "E3 G3 B3 F#4",
    "E3 G3 B3 D4",
)
BASS = ((0.0, 1.0), (0.75, 1.0), (1.5, 1.5), (2.5, 1.0), (3.25, 2.0))  # (beat, times the root's frequency)
LEAD = ((0.5, 2), (1.25, 3), (2.0, 1), (2.75, 3), (3.5, 2))  # (beat, note of the chord)


def music() -> Samples:
    """The loop: what rings on beyond its end sounds at its beginning."""
    mixed = np.zeros(round(BARS * 4 * BEAT * RATE))
    for start, sound in (note for bar in range(BARS) for note in music_bar(bar)):
        place = (round(start * RATE) + np.arange(sound.size)) % mixed.size
        np.add.at(mixed, place, sound)
    return mixed


def music_bar(bar: int) -> Notes:
    """The notes of one bar: chord, bass and drums always, the lead in two bars of four."""
    start, chord = bar * 4.0 * BEAT, [pitch(note) for note in CHORDS[bar].split()]
    root = chord[0] / 2.0
    notes = [(start, 0.09 * pad(hz)) for hz in chord[1:]]
    notes += [(start + beat * BEAT, 0.34 * pluck(times_root * root, 0.4, 0.11, 0.5)) for beat, times_root in BASS]
    notes += [(start + beat * BEAT, 0.36 * sweep(120.0, 46.0, 0.2, 0.05, glide=0.025)) for beat in (0.0, 1.5, 2.0)]
    notes += [(start + beat * BEAT, 0.1 * burst("snare", 0.14, 0.025, 900.0, 4500.0)) for beat in (1.0, 3.0)]
    notes += [
        (start + half * BEAT / 2.0, (0.045 if half % 2 else 0.025) * burst("hat", 0.05, 0.009, 5000.0, 9000.0))
        for half in range(8)
    ]
    if bar % 4 in (1, 2) or bar >= 8:
        notes += [(start + beat * BEAT, 0.17 * pluck(2.0 * chord[note], 0.5, 0.09, 0.4)) for beat, note in LEAD]
    return notes


def pad(hz: float) -> Samples:
    """A soft chord tone of one bar: two strings slightly apart that swell and fade."""
    seconds = 4.0 * BEAT + 0.4
    t = times(seconds)
    tone = sum(np.sin(2.0 * np.pi * n * hz * detune * t) / n**2 for n in (1, 2, 3) for detune in (0.998, 1.002))
    return np.asarray(tone * np.sin(np.pi * t / seconds) ** 0.7)


def loudness(samples: Samples) -> float:
    """How loud the loudest 50 ms are to the ear: decibels below full scale, A-weighted (IEC 61672-1)."""
    padded = np.pad(samples, RATE // 10)
    f2 = np.fft.rfftfreq(padded.size, 1.0 / RATE) ** 2
    ear = f2**2 / ((f2 + 20.6**2) * np.sqrt((f2 + 107.7**2) * (f2 + 737.9**2)) * (f2 + 12194.0**2))
    heard = np.fft.irfft(np.fft.rfft(padded) * ear * 12194.0**2 * 1.2589, padded.size)
    window = RATE // 20
    power = np.diff(np.cumsum(heard**2)[::window]) / window
    return float(10.0 * np.log10(power.max()))


def as_loud_as(samples: Samples, decibels: float) -> Samples:
    """Made that loud, or as loud as it can be without clipping."""
    gain = float(10.0 ** ((decibels - loudness(samples)) / 20.0))
    return samples * min(gain, 0.85 / float(np.abs(samples).max()))


def finished(samples: Samples) -> Samples:
    """Without any direct current, faded in and out."""
    samples = samples - float(samples.mean())
    fade_in, fade_out = round(0.0015 * RATE), round(0.012 * RATE)
    samples[:fade_in] *= np.linspace(0.0, 1.0, fade_in)
    samples[-fade_out:] *= np.linspace(1.0, 0.0, fade_out)
    return samples


MUSIC_LOUDNESS = -22.0
SOUNDS: dict[str, tuple[Callable[[], Samples], float]] = {  # how it is made, and its loudness
    **{f"fire{player + 1}": (partial(fire, player), -21.0) for player in range(4)},
    **{f"join{player + 1}": (partial(join, player), -15.0) for player in range(4)},
    **{f"ready{player + 1}": (partial(ready, player), -15.0) for player in range(4)},
    "hit": (hit, -15.0),
    "wall": (wall, -23.0),
    "crumble": (crumble, -17.0),
    "shield": (shield, -18.0),
    "pickup": (lambda: melody("E5 B5 E6", 0.06), -15.0),
    "power_end": (lambda: melody("B4 E4", 0.09, bright=0.3), -18.0),
    "drop": (lambda: melody("B3 B3", 0.07, last=0.12, half=0.02), -19.0),
    "mine": (mine, -14.0),
    "count": (lambda: pluck(pitch("E5"), 0.2, 0.05, 0.3), -15.0),
    "go": (go, -13.0),
    "tick": (lambda: pluck(pitch("B5"), 0.07, 0.012, 0.6), -18.0),
    "win": (win, -14.0),
    "fanfare": (fanfare, -14.0),
    "tie": (lambda: melody("B4 B4 A4", 0.16, last=0.6, half=0.14), -15.0),
    "lose": (lambda: melody("B4 G4 F#4 E4", 0.15, last=0.6, half=0.12), -15.0),
    "lap": (lambda: melody("B4 E5", 0.08), -17.0),
    "best_lap": (lambda: melody("E5 G#5 B5 E6", 0.06), -15.0),
    "last_lap": (lambda: melody("E5 E5 E5 B5", 0.09), -15.0),
    "missed": (lambda: melody("F4 C4", 0.12, half=0.09, bright=0.8), -17.0),
    "wrong_way": (lambda: melody("A4 A4 A4", 0.1, last=0.14, half=0.05, bright=0.8), -18.0),
    "mud": (mud, -21.0),
    "boost": (boost, -18.0),
    "oil": (oil, -17.0),
    "slipstream": (slipstream, -23.5),
    "overtake": (lambda: melody("G4 B4 E5", 0.05), -18.0),
    "back_on_track": (back_on_track, -17.0),
    "photo_finish": (photo_finish, -14.0),
    "finish": (finish, -15.0),
    "lift": (lift, -20.0),
    "set_down": (set_down, -20.0),
    "refused": (lambda: melody("A3 A3", 0.08, last=0.1, half=0.03, bright=0.8), -21.0),
    "machine_done": (machine_done, -19.0),
    "spoiled": (spoiled, -16.0),
    "delivered_ice": (delivered_ice, -15.0),
    "delivered_fire": (delivered_fire, -15.0),
    "one_to_go": (one_to_go, -15.0),
    "clearing": (partial(warning, False), -19.0),
    "jamming": (partial(warning, True), -21.0),
    "stolen": (stolen, -16.0),
    "rush": (lambda: melody("B5 B5 E6 B5 B5 E6", 0.06, bright=0.3), -16.0),
    "expired": (lambda: melody("E4 C4 A3", 0.12, bright=0.7), -18.0),
    "fast": (
        lambda: together([(0.0, sweep(180.0, 720.0, 0.45, 0.25, glide=0.2)), (0.3, pluck(pitch("E6"), 0.3, 0.07))]),
        -17.0,
    ),
    "star_lost": (lambda: melody("E5 C5 A4", 0.11, last=0.5, half=0.12, bright=0.3), -16.0),
    "freeze": (freeze, -17.0),
    "arrived": (lambda: melody("E4 G4", 0.09, bright=0.3), -20.0),
    "move": (lambda: pluck(pitch("E5"), 0.06, 0.012, 0.3), -23.0),
    "accept": (lambda: melody("B4 E5", 0.07), -18.0),
    "back": (lambda: melody("E5 B4", 0.07), -19.0),
    "error": (error, -19.0),
}


def rendered(name: str) -> Samples:
    """The samples of a sound by its name, or of the `music`."""
    if name == "music":
        loop = music()
        return as_loud_as(loop - float(loop.mean()), MUSIC_LOUDNESS)  # no fades: its end runs into its beginning
    make, decibels = SOUNDS[name]
    return as_loud_as(finished(make()), decibels)


def write(folder: Path) -> None:
    """Write every sound and the music as OGG files."""
    import soundfile

    for name in (*SOUNDS, "music"):
        samples = rendered(name).astype(np.float32)
        with soundfile.SoundFile(folder / f"{name}.ogg", "w", RATE, 1, "VORBIS", compression_level=0.7) as file:
            for block in np.array_split(samples, samples.size // RATE + 1):  # long blocks overflow libsndfile's stack
                file.write(block)


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
