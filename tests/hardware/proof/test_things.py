"""Things on the emulated mat are found where they are, and nothing else is found."""

from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.hardware.emulator import renderer
from pigaming_app.hardware.emulator.things.prism import TAPE, box
from pigaming_app.hardware.proof.things import ThingsBed, compare, distances, trial
from pigaming_app.hardware.scan.things import ThingKind
from pigaming_app.jobs.bench.robots import TARGETS
from tests.cases import repeated
from tests.hardware.proof.things_watch import BETWEEN, WatchedMatch, layout_of


def test_outlines_apart_by_a_millimetre_on_all_sides_differ_by_one():
    square = np.array([(0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)])
    misses = distances(square, square + 1.0 * np.sign(square - (50.0, 30.0)), 1.0)
    assert misses == pytest.approx(np.ones(len(misses)))
    assert len(misses) == 320


@pytest.mark.long(first=True)
@pytest.mark.parametrize("first", repeated(range(1, 51, 5)))
def test_in_fifty_scenes_every_thing_is_found_and_no_other(first):
    run = trial(range(first, first + 5))
    assert (run.missed, run.false) == (0, 0)
    assert len(run.means) == 40
    assert max(run.means) <= TARGETS["things_mean_mm"]
    assert max(run.worsts) <= TARGETS["things_worst_mm"]
    assert max(map(abs, run.heights)) < 6.0


@pytest.mark.again  # with the camera from above, of the same scenes
@pytest.mark.long(first=True)
@pytest.mark.parametrize("first", repeated((1, 6)))
def test_a_tilted_camera_of_720p_finds_them_too(first):
    run = trial(range(first, first + 5), tilted=True)
    assert (run.missed, run.false) == (0, 0)
    assert max(run.means) <= TARGETS["things_tilted_mean_mm"]
    assert max(run.worsts) <= TARGETS["things_tilted_worst_mm"]


@pytest.mark.long
def test_a_dark_glossy_phone_is_one_thing_and_what_differs_by_28_percent_is_found():
    """Reflectance of the mat: 0.85. Phones of 8 mm may count as flat."""
    bed, pale = ThingsBed(2), 0.72 * 0.85
    looks = ((-500, -250, 8.0, 0.04), (-150, 200, 8.0, 0.03), (300, -250, 14.0, 0.05), (-450, 220, 8.0, 0.1))
    true = [box(x, y, 150, 75, high, 0.3 + 0.01 * x, grey, "glossy", 2) for x, y, high, grey in looks]
    true += [box(500, 200, 200, 140, TAPE, 0.2, pale), box(100, 0, 150, 100, TAPE, 0.7, pale, seed=7)]
    bed.furnish(true, [(200.0, 150.0, 0.0), (1400.0, 750.0, 1.0), (1400.0, 150.0, 2.0), (200.0, 750.0, 3.0)])
    found = layout_of(bed.scan()).things
    assert len(found) == len(true)
    for thing in true:
        kinds = [replace(thing, height=20.0 if tall else TAPE) for tall in (True, False)]
        worst = min(min(compare(found, [kind], bed).worsts, default=99.0) for kind in kinds)
        assert worst < 6.0, thing


@pytest.mark.long
def test_white_things_on_a_grey_mat_are_found(monkeypatch):
    """A mat that reflects half the light; of the flat ones, one is brighter and one darker by a third."""
    cloth = renderer._cloth
    monkeypatch.setattr(renderer, "_cloth", lambda random: np.float32(0.5 / 0.85) * cloth(random))
    bed = ThingsBed(2)
    true = [box(-500, -250, 200, 120, 60.0, 0.3, 0.9), box(300, -250, 180, 140, 120.0, 1.0, 0.75)]
    true += [box(-450, 220, 200, 140, TAPE, 0.2, 0.66), box(500, 200, 200, 140, TAPE, 0.2, 0.34)]
    true += [box(-150, 200, 150, 100, 15.0, 0.5, 0.9), box(100, 0, 150, 100, TAPE, 0.7, 0.95)]
    bed.furnish(true, [(200.0, 150.0, 0.0), (1400.0, 750.0, 1.0), (1400.0, 150.0, 2.0), (200.0, 750.0, 3.0)])
    found = layout_of(bed.scan()).things
    assert len(found) == len(true)
    for thing in true:
        assert max(compare(found, [thing], bed).worsts, default=99.0) < 6.0, thing


@pytest.mark.long
def test_an_empty_mat_is_empty_and_a_mat_without_robots_uses_the_projectors_known_place():
    bed = ThingsBed(3)
    places = [(300.0, 200.0, 0.0), (1300.0, 700.0, 1.0), (1300.0, 200.0, 2.0), (800.0, 450.0, 3.0)]
    bed.furnish([], places)
    empty = layout_of(bed.scan())
    assert empty.things == ()
    bed.furnish(BETWEEN, [])
    assert "projector_robots" in str(bed.scan().fault)
    assert [thing.kind for thing in layout_of(bed.scan(empty)).things] == [ThingKind.TALL] * len(BETWEEN)


@pytest.mark.again  # through the screens: test_arena_page
@pytest.mark.long(first=True)
def test_things_are_watched_over_a_match_without_a_false_alarm_until_one_is_pushed():
    match = WatchedMatch(2)
    assert len(layout_of(match.scan).things) == len(BETWEEN)
    assert not match.drive(120.0)
    assert match.watch.checks > 100
    match.push(1)
    assert match.drive(8.0)
