"""A scan takes each picture when the camera really shows it, and says why it cannot go on.

Heights from fringes, against geometry written down once more: a ray of the camera meets a ray of the projector.
"""

import cv2
import numpy as np
import pytest

from pigaming_app.hardware.scan.expected import Light
from pigaming_app.hardware.scan.heights import Rectified, surface
from pigaming_app.hardware.scan.patterns import PATTERNS
from pigaming_app.hardware.scan.procedure import Scan, _has_moved
from pigaming_app.hardware.scan.projector_place import projector_place
from pigaming_app.hardware.scan.things import ProjectorPlace
from pigaming_app.hardware.scan.watch import PATIENCE, ThingsWatch
from pigaming_app.hardware.signals import CameraFrame
from tests.hardware.mat import nominal
from tests.hardware.sentences import sentence

SIZE = (640, 360)
TICK = 1 / 30  # s
FRINGED = (960, 540)
GROUND = nominal(FRINGED)
LAMP = ProjectorPlace((700.0, 20.0), 2700.0)
ROBOTS = [(300.0, 250.0), (1300.0, 260.0), (1250.0, 700.0)]
BOX = (900.0, 1000.0, 420.0, 480.0)  # canvas px: left, right, top, bottom of the picture of a box's top


class Mat:
    """A flat mat under a projector whose light comes `late` pictures after it was drawn, of a strength.

    `hand`: pictures of the scan for which a hand is over the mat, of grey levels as a share of the mat's.
    """

    def __init__(self, late, light=0.6, hand=(), grey=0.5):
        self.now, self.late, self.light, self.hand, self.grey = 0.0, late, light, hand, grey
        self.scan = Scan(nominal(SIZE), lambda: self.now)
        self.shown, self.used = [], []
        self.cards = {id(p): cv2.resize(p.picture(), SIZE, interpolation=cv2.INTER_AREA) for p in PATTERNS}

    def run(self):
        noise = np.random.default_rng(1).normal(0.0, 2.0, (7, SIZE[1], SIZE[0]))
        for number in range(300):
            if self.scan.pattern is None:
                break
            pattern = self.scan.pattern
            self.scan.mark_shown(pattern)
            self.shown.append(pattern)
            self.now += TICK
            card = self.cards[id(self.shown[max(0, len(self.shown) - 1 - self.late)])]
            seen = 40 + self.light * card + noise[number % 7]
            if len(self.scan._pictures) in self.hand:
                seen[160:256, 320:384] *= self.grey
            image = seen.clip(0, 255).astype(np.uint8)
            self.scan.process(CameraFrame(image, self.now, number))
        return self.scan


@pytest.mark.parametrize("late", [0, 3, 9])
def test_every_picture_is_taken_when_its_light_has_come(late):
    mat = Mat(late)
    scan = mat.run()
    assert scan.computing
    for pattern, picture in zip(PATTERNS, scan._pictures, strict=True):
        assert np.abs(picture - 40 - 0.6 * mat.cards[id(pattern)]).max() < 9.0
    assert mat.now < 6.0 + 0.5 * late


@pytest.mark.parametrize(
    ("hand", "grey"),
    [((0, 1), 0.5), (range(8, 14), 0.9), ((4,), 0.6), (range(5, 8), 1.15)],
    ids=["in white and black", "a pale thing put down", "in one picture", "in one set of fringes"],
)
def test_something_that_moves_during_a_scan_is_noticed(hand, grey):
    scan = Mat(1, hand=hand, grey=grey).run()
    scan.compute()
    assert scan.fault is not None
    assert "moved" in sentence(scan.fault)


def test_what_stays_is_no_motion_and_a_glaring_picture_is_named():
    assert not _has_moved(Mat(1, hand=range(14)).run()._pictures)
    glaring = Mat(1, light=1.5, hand=range(14)).run()
    glaring.compute()
    assert "bright" in sentence(glaring.fault)


def test_without_projected_light_the_projector_is_named():
    assert "projector" in sentence(Mat(0, light=0.0).run().fault)


class Eyes(ThingsWatch):
    """A watch over masks given by the test."""

    def __init__(self, *masks):
        self.masks = iter(masks)
        super().__init__(type("Expected", (), {"ground": nominal()})(), lambda: 0.0)

    def disagreement(self, image, canvases, robots):
        return next(self.masks)


def spot(x, y):
    mask = np.zeros((180, 320), bool)
    mask[y : y + 6, x : x + 6] = True
    return mask


@pytest.mark.parametrize(
    ("masks", "changed"),
    [
        ([spot(50, 50)] * PATIENCE, True),
        ([spot(50 + 40 * i, 50) for i in range(PATIENCE)], False),
        ([spot(50, 50)] * (PATIENCE - 1), False),
    ],
    ids=["a thing was moved", "a hand passed", "not yet"],
)
def test_things_have_moved_if_the_same_place_disagrees_in_a_row(masks, changed):
    watch = Eyes(*masks)
    for _ in masks:
        watch.check(np.zeros((2, 2), np.uint8), [], [])
    assert watch.changed == changed
    assert watch.places == ([pytest.approx((158.0, 178.0))] if changed else [])


