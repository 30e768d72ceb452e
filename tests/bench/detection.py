"""Share of the pictures in which a driving robot's marker is found, by edge, blur and exposure; and the prediction.

Robots drive at 0.35 m/s over a busy floor with the disc of a match under them, seen by the emulated camera with a
rolling shutter and JPEG; each marker is searched as the tracker does, near its place. `main` prints the tables of
docs/hardware.md, measured and predicted by the wizard; it takes about 6 minutes:

    python -X pigaming -m tests.bench.detection
"""

from collections.abc import Iterator, Sequence
from itertools import product
from math import cos, sin, tau
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from pigaming_app.hardware.calibration.detection import SPEED, found_share
from pigaming_app.hardware.calibration.quality import NEEDED
from pigaming_app.hardware.emulator.arena import ARENA_AT
from pigaming_app.hardware.emulator.camera import TRAITS
from pigaming_app.hardware.emulator.objects import BODY_HEIGHT, LID_HEIGHT, MARKER, FlatObject, body, lid
from pigaming_app.hardware.emulator.optics import SENSOR, Optics, TrueLens
from pigaming_app.hardware.emulator.renderer import ExposureSetup, SceneRenderer
from pigaming_app.hardware.session.lighting import DISC, GREY, busy_floor
from pigaming_app.hardware.vision.markers import ROBOT_IDS, MarkerDetector, SearchWindow
from pigaming_app.sim.world import HEIGHT, WIDTH

CLOSE = TrueLens(focal=2100.0)
SIZES = (1920, 1600, 1440, 1280, 1120, 960, 800)  # px, width of the picture
CAMERAS: tuple[tuple[int, TrueLens | None], ...] = ((1920, CLOSE), *((width, None) for width in SIZES))
DEFOCUS = (0.0, 0.7, 1.1, 1.5, 1.9, 2.3, 2.8)  # px, beyond the blur of a sharp picture
EXPOSURES = (1 / 120, 1 / 80, 1 / 60, 1 / 50, 1 / 45, 1 / 40, 1 / 35, 1 / 30)  # s
READOUT, JPEG = 1 / 40, 80  # s from the first row to the last; quality
PICTURES = 30  # of four robots each, per case
STEPS = 9  # poses in an exposure
ASTRAY = 4.0  # px, error of the tracker's prediction
NEAR = 0.15  # edges from the truth within which a marker counts as found

Floats = NDArray[np.float64]


class Sample(NamedTuple):
    """A marker in a picture: its number, edge and blur in px, exposure in s."""

    number: int
    edge: float
    blur: float
    exposure: float
    found: bool


Cases = dict[tuple[tuple[int, TrueLens | None], float, float], list[Sample]]


