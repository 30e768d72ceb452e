"""Figures for each way of showing and each driver, on a small scale: `bench robots` measures them in full."""

import numpy as np
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.emulator.optics import LAMP, Optics, TrueLens
from pigaming_app.hardware.proof import figures, hostile, testbed
from pigaming_app.hardware.proof.emergencies import BREAKDOWNS, MISWIRED, break_down, gone_over_edge
from pigaming_app.hardware.proof.fleets import FLEETS
from pigaming_app.hardware.proof.showings import SHOWINGS
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector
from pigaming_app.jobs.bench.robots import TARGETS, reached
from tests.cases import one_in, repeated


@pytest.fixture(scope="module")
def bed():
    return testbed.Testbed(5, 30.0)


def assert_good(found):
    assert [key for key, good in reached(found).items() if not good] == [], found


@pytest.mark.long
@pytest.mark.parametrize("name", repeated(reversed(SHOWINGS)))
def test_robots_are_followed_and_nothing_else_is_one_however_the_game_is_shown(name):
    found = figures.of_showing(name, 5, pictures=60, seconds=3.0)
    assert found.keys() < TARGETS.keys()
    assert_good(found)


@pytest.mark.long(first=True)
@pytest.mark.again  # half a minute each; in bench robots
@pytest.mark.usefixtures("micropython")
@pytest.mark.parametrize("name", FLEETS)
def test_robots_of_every_driver_are_followed_and_stopped(name):
    found = figures.of_driver(name, 5, seconds=3.0)
    assert {"pose_rmse_mm", "worst_stop_ms", "breakdown_ms", "breakdown_mm"} <= found.keys()
    assert_good(found)


def test_hostile_pictures_have_no_robot_and_true_markers_among_them_are_found(bed, monkeypatch):
    """The second shows that the first can fail; OpenCV's own detector, on the floor itself, agrees with both."""
    detector, floor = MarkerDetector(ROBOT_IDS), hostile.hostile_floor
    random = np.random.default_rng(3)
    assert not any(detector.detect(floor(random)) for _ in range(6))
    assert sum(len(detector.detect(floor(random, robots=True))) for _ in range(3)) >= 6
    assert hostile.false_robots(bed, 8) == 0
    monkeypatch.setattr(hostile, "hostile_floor", lambda random: floor(random, robots=True))
    assert hostile.false_robots(bed, 8) > 0
    bed.arena.cleared = False


@pytest.mark.parametrize("name", one_in(5, BREAKDOWNS))
def test_a_robot_that_breaks_while_it_drives_is_stopped(bed, name):
    bed.arena.cleared = False
    run = break_down(FigureEight(bed), name, 1)
    assert 0.1 < run.seconds <= TARGETS["breakdown_ms"] / 1e3
    assert run.mm <= TARGETS["breakdown_mm"]
    assert (run.mm < 1.0) is (name == "pinned"), "one that is held goes nowhere"
    assert not bed.arena.faults.on()


@pytest.mark.long
@pytest.mark.parametrize("name", repeated(MISWIRED))
def test_a_miswired_robot_at_the_edge_does_not_get_far_out(bed, name):
    bed.arena.cleared = False
    bed.session.find()
    assert gone_over_edge(bed, name, 0.0, np.pi * (name == "lids_swapped"), 260.0) <= TARGETS["outside_mm"]


def test_light_that_comes_aslant_is_weaker_far_from_the_lamp():
    """By hand: 3 m above the middle of the mat and 4 m aside of it, light has 5 m to go, and 3 right below the lamp."""
    lens = TrueLens((0.0, 0.0, 9000.0), (0.0, 0.0), 0.0, 900.0, radial=(0.0, 0.0, 0.0), tangential=(0.0, 0.0))
    optics = Optics(lens, lamp=np.array([4000.0, 0.0, 3000.0]))
    middle, below = (np.rint(optics.sensor(np.array([(x, 0.0)]))[0]).astype(int)[::-1] for x in (0.0, 4000.0))
    beam = optics.beam(0.0)
    assert beam is not None
    assert [beam[tuple(middle)], beam[tuple(below)]] == pytest.approx([1.0, (5.0 / 3.0) ** 3], rel=0.01)
    assert Optics(lens, lamp=LAMP).beam(0.0) is None


def test_what_a_group_misses_is_named_with_it():
    found = reached({"showing": {"television": {"false_robots": 1.0}}, "wall_entry_mm": 5.0})
    assert found == {"showing.television.false_robots": False, "wall_entry_mm": True}
