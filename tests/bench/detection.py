"""Share of the pictures in which a driving robot's marker is found, by edge, blur and exposure; and the wizard's rule.

Robots drive at 0.35 m/s over a busy floor with the disc of a match under them, seen by the emulated camera; each marker
is searched as the tracker does, near its place. `main` prints tables of measured and predicted shares, and the weights
of `calibration.quality`; it takes about 6 minutes:

    python -X pigaming -m tests.bench.detection
"""

from collections.abc import Iterator
from itertools import product
from math import cos, sin, tau
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.quality import NEEDED, SPEED, clarity_terms, motion_terms, predicted
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.emulator.objects import BODY_HEIGHT, LID_HEIGHT, MARKER, FlatObject, body, lid
from pigaming_app.hardware.emulator.optics import SENSOR, Optics, TrueLens
from pigaming_app.hardware.emulator.renderer import CameraScene, SceneRenderer
from pigaming_app.hardware.session.lighting import DISC, GREY, busy_floor
from pigaming_app.hardware.vision.markers import MarkerDetector, SearchWindow
from pigaming_app.sim.world import HEIGHT, WIDTH

CLOSE = TrueLens(focal=2100.0)
SIZES = (1920, 1600, 1440, 1280, 1120, 960, 800)  # px, width of the picture
CAMERAS: tuple[tuple[int, TrueLens | None], ...] = ((1920, CLOSE), *((width, None) for width in SIZES))
DEFOCUS = (0.0, 0.7, 1.1, 1.5, 1.9, 2.3, 2.8)  # px, beyond the blur of a sharp picture
EXPOSURES = (1 / 250, 1 / 120, 1 / 80, 1 / 60, 1 / 50, 1 / 45, 1 / 40, 1 / 35, 1 / 30)  # s
PICTURES = 30  # of four robots each, per case
STEPS = 9  # poses in an exposure
ASTRAY = 4.0  # px, error of the tracker's prediction
NEAR = 3.0  # px from the truth within which a marker counts as found

Floats = NDArray[np.float64]


class Sample(NamedTuple):
    """A marker in a picture: edge and blur in px, exposure in s."""

    edge: float
    blur: float
    exposure: float
    found: bool


Cases = dict[tuple[tuple[int, TrueLens | None], float, float], list[Sample]]


