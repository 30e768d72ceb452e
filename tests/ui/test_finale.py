"""A finale is added to a theme sample by sample, from where it will soon play."""

import numpy as np
import numpy.typing as npt
import pygame
import pytest

from pigaming_app.ui.finale import AHEAD, SWELL, add

RATE, SIZE = 1000, 6000  # of a small theme
BEGINS, FULL = round(AHEAD * RATE), round((AHEAD + SWELL) * RATE)
Sides = npt.NDArray[np.int64]


@pytest.fixture(autouse=True)
def _mixer() -> None:
    pygame.mixer.init(44100, -16, 2, 512, allowedchanges=0)


def sound(samples: Sides) -> pygame.mixer.Sound:
    return pygame.sndarray.make_sound(np.stack([samples, -samples], axis=1).astype(np.int16))


def heard(theme: pygame.mixer.Sound, played: float) -> Sides:
    """The left side, from what plays now on."""
    return np.roll(pygame.sndarray.array(theme)[:, 0].astype(np.int64), -round(played * RATE))


@pytest.mark.parametrize("played", [0.0, 2.3, 5.9, 6.0, 100.25])
def test_it_swells_in_step_with_its_theme(played: float) -> None:
    chance = np.random.default_rng(5)
    one, other = (chance.integers(-9000, 9000, SIZE) for _ in range(2))
    theme = sound(one)
    add(sound(other), theme, played, RATE)
    plays, joins = (np.roll(part, -round(played * RATE)) for part in (one, other))
    out = heard(theme, played)
    assert np.array_equal(out[:BEGINS], plays[:BEGINS]), "what plays now is left as it is"
    half = (BEGINS + FULL) // 2
    assert abs(out[half] - plays[half] - 0.5 * joins[half]) < 10
    assert np.array_equal(out[FULL : SIZE - BEGINS], (plays + joins)[FULL : SIZE - BEGINS])
    assert np.abs(out[-20:] - plays[-20:]).max() < 0.05 * 9000, "it fades before it comes round"


def test_a_short_one_is_repeated_and_the_sum_does_not_wrap() -> None:
    theme = sound(np.full(SIZE, 30000))
    add(sound(np.full(700, 9000)), theme, 0.0, RATE)
    assert heard(theme, 0.0)[FULL] == 32767


def test_a_theme_shorter_than_the_swell() -> None:
    theme = sound(np.zeros(8, np.int64))
    add(sound(np.full(8, 100)), theme, 0.0, RATE)
    assert heard(theme, 0.0).max() == 100
