"""The effects: what is heard of the robots, the matches and the menus."""

from zlib import crc32

import numpy as np

from assets.sounds.synth import Samples, brass, burst, drum, melody, pitch, pluck, sweep, times, together

PLAYERS = ("E4", "G4", "B4", "D5")  # each player's own pitch: together they are a chord of the music


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
    """The winner's sting: a run of horns up to a chord as the robot arrives, an answer, and a broad final chord."""
    run = [(0.12 * i, 1.1 * brass(pitch(note), 0.1)) for i, note in enumerate(("E4", "G#4", "B4", "E5"))]
    chords = ((0.5, "B3 E4 G#4 B4 E5", 0.4), (1.0, "A3 E4 A4 C#5 E5", 0.18), (1.25, "B3 F#4 B4 D#5 F#5", 0.18))
    blown = [(at, 0.55 * brass(pitch(note), held)) for at, notes, held in chords for note in notes.split()]
    last = ["E3", "B3", "E4", "G#4", "B4", "E5", "G#5"]
    final = [(1.5, 0.55 * brass(pitch(note), 0.75)) for note in last]
    final += [(1.5, 0.5 * pluck(pitch(note), 1.3, 0.26, 0.6)) for note in ["E2", *last]]
    roll = [(0.06 * i, (0.15 + 0.05 * i) * drum("snare")) for i in range(8)]
    beats = [(at, 0.8 * drum("kick")) for at in (0.5, 1.0, 1.25, 1.5)]
    return together([*run, *blown, *final, *roll, *beats, (0.5, 0.3 * drum("crash")), (1.5, 0.5 * drum("crash"))])


def error() -> Samples:
    return together([(start, pluck(pitch("A3"), 0.13, 0.08, 0.8)) for start in (0.0, 0.14)])
