"""The sounds: rendered by the project's script, played if there is a device, silent otherwise."""

import importlib.util
import math
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import numpy as np
import pygame
import pytest

from pigaming_app.ui.sounds import FOLDER, Sounds, stereo

PITCHED = [f"{name}{player}" for name in ("fire", "join", "ready") for player in (1, 2, 3, 4)]
GAME = ["hit", "wall", "crumble", "shield", "pickup", "power_end", "drop", "mine"]
MATCH = ["count", "go", "tick", "win", "fanfare", "lose", "tie"]
RACE = ["lap", "best_lap", "last_lap", "missed", "wrong_way", "mud", "finish", "back_on_track"]
RACE_PARTY = ["boost", "oil", "slipstream", "overtake", "photo_finish"]
FACTORY = ["lift", "set_down", "refused", "machine_done", "spoiled", "delivered_ice", "delivered_fire", "freeze"]
FACTORY += ["arrived", "one_to_go", "clearing", "jamming", "stolen", "rush", "expired", "fast", "star_lost"]
CONTRACT = [*PITCHED, *GAME, *MATCH, *RACE, *RACE_PARTY, *FACTORY, "move", "accept", "back", "error"]


def script() -> ModuleType:
    """The script that renders the sounds; it is not part of the package."""
    spec = importlib.util.spec_from_file_location("render", FOLDER / "render.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


RENDER = script()


@pytest.fixture
def sounds() -> Iterator[Sounds]:
    opened = Sounds()
    assert opened.wait()
    yield opened
    opened.close()


@pytest.fixture
def now(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """A clock advanced by the test."""
    clock = [1000.0]
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    return clock


def voices() -> int:
    return sum(pygame.mixer.Channel(number).get_busy() for number in range(pygame.mixer.get_num_channels()))


def test_every_sound_of_the_arcade_is_rendered() -> None:
    assert set(RENDER.SOUNDS) == set(CONTRACT)
    assert {path.stem for path in FOLDER.glob("*.ogg")} == {*CONTRACT, "music"}


@pytest.mark.parametrize("name", CONTRACT)
def test_a_sound_is_clean(name: str) -> None:
    samples = RENDER.rendered(name)
    assert 0.2 < np.abs(samples).max() <= 0.85 + 1e-9  # no clipping, with room for the encoder
    assert abs(samples.mean()) < 0.002
    assert samples[0] == samples[-1] == 0.0
    assert np.abs(samples[-200:]).max() < 0.02
    assert samples.size < (3.0 if name == "fanfare" else 1.5) * RENDER.RATE
    assert -24.0 < RENDER.loudness(samples) < -12.0
    assert (FOLDER / f"{name}.ogg").stat().st_size < 20_000


def test_a_weighting_leaves_1000_hz_unchanged() -> None:
    """A-weighting leaves 1 kHz alone (IEC 61672-1): a full-scale sine has half the power, -3.01 dB."""
    tone = np.sin(2.0 * np.pi * 1000.0 * np.arange(RENDER.RATE) / RENDER.RATE)
    assert RENDER.loudness(tone) == pytest.approx(10.0 * math.log10(0.5), abs=0.05)


def test_the_same_script_gives_the_same_samples() -> None:
    for name in ("crumble", "hit", "fire3"):
        assert np.array_equal(RENDER.rendered(name), script().rendered(name))


@pytest.mark.parametrize("name", ["fire1", "crumble", "win"])
def test_the_files_hold_what_the_script_renders(sounds: Sounds, name: str) -> None:
    heard = pygame.sndarray.array(pygame.mixer.Sound(str(FOLDER / f"{name}.ogg")))[:, 0].astype(float)
    made = RENDER.rendered(name)
    assert abs(heard.size - made.size) < 64
    size = min(heard.size, made.size)
    assert np.corrcoef(heard[:size], made[:size])[0, 1] > 0.97


def test_each_player_has_a_pitch() -> None:
    hertz = [RENDER.pitch(note) for note in RENDER.PLAYERS]
    assert RENDER.pitch("A4") == 440.0
    assert RENDER.pitch("A3") == 220.0
    assert all(high / low > 2 ** (2.5 / 12) for low, high in pairwise(hertz))


def test_the_music_runs_into_itself() -> None:
    loop = RENDER.rendered("music")
    assert loop.size == round(28.8 * RENDER.RATE)
    assert np.abs(loop).max() <= 0.85
    steps = np.abs(np.diff(loop))
    assert abs(loop[0] - loop[-1]) <= np.quantile(steps, 0.999)  # no click at the seam
    assert (FOLDER / "music.ogg").stat().st_size < 250_000


def test_each_player_sounds_in_its_own_pitch(sounds: Sounds) -> None:
    sounds.play("join", player=2)
    sounds.play("join")
    playing = [pygame.mixer.Channel(number).get_sound() for number in (0, 1)]
    for sound, name in zip(playing, ("join3", "join1"), strict=True):
        assert sound is not None
        assert sound.get_raw() == pygame.mixer.Sound(str(FOLDER / f"{name}.ogg")).get_raw()


@pytest.mark.parametrize(("pan", "sides"), [(0.0, (1.0, 1.0)), (1.0, (0.3, 1.0)), (-9.0, (1.0, 0.3))])
def test_sounds_are_panned_to_the_robot(pan: float, sides: tuple[float, float]) -> None:
    assert stereo(pan) == pytest.approx(sides)


def test_a_burst_of_the_same_sound_starts_once(sounds: Sounds, now: list[float]) -> None:
    for _ in range(10):
        sounds.play("hit")
    assert voices() == 1
    sounds.play("fire", player=0)
    sounds.play("fire", player=1)
    assert voices() == 3
    now[0] += 0.06
    sounds.play("hit")
    assert voices() == 4


def test_four_players_who_mash_buttons_never_run_out_of_voices(sounds: Sounds, now: list[float]) -> None:
    for _ in range(40):
        now[0] += 0.06
        for player in range(4):
            sounds.play("ready", player)
    assert voices() <= pygame.mixer.get_num_channels()


def test_music_requested_before_the_device_opens_plays() -> None:
    sounds = Sounds()
    sounds.music(True)
    sounds.volume(10, 5)
    assert sounds.wait()
    assert pygame.mixer.music.get_busy()
    assert pygame.mixer.music.get_volume() == pytest.approx(1.0, abs=0.01)
    sounds.volume(5, 5)
    assert pygame.mixer.music.get_volume() == pytest.approx(0.25, abs=0.01)
    sounds.music(False)
    sounds.close()
    sounds.play("hit")
    sounds.music(True)


def test_unknown_sounds_are_silence(sounds: Sounds) -> None:
    sounds.play("unheard_of", player=3)
    assert voices() == 0


def test_without_a_device_there_is_silence_and_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame.mixer.quit()
    monkeypatch.setenv("SDL_AUDIODRIVER", "nonsense")
    sounds = Sounds()
    sounds.open()
    sounds.play("fire", player=0)
    sounds.music(True)
    assert not sounds.wait()
    assert sounds.trouble.startswith("There is no sound: ")
    sounds.play("hit", pan=-5.0)
    sounds.volume(0, 10)
    sounds.music(False)
    sounds.close()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks Linux")
def test_a_computer_without_a_sound_card_is_not_probed(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("SDL_AUDIODRIVER", "AUDIODEV", "PULSE_SERVER"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "exists", lambda path: False)
    sounds = Sounds()
    assert not sounds.wait()
    assert sounds.trouble == "There is no sound: no sound device was found."


def test_a_folder_without_files_and_a_file_without_sound_are_silence(tmp_path: Path) -> None:
    (tmp_path / "hit.ogg").write_bytes(b"this is not a sound")
    sounds = Sounds(tmp_path)
    assert sounds.wait()
    sounds.play("hit")
    sounds.music(True)
    assert voices() == 0
    sounds.close()
