"""Music: one theme at a time, which repeats, and its finale, a second part for the last seconds of a match.

`theme_NAME.ogg` and `finale_NAME.ogg` are loops of one length. The finale is added to the samples of the theme while
they play, so it is in step with them whatever the device does, and volume, pause and fading apply to both. Files are
loaded in a thread; the latest request counts.
"""

import logging
import time
from collections.abc import Sequence
from pathlib import Path
from threading import RLock, Thread

import pygame

RATE = 44100  # samples in a second, of the mixer
CHANNELS = 2  # of the mixer, for music: one fades out while the other fades in
DEFAULT = "title"  # plays for a game without a theme
FADE = 800  # ms
_log = logging.getLogger(__name__)


class Playing:
    """A theme on a channel, from its beginning. `extra`: its finale, until that is added."""

    def __init__(
        self, channel: "pygame.mixer.Channel", sound: "pygame.mixer.Sound", extra: "pygame.mixer.Sound | None"
    ) -> None:
        self.channel, self.sound, self.extra = channel, sound, extra
        self._played, self._since = 0.0, time.monotonic()  # s before the last pause, and when it went on
        self.held = False
        channel.play(sound, loops=-1, fade_ms=FADE)

    def hold(self, on: bool) -> None:
        """Pause, or go on."""
        if on == self.held:
            return
        self._played, self._since = self.position, time.monotonic()
        self.held = on
        (self.channel.pause if on else self.channel.unpause)()

    def end(self) -> None:
        """Fade out; what is held is silent and ends at once."""
        if self.held:
            self.channel.stop()
        else:
            self.channel.fadeout(FADE)

    @property
    def position(self) -> float:
        """Seconds played so far."""
        return self._played + (0.0 if self.held else time.monotonic() - self._since)

    def add_finale(self) -> None:
        """Add the finale to what will play from now on."""
        from pigaming_app.ui.finale import add  # NumPy, at which the first picture does not wait

        extra, self.extra = self.extra, None
        if extra:
            add(extra, self.sound, self.position, RATE)


class Music:
    """What plays. Silent until `open`; `folders` are searched in order."""

    def __init__(self) -> None:
        self.theme: str | None = None
        self._folders: Sequence[Path] = ()
        self._amplitude = 0.0
        self._held = self._finale = False
        self._request = self._number = 0  # of the latest theme that was wanted; of the channel that played last
        self._playing: Playing | None = None
        self._works: list[Thread] = []  # those that have not ended
        self._lock = RLock()

    def open(self, folders: Sequence[Path]) -> None:
        """The mixer is ready: play what was wanted before."""
        with self._lock:
            self._folders = folders
            self._load()

    def wait(self) -> None:
        """Wait until what was wanted plays."""
        for work in self._works:
            work.join()

    def close(self) -> None:
        """Forget what plays; nothing uses the mixer any more."""
        with self._lock:
            self._folders, self._playing = (), None
            self._request += 1
        self.wait()

    def play(self, theme: str | None) -> None:
        """Fade to a theme, from its beginning, or go on with it if it plays or is held; None: fade out."""
        with self._lock:
            if theme != self.theme:
                self.theme, self._finale, self._held = theme, False, False
                self._fade_out()
                self._load()
            self._hold(False)

    def hold(self) -> None:
        """Pause the theme until it is played again."""
        self._hold(True)

    def finale(self) -> None:
        """Add the finale to the theme that plays, once."""
        with self._lock:
            if self._finale or self.theme is None:
                return
            self._finale = True
            if self._playing:
                self._start(Thread(target=self._playing.add_finale, name="finale", daemon=True))

    def volume(self, amplitude: float) -> None:
        """Set the volume, 0 to 1. That of the sound, not of the channel, which is fading."""
        with self._lock:
            self._amplitude = amplitude
            if self._playing:
                self._playing.sound.set_volume(amplitude)

    def _hold(self, on: bool) -> None:
        with self._lock:
            self._held = on
            if self._playing:
                self._playing.hold(on)

    def _fade_out(self) -> None:
        if self._playing:
            self._playing.end()
            self._playing = None

    def _load(self) -> None:
        """Load the wanted theme in a thread, and play it."""
        self._request += 1
        if self.theme is not None and self._folders:
            self._start(Thread(target=self._begin, args=(self.theme, self._request), name="music", daemon=True))

    def _start(self, work: Thread) -> None:
        work.start()
        self._works = [*(other for other in self._works if other.is_alive()), work]

    def _begin(self, theme: str, request: int) -> None:
        if request != self._request:
            return
        sound = self._sound(f"theme_{theme}")
        name = theme if sound else DEFAULT
        sound, extra = sound or self._sound(f"theme_{name}"), self._sound(f"finale_{name}")
        with self._lock:
            if sound is None or request != self._request:
                return
            sound.set_volume(self._amplitude)
            self._number = (self._number + 1) % CHANNELS
            self._playing = Playing(pygame.mixer.Channel(self._number), sound, extra)
            if self._finale:
                self._playing.add_finale()
            self._playing.hold(self._held)

    def _sound(self, name: str) -> "pygame.mixer.Sound | None":
        path = next((path for folder in self._folders if (path := folder / f"{name}.ogg").exists()), None)
        try:
            return pygame.mixer.Sound(str(path)) if path else None
        except (pygame.error, OSError) as error:
            _log.warning("%s: %s", path, error)
            return None
