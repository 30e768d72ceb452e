"""The themes of title and games, and their finales: loops that run into themselves, of even loudness."""

import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from assets.sounds import render, score
from assets.sounds.effects import PLAYERS
from assets.sounds.score import Part, Score
from assets.sounds.synth import RATE, pitch
from pigaming_app.games.registry import games
from tests.cases import repeated
from tests.sounds.meter import Samples, decoded, measured

SCORES = {path.stem.removeprefix("theme_"): path for folder in render.SCORES for path in folder.glob("theme_*.toml")}
GAMES = sorted({*SCORES} - {"title"})
FILES = [("theme", name) for name in sorted(SCORES)] + [("finale", name) for name in GAMES]
each_file = pytest.mark.parametrize(("group", "name"), FILES, ids=[f"{group}_{name}" for group, name in FILES])


def file(group: str, name: str) -> Path:
    return SCORES[name].with_name(f"{group}_{name}.ogg")


@cache
def heard(group: str, name: str) -> Samples:
    return decoded(file(group, name))


def test_the_title_and_each_game_have_a_theme() -> None:
    assert {*SCORES} == {"title", *games()}
    assert SCORES["football"].parent.parent.name == "pigaming_football", "a plug-in has its own"


def test_each_theme_has_its_own_tempo_and_key_and_the_title_is_the_calmest() -> None:
    scores = {name: score.read(path) for name, path in SCORES.items()}
    assert len({each.tempo for each in scores.values()}) == len({each.chords[0][0] for each in scores.values()}) == 5
    assert min(scores, key=lambda name: scores[name].tempo) == "title"
    assert all(30.0 <= each.size / RATE <= 60.0 for each in scores.values())


@pytest.mark.parametrize("name", sorted(SCORES))
def test_the_players_pitches_are_notes_of_each_theme(name: str) -> None:
    written = score.read(SCORES[name])
    lead = {
        written.hz(note, int(at))
        for at, _, step in written.parts[0].steps(len(written.chords))
        for note in step.split("+")
    }
    notes = {round(12 * math.log2(hz / 440.0)) % 12 for hz in lead.union(*written.chords)}
    assert notes >= {round(12 * math.log2(pitch(note) / 440.0)) % 12 for note in PLAYERS}
    assert len(notes) <= 9, "a key, and at most two notes that lead elsewhere"


@each_file
@pytest.mark.usefixtures("mixer")
def test_a_theme_runs_into_itself(group: str, name: str) -> None:
    loop = heard(group, name)
    assert len(loop) == score.read(SCORES[name]).size, "the finale is as long as its theme, to the sample"
    steps = np.abs(np.diff(loop, axis=0))
    assert np.abs(loop[0] - loop[-1]).max() <= 0.5 * steps.max(), "no click at the seam"
    assert np.abs(loop.mean(axis=0)).max() < 0.001
    halves = loop[: len(loop) // (RATE // 2) * (RATE // 2)].reshape(-1, RATE // 2, 2)
    assert np.sqrt((halves**2).mean(axis=(1, 2))).min() > 0.01, "no half second is silent"
    assert file(group, name).stat().st_size * 8 / (len(loop) / RATE) < 64_000, "bits per second"


@each_file
@pytest.mark.usefixtures("mixer")
@pytest.mark.long
def test_a_theme_is_as_loud_as_the_others(group: str, name: str) -> None:
    assert measured(heard(group, name)) == pytest.approx(render.GROUPS[group], abs=1.0)


@pytest.mark.parametrize("name", repeated(sorted(SCORES)))
@pytest.mark.usefixtures("mixer")
@pytest.mark.long
def test_the_files_hold_what_the_script_renders(name: str) -> None:
    made = render.theme(SCORES[name])
    assert [*made] == (["theme"] if name == "title" else ["theme", "finale"])
    for group, samples in made.items():
        assert np.corrcoef(heard(group, name).ravel(), samples.ravel())[0, 1] > 0.96


# ---- the notation


def steps(notes: str, bars: int = 1, voice: str = "lead", plays: str = "x") -> list[tuple[float, float, str]]:
    return list(Part(voice, 1.0, notes, plays).steps(bars))


def test_a_bar_is_parted_by_its_steps() -> None:
    assert steps("C4 . E4 -") == [(0.0, 0.25, "C4"), (0.5, 0.5, "E4")]
    assert steps("C4 E4 | G4") == [(0.0, 0.5, "C4"), (0.5, 0.5, "E4")]
    assert steps("C4 E4 | G4", bars=3) == [*steps("C4 E4"), (1.0, 1.0, "G4"), (2.0, 0.5, "C4"), (2.5, 0.5, "E4")]


def test_a_note_is_held_over_the_bar() -> None:
    assert steps("C4 - | - .", bars=2) == [(0.0, 1.5, "C4")]


def test_a_part_plays_in_its_bars() -> None:
    assert steps("x.", bars=4, voice="kick", plays=".x") == [(1.0, 0.5, "x"), (3.0, 0.5, "x")]


def test_a_tone_of_the_chord_has_its_octave() -> None:
    chord = [pitch(note) for note in ("C3", "E3", "G3", "B3")]
    theme = Score(120.0, [chord], [])
    assert [theme.hz(name, 0) for name in ("1", "3'", "2,", "A4")] == [chord[0], 2 * chord[2], chord[1] / 2, 440.0]


def test_a_score_from_elsewhere_is_rendered_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "theme_tag.toml"
    part = 'voice = "{}"\nlevel = 0.2\nnotes = "{}"\nfinale = {}'
    parts = part.format("bell", "1 4", "false"), part.format("hat", "x.", "true")
    path.write_text("\n[[part]]\n".join(('tempo = 240\nchords = ["C3 E3 G3 C4"]', *parts)))
    theme, finale = render.rendered([path])
    assert [theme[0].name, finale[0].name] == ["theme_tag.ogg", "finale_tag.ogg"]
    assert theme[0].parent == finale[0].parent == tmp_path
    assert theme[1].shape == finale[1].shape == (RATE, 2), "one bar of four quarter notes"


def test_what_rings_on_beyond_the_end_sounds_at_the_beginning() -> None:
    mixed = np.zeros(5)
    score.add_round(mixed, 3, np.arange(1.0, 8.0))
    assert mixed.tolist() == [3.0, 4.0, 5.0, 1.0 + 6.0, 2.0 + 7.0]
