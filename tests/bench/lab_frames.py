"""Frame times of the Lab at 60 frames/s while it trains at every speed: a table, compiled and plain, and a network.

    python -m tests.bench.lab_frames [SECONDS]

Twenty seconds of each by default. `work` is the CPU time of the main thread for a frame, `frame` the real time between
two frames. The first line is the time to the first frame. The display is SDL's dummy. Exit code 1 where the work of a
frame exceeds its limit.
"""

import os
import sys
import tempfile
from collections.abc import Callable
from time import perf_counter, thread_time

os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"

import pygame

from pigaming_app.scenes.lab.network.kind_switch import NETWORK
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.scenes.lab.view import SPEEDS
from pigaming_app.sim.kernel import _cache_folder, can_compile
from pigaming_app.ui.input.controls import Controls
from tests.scenes.arcade import Arcade

FPS = 60
MEDIAN, P99 = 4.0, 8.0  # ms of work; plain training adds PLAIN
PLAIN = 8.0  # ms, slice of plain training in a frame
WAITS, PREPARATION = ("compiling", "preparing"), 900.0  # measured until done, s at most
WARM = 60  # frames of warm-up, not counted


def main(seconds: float) -> int:
    """Measure and print; returns the exit code."""
    pygame.display.init()
    arcade = Arcade(Controls())
    began = perf_counter()
    lab = Lab(arcade.context)
    arcade.open(lab)
    arcade.frame(draw=True)
    print(f"first frame: {1000 * (perf_counter() - began):.0f} ms")
    good = True
    if can_compile():
        good &= measured("compiling", arcade, lab, seconds, lambda: lab.table.fast)
        for lab.table.speed in range(len(SPEEDS)):
            good &= measured("compiled", arcade, lab, seconds)
        lab.show_kind(NETWORK)
        good &= measured("preparing", arcade, lab, seconds, lambda: bool(lab.network.progress.measures))
        for lab.network.speed in range(len(SPEEDS)):
            lab.begin()
            good &= measured("network", arcade, lab, seconds)
            print(f"           wins {[round(measure.share, 2) for measure in lab.network.progress.measures]}")
    lab.network.end()
    lab.table.close()
    lab.table.join()
    plain = Lab(arcade.context, fast=False)
    arcade.open(plain)
    for plain.table.speed in range(len(SPEEDS)):
        good &= measured("plain", arcade, plain, seconds)
    return 0 if good else 1


def measured(name: str, arcade: Arcade, lab: Lab, seconds: float, done: Callable[[], bool] = lambda: False) -> bool:
    """Run frames for `seconds`, or until `done`; true if their work is within the limits."""
    clock, work, frames = pygame.time.Clock(), [], []
    began = last = perf_counter()
    matches = lab.trainer.snapshot.matches
    while last - began < (PREPARATION if name in WAITS else seconds) and not done():
        now, busy = perf_counter(), thread_time()
        arcade.frame(min(0.1, now - last), draw=True)
        work.append(1000 * (thread_time() - busy))
        frames.append(1000 * (now - last))
        last = now
        clock.tick(FPS)
    matches = lab.trainer.snapshot.matches - matches
    slice_ms = PLAIN if name in ("compiling", "plain") else 0.0
    work, frames = sorted(work[WARM:]), sorted(frames[WARM:])
    if not work:
        print(f"{name:9}  too short to tell: it was compiled before")
        return True
    median, p99 = work[len(work) // 2], work[int(0.99 * len(work))]
    frame_text = (
        f"frame median {frames[len(frames) // 2]:.1f} p99 {frames[int(0.99 * len(frames))]:.1f} max {frames[-1]:.1f}"
    )
    work_text = f"{name:9} {SPEEDS[lab.trainer.speed]:>3}  work median {median:.2f} p99 {p99:.2f} ms"
    print(f"{work_text}  {frame_text} ms  {matches} matches")
    return median <= MEDIAN + slice_ms and p99 <= P99 + slice_ms


if __name__ == "__main__":
    os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))
    with tempfile.TemporaryDirectory() as home:
        os.environ["PIGAMING_HOME"] = home
        sys.exit(main(float(sys.argv[1]) if len(sys.argv) > 1 else 20.0))
