"""Sounds, and the music (`music.py`). A thread opens the device, so that the first picture does not wait for it.

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
from pigaming_app.ui.music import CHANNELS, RATE, Music

FOLDER = ASSETS / "sounds"
_MAX_VOICES = 24  # simultaneous sounds; more are dropped
MIN_REPEAT = 0.05  # seconds before the same sound may restart: four players mash their buttons
_log = logging.getLogger(__name__)


class Sounds:
    """Sounds and music. Silent until `open` has found a device; `trouble` is the reason if it does not."""

    def __init__(self, folder: Path = FOLDER) -> None:
        self.trouble = ""
        self._folder = folder
        self._sounds: dict[str, pygame.mixer.Sound] = {}
        self._started: dict[str, float] = {}
        self._music = Music()
        self._voices: list[pygame.mixer.Channel] = []
        self._volumes = (10, 10)
        self._ready = False
        self._opener: Thread | None = None

    def open(self) -> None:
        """Start opening the device and loading the sounds in a thread. Further calls do nothing."""
        if self._opener is None:
            self._opener = Thread(target=self._open, name="sounds", daemon=True)
            self._opener.start()

    def wait(self) -> bool:
        """Wait until opening has finished, and the music plays; true if sound is available."""
        self.open()
        if self._opener:
            self._opener.join()
        self._music.wait()
        return self._ready

    def close(self) -> None:
        """Stop all sound and close the device."""
        if self._opener:
            self._opener.join()
        self._ready, self._sounds = False, {}
        self._music.close()
        pygame.mixer.quit()

    def play(self, name: str, player: int | None = None, pan: float = 0.0) -> None:
        """Play a sound, in the pitch of a player (seat 0..3) if it has one, panned from -1 (left) to 1 (right)."""
        if not self._ready:
            return
        variant = f"{name}{(player or 0) + 1}"  # sounds with a variant per player have no other
        key = variant if variant in self._sounds else name
        sound, now = self._sounds.get(key), time.monotonic()
        if sound is None or now - self._started.get(key, 0.0) < MIN_REPEAT:
            return
        channel = next((voice for voice in self._voices if not voice.get_busy()), None)
        if channel is None:
            return
        self._started[key] = now
        channel.play(sound)
        channel.set_volume(*stereo(pan))

    def music(self, theme: str | None) -> None:
        """Fade to a theme, that of a game or of the menus, "title"; go on if it plays or is held. None: fade out."""
        self._music.play(theme)

    def hold_music(self) -> None:
        """Pause the music until it is wanted again."""
        self._music.hold()

    def finale(self) -> None:
        """The last seconds of a match: add the finale to its theme."""
        self._music.finale()

    def volume(self, music: int, sounds: int) -> None:
        """Set both volumes, 0 (off) to 10."""
        self._volumes = (music, sounds)
        self._music.volume(_amplitude(music))
        if self._ready:
            self._set_volumes()

    def _open(self) -> None:
        try:
            if _no_sound_device():
                raise pygame.error("no sound device was found")
            pygame.mixer.init(RATE, -16, 2, 512, allowedchanges=0)
            pygame.mixer.set_num_channels(CHANNELS + _MAX_VOICES)
        except (pygame.error, NotImplementedError) as error:
            self.trouble = f"There is no sound: {error}."
            _log.info(self.trouble)
            return
        self._voices = [pygame.mixer.Channel(CHANNELS + number) for number in range(_MAX_VOICES)]
        folders = [self._folder, *(folder for _, folder in data_folders("sounds"))]  # the first ones take precedence
        self._music.open(folders)
        for folder in reversed(folders):
            for path in sorted(folder.glob("*.ogg")):
                if not path.stem.startswith(("theme_", "finale_")):
                    self._load(path)
        self._ready = True
        self._set_volumes()

    def _load(self, path: Path) -> None:
        try:
            self._sounds[path.stem] = pygame.mixer.Sound(str(path))
        except (pygame.error, OSError) as error:
            _log.warning("%s: %s", path, error)

    def _set_volumes(self) -> None:
        music, sounds = (_amplitude(volume) for volume in self._volumes)
        self._music.volume(music)
        for sound in self._sounds.values():
            sound.set_volume(sounds)


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
