"""Share of the pictures in which a driving robot's marker is found, by edge, blur and exposure; and the wizard's rule.

Robots drive at 0.35 m/s over a busy floor with the disc of a match under them, seen by the emulated camera; each marker
is searched as the tracker does, near its place. `main` prints the table and the weights of `calibration.quality`:

    python -X pigaming -m tests.bench.detection
"""

from collections.abc import Iterator
from itertools import product
from math import cos, sin, tau
from typing import NamedTuple

import cv2
import numpy as np

from pigaming_app.hardware.calibration.quality import SPEED, predicted, terms
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.emulator.objects import BODY_HEIGHT, LID_HEIGHT, MARKER, FlatObject, body, lid
from pigaming_app.hardware.emulator.optics import SENSOR, Optics, TrueLens
from pigaming_app.hardware.emulator.renderer import CameraScene, SceneRenderer
from pigaming_app.hardware.session.lighting import DISC, GREY, busy_floor
from pigaming_app.hardware.vision.markers import MarkerDetector, SearchWindow
from pigaming_app.sim.world import HEIGHT, WIDTH

SIZES = (1920, 1600, 1440, 1280, 1120, 960, 800)  # px, width of the picture
DEFOCUS = (0.0, 0.7, 1.1, 1.5, 1.9, 2.2, 2.6, 3.2)  # px, beyond the blur of a sharp picture
EXPOSURES = (1 / 250, 1 / 100, 1 / 60, 1 / 50, 1 / 40, 1 / 30)  # s
PICTURES = 30  # of four robots each, per case
STEPS = 9  # poses in an exposure
ASTRAY = 4.0  # px, error of the tracker's prediction
NEAR = 3.0  # px from the truth within which a marker counts as found


class Sample(NamedTuple):
    """A marker in a picture: edge and blur in px, exposure in s."""

    edge: float
    blur: float
    exposure: float
    found: bool


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


def fitted(found: list[Sample]) -> list[float]:
    """Weights of the rule's terms, a logistic regression by Newton's method."""
    rows = np.array([terms(sample.edge, sample.blur, sample.exposure) for sample in found])
    hits, weights = np.array([sample.found for sample in found], dtype=float), np.zeros(rows.shape[1])
    for _ in range(60):
        share = 1.0 / (1.0 + np.exp(-np.clip(rows @ weights, -30.0, 30.0)))
        curve = (rows * (share * (1.0 - share))[:, None]).T @ rows + 1e-6 * np.eye(rows.shape[1])
        weights += np.linalg.solve(curve, rows.T @ (hits - share))
    return [round(weight, 2) for weight in weights.tolist()]


def share(found: list[Sample]) -> float:
    return sum(sample.found for sample in found) / len(found)


def table(cases: dict[tuple[int, float, float], list[Sample]], exposure: float) -> None:
    """Print measured and predicted shares, %, by edge (rows) and blur (columns), px."""
    print(f"\nexposure 1/{round(1 / exposure)} s: found / predicted, %")
    for width in SIZES:
        row = [cases[width, defocus, exposure] for defocus in DEFOCUS]
        edge = float(np.mean([sample.edge for sample in row[0]]))
        cells = []
        for found in row:
            rule = np.mean([predicted(sample.edge, sample.blur, exposure) for sample in found])
            cells.append(f"{found[0].blur:.1f}: {100 * share(found):3.0f}/{100 * rule:3.0f}")
        print(f"edge {edge:4.1f} px   " + "   ".join(cells))


def main() -> None:
    """Print table, weights, and the cases of the field."""
    cases: dict[tuple[int, float, float], list[Sample]] = {}
    for case in product(SIZES, DEFOCUS, EXPOSURES):
        cases[case] = list(samples(*case))
    for exposure in EXPOSURES:
        table(cases, exposure)
    weights = fitted([sample for found in cases.values() for sample in found])
    errors = [abs(share(found) - np.mean([predicted(*sample[:3]) for sample in found])) for found in cases.values()]
    print(f"\nWEIGHTS = {weights}; mean error of the rule {100 * np.mean(errors):.1f} %")
    traits = TRAITS["tilted"]
    tilted = list(samples(traits.size[0], traits.defocus, 1 / 60, 60, traits.lens))
    edges = [sample.edge for sample in tilted]
    print(f"720p tilted: edge {min(edges):.1f} to {max(edges):.1f} px, {100 * share(tilted):.0f} % found")


if __name__ == "__main__":
    main()
