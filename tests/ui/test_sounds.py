"""Sounds are played if there is a device; the arcade is silent otherwise."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest

from pigaming_app.ui.music import CHANNELS
from pigaming_app.ui.sounds import FOLDER, Sounds, stereo


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


def test_each_player_sounds_in_its_own_pitch(sounds: Sounds) -> None:
    sounds.play("join", player=2)
    sounds.play("join")
    playing = [pygame.mixer.Channel(CHANNELS + number).get_sound() for number in (0, 1)]
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


def test_unknown_sounds_are_silence(sounds: Sounds) -> None:
    sounds.play("unheard_of", player=3)
    assert voices() == 0


def test_without_a_device_there_is_silence_and_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame.mixer.quit()
    monkeypatch.setenv("SDL_AUDIODRIVER", "nonsense")
    sounds = Sounds()
    sounds.open()
    sounds.play("fire", player=0)
    sounds.music("title")
    assert not sounds.wait()
    assert sounds.trouble.startswith("There is no sound: ")
    sounds.play("hit", pan=-5.0)
    sounds.volume(0, 10)
    sounds.music(None)
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
    sounds.music("title")
    assert voices() == 0
    sounds.close()
