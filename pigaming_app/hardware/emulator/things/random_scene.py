"""Random scenes of things: boxes (dark, of the mat's colour, striped), cups, a plate of 20 mm, and two strips of tape.

The tape is 25 mm wide; four robots stand around. Nothing hides or shades anything flat, or a robot.
"""

from collections.abc import Sequence
from math import hypot, pi
from random import Random

import numpy as np

from pigaming_app.hardware.emulator.optics import Optics
from pigaming_app.hardware.emulator.things.prism import TAPE, Prism, box, cylinder
from pigaming_app.sim.plant import Pose

FREE = 700.0, 420.0  # mm: things stand within these distances of the middle
AWAY = 190.0  # mm between the things of `some_things` and the places of robots
MIX = (2, 6, 0, 4, 3, 7, 1, 5)  # order in which it takes things: box, cup, tape, book, box, cup, tape, box
TRIES = 1000  # scenes
GAPS = (70.0, 190.0, 170.0)  # mm between tall things, around flat ones, around robots


def scene(seed: int, optics: Optics) -> tuple[list[Prism], list[Pose]]:
    """Eight random things (mm on the mat), and the poses of four robots (arena px and rad)."""
    random = Random(f"things {seed}")
    taken: list[tuple[float, float, float, int]] = []  # place, radius, index in GAPS

    def place(radius: float, sort: int) -> tuple[float, float]:
        for _ in range(20000):
            x, y = random.uniform(-FREE[0], FREE[0]), random.uniform(-FREE[1], FREE[1])
            if all(hypot(x - u, y - v) > radius + r + GAPS[max(sort, s)] for u, v, r, s in taken):
                taken.append((x, y, radius, sort))
                return x, y
        raise RuntimeError("no room for a thing")

    robots = []
    for i in range(4):
        x, y = (-900.0 if i in (0, 3) else 900.0), (-400.0 if i < 2 else 400.0)
        x, y = x + random.uniform(-60.0, 60.0), y + random.uniform(-60.0, 60.0)
        taken.append((x, y, 50.0, 2))
        u, v = (optics.canvas(np.array([(x, y)]))[0] - (160.0, 140.0)).tolist()
        robots.append((u, v, random.uniform(-pi, pi)))
    things = []
    for i, grey in enumerate((random.uniform(0.12, 0.3), 0.08)):  # the tapes first: they need most room
        long = random.uniform(150.0, 300.0) if i == 0 else random.uniform(120.0, 200.0)
        x, y = place(0.35 * long, 1)
        things.append(box(x, y, long, 25.0, TAPE, random.uniform(0.0, pi), grey, seed=seed + i))
    looks = ((0.85, "plain"), (0.07, "plain"), (0.45, "printed"), (0.6, "striped"), (0.9, "plain"), (0.3, "cloudy"))
    for i, (grey, look) in enumerate(looks):
        turn, high = random.uniform(0.0, pi), random.uniform(60.0, 180.0)
        if i >= 4:
            radius = random.uniform(32.0, 50.0)
            things.append(cylinder(*place(radius, 0), radius, high, grey, look, seed + i))
            continue
        long, wide = random.uniform(70.0, 170.0), random.uniform(60.0, 100.0)
        high = 20.0 if i == 2 else high
        long, wide = (200.0, 140.0) if i == 2 else (long, wide)
        x, y = place(0.5 * hypot(long, wide), 0)
        things.append(box(x, y, long, wide, high, turn, grey, look, seed + i))
    return things, robots


def some_things(seed: int, count: int, optics: Optics, places: Sequence[Pose]) -> list[Prism]:
    """At most eight random things, mm on the mat, away from these places of robots, arena px and rad."""
    robots = optics.mat(np.array([(x + 160.0, y + 140.0) for x, y, _ in places]))
    for attempt in range(TRIES):
        things, _ = scene(seed + 1000 * attempt, optics)
        chosen = [things[i] for i in MIX[:count]]
        if all(float(np.hypot(*(robots - one.middle).T).min()) > one.reach + AWAY for one in chosen):
            return chosen
    raise RuntimeError("no room for things")
