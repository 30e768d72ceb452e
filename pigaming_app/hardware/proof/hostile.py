"""Hostile pictures: floors without any robot that show all that looks like one, seen by the emulated camera.

Markers of every other number and of other families, markers of robots with a single wrong cell, checkers, text, bars
and noise, at all sizes and angles. Whatever a tracker takes for a robot there is a false one.
"""

from collections.abc import Iterator

import numpy as np

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.optics import CANVAS
from pigaming_app.hardware.emulator.renderer import ExposureSetup
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.signals import CameraFrame, Image
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.markers import ROBOT_IDS

BETWEEN = 0.06  # s between two pictures: the tracker searches the whole of each
DECOYS = 14  # in a picture
PHOTOS, SHEETS = 4, 25  # pictures of a floor, in other light; printed floors, each for its share of all pictures
FAMILIES = ("DICT_4X4_50", "DICT_5X5_50", "DICT_6X6_50", "DICT_4X4_250", "DICT_ARUCO_ORIGINAL")
CELLS = 6  # of a robot's marker with its border


def false_robots(bed: Testbed, pictures: int, seed: int = 1) -> int:
    """How many times a tracker takes part of a hostile picture for a robot."""
    tracker, time = Tracker(bed.ground, bed.arena.clock), 0.0
    found = 0
    for number, image in enumerate(_photos(bed, pictures, seed)):
        time += BETWEEN
        found += len(tracker.process(CameraFrame(image, time, number)))
    return found


def hostile_floor(random: np.random.Generator, robots: bool = False) -> Image:
    """A canvas full of decoys, (1080, 1920). `robots`: among them are true markers of robots."""
    import cv2

    page = np.full((CANVAS[1], CANVAS[0]), int(random.integers(0, 200)), np.uint8)
    for _ in range(12):
        (x, y), (wide, high) = random.integers((0, 0), CANVAS), random.integers(8, 180, 2)
        cv2.rectangle(
            page,
            (int(x), int(y)),
            (int(x + wide), int(y + high)),
            int(random.integers(256)),
            int(random.choice([-1, 3])),
        )
    for _ in range(DECOYS):
        edge = 38 if random.random() < 0.6 else int(random.integers(24, 160))  # often as large as on a robot
        decoy = _marker(int(random.choice(ROBOT_IDS))) if robots else _decoy(random)
        _paste(page, decoy, edge, random)
    if random.random() < 0.3:
        page = np.asarray(cv2.add(page, random.integers(0, 60, page.shape, np.uint8)))
    return page


def _photos(bed: Testbed, pictures: int, seed: int) -> Iterator[Image]:
    """What the camera sees of hostile floors."""
    arena, random, per = bed.arena, np.random.default_rng(seed), max(1, pictures // SHEETS)
    arena.cleared = True
    arena.camera.painter.refresh = 1
    floor: Image = np.zeros((CANVAS[1], CANVAS[0]), np.uint8)
    for number in range(pictures):
        if not bed.showing.paper:
            floor = floor if number % PHOTOS else hostile_floor(random)
        elif number % per == 0:
            bed.showing.lay(arena, hostile_floor(random))
        yield arena.camera.painter.paint(_exposed(arena, floor, number, random))


def _exposed(arena: EmulatedArena, floor: Image, number: int, random: np.random.Generator) -> ExposureSetup:
    gain = arena.camera.brightness * float(random.uniform(0.5, 1.5))
    return ExposureSetup(floor, (), float(random.random()), gain, number)


def _decoy(random: np.random.Generator) -> Image:
    """Something that looks like a marker, (cells, cells) or larger, grey; never that of a robot."""
    import cv2

    cells: Image
    match int(random.integers(6)):
        case 0:  # one wrong cell
            cells = _marker(int(random.choice(ROBOT_IDS)))
            y, x = random.integers(1, CELLS - 1, 2)
            cells[y, x] = 255 - cells[y, x]
        case 1:  # checkers
            count = int(random.integers(3, 9))
            cells = np.asarray(np.indices((count, count)).sum(axis=0) % 2 * 255, np.uint8)
        case 2:  # text
            cells = np.full((64, 64), 255, np.uint8)
            cv2.putText(cells, chr(int(random.integers(65, 91))), (10, 52), cv2.FONT_HERSHEY_DUPLEX, 2.0, 0, 5)
        case 3:  # random cells in a black frame
            while True:
                cells = np.pad(np.asarray(random.integers(0, 2, (4, 4)) * 255, np.uint8), 1)
                if not any((np.rot90(cells, turn) == _marker(one)).all() for turn in range(4) for one in ROBOT_IDS):
                    break
        case _:  # another marker
            family = str(random.choice(FAMILIES))
            words = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, family))
            others = [n for n in range(50) if not family.startswith("DICT_4X4") or n not in ROBOT_IDS]
            cells = np.asarray(cv2.aruco.generateImageMarker(words, int(random.choice(others)), words.markerSize + 2))
    return cells


def _marker(number: int) -> Image:
    import cv2

    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    return np.array(cv2.aruco.generateImageMarker(words, number, CELLS), np.uint8)


def _paste(page: Image, decoy: Image, edge: int, random: np.random.Generator) -> None:
    """Lay a decoy on a page at a random place and angle, on a white sheet; `edge`: px of the page."""
    import cv2

    side = 2 * edge
    sheet = np.full((side, side), int(random.integers(150, 256)), np.uint8)
    shape = cv2.resize(decoy, (edge, edge), interpolation=cv2.INTER_NEAREST)
    at = (side - edge) // 2
    sheet[at : at + edge, at : at + edge] = np.minimum(shape, sheet[at : at + edge, at : at + edge])
    turn = cv2.getRotationMatrix2D((side / 2, side / 2), float(random.uniform(0, 360)), 1.0)
    turned = cv2.warpAffine(sheet, turn, (side, side), borderValue=float(sheet[0, 0]))
    x, y = int(random.integers(0, CANVAS[0] - side)), int(random.integers(0, CANVAS[1] - side))
    page[y : y + side, x : x + side] = turned
