"""Robots on a printed floor, seen in room light alone: poses, and a whole match."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import load, on_mat
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.optics import TrueLens
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.testbed import TimedTracker
from pigaming_app.hardware.proof.trials import FigureEight, follow, play
from pigaming_app.sim.world import ROBOTS
from tests.hardware.paper import SURFACE, PrintedSession
from tests.matches import setup_of

SMALL, LOW = FloorSurface(1439.0, 809.0), TrueLens((45.0, 153.0, 1440.0), (5.0, 16.0), 0.021)  # 65 inches
DARK = np.zeros((1080, 1920), np.uint8)


class Bed(testbed.Testbed):
    """The testbed over paper."""

    lighting: Any
    tracker: Any

    def __init__(self, seed, surface=SURFACE, lens=None):
        self.lighting = SimpleNamespace(show=lambda busy: None, picture=lambda robots: DARK)
        self.session = PrintedSession(seed, False, lighting=self.lighting, tracker=TimedTracker)
        self.session.surface, self.session.lens = surface, lens
        self.rig = self.session.open()
        self.arena, self.ground = self.session.arena, self.session.ground
        self.tracker, self.link = self.rig.tracker, self.rig.link


@pytest.mark.long
def test_robots_are_followed_to_two_millimetres_and_a_degree():
    run = follow(FigureEight(Bed(5)), 4.0)
    assert run.rmse_mm <= 2.0
    assert run.rmse_deg <= 1.0
    assert run.complete >= 0.99


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize(
    ("surface", "lens", "name"), [(SURFACE, None, "classic"), (SMALL, LOW, "trenches")], ids=["2.54 m", "65 inches"]
)
def test_a_match_is_played_and_nobody_enters_a_wall(surface, lens, name):
    bed = Bed(7, surface, lens)
    arena = on_mat("pitanks", load("pitanks", name), (), bed.rig.radius_in_play(range(ROBOTS)))
    setup = setup_of("pitanks", "level3 level3 level3 level3", name, 0.2, 3, "pickups")
    match = new_match(setup, plant=lambda world: RealPlant(world, bed.rig), arena=arena)
    run = play(bed, match, 12.0)
    assert match.over
    assert run.deepest_mm <= 5.0
    assert run.alarms == 0
    assert run.paused <= 1.0
