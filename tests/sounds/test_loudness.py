"""Both meters of loudness, against published signals and, where they are installed, pyloudnorm and ffmpeg."""

import re
import shutil
import subprocess
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from assets.sounds.loudness import loudness
from assets.sounds.render import FOLDER, GROUPS
from tests.sounds.meter import RATE, Samples, measured

METERS = pytest.mark.parametrize("meter", [loudness, measured], ids=["renderer", "test"])


def sine(hz: float, *parts: tuple[float, float], sides: int = 2) -> Samples:
    """A sine with these peaks (dB of full scale), each for so many seconds."""
    level = np.concatenate([np.full(round(seconds * RATE), 10.0 ** (peak / 20.0)) for peak, seconds in parts])
    tone = level * np.sin(2.0 * np.pi * hz * np.arange(level.size) / RATE)
    return np.stack([tone] * sides, axis=1)


@METERS
def test_a_full_scale_sine_on_one_channel(meter: Callable[[Samples], float]) -> None:
    """BS.1770-5, annex 1: a 997 Hz sine of 0 dBFS on one front channel reads -3.01 LKFS."""
    assert meter(sine(997.0, (0.0, 5.0), sides=1)) == pytest.approx(-3.01, abs=0.01)


@METERS
@pytest.mark.parametrize(
    ("parts", "lufs"),
    [
        (((-23.0, 20.0),), -23.0),
        (((-33.0, 20.0),), -33.0),
        (((-36.0, 10.0), (-23.0, 60.0), (-36.0, 10.0)), -23.0),
        (((-72.0, 10.0), (-36.0, 10.0), (-23.0, 60.0), (-36.0, 10.0), (-72.0, 10.0)), -23.0),
        (((-26.0, 20.0), (-20.0, 20.1), (-26.0, 20.0)), -23.0),
    ],
    ids=["1", "2", "3", "4", "5"],
)
@pytest.mark.long
def test_signals_of_the_broadcasting_union(
    meter: Callable[[Samples], float], parts: tuple[tuple[float, float], ...], lufs: float
) -> None:
    """EBU Tech 3341, minimum requirements, test signals 1 to 5: within 0.1 LU."""
    assert meter(sine(1000.0, *parts)) == pytest.approx(lufs, abs=0.1)


@pytest.mark.parametrize("seconds", [0.1, 0.5, 2.0])
def test_both_meters_agree(seconds: float) -> None:
    noise = np.random.default_rng(3).standard_normal((round(seconds * RATE), 2)) * 0.1
    assert loudness(noise) == pytest.approx(measured(noise), abs=0.1)


def test_pyloudnorm_agrees() -> None:
    pyloudnorm: Any = pytest.importorskip("pyloudnorm")
    noise = np.random.default_rng(4).standard_normal((5 * RATE, 2)) * 0.1
    assert pyloudnorm.Meter(RATE, filter_class="DeMan").integrated_loudness(noise) == pytest.approx(
        loudness(noise), abs=0.01
    )


@pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed")
def test_ffmpeg_agrees() -> None:
    command = ["ffmpeg", "-nostats", "-i", str(FOLDER / "theme_title.ogg"), "-af", "ebur128", "-f", "null", "-"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    assert float(re.findall(r"I:\s+(-[\d.]+) LUFS", said)[-1]) == pytest.approx(GROUPS["theme"], abs=0.5)
