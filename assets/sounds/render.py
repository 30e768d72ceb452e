"""Renders all sounds: `python -m assets.sounds.render` writes the effects, and the theme of each score, as OGG files.

`python -m assets.sounds.render path/to/theme_NAME.toml …` renders only the themes of these scores, beside them.
Everything is computed from the voices in `synth.py`; the same script always gives the same samples. A sound is as loud
as its group. Needs numpy, and soundfile (the extra `sounds`) to write the files.
"""

import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from assets.sounds import effects, score
from assets.sounds.loudness import loudness
from assets.sounds.synth import RATE, Samples, melody, pitch, pluck, sweep, together

FOLDER = Path(__file__).parent
SCORES = (FOLDER, FOLDER.parents[1] / "pigaming_football" / "sounds")  # folders with scores
PEAK = 0.85  # at most, which leaves room for the encoder

GROUPS = {  # LUFS
    "theme": -28.0,
    "finale": -31.0,  # what it adds to the theme
    "sting": -24.0,  # the end of a match, alone
    "call": -26.5,  # what everybody has to notice
    "blow": -27.5,  # what hits a robot or speeds it up
    "small": -32.5,  # what is heard all the time
    "menu": -29.0,
}
CROWD = 0.19  # the peak of a sound, of which four players make many at once, unless it would be
QUIETER = 2.2  # LU quieter than its group for it
Effect = Callable[[], Samples]
SOUNDS: dict[str, dict[str, Effect]] = {  # by group
    "sting": {
        "win": effects.win,
        "fanfare": effects.fanfare,
        "tie": lambda: melody("B4 B4 A4", 0.16, last=0.6, half=0.14),
        "lose": lambda: melody("B4 G4 F#4 E4", 0.15, last=0.6, half=0.12),
        "photo_finish": effects.photo_finish,
        "finish": effects.finish,
    },
    "call": {
        **{f"join{player + 1}": partial(effects.join, player) for player in range(4)},
        **{f"ready{player + 1}": partial(effects.ready, player) for player in range(4)},
        "count": lambda: pluck(pitch("E5"), 0.2, 0.05, 0.3),
        "go": effects.go,
        "pickup": lambda: melody("E5 B5 E6", 0.06),
        "lap": lambda: melody("B4 E5", 0.08),
        "best_lap": lambda: melody("E5 G#5 B5 E6", 0.06),
        "last_lap": lambda: melody("E5 E5 E5 B5", 0.09),
        "missed": lambda: melody("F4 C4", 0.12, half=0.09, bright=0.8),
        "wrong_way": lambda: melody("A4 A4 A4", 0.1, last=0.14, half=0.05, bright=0.8),
        "overtake": lambda: melody("G4 B4 E5", 0.05),
        "back_on_track": effects.back_on_track,
        "delivered_ice": effects.delivered_ice,
        "delivered_fire": effects.delivered_fire,
        "one_to_go": effects.one_to_go,
        "stolen": effects.stolen,
        "rush": lambda: melody("B5 B5 E6 B5 B5 E6", 0.06, bright=0.3),
        "expired": lambda: melody("E4 C4 A3", 0.12, bright=0.7),
        "fast": lambda: together([(0.0, sweep(180.0, 720.0, 0.45, 0.25, glide=0.2)), (0.3, pluck(1318.5, 0.3, 0.07))]),
        "star_lost": lambda: melody("E5 C5 A4", 0.11, last=0.5, half=0.12, bright=0.3),
    },
    "blow": {
        "hit": effects.hit,
        "mine": effects.mine,
        "crumble": effects.crumble,
        "spoiled": effects.spoiled,
        "freeze": effects.freeze,
        "shield": effects.shield,
        "boost": effects.boost,
        "oil": effects.oil,
    },
    "small": {
        **{f"fire{player + 1}": partial(effects.fire, player) for player in range(4)},
        "wall": effects.wall,
        "tick": lambda: pluck(pitch("B5"), 0.07, 0.012, 0.6),
        "power_end": lambda: melody("B4 E4", 0.09, bright=0.3),
        "drop": lambda: melody("B3 B3", 0.07, last=0.12, half=0.02),
        "mud": effects.mud,
        "slipstream": effects.slipstream,
        "lift": effects.lift,
        "set_down": effects.set_down,
        "refused": lambda: melody("A3 A3", 0.08, last=0.1, half=0.03, bright=0.8),
        "machine_done": effects.machine_done,
        "clearing": partial(effects.warning, False),
        "jamming": partial(effects.warning, True),
        "arrived": lambda: melody("E4 G4", 0.09, bright=0.3),
        "move": lambda: pluck(pitch("E5"), 0.06, 0.012, 0.3),
    },
    "menu": {
        "accept": lambda: melody("B4 E5", 0.07),
        "back": lambda: melody("E5 B4", 0.07),
        "error": effects.error,
    },
}