class Mirror:
    """An expectation of a mat in room light alone, whose camera pictures are given as grey levels of its cells."""

    def __init__(self, room):
        self.room, self.usable = room, np.ones(room.shape, bool)
        self.ground, self.projector = nominal(), None

    def seen(self, image):
        return image

    def light(self, shown):
        return Light(self.room, np.zeros_like(self.room), np.zeros_like(self.room))


def disagreement(mirror, seen):
    """Cells in which a watch sees another light than expected."""
    return ThingsWatch(mirror, lambda: 0.0).disagreement(seen, [], [])


@pytest.mark.parametrize("share", [-0.3, 0.4])
def test_a_bright_or_dark_spot_of_room_light_is_no_change_but_a_small_box_in_it_is(share):
    y, x = np.mgrid[0:180, 0:320].astype(np.float32)
    room = np.full((180, 320), 100.0, np.float32) - 0.1 * x
    noise = np.random.default_rng(2).normal(0.0, 1.5, room.shape)
    spot_light = 1.0 + share * np.exp(-(((x - 200) / 80) ** 2) - ((y - 150) / 65) ** 2)
    seen = (room * spot_light + noise).astype(np.float32)
    assert not disagreement(Mirror(room), seen).any()
    seen[140:148, 200:208] *= 0.5
    rows, columns = np.nonzero(disagreement(Mirror(room), seen))
    assert len(rows) >= 50
    assert 139 <= rows.min() <= rows.max() <= 148
    assert 199 <= columns.min() <= columns.max() <= 208


@pytest.mark.parametrize("grey", [0.91, 1.0], ids=["a pale box", "none"])
def test_a_pale_thing_is_seen_beside_the_edges_of_the_old_place_where_the_light_is_unknown(grey):
    room = np.full((180, 320), 100.0, np.float32)
    mirror = Mirror(room)
    mirror.usable[80:90, 150:153] = False  # an edge, where the scan knows no light
    seen = room + np.random.default_rng(3).normal(0.0, 1.0, room.shape).astype(np.float32)
    seen[80:90, 148:155] *= np.float32(grey)  # two cells wide on both sides
    seen[2:12, 40:80] *= np.float32(0.5)  # scores, above the arena
    off = disagreement(mirror, seen)
    assert off.sum() == (40 if grey < 1.0 else 0)
    assert not off[80:90, 150:153].any()


def pictures(height, bend=1.0, dark=1.0):
    """Camera pictures of robots' lids and a plate at a height over a flat mat; `bend`: exponent of the response."""
    v, u = np.mgrid[0 : FRINGED[1], 0 : FRINGED[0]].astype(float)
    seen = np.stack([2.0 * u - 160.0, 2.0 * v - 140.0], axis=-1)  # arena px
    z, light = np.zeros(FRINGED[::-1]), np.full(FRINGED[::-1], 150.0)
    left, right, top, bottom = BOX
    inside = (2.0 * u > left) & (2.0 * u < right) & (2.0 * v > top) & (2.0 * v < bottom)
    z[inside], light[inside] = height, 150.0 * dark
    foot, lamp = np.array(GROUND.foot), np.array(LAMP.foot)
    for robot in ROBOTS:
        lid = foot + (np.array(robot) - foot) * GROUND.height / (GROUND.height - GROUND.lid)
        z[np.hypot(*np.moveaxis(seen - lid, -1, 0)) < 36.0] = GROUND.lid
    point = foot + (seen - foot) * (1.0 - z / GROUND.height)[..., None]
    lit = lamp + (point - lamp) * (LAMP.height / (LAMP.height - z))[..., None] + (160.0, 140.0)
    noise = np.random.default_rng(1)
    result = []
    for pattern in PATTERNS:
        share = np.full(FRINGED[::-1], pattern.level)
        if pattern.fringes is not None:
            axis, period = pattern.fringes
            share = 0.5 + 0.5 * np.cos(2.0 * np.pi * (lit[..., axis] / period - pattern.step / 3.0))
        result.append((40.0 + light * share**bend + noise.normal(0.0, 1.0, FRINGED[::-1])).astype(np.float32))
    return Rectified(GROUND, result)


@pytest.mark.parametrize(("height", "bend", "dark"), [(120.0, 1.0, 1.0), (20.0, 1.6, 1.0), (200.0, 0.7, 0.15)])
def test_a_plate_is_as_high_as_it_is_whatever_its_colour_and_the_projectors_response(height, bend, dark):
    seen = surface(pictures(height, bend, dark), LAMP, slice(430, 470), slice(700, 990))
    top, mat = seen.height[:, 220:280], seen.height[:, 20:160]
    assert float(np.median(top)) == pytest.approx(height, abs=1.0)
    assert float(np.abs(mat).max()) < 6.0
    assert float(seen.misfit[:, 220:280].mean()) < 0.7


def test_robots_of_known_height_show_where_the_projector_is():
    found = projector_place(pictures(100.0), ROBOTS)
    assert found.height == pytest.approx(LAMP.height, rel=0.03)
    assert found.foot == pytest.approx(LAMP.foot, abs=15.0)
