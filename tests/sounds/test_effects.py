"""The effects: rendered by the project's script, without clicks, each as loud as the others of its group."""

from itertools import pairwise

import numpy as np
import pytest

from assets.sounds import effects, render
from assets.sounds.synth import RATE, pitch
from tests.sounds.meter import decoded, measured

PITCHED = [f"{name}{player}" for name in ("fire", "join", "ready") for player in (1, 2, 3, 4)]
GAME = ["hit", "wall", "crumble", "shield", "pickup", "power_end", "drop", "mine"]
MATCH = ["count", "go", "tick", "win", "fanfare", "lose", "tie"]
RACE = ["lap", "best_lap", "last_lap", "missed", "wrong_way", "mud", "finish", "back_on_track"]
RACE_PARTY = ["boost", "oil", "slipstream", "overtake", "photo_finish"]
FACTORY = ["lift", "set_down", "refused", "machine_done", "spoiled", "delivered_ice", "delivered_fire", "freeze"]
FACTORY += ["arrived", "one_to_go", "clearing", "jamming", "stolen", "rush", "expired", "fast", "star_lost"]
CONTRACT = [*PITCHED, *GAME, *MATCH, *RACE, *RACE_PARTY, *FACTORY, "move", "accept", "back", "error"]
GROUP = {name: group for group, sounds in render.SOUNDS.items() for name in sounds}


def test_every_sound_of_the_arcade_is_rendered() -> None:
    assert set(GROUP) == set(CONTRACT)
    assert sum(map(len, render.SOUNDS.values())) == len(GROUP), "each in one group"
    themes = {path.stem for path in render.FOLDER.glob("*.ogg") if path.stem.startswith(("theme_", "finale_"))}
    assert {path.stem for path in render.FOLDER.glob("*.ogg")} == {*CONTRACT, *themes}


@pytest.mark.parametrize("name", CONTRACT)
def test_a_sound_is_clean(name: str) -> None:
    samples = render.effect(name)
    assert 0.05 < np.abs(samples).max() <= render.PEAK
    assert abs(samples.mean()) < 0.002
    assert samples[0] == samples[-1] == 0.0
    assert np.abs(samples[-200:]).max() < 0.02
    assert samples.size < (3.0 if name == "fanfare" else 1.5) * RATE
    assert (render.FOLDER / f"{name}.ogg").stat().st_size < (30_000 if name == "fanfare" else 12_000)


@pytest.mark.parametrize("name", CONTRACT)
@pytest.mark.usefixtures("mixer")
def test_a_file_is_as_loud_as_its_group(name: str) -> None:
    """Within 3 LU, by a meter that shares no code with that of the script; mono, as it is written."""
    samples = decoded(render.FOLDER / f"{name}.ogg")
    assert np.array_equal(samples[:, 0], samples[:, 1])
    assert measured(samples[:, :1]) == pytest.approx(render.GROUPS[GROUP[name]], abs=3.0)


def test_a_sound_that_would_clip_is_refused() -> None:
    click = np.zeros(RATE)
    click[100] = 0.5
    with pytest.raises(ValueError, match="LUFS need a peak of"):
        render.as_loud_as(click, -20.0)


def test_the_same_script_gives_the_same_samples() -> None:
    for name in ("crumble", "hit", "fire3"):
        assert np.array_equal(render.effect(name), render.effect(name))


@pytest.mark.parametrize("name", CONTRACT)
@pytest.mark.usefixtures("mixer")
def test_the_files_hold_what_the_script_renders(name: str) -> None:
    heard, made = decoded(render.FOLDER / f"{name}.ogg")[:, 0], render.effect(name)
    assert abs(heard.size - made.size) < 64
    size = min(heard.size, made.size)
    assert np.corrcoef(heard[:size], made[:size])[0, 1] > 0.95
    assert np.abs(heard).max() == pytest.approx(np.abs(made).max(), rel=0.25)


def test_each_player_has_a_pitch() -> None:
    hertz = [pitch(note) for note in effects.PLAYERS]
    assert pitch("A4") == 440.0
    assert pitch("A3") == 220.0
    assert all(high / low > 2 ** (2.5 / 12) for low, high in pairwise(hertz))
