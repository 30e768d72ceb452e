"""Robots on a television that lies flat, emulated: lamps mirrored in its glass, less light at an angle, flicker."""

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.optics import Optics, TrueLens
from pigaming_app.hardware.emulator.television import MirroredLamp, Television
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.showings import LAMPS, SHOWINGS
from pigaming_app.hardware.proof.trials import FigureEight, follow

FLAT = SHOWINGS["television"]  # 65 inches
ABOVE = TrueLens((40.0, 150.0, 1450.0), (5.0, 16.0), 0.021)
ASIDE = FLAT.lens  # 33 degrees off the vertical


def bed_on(lens: TrueLens, television: Television, readout: float = 0.0) -> testbed.Testbed:
    return testbed.Testbed(5, 30.0, showing=FLAT._replace(lens=lens, television=television, readout=readout))


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize(
    ("lens", "television", "readout"),
    [
        (ABOVE, Television(lamps=LAMPS, hertz=240.0, duty=0.5), 0.0),
        (ASIDE, Television(lamps=LAMPS), 0.0),
        (ABOVE, Television(hertz=240.0, duty=0.5), 1 / 40),
    ],
    ids=["mirrored lamps and flicker", "at an angle", "flicker and a rolling shutter"],
)
def test_robots_are_followed_on_a_television(lens, television, readout, monkeypatch):
    bed = bed_on(lens, television, readout)
    eight, way = FigureEight(bed), np.zeros(4)
    tick, last = eight.tick, np.array(bed.arena.poses())

    def measured():
        nonlocal last, way
        tick()
        now = np.array(bed.arena.poses())
        way, last = way + np.hypot(*(now - last)[:, :2].T) * bed.ground.mm, now

    monkeypatch.setattr(eight, "tick", measured)
    run = follow(eight, 3.0)
    assert bed.ground.mean_mm <= 1.5
    assert run.rmse_mm <= 2.0
    assert run.rmse_deg <= 1.0
    assert run.complete >= 0.98
    assert not eight.plant.faults
    assert way.min() > 0.7 * FLAT.speed * 5.0  # they drive: two seconds, then three


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize(
    ("lens", "television", "light", "advice"),
    [
        (ABOVE, Television(hertz=100.0, duty=0.5), (0.4, 0.7), "flickers"),
        (ASIDE, Television(falloff=6.0), (0.5, 0.7), None),
        (ABOVE, Television(lamps=LAMPS), (0.8, 0.95), None),
    ],
    ids=["flicker", "at an angle", "mirrored lamps"],
)
def test_the_wizard_measures_the_light_of_a_television_and_its_flicker(lens, television, light, advice):
    quality = bed_on(lens, television).ground.quality
    assert light[0] < quality.light < light[1]
    assert (quality.advice and quality.advice.key) == advice
    assert quality.sufficient


def test_a_backlight_flickers_less_the_longer_the_exposure():
    """By hand: half of each 10 ms is dark."""
    television = Television(hertz=100.0, duty=0.5)
    assert television.shine(0.0, 0.005) == pytest.approx(2.0)
    assert television.shine(0.005, 0.005) == pytest.approx(0.0, abs=1e-9)
    assert television.shine(0.0021, 0.010) == pytest.approx(1.0)
    assert television.shine(0.0, 0.015) == pytest.approx(4 / 3)


def test_white_is_darker_at_an_angle_and_a_lamp_is_seen_at_its_mirror_image():
    """By hand: a lamp 500 mm above the glass shows where the line from the eye to 500 mm below it meets the glass."""
    optics = Optics(TrueLens((0.0, 0.0, 1000.0), (0.0, 0.0), 0.0, 900.0, radial=(0.0, 0.0, 0.0), tangential=(0.0, 0.0)))
    white, mirrored = Television(100.0, 2.0, (MirroredLamp(300.0, 0.0, 500.0, 40.0, 50.0),)).seen(optics)
    at = [tuple(np.rint(optics.sensor(np.array([(x, 0.0)]))[0]).astype(int)[::-1]) for x in (0.0, 200.0, 500.0)]
    assert [white[place] for place in at] == pytest.approx([100.0, 100 / 1.04, 80.0], rel=2e-3)
    assert [mirrored[place] for place in at] == pytest.approx([0.0, 50.0, 0.0], abs=0.1)
