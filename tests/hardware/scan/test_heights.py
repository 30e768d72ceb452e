"""Heights from fringes, against geometry written down once more: a ray of the camera meets a ray of the projector."""

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from pigaming_app.hardware.scan.heights import Rectified, surface  # noqa: E402
from pigaming_app.hardware.scan.patterns import PATTERNS  # noqa: E402
from pigaming_app.hardware.scan.projector_place import projector_place  # noqa: E402
from pigaming_app.hardware.scan.things import ProjectorPlace  # noqa: E402
from tests.hardware.grounds import nominal  # noqa: E402

SIZE = (960, 540)
GROUND = nominal(SIZE)
LAMP = ProjectorPlace((700.0, 20.0), 2700.0)
ROBOTS = [(300.0, 250.0), (1300.0, 260.0), (1250.0, 700.0)]
BOX = (900.0, 1000.0, 420.0, 480.0)  # canvas px: left, right, top, bottom of the picture of a box's top


def pictures(height, bend=1.0, dark=1.0):
    """Camera pictures of robots' lids and a plate at a height over a flat mat; `bend`: exponent of the response."""
    v, u = np.mgrid[0 : SIZE[1], 0 : SIZE[0]].astype(float)
    seen = np.stack([2.0 * u - 160.0, 2.0 * v - 140.0], axis=-1)  # arena px
    z, light = np.zeros(SIZE[::-1]), np.full(SIZE[::-1], 150.0)
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
        share = np.full(SIZE[::-1], pattern.level)
        if pattern.fringes is not None:
            axis, period = pattern.fringes
            share = 0.5 + 0.5 * np.cos(2.0 * np.pi * (lit[..., axis] / period - pattern.step / 3.0))
        result.append((40.0 + light * share**bend + noise.normal(0.0, 1.0, SIZE[::-1])).astype(np.float32))
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