def effect(name: str) -> Samples:
    """The samples of an effect, as loud as its group."""
    group = next(group for group, sounds in SOUNDS.items() if name in sounds)
    sound = as_loud_as(finished(SOUNDS[group][name]()), GROUPS[group])
    return sound if group == "sting" else sound * max(10.0 ** (-QUIETER / 20.0), min(1.0, CROWD / np.abs(sound).max()))


def theme(path: Path) -> dict[str, Samples]:
    """The theme of a score, and its finale if it has one: loops of one length, without fades."""
    written = score.read(path)
    groups = ["theme", "finale"] if any(part.finale for part in written.parts) else ["theme"]
    loops = {group: written.loop(group == "finale") for group in groups}
    loops = {group: loop - loop.mean(axis=0) for group, loop in loops.items()}
    return {group: as_loud_as(loop, GROUPS[group]) for group, loop in loops.items()}


def as_loud_as(samples: Samples, lufs: float) -> Samples:
    """Made that loud. Raises ValueError if it would clip."""
    louder = samples * 10.0 ** ((lufs - loudness(samples)) / 20.0)
    if np.abs(louder).max() > PEAK:
        raise ValueError(f"{lufs} LUFS need a peak of {np.abs(louder).max():.2f}")
    return np.asarray(louder)


def finished(samples: Samples) -> Samples:
    """Without any direct current, faded in and out."""
    samples = samples - float(samples.mean())
    fade_in, fade_out = round(0.0015 * RATE), round(0.012 * RATE)
    samples[:fade_in] *= np.linspace(0.0, 1.0, fade_in)
    samples[-fade_out:] *= np.linspace(1.0, 0.0, fade_out)
    return samples


def rendered(scores: list[Path]) -> Iterator[tuple[Path, Samples, float]]:
    """Each file to write, its samples, and how far the encoder may simplify them, 0 to 1."""
    for path in scores:
        for group, loop in theme(path).items():
            yield path.with_name(f"{group}_{path.stem.removeprefix('theme_')}.ogg"), loop, 1.0


def write(path: Path, samples: Samples, simpler: float) -> None:
    """Write an OGG file."""
    import soundfile

    sides = 1 if samples.ndim == 1 else samples.shape[1]
    with soundfile.SoundFile(path, "w", RATE, sides, "VORBIS", compression_level=simpler) as file:
        for block in np.array_split(samples.astype(np.float32), len(samples) // RATE + 1):  # its stack is small
            file.write(block)


def main(scores: list[Path]) -> None:
    """Write the themes of these scores; without any, everything."""
    for sound in rendered(scores or [path for folder in SCORES for path in sorted(folder.glob("theme_*.toml"))]):
        write(*sound)
    if not scores:
        for name in (name for sounds in SOUNDS.values() for name in sounds):
            write(FOLDER / f"{name}.ogg", effect(name), 0.7)


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])
