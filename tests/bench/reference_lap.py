"""Reference lap of each track, lap times of the drivers against it, and their failures.

    python -m tests.bench.reference_lap [RACES]

1000 races by default; exit code 1 where a target is missed.

The reference is a lap by dynamic programming over (x, y, heading), without turbo. The states lie on lines across the
course at each of its 320 points, 3 px apart and up to 40 px into the mud, with headings 2.5 degrees apart. From each
the robot drives an arc to the next line: at full speed as far as its turn rate allows, else slower, in the mud at a
third. The best path is then driven without rounding, and timed. Motors are assumed to have no lag. Paths further off
the course, through the infield, are not searched.

A driver's ratio is the reference over the mean of its flying laps, alone on the track, with its turbo meter always
empty, so that both have the same limits. With turbo, printed beside it, a driver may be faster than the reference.
"""

import argparse
import sys
from collections import deque
from math import atan2, cos, pi, sin
from typing import Any

import numpy as np

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.race.course import POINTS, Course
from pigaming_app.games.race.start import set_rules
from pigaming_app.games.race.state import MAX_LAPS, RaceRules
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import compiled, kernel
from pigaming_app.sim.world import DT, HEIGHT, HZ, RADIUS, ROBOTS, WIDTH

ASIDE, ASIDES = 3.0, 111  # px between states of a line, and their number
LEAN, LEANS = pi / 72, 61  # rad between headings, and their number
BENDS = (-3.0, -2.0, -1.4, -1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0)  # of the full-speed bend
MUDDY = 40.0  # px off the course, limit of the search
NEVER = 1e6
LAPS = 3  # of dynamic programming, until the cost of a further lap is the same from all states
TARGETS = {"hand1": (0.62, 0.85), "hand2": (0.82, 0.95), "hand3": (0.94, 1.01)}
SOLO = 8  # races of a driver alone
MIXTURES = (
    ("hand1", "hand2", "hand3", "hand3"),
    ("hand3", "hand3", "hand1", "hand1"),
    ("hand2", "hand1", "hand3", "hand2"),
    ("hand1", "hand3", "hand2", "hand1"),
    ("hand3", "hand1", "hand3", "hand2"),
)
LOOK = 5  # ticks between two checks of a race
STUCK, STUCK_PX = 3 * HZ, 10.0  # ticks with the stick pushed, and px within which a robot is stuck


