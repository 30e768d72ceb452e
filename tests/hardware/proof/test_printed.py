"""Robots on a printed floor, seen in room light alone: poses, and a whole match."""

import pytest

pytest.importorskip("cv2")
pytest.importorskip("pypdfium2")

import numpy as np

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import load, on_mat
from pigaming_app.hardware.calibration.floor_surface import FloorSurface
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.optics import TrueLens
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.showings import FINE, LENS, printed_floor
from pigaming_app.hardware.proof.trials import FigureEight, follow, play
from pigaming_app.sim.world import ROBOTS
from tests.hardware.paper import SURFACE, floor_picture, printed
from tests.matches import setup_of
from tests.scenes.mat.paper.rendered import found

SMALL, LOW = FloorSurface(1439.0, 809.0), TrueLens((45.0, 153.0, 1440.0), (5.0, 16.0), 0.021)  # 65 inches


def test_the_floor_of_bench_robots_has_its_corner_markers_where_the_printed_page_has_them():
    drawn, page = found(printed_floor(1), FINE), found(floor_picture(), 1.0)
    assert {10, 11, 12, 13} == {*drawn} <= {*page}
    assert max(np.abs(drawn[number] - page[number]).max() for number in drawn) < 0.8  # mm


@pytest.mark.long
def test_robots_are_followed_to_two_millimetres_and_a_degree():
    run = follow(FigureEight(testbed.Testbed(5, 30.0, showing=printed())), 4.0)
    assert run.rmse_mm <= 2.0
    assert run.rmse_deg <= 1.0
    assert run.complete >= 0.99


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize(
    ("surface", "lens", "name"), [(SURFACE, LENS, "classic"), (SMALL, LOW, "trenches")], ids=["2.54 m", "65 inches"]
)
def test_a_match_is_played_and_nobody_enters_a_wall(surface, lens, name):
    bed = testbed.Testbed(7, 30.0, showing=printed(surface, lens))
    arena = on_mat("pitanks", load("pitanks", name), (), bed.rig.radius_in_play(range(ROBOTS)))
    setup = setup_of("pitanks", "level3 level3 level3 level3", name, 0.2, 3, "pickups")
    match = new_match(setup, plant=lambda world: RealPlant(world, bed.rig), arena=arena)
    run = play(bed, match, 12.0)
    assert match.over
    assert run.deepest_mm <= 5.0
    assert run.alarms == 0
    assert run.paused <= 1.0
