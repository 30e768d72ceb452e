"""The chassis, measured on the meshes that Debian's OpenSCAD makes of it; skipped without openscad."""

import re
import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest

from pigaming_app.sim.drivetrain import MM

ROOT = Path(__file__).resolve().parents[2]
MODEL = ROOT / "docs" / "chassis" / "robot.scad"
PRINTED = ("plate", "lid", "foot", "front")
PAPER = 66.7  # mm, edge of a marker of 50 mm with its white rim
BED = 120.0  # mm, of a small printer
WALL = 1.2  # mm, three lines of a nozzle of 0.4 mm
STEEPEST = 46.0  # degrees from the vertical that are printed without supports
CELLS = 58.0, 31.0, 28.0  # mm, a holder of 2 x 2 cells AA
NUDGE = 1e-3  # mm
COARSE = ("$fn=48",)  # of the assembly: half the sides of a circle that are printed, in a third of the time
CHANGED = "base=78", "lid_top=62"  # of the assembly, beside the model as it is

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not shutil.which("openscad"), reason="no openscad: apt-get install openscad"),
]


@cache
def mesh(part: str, *changes: str) -> Any:
    """The triangles of a part (n, 3 corners, 3), mm."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "part.stl"
        words = ["openscad", "-q", "-o", str(file), "-D", f'part="{part}"']
        for change in (*COARSE, *changes) if part == "assembly" else changes:
            words += ["-D", change]
        subprocess.run([*words, str(MODEL)], check=True, timeout=300, capture_output=True)
        numbers = re.findall(r"vertex (\S+) (\S+) (\S+)", file.read_text(encoding="ascii"))
    triangles = np.array(numbers, float).reshape(-1, 3, 3)
    return triangles[np.lexsort(triangles.reshape(-1, 9).T)]  # OpenSCAD's order differs from run to run


def vertices(triangles: Any) -> Any:
    """The number of each corner (n, 3): equal for corners at the same place."""
    _, numbers = np.unique(triangles.reshape(-1, 3).round(4), axis=0, return_inverse=True)
    return numbers.reshape(-1, 3)


def bodies(triangles: Any) -> list[Any]:
    """The connected bodies of a mesh."""
    numbers = vertices(triangles)
    root = np.arange(numbers.max() + 1)
    while True:  # each corner takes the smallest number in reach
        least = root[numbers].min(axis=1)
        before = root.copy()
        np.minimum.at(root, numbers.ravel(), least.repeat(3))
        root = root[root]
        if (root == before).all():
            return [triangles[root[numbers[:, 0]] == one] for one in np.unique(root[numbers[:, 0]])]


def size(triangles: Any) -> Any:
    corners = triangles.reshape(-1, 3)
    return corners.max(axis=0) - corners.min(axis=0)


def normals(triangles: Any) -> tuple[Any, Any]:
    """Unit normals, and areas."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    lengths = np.linalg.norm(across, axis=1)
    return across / np.maximum(lengths, 1e-12)[:, None], lengths / 2.0


