"""Matches a second of the Lab's training with a table: alone, and at *max* on the page while it is drawn.

    python -m tests.bench.lab_rate [--bursts 60] [--seconds 60]

Alone, each burst of twenty matches is counted by its processor time, so that other programs hardly matter. On the page
the numbers are those that it shows, twice a second, after its first evaluations; `--seconds`: for which it is shown, 60
pictures a second. Needs the extra train.
"""

import argparse
import os
from collections.abc import Sequence
from statistics import median
from time import clock_gettime, perf_counter, process_time, pthread_getcpuclockid, sleep

from pigaming_app.ai.learning.evaluation import compile_all
from pigaming_app.ai.learning.training import MINUTES, TableTraining
from pigaming_app.scenes.lab.progress import EXAMS_PER_CURVE
from pigaming_app.scenes.lab.scene import FIRST, Lab
from pigaming_app.scenes.lab.sides import WINDOW
from pigaming_app.scenes.lab.trainer import FASTEST
from pigaming_app.sim.world import HZ
from pigaming_app.ui.input.controls import Controls
from tests.scenes.arcade import Arcade

BURST = 20  # matches
FRAME = 1 / 60  # s
FIRST_MATCHES = 8 * EXAMS_PER_CURVE  # after which most of the time is the training's, and the number is its


def main(arguments: Sequence[str] | None = None) -> None:
    """Print both."""
    parser = argparse.ArgumentParser(prog="lab_rate")
    parser.add_argument("--bursts", type=int, default=60)
    parser.add_argument("--seconds", type=float, default=60.0)
    args = parser.parse_args(arguments)
    compile_all()
    report("alone, in a second of processor time", alone(args.bursts))
    shown, busy = on_the_page(args.seconds)
    report("on the page", shown)
    print(f"its thread, evaluations included, in a second of processor time: {busy:.0f}")


def report(what: str, rates: Sequence[float]) -> None:
    """Print some rates, matches a second."""
    print(f"{what}: median {median(rates):.0f} ({min(rates):.0f} to {max(rates):.0f})")


def alone(bursts: int) -> list[float]:
    """Matches in a second of processor time, of each burst."""
    training, found = TableTraining(FIRST, 1, fast=True), []
    training.warm()
    for _ in range(bursts):
        start = process_time()
        training.run(round(BURST * MINUTES * 60 * HZ))
        found.append(BURST / (process_time() - start))
    return found


def on_the_page(seconds: float) -> tuple[list[float], float]:
    """The numbers on the page at full speed, and the matches in a second of its thread's processor time."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    arcade = Arcade(Controls())
    lab = arcade.open(Lab(arcade.context, fast=True))
    lab.table.speed, lab.idle = FASTEST, float("inf")

    def frames(wanted: float, least: int = 0) -> list[float]:
        """Show the page for `wanted` s and until it has played `least` matches; the numbers on it."""
        numbers, start, before = [], perf_counter(), perf_counter() - FRAME
        while perf_counter() - start < wanted or lab.table.training.matches < least:
            now = perf_counter()
            arcade.frame(now - before, draw=True)
            numbers.append(float(lab.shown.rate))
            before = now
            sleep(max(0.0, FRAME - (perf_counter() - now)))
        return numbers[:: round(0.5 / FRAME)]

    frames(2 * WINDOW, FIRST_MATCHES)
    thread = lab.table._thread
    assert thread is not None
    clock, matches = pthread_getcpuclockid(thread.ident or 0), lab.table.training.matches
    start = clock_gettime(clock)
    shown = frames(seconds)
    busy = (lab.table.training.matches - matches) / (clock_gettime(clock) - start)
    lab.on_leave()
    return shown, busy


if __name__ == "__main__":
    main()
