"""Sound. A thread opens the device, so that the first picture does not wait for it.

Without a device or a sound file the arcade stays silent and never fails.
"""

import logging
import os
import sys
import time
from pathlib import Path
from threading import Thread

import pygame

from pigaming_app import ASSETS
from pigaming_app.storage.plugins.parts import data_folders

FOLDER = ASSETS / "sounds"
_MAX_VOICES = 24  # simultaneous sounds; more are dropped
_MIN_REPEAT = 0.05  # seconds before the same sound may restart: four players mash their buttons
_log = logging.getLogger(__name__)


class Sounds:
    """Sounds and music. Silent until `open` has found a device; `trouble` is the reason if it does not."""

    def __init__(self, folder: Path = FOLDER) -> None:
        self.trouble = ""
        self._folder = folder
        self._sounds: dict[str, pygame.mixer.Sound] = {}
        self._started: dict[str, float] = {}
        self._music_on = False
        self._music_playing = False
        self._volumes = (6, 8)
        self._ready = False
        self._opener: Thread | None = None

    def open(self) -> None:
        """Start opening the device and loading the sounds in a thread. Further calls do nothing."""
        if self._opener is None:
            self._opener = Thread(target=self._open, name="sounds", daemon=True)
            self._opener.start()

    def wait(self) -> bool:
        """Wait until opening has finished; true if sound is available."""
        self.open()
        if self._opener:
            self._opener.join()
        return self._ready

    def close(self) -> None:
        """Stop all sound and close the device."""
        if self._opener:
            self._opener.join()
        self._ready, self._music_playing, self._sounds = False, False, {}
        pygame.mixer.quit()

    def play(self, name: str, player: int | None = None, pan: float = 0.0) -> None:
        """Play a sound, in the pitch of a player (seat 0..3) if it has one, panned from -1 (left) to 1 (right)."""
        if not self._ready:
            return
        variant = f"{name}{(player or 0) + 1}"  # sounds with a variant per player have no other
        key = variant if variant in self._sounds else name
        sound, now = self._sounds.get(key), time.monotonic()
        if sound is None or now - self._started.get(key, 0.0) < _MIN_REPEAT:
            return
        channel = pygame.mixer.find_channel()
        if channel is None:
            return
        self._started[key] = now
        channel.play(sound)
        channel.set_volume(*stereo(pan))

    def music(self, on: bool) -> None:
        """Start the music from its beginning, or fade it out."""
        self._music_on = on
        if self._ready:
            self._follow_music()

    def volume(self, music: int, sounds: int) -> None:
        """Set both volumes, 0 (off) to 10."""
        self._volumes = (music, sounds)
        if self._ready:
            self._set_volumes()

    def _open(self) -> None:
        try:
            if _no_sound_device():
                raise pygame.error("no sound device was found")
            pygame.mixer.init(44100, -16, 2, 512, allowedchanges=0)
            pygame.mixer.set_num_channels(_MAX_VOICES)
        except (pygame.error, NotImplementedError) as error:
            self.trouble = f"There is no sound: {error}."
            _log.info(self.trouble)
            return
        added = [folder for _, folder in data_folders("sounds")]
        for folder in (*reversed(added), self._folder):  # the later ones replace others of their name
            for path in sorted(folder.glob("*.ogg")):
                if path.stem != "music":
                    self._load(path)
        self._set_volumes()
        self._ready = True
        self._follow_music()

    def _load(self, path: Path) -> None:
        try:
            self._sounds[path.stem] = pygame.mixer.Sound(str(path))
        except (pygame.error, OSError) as error:
            _log.warning("%s: %s", path, error)

    def _set_volumes(self) -> None:
        music, sounds = (_amplitude(volume) for volume in self._volumes)
        pygame.mixer.music.set_volume(music)
        for sound in self._sounds.values():
            sound.set_volume(sounds)

    def _follow_music(self) -> None:
        path = self._folder / "music.ogg"
        try:
            if self._music_on and not self._music_playing:
                pygame.mixer.music.load(str(path))
                pygame.mixer.music.play(-1, fade_ms=800)
                self._music_playing = True
            elif self._music_playing and not self._music_on:
                pygame.mixer.music.fadeout(800)
                self._music_playing = False
        except (pygame.error, OSError) as error:
            _log.warning("%s: %s", path, error)


def stereo(pan: float) -> tuple[float, float]:
    """Volumes of the left and right channel; neither is ever silent, as players sit beside each other."""
    side = max(-1.0, min(1.0, pan)) * 0.7
    return (min(1.0, 1.0 - side), min(1.0, 1.0 + side))


def _no_sound_device() -> bool:
    """True if a Linux system certainly has no sound. Probing it would fill the terminal with ALSA errors."""
    if not sys.platform.startswith("linux") or os.environ.keys() & {"SDL_AUDIODRIVER", "AUDIODEV", "PULSE_SERVER"}:
        return False
    servers = Path(os.environ.get("XDG_RUNTIME_DIR", f"/run/user/{os.getuid()}"))
    return not any(place.exists() for place in (Path("/dev/snd"), servers / "pulse" / "native", servers / "pipewire-0"))


def _amplitude(volume: int) -> float:
    """Perceived loudness is logarithmic: volume 5 of 10 is a quarter of the amplitude."""
    return (max(0, min(10, volume)) / 10.0) ** 2
