"""Robots on a television that lies flat, emulated: lamps mirrored in its glass, less light at an angle, flicker."""

from math import hypot
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits, FrameTiming
from pigaming_app.hardware.emulator.optics import Optics, TrueLens
from pigaming_app.hardware.emulator.radio import MODERATE
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.hardware.emulator.television import MirroredLamp, Television
from pigaming_app.hardware.proof import testbed, trials
from pigaming_app.hardware.proof.testbed import TimedTracker
from pigaming_app.hardware.proof.trials import FigureEight, follow
from pigaming_app.hardware.session.emulated import QUICK, EmulatedSession, calibrated
from pigaming_app.hardware.session.lighting import Lighting

INCHES = 65.0
WIDE, HIGH = (INCHES * 25.4 * side / hypot(16.0, 9.0) for side in (16.0, 9.0))  # mm: 1439 x 809
ABOVE = TrueLens((40.0, 150.0, 1450.0), (5.0, 16.0), 0.021)
ASIDE = TrueLens((40.0, 900.0, 1350.0), (5.0, 40.0), 0.021)  # 33 degrees off the vertical
LAMPS = (MirroredLamp(-300.0, 120.0, 1200.0, 90.0, 300.0), MirroredLamp(420.0, 60.0, 1200.0, 70.0, 220.0))
SLOWER = 200.0  # mm/s: as fast in px as on a mat
ROOM = 2.0  # share of the emulator's room light: the lids have no other


class TelevisionSession(EmulatedSession):
    """Emulated robots on a television."""

    lens, television, readout = ABOVE, Television(), 0.0

    def _new_arena(self):
        traits = CameraTraits(lens=self.lens, readout=self.readout)
        corners = np.array([(-WIDE, -HIGH), (WIDE, -HIGH), (WIDE, HIGH), (-WIDE, HIGH)]) / 2.0
        arena = EmulatedArena(
            self.seed, FrameTiming(30.0), MODERATE, QUICK, traits=traits, optics=Optics(self.lens, corners)
        )
        arena.camera.painter.ambient = ROOM
        arena.lay_television(self.television)
        if self._made is None:
            self._made = calibrated(arena, EmulatedCalibrationSite(arena=arena))
        return arena


class Bed(testbed.Testbed):
    """The testbed on a television."""

    tracker: Any

    def __init__(self, seed, lens, television, readout):
        self.lighting = Lighting(seed)
        self.session = TelevisionSession(seed, False, lighting=self.lighting, tracker=TimedTracker)
        self.session.lens, self.session.television, self.session.readout = lens, television, readout
        self.rig = self.session.open()
        self.arena, self.ground = self.session.arena, self.session.ground
        self.tracker, self.link = self.rig.tracker, self.rig.link


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
    monkeypatch.setattr(trials, "SPEED", SLOWER)
    bed = Bed(5, lens, television, readout)
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
    assert way.min() > 0.7 * SLOWER * 5.0  # they drive: two seconds, then three


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
    session = TelevisionSession(5, False)
    session.lens, session.television = lens, television
    quality = session.ground.quality
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