def samples(
    width: int, defocus: float, exposure: float, pictures: int = PICTURES, lens: TrueLens | None = None, seed: int = 1
) -> Iterator[Sample]:
    """Markers of four robots in pictures `width` px wide with this defocus, px, and exposure, s."""
    optics, random = Optics(lens), np.random.default_rng((seed, width, round(defocus * 10), round(1 / exposure)))
    size = (width, width * 9 // 16)
    painter = SceneRenderer(optics, seed, pictures + 1, size=size, defocus=defocus)
    detector, floor, scale = MarkerDetector(range(4)), busy_floor(seed), width / SENSOR[0]
    blur = float(np.hypot(_sharp(optics, scale), defocus))
    for number in range(pictures):
        image, things, truths = floor.copy(), [], []
        for robot in range(4):
            x, y = random.uniform((60.0, 60.0), (WIDTH / 2 - 60.0, HEIGHT / 2 - 60.0))
            place = np.array([(x + WIDTH / 2 * (robot % 2), y + HEIGHT / 2 * (robot // 2))]) + ARENA_AT
            cv2.circle(image, (round(place[0, 0]), round(place[0, 1])), round(DISC), GREY, -1)
            (x, y), heading = optics.mat(place)[0].tolist(), random.uniform(0.0, tau)
            ways = [SPEED * exposure * (i / (STEPS - 1) - 0.5) for i in range(STEPS)]
            poses = tuple((x + way * cos(heading), y + way * sin(heading), heading) for way in ways)
            things += [FlatObject(body(), BODY_HEIGHT, poses[:1], dark=True), FlatObject(lid(robot), LID_HEIGHT, poses)]
            truths.append((x, y))
        picture = painter.paint(CameraScene(image, tuple(things), 0.1, 1.0, number))
        for robot, (x, y) in enumerate(truths):
            edge = scale * _edge(optics, x, y)
            at = (optics.sensor(np.array([(x, y)]), LID_HEIGHT)[0] + 0.5) * scale - 0.5
            aside = at + random.normal(0.0, ASTRAY * scale, 2)
            mark = detector.detect_in(picture, SearchWindow(*aside, 1.1 * edge + 6.0 + ASTRAY, edge), robot)
            found = mark is not None and bool(np.hypot(*(mark.corners.mean(axis=0) - at)) < NEAR)
            yield Sample(edge, blur, exposure, found)


def _edge(optics: Optics, x: float, y: float) -> float:
    """The shorter side of a marker at a place of the mat, px of the sensor."""
    here, right, down = optics.sensor(np.array([(x, y), (x + 1.0, y), (x, y + 1.0)]), LID_HEIGHT)
    return MARKER * float(np.linalg.svd(np.stack([right - here, down - here], axis=1), compute_uv=False).min())


def _sharp(optics: Optics, scale: float) -> float:
    """Blur of a sharp picture, px: lens and footprint of a px (`objects.SOFT`), averaged where it is scaled down."""
    return float(np.hypot(0.8 * scale, np.sqrt((1.0 - scale * scale) / 12.0)))


def fitted(found: list[Sample]) -> tuple[list[float], list[float]]:
    """Weights of the rule's two factors, by expectation maximisation: each miss is shared out between them."""
    motion = np.array([motion_terms(sample.exposure) for sample in found])
    clarity = np.array([clarity_terms(sample.edge, sample.blur, sample.exposure) for sample in found])
    hits = np.array([sample.found for sample in found], dtype=float)
    one, other = np.zeros(motion.shape[1]), np.zeros(clarity.shape[1])
    one[0] = other[0] = 2.0
    for _ in range(60):
        p, q = _shares(motion, one), _shares(clarity, other)
        missed = np.maximum(1.0 - p * q, 1e-9)
        one = _newton(motion, np.where(hits > 0.0, 1.0, p * (1.0 - q) / missed), one)
        other = _newton(clarity, np.where(hits > 0.0, 1.0, q * (1.0 - p) / missed), other)
    return [round(weight, 2) for weight in one.tolist()], [round(weight, 2) for weight in other.tolist()]


def _shares(rows: Floats, weights: Floats) -> Floats:
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(rows @ weights, -30.0, 30.0))))


def _newton(rows: Floats, wanted: Floats, weights: Floats) -> Floats:
    """Some steps of a logistic regression."""
    for _ in range(3):
        found = _shares(rows, weights)
        curve = (rows * (found * (1.0 - found))[:, None]).T @ rows + 1e-6 * np.eye(rows.shape[1])
        weights = weights + np.linalg.solve(curve, rows.T @ (wanted - found))
    return weights


def share(found: list[Sample]) -> float:
    return sum(sample.found for sample in found) / len(found)


def rule(found: list[Sample]) -> float:
    """Mean predicted share."""
    return float(np.mean([predicted(*sample[:3]) for sample in found]))


def table(cases: Cases, exposure: float) -> None:
    """Print measured and predicted shares, %, by edge (rows) and blur (columns), px."""
    print(f"\nexposure 1/{round(1 / exposure)} s: found / predicted, %")
    for camera in CAMERAS:
        row = [cases[camera, defocus, exposure] for defocus in DEFOCUS]
        edge = float(np.mean([sample.edge for sample in row[0]]))
        cells = [f"{found[0].blur:.1f}: {100 * share(found):3.0f}/{100 * rule(found):3.0f}" for found in row]
        print(f"edge {edge:4.1f} px   " + "   ".join(cells))


def main() -> None:
    """Print tables, weights, and the cases of the field."""
    cases: Cases = {}
    for camera, defocus, exposure in product(CAMERAS, DEFOCUS, EXPOSURES):
        cases[camera, defocus, exposure] = list(samples(camera[0], defocus, exposure, lens=camera[1]))
    for exposure in EXPOSURES:
        table(cases, exposure)
    motion, clarity = fitted([sample for found in cases.values() for sample in found])
    errors = [rule(found) - share(found) for found in cases.values()]
    accepted = [share(found) for found in cases.values() if rule(found) >= NEEDED]
    print(f"\nMOTION = {motion}, CLARITY = {clarity}")
    print(f"error of the rule: {100 * np.mean(np.abs(errors)):.1f} % on average, at most {100 * max(errors):+.0f} %")
    print(f"accepted: {len(accepted)} of {len(cases)}; found in the worst of them: {100 * min(accepted):.0f} %")
    traits = TRAITS["tilted"]
    tilted = list(samples(traits.size[0], traits.defocus, 1 / 60, 60, traits.lens))
    edges = [sample.edge for sample in tilted]
    print(f"720p tilted: edge {min(edges):.1f} to {max(edges):.1f} px, {100 * share(tilted):.0f} % found")


if __name__ == "__main__":
    main()