def samples(
    width: int,
    defocus: float,
    exposure: float,
    pictures: int = PICTURES,
    lens: TrueLens | None = None,
    seed: int = 1,
    numbers: Sequence[int] = ROBOT_IDS,
) -> Iterator[Sample]:
    """Markers of four robots in pictures `width` px wide with this defocus, px, and exposure, s."""
    optics, random = Optics(lens), np.random.default_rng((seed, width, round(defocus * 10), round(1 / exposure)))
    size = (width, width * 9 // 16)
    painter = SceneRenderer(optics, seed, pictures + 1, size=size, defocus=defocus, jpeg=JPEG)
    detector, floor, scale = MarkerDetector(numbers), busy_floor(seed), width / SENSOR[0]
    blur = float(np.hypot(_sharp(optics, scale), defocus))
    for shot in range(pictures):
        image, things, truths = floor.copy(), [], []
        for robot, number in enumerate(numbers):
            x, y = random.uniform((60.0, 60.0), (WIDTH / 2 - 60.0, HEIGHT / 2 - 60.0))
            place = np.array([(x + WIDTH / 2 * (robot % 2), y + HEIGHT / 2 * (robot // 2))]) + ARENA_AT
            cv2.circle(image, (round(place[0, 0]), round(place[0, 1])), round(DISC), GREY, -1)
            (x, y), heading = optics.mat(place)[0].tolist(), random.uniform(0.0, tau)
            ways = [SPEED * exposure * ((i + 0.5) / STEPS - 0.5) for i in range(STEPS)]
            poses = tuple((x + way * cos(heading), y + way * sin(heading), heading) for way in ways)
            pace = SPEED * READOUT / SENSOR[1]
            slant = pace * cos(heading), pace * sin(heading)
            things += [
                FlatObject(body(), BODY_HEIGHT, poses[:1], dark=True),
                FlatObject(lid(number), LID_HEIGHT, poses, slant=slant),
            ]
            truths.append((x, y))
        picture = painter.paint(ExposureSetup(image, tuple(things), 0.1, 1.0, shot))
        for number, (x, y) in zip(numbers, truths, strict=True):
            edge = scale * _edge(optics, x, y)
            at = (optics.sensor(np.array([(x, y)]), LID_HEIGHT)[0] + 0.5) * scale - 0.5
            u, v = at + random.normal(0.0, ASTRAY * scale, 2)
            mark = detector.detect_in(picture, SearchWindow(u, v, 1.1 * edge + 6.0 + ASTRAY, edge), number)
            found = mark is not None and bool(np.hypot(*(mark.corners.mean(axis=0) - at)) < NEAR * edge)
            yield Sample(number, edge, blur, exposure, found)


def _edge(optics: Optics, x: float, y: float) -> float:
    """The shorter side of a marker at a place of the mat, px of the sensor."""
    here, right, down = optics.sensor(np.array([(x, y), (x + 1.0, y), (x, y + 1.0)]), LID_HEIGHT)
    return MARKER * float(np.linalg.svd(np.stack([right - here, down - here], axis=1), compute_uv=False).min())


def _sharp(optics: Optics, scale: float) -> float:
    """Blur of a sharp picture, px: lens and footprint of a px (`objects.SOFT`), averaged where it is scaled down."""
    return float(np.hypot(0.8 * scale, np.sqrt((1.0 - scale * scale) / 12.0)))


def share(found: list[Sample]) -> float:
    return sum(sample.found for sample in found) / len(found)


def prediction(found: list[Sample]) -> float:
    """Mean predicted share, each marker at the mean edge of its sights."""
    numbers = sorted({sample.number for sample in found})
    edges = [float(np.mean([sample.edge for sample in found if sample.number == number])) for number in numbers]
    look = found[0].blur, found[0].exposure
    return float(np.mean([found_share(number, edge, *look) for number, edge in zip(numbers, edges, strict=True)]))


def cell(found: list[Sample]) -> str:
    return f"{100 * share(found):.0f} / {100 * prediction(found):.0f}"


def row(cells: list[list[Sample]]) -> str:
    """A row of a table: edge, then found / predicted, %."""
    edge = float(np.mean([sample.edge for sample in cells[0]]))
    return f"| {edge:.0f} px | {' | '.join(cell(found) for found in cells)} |"


def main() -> None:
    """Print the tables, the error of the prediction, and the case of the field."""
    cases: Cases = {}
    for camera, defocus, exposure in product(CAMERAS, DEFOCUS, EXPOSURES):
        if defocus and exposure != 1 / 60:
            continue
        cases[camera, defocus, exposure] = list(samples(camera[0], defocus, exposure, lens=camera[1]))
    print("blur:", *(f"{cases[CAMERAS[0], defocus, 1 / 60][0].blur:.1f}" for defocus in DEFOCUS))
    for camera in CAMERAS:
        print(row([cases[camera, defocus, 1 / 60] for defocus in DEFOCUS]))
    print("exposure:", *(f"1/{round(1 / exposure)}" for exposure in EXPOSURES))
    for camera in CAMERAS:
        print(row([cases[camera, 0.0, exposure] for exposure in EXPOSURES]))
    errors = [prediction(found) - share(found) for found in cases.values()]
    accepted = [share(found) for found in cases.values() if prediction(found) >= NEEDED]
    print(f"\nerror: {100 * np.mean(np.abs(errors)):.1f} % on average, at most {100 * max(errors, key=abs):+.0f} %")
    print(f"accepted: {len(accepted)} of {len(cases)}; found in the worst of them: {100 * min(accepted):.0f} %")
    traits = TRAITS["tilted"]
    tilted = list(samples(traits.size[0], traits.defocus, 1 / 60, 60, traits.lens))
    edges = [sample.edge for sample in tilted]
    print(f"720p tilted: edge {min(edges):.1f} to {max(edges):.1f} px, {100 * share(tilted):.0f} % found")


if __name__ == "__main__":
    main()
