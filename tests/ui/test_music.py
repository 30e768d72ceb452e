"""Music: one theme at a time, held under a pause, and its finale in step with it."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pygame
import pytest

from pigaming_app.ui.finale import AHEAD
from pigaming_app.ui.music import CHANNELS, RATE, Playing
from pigaming_app.ui.sounds import FOLDER, Sounds


@pytest.fixture
def sounds() -> Iterator[Sounds]:
    opened = Sounds()
    opened.volume(10, 10)
    assert opened.wait()
    yield opened
    opened.close()


def playing(sounds: Sounds, theme: str | None = None) -> Playing:
    """The theme that plays; first fade to another one."""
    if theme:
        sounds.music(theme)
    sounds.wait()
    assert sounds._music._playing
    return sounds._music._playing


def file(name: str) -> np.ndarray:
    return pygame.sndarray.array(pygame.mixer.Sound(str(FOLDER / f"{name}.ogg")))


def busy() -> int:
    return sum(pygame.mixer.Channel(number).get_busy() for number in range(CHANNELS))


def test_music_wanted_before_the_device_opens_plays() -> None:
    sounds = Sounds()
    sounds.music("title")
    sounds.volume(5, 5)
    assert sounds.wait()
    now = playing(sounds)
    assert now.channel.get_sound() is now.sound
    assert np.array_equal(pygame.sndarray.array(now.sound), file("theme_title"))
    assert now.sound.get_volume() == pytest.approx(0.25, abs=0.01)
    sounds.close()
    sounds.music("race")
    sounds.finale()
    sounds.hold_music()


def test_the_same_theme_goes_on_and_another_one_begins(sounds: Sounds) -> None:
    title = playing(sounds, "title")
    assert playing(sounds, "title") is title
    race = playing(sounds, "race")
    assert race.channel is not title.channel
    assert busy() == 2, "one fades out while the other fades in"
    assert np.array_equal(pygame.sndarray.array(race.sound), file("theme_race"))


def test_the_latest_of_several_wishes_counts(sounds: Sounds) -> None:
    for theme in ("race", "title", None, "pitanks"):
        sounds.music(theme)
    now = playing(sounds)
    assert np.array_equal(pygame.sndarray.array(now.sound), file("theme_pitanks"))
    sounds.music(None)
    assert sounds._music._playing is None


def test_music_is_held_and_goes_on(sounds: Sounds, monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    race = playing(sounds, "race")
    clock[0] += 3.0
    sounds.hold_music()
    clock[0] += 60.0
    assert race.held
    assert race.position == 3.0
    sounds.music("race")
    clock[0] += 1.0
    assert not race.held
    assert race.position == 4.0
    sounds.hold_music()
    assert not playing(sounds, "title").held
    assert busy() == 1, "what is held does not sound again while it fades out"


def test_what_is_held_while_it_loads_does_not_play(sounds: Sounds) -> None:
    sounds.music("race")
    sounds.hold_music()
    assert playing(sounds).held


def test_the_finale_is_added_where_the_theme_plays(sounds: Sounds, monkeypatch: pytest.MonkeyPatch) -> None:
    """Half a second further on, once."""
    clock = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    race = playing(sounds, "race")
    clock[0] += 50.0
    sounds.finale()
    sounds.finale()
    sounds.wait()
    first, size = round((50.0 + AHEAD) * RATE), len(file("theme_race"))
    changed = np.flatnonzero((pygame.sndarray.array(race.sound) != file("theme_race")).any(axis=1))
    since = (changed - first) % size
    assert since.min() < 0.02 * RATE
    assert since.max() < size - round(AHEAD * RATE), "the part that plays now is left as it is"


def test_a_finale_wanted_while_the_theme_loads_is_added(sounds: Sounds) -> None:
    sounds.music("race")
    sounds.finale()
    now = playing(sounds)
    assert now.extra is None
    assert not np.array_equal(pygame.sndarray.array(now.sound), file("theme_race"))


def test_a_new_match_begins_without_the_finale(sounds: Sounds) -> None:
    playing(sounds, "race")
    sounds.finale()
    sounds.music(None)
    now = playing(sounds, "race")
    assert np.array_equal(pygame.sndarray.array(now.sound), file("theme_race"))


def test_the_volume_is_that_of_theme_and_finale(sounds: Sounds) -> None:
    race = playing(sounds, "race")
    sounds.finale()
    sounds.wait()
    sounds.volume(0, 10)
    assert race.channel.get_sound() is race.sound
    assert race.sound.get_volume() == 0.0
    sounds.volume(10, 0)
    assert race.sound.get_volume() == 1.0


def test_a_game_without_a_theme_has_that_of_the_title(sounds: Sounds) -> None:
    now = playing(sounds, "unheard_of")
    assert np.array_equal(pygame.sndarray.array(now.sound), file("theme_title"))
    sounds.finale()
    sounds.wait()
    assert np.array_equal(pygame.sndarray.array(now.sound), file("theme_title"))


def test_a_theme_of_a_plug_in_is_in_its_own_folder(sounds: Sounds) -> None:
    assert not (FOLDER / "theme_football.ogg").exists()
    assert not np.array_equal(pygame.sndarray.array(playing(sounds, "football").sound), file("theme_title"))


def test_a_file_that_is_no_music_is_silence(tmp_path: Path) -> None:
    (tmp_path / "theme_title.ogg").write_bytes(b"this is not a sound")
    sounds = Sounds(tmp_path)
    sounds.music("title")
    assert sounds.wait()
    assert busy() == 0
    sounds.finale()
    sounds.hold_music()
    sounds.close()