def reference(course: Course) -> float:
    """Time of the fastest flying lap, s."""
    rules, nobody = RaceRules(), Seat("off", 0)
    set_rules(rules, Setup("race", "", (nobody, nobody, nobody, nobody), 1.0, 1, "standard"))
    ring = np.zeros((POINTS, 4))  # x, y, way, half
    for i in range(POINTS):
        after = (i + 1) % POINTS
        way = atan2(course.ys[after] - course.ys[i - 1], course.xs[after] - course.xs[i - 1])
        ring[i] = course.xs[i], course.ys[i], way, course.half[i]
    limits = np.array([rules.speed, rules.turn_rate, rules.mud])
    full = rules.turn_rate / rules.speed
    rest = np.zeros((POINTS + 1, ASIDES, LEANS))
    fill_all, drive_all = compiled(fill), compiled(follow)
    for _ in range(LAPS):
        rest[POINTS] = rest[0] - rest[0].min()
        fill_all(rest, ring, np.array(BENDS) * full, limits)
    path = np.zeros((LAPS * POINTS + 1, 3))  # aside, lean, s
    a, b = np.unravel_index(rest[0].argmin(), rest[0].shape)
    path[0] = (a - ASIDES // 2) * ASIDE, (b - LEANS // 2) * LEAN, 0.0
    drive_all(rest, ring, np.linspace(-3.0, 3.0, 241) * full, limits, path)
    return float(path[-1, 2] - path[-1 - POINTS, 2])


@kernel
def step(ring: Any, i: int, aside: float, lean: float, bend: float, limits: Any) -> tuple[float, float, float]:
    """Intersection of an arc from line i with the next: offset, heading, and time in s; NEVER if there is none."""
    here, there = ring[i], ring[(i + 1) % len(ring)]
    x, y = here[0] - aside * sin(here[2]), here[1] + aside * cos(here[2])
    heading = here[2] + lean
    tx, ty = cos(there[2]), sin(there[2])
    straight = (there[0] - x) * tx + (there[1] - y) * ty
    way = straight
    for _ in range(3):
        middle = heading + 0.5 * bend * way
        facing = cos(middle) * tx + sin(middle) * ty
        if facing < 0.2:
            return 0.0, 0.0, NEVER
        way = straight / facing
    if way < 0.0 or way > 100.0:
        return 0.0, 0.0, NEVER
    middle = heading + 0.5 * bend * way
    x, y = x + way * cos(middle), y + way * sin(middle)
    after = (y - there[1]) * tx - (x - there[0]) * ty
    if abs(after) > there[3] + MUDDY or not (RADIUS <= x <= WIDTH - RADIUS and RADIUS <= y <= HEIGHT - RADIUS):
        return 0.0, 0.0, NEVER
    speed = limits[0] * limits[2] if abs(after) > there[3] or abs(aside) > here[3] else limits[0]
    drive, turn = way / speed, abs(bend) * way / limits[1]
    return after, turn_to(heading + bend * way - there[2]), drive if drive > turn else turn


@kernel
def worth(table: Any, aside: float, lean: float) -> float:
    """The table, interpolated."""
    a, b = aside / ASIDE + ASIDES // 2, lean / LEAN + LEANS // 2
    i, j = int(a), int(b)
    if a < 0.0 or b < 0.0 or i >= ASIDES - 1 or j >= LEANS - 1:
        return NEVER
    a, b = a - i, b - j
    low = table[i, j] + a * (table[i + 1, j] - table[i, j])
    high = table[i, j + 1] + a * (table[i + 1, j + 1] - table[i, j + 1])
    between: float = low + b * (high - low)
    return between


def fill(rest: Any, ring: Any, bends: Any, limits: Any) -> None:
    """One lap backwards: the cost-to-go of every state of every line."""
    for i in range(len(ring) - 1, -1, -1):
        for a in range(ASIDES):
            for b in range(LEANS):
                aside, lean = (a - ASIDES // 2) * ASIDE, (b - LEANS // 2) * LEAN
                lowest = NEVER
                if abs(aside) <= ring[i, 3] + MUDDY:
                    for bend in bends:
                        on, turned, cost = step(ring, i, aside, lean, bend, limits)
                        if cost < NEVER:
                            lowest = min(lowest, cost + worth(rest[i + 1], on, turned))
                rest[i, a, b] = lowest


def follow(rest: Any, ring: Any, bends: Any, limits: Any, path: Any) -> None:
    """Drive the best path without rounding; fills `path` from its first row on."""
    for n in range(len(path) - 1):
        i = n % len(ring)
        lowest = 1e9
        for bend in bends:
            on, turned, cost = step(ring, i, path[n, 0], path[n, 1], bend, limits)
            total = cost + worth(rest[i + 1], on, turned)
            if cost < NEVER and total < lowest:
                lowest = total
                path[n + 1, 0], path[n + 1, 1], path[n + 1, 2] = on, turned, path[n, 2] + cost


# ------------------------------------------------------------------------------------------------------------- drivers


def alone(track: str, strength: str, turbo: bool) -> float:
    """Mean time of the flying laps of a driver alone on the track, s."""
    seats = Seat(strength, 0), Seat("off", 1), Seat("off", 2), Seat("off", 3)
    setups = [Setup("race", track, seats, 10.0, seed, "standard", MAX_LAPS) for seed in range(1, SOLO + 1)]
    batch = Batch(setups, [BRAINS["race"][strength]], True)
    if not turbo:
        batch.matches["robots"]["turbo"] = 0.0
        batch.matches["rules"]["turbo_refill"] = 0.0
    batch.play(10 * 60 * HZ)
    return float(batch.matches["racers"]["laps"][:, 0, 1:].mean()) * DT


def race(track: str, strengths: tuple[str, ...], seeds: range) -> dict[str, int]:
    """Races of four drivers: numbers that missed a line, were stuck, or did not finish in time."""
    one, two, three, four = (Seat(strength, i) for i, strength in enumerate(strengths))
    setups = [Setup("race", track, (one, two, three, four), 10.0, seed, "standard") for seed in seeds]
    batch = Batch(setups, [BRAINS["race"][strength] for strength in strengths], True)
    matches, racers = batch.matches, batch.matches["racers"]
    missed = np.zeros((len(setups), ROBOTS), bool)
    stuck = np.zeros((len(setups), ROBOTS), bool)
    trail: deque[Any] = deque(maxlen=STUCK // LOOK + 1)
    while not matches["over"].all():
        batch.play(LOOK)
        missed |= (racers["missed"] > 0) | (racers["void"] > 0)
        robots, actions = matches["robots"], matches["actions"]
        driving = (actions["linear"] != 0.0) & (racers["finished"] == 0) & (matches["over"] == 0)[:, None]
        trail.append((np.stack([robots["x"], robots["y"]], axis=-1), driving))
        if len(trail) == trail.maxlen:
            places, sticks = (np.stack(part) for part in zip(*trail, strict=True))
            moved = np.sqrt(((places - places[0]) ** 2).sum(axis=-1)).max(axis=0)
            stuck |= sticks.all(axis=0) & (moved < STUCK_PX)
    unfinished = racers["finished"] == 0
    return {"missed": int(missed.sum()), "stuck": int(stuck.sum()), "unfinished": int(unfinished.sum())}


def sweep(races: int, first: int = 1) -> tuple[int, dict[str, int]]:
    """At least that many races over all tracks and mixtures of strengths; returns the failures."""
    tracks = arenas("race")
    each = -(-races // (len(tracks) * len(MIXTURES)))
    total = {"missed": 0, "stuck": 0, "unfinished": 0}
    for track in tracks:
        for i, mixture in enumerate(MIXTURES):
            begin = first + i * each
            for name, count in race(track, mixture, range(begin, begin + each)).items():
                total[name] += count
    return each * len(tracks) * len(MIXTURES), total


def main(races: int) -> int:
    """Print the ratios and the sweep; returns the exit code."""
    good = True
    for track in arenas("race"):
        lap = reference(load("race", track).plan.course)
        print(f"{track:10} reference {lap:6.2f} s", end="")
        for strength, (low, high) in TARGETS.items():
            ratio = lap / alone(track, strength, False)
            good &= low <= ratio <= high
            print(
                f"   {strength} {ratio:.3f} (with turbo {lap / alone(track, strength, True):.3f})", end="", flush=True
            )
        print()
    played, wrong = sweep(races)
    print(f"{played} races:", ", ".join(f"{count} {name}" for name, count in wrong.items()))
    return int(not good or any(wrong.values()))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.bench.reference_lap", description=__doc__.splitlines()[0])
    parser.add_argument("races", type=int, nargs="?", default=1000, help="races of four drivers (1000)")
    sys.exit(main(parser.parse_args().races))
