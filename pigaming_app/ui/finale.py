"""The finale of a theme is added to its samples while they play."""

import numpy as np
import numpy.typing as npt
import pygame

AHEAD, SWELL = 0.5, 1.5  # s: from what plays now to where the finale begins, and from there to its full volume


def add(finale: pygame.mixer.Sound, theme: pygame.mixer.Sound, played: float, rate: int) -> None:
    """Add a finale, cut or repeated to the length of its theme, that has played for so many seconds.

    `rate`: samples in a second.
    """
    playing = pygame.sndarray.samples(theme)
    gain = np.roll(swell(len(playing), rate), round((played + AHEAD) * rate))
    extra = np.resize(pygame.sndarray.samples(finale), playing.shape)
    playing[:] = np.clip(playing + gain[:, None] * extra, -32768, 32767)


def swell(size: int, rate: int) -> npt.NDArray[np.float32]:
    """The gain of a finale from its beginning on: it swells, stays, and leaves out the part that is playing now."""
    ahead, rise = (min(round(seconds * rate), size // 4) for seconds in (AHEAD, SWELL))
    up, down = np.linspace(0.0, 1.0, rise, dtype=np.float32), np.linspace(1.0, 0.0, ahead, dtype=np.float32)
    stays = np.ones(size - rise - 2 * ahead, np.float32)
    return np.concatenate([up, stays, down, np.zeros(ahead, np.float32)])