def depth(triangles: Any, points: Any, inward: Any) -> Any:
    """The distance from each point to the next surface along its direction (Möller and Trumbore)."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    found = np.full(len(points), np.inf)
    for i, (point, way) in enumerate(zip(points + NUDGE * inward, inward, strict=True)):
        across = np.cross(way, ac)
        share = (ab * across).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            u = ((point - a) * across).sum(axis=1) / share
            turned = np.cross(point - a, ab)
            v, far = (way * turned).sum(axis=1) / share, (ac * turned).sum(axis=1) / share
            hit = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (far > 0.0) & (abs(share) > 1e-12)
        found[i] = far[hit].min(initial=np.inf)
    return found + NUDGE


@pytest.mark.parametrize("part", PRINTED)
def test_a_part_is_one_closed_body(part: str) -> None:
    triangles = mesh(part)
    numbers = vertices(triangles)
    edges = np.concatenate([numbers[:, [i, (i + 1) % 3]] for i in range(3)])
    there, times = np.unique(edges, axis=0, return_counts=True)
    assert (times == 1).all(), "an edge twice in one direction"
    assert {tuple(edge) for edge in there.tolist()} == {(b, a) for a, b in there.tolist()}, "a hole"
    assert len(bodies(triangles)) == 1
    assert np.einsum("ni,ni->n", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() > 0.0


@pytest.mark.parametrize("part", PRINTED)
def test_a_part_is_printed_flat_and_without_supports(part: str) -> None:
    triangles = mesh(part)
    low = triangles[:, :, 2].min()
    assert low == pytest.approx(0.0, abs=1e-3)
    assert (size(triangles)[:2] <= BED).all()
    ways, areas = normals(triangles)
    lying = (triangles[:, :, 2] <= low + 1e-3).all(axis=1)
    assert areas[lying].sum() > 90.0, "mm² on the bed"
    over = np.degrees(np.arcsin(np.clip(-ways[:, 2], 0.0, 1.0)))
    assert over[~lying & (areas > 1e-6)].max() <= STEEPEST


@pytest.mark.parametrize("part", PRINTED)
def test_walls_are_thick_enough(part: str) -> None:
    triangles, random = mesh(part), np.random.default_rng(1)
    ways, areas = normals(triangles)
    chosen = random.choice(len(triangles), 600, p=areas / areas.sum())
    shares = random.dirichlet((1.0, 1.0, 1.0), 600)
    points = (triangles[chosen] * shares[:, :, None]).sum(axis=1)
    thin = depth(triangles, points, -ways[chosen]) < WALL
    assert thin.mean() <= 0.01, "at sharp corners only"


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ("diameter=60;base=50", "base"),
        ("diameter=60", "diameter"),
        ("caster_h=21", "caster_h"),
        ("lid_top=35", "lid_top"),
    ],
)
def test_sizes_that_make_no_robot_are_refused_by_name(tmp_path: Path, change: str, named: str) -> None:
    words = ["openscad", "-o", str(tmp_path / "robot.stl"), "-D", change, str(MODEL)]
    told = subprocess.run(words, timeout=60, capture_output=True, text=True, check=False)
    assert told.returncode != 0
    assert f'"{named}: ' in told.stderr


@pytest.mark.parametrize(
    "change", ["wheel_d=34", "motor=[26, 12, 10]", "base=78", "lid_top=62", "diameter=110;base=96"]
)
def test_other_sizes_are_not(tmp_path: Path, change: str) -> None:
    words = ["openscad", "-o", str(tmp_path / "robot.csg"), "-D", change, str(MODEL)]
    told = subprocess.run(words, timeout=60, capture_output=True, text=True, check=True)
    assert "ERROR" not in told.stderr


def wheels(triangles: Any) -> list[Any]:
    """The bodies that are wheels."""
    return [body for body in bodies(triangles) if size(body) == pytest.approx((7.0, 32.0, 32.0), abs=0.1)]


@pytest.mark.parametrize("base", [82.0, pytest.param(78.0, marks=pytest.mark.again)])
def test_the_wheels_are_where_the_model_says(base: float) -> None:
    triangles = mesh("assembly", *(CHANGED if base != 82.0 else ()))
    one, two = (body.reshape(-1, 3) for body in wheels(triangles))
    middles = [(body.max(axis=0) + body.min(axis=0)) / 2.0 for body in (one, two)]
    assert abs(middles[0][0] - middles[1][0]) == pytest.approx(base, abs=0.05)
    assert middles[0][1:] == pytest.approx((0.0, 16.0), abs=0.05)


@pytest.mark.parametrize("top", [70.0, pytest.param(62.0, marks=pytest.mark.again)])
def test_the_marker_is_level_at_the_height_of_the_lids_and_the_robot_as_wide_as_in_the_games(top: float) -> None:
    triangles = mesh("assembly", *(CHANGED if top != 70.0 else ()))
    corners = triangles.reshape(-1, 3)
    assert corners[:, 2].max() == pytest.approx(top, abs=0.05)
    assert corners[:, 2].min() == pytest.approx(0.0, abs=0.11), "wheels and caster on the mat"
    ways, areas = normals(triangles)
    plane = (triangles[:, :, 2] > top - 0.05).all(axis=1) & (ways[:, 2] > 0.999)
    inside = abs(triangles[plane].mean(axis=1)[:, :2]).max()
    assert areas[plane].sum() > 0.9 * np.pi * 47.5**2
    assert inside <= 47.5
    assert np.hypot(corners[:, 0], corners[:, 1]).max() * 2.0 == pytest.approx(72 * MM, abs=0.6)


def test_it_stands_on_wheels_and_rear_caster_and_brakes_onto_the_front_one() -> None:
    """The cells are over the axle: a robot that brakes tips forward, by less than a millimetre, not onto its plate."""
    corners = mesh("assembly").reshape(-1, 3)
    low = corners[corners[:, 2] < 0.15]
    assert low[:, 0].min() < -37.0
    assert low[:, 0].max() > 37.0
    assert -36.0 < low[:, 1].min() < -30.0
    front = corners[(corners[:, 1] > 28.0) & (abs(corners[:, 0]) < 10.0)]
    assert 0.3 < front[:, 2].min() < 1.2
    assert front[front[:, 2] < 1.2][:, 1].mean() == pytest.approx(33.0, abs=0.5)


def test_the_cells_fit_between_plate_and_lid() -> None:
    plate, (wide, long, high) = mesh("plate"), CELLS
    corners = plate.reshape(-1, 3)
    above = corners[corners[:, 2] > 3.0 + 1e-3]
    assert not ((abs(above[:, 0]) < wide / 2) & (abs(above[:, 1]) < long / 2)).any(), "a post stands there"
    assert corners[:, 2].max() - 3.0 > high + 12.0, "and the board on top of them"


def test_the_lid_is_screwed_onto_the_posts() -> None:
    """Holes of the lid and posts of the plate have the same middles: no point of a lid is over a post's hole."""
    plate, lid = (mesh(part).reshape(-1, 3) for part in ("plate", "lid"))
    tops = plate[plate[:, 2] > plate[:, 2].max() - 1e-3]
    rim = lid[(lid[:, 2] < 1e-3) & (np.hypot(lid[:, 0], lid[:, 1]) < 46.0)]
    for body in (tops, rim):
        assert len(body) > 30
    for x, y in ((13.0, 38.5), (-13.0, 38.5), (0.0, -40.0)):
        assert max(abs(x), abs(y)) - 3.4 > PAPER / 2.0, "no screw under the paper of the marker"
        for points, radius in ((tops, 4.0), (rim, 1.7)):
            near = np.hypot(points[:, 0] - x, points[:, 1] - y)
            assert near[near < 6.0].max() == pytest.approx(radius, abs=0.02)
