"""Memory of the headless arcade over a long day: `python -m tests.bench.memory [presses N SEED | attract MINUTES]`.

`presses`: random keys, four per frame of 50 ms of simulated time, 200,000 in total. `attract`: seven minutes without
input. Resident memory is printed regularly; exit code 1 where it exceeds its limit.
"""

import os
import random
import sys
import tempfile
from collections.abc import Callable, Sequence
from time import process_time

import pygame

from pigaming_app.jobs.bench.memory import resident_mb

KEYS = [
    *(pygame.KSCAN_W, pygame.KSCAN_A, pygame.KSCAN_S, pygame.KSCAN_D, pygame.KSCAN_SPACE, pygame.KSCAN_LSHIFT),
    *(pygame.KSCAN_UP, pygame.KSCAN_LEFT, pygame.KSCAN_DOWN, pygame.KSCAN_RIGHT, pygame.KSCAN_RCTRL),
    *(pygame.KSCAN_I, pygame.KSCAN_J, pygame.KSCAN_K, pygame.KSCAN_L, pygame.KSCAN_U, pygame.KSCAN_O),
    *(pygame.KSCAN_KP8, pygame.KSCAN_KP4, pygame.KSCAN_KP5, pygame.KSCAN_KP6, pygame.KSCAN_KP0),
    *(pygame.KSCAN_RETURN, pygame.KSCAN_ESCAPE, pygame.KSCAN_TAB, pygame.KSCAN_X, pygame.KSCAN_F4),
]
A_FRAME = 4  # presses
LIMIT_MB = 300.0
REPORTS = 20


def main(arguments: Sequence[str]) -> int:
    """Run one of the two; returns the exit code."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    os.environ["PIGAMING_HOME"] = tempfile.mkdtemp(prefix="pigaming-memory-")
    job, *numbers = arguments or ["presses"]
    if job == "attract":
        seconds = 60.0 * float(numbers[0] if numbers else 7.0)
        return soak(round(seconds * 30), 1 / 30, lambda: None)
    count, seed = (int(number) for number in (*numbers, *("200000", "1")[len(numbers) :]))
    rng = random.Random(seed)
    return soak(count // A_FRAME, 1 / 20, lambda: press(rng, A_FRAME))


def soak(frames: int, step: float, act: Callable[[], None]) -> int:
    """Run the arcade for some frames of `step` s, with `act` before each; returns 1 if it exceeds LIMIT_MB."""
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.start import run

    began, found = process_time(), [0.0]
    frame = 0

    def over() -> bool:
        nonlocal frame
        frame += 1
        if frame % max(1, frames // REPORTS) == 0:
            found.append(resident_mb() or 0.0)
            print(f"{frame:7} frames, {frame * step / 60:6.1f} min: {found[-1]:6.1f} MB", flush=True)
        act()
        return frame >= frames

    code = run(Options(headless=True, kiosk=True, step=step, should_close=over))
    print(f"at most {max(found):.1f} MB, in {process_time() - began:.0f} s of CPU; code {code}")
    return int(code or max(found) > LIMIT_MB)


def press(rng: random.Random, count: int) -> None:
    """Press and release random keys; from time to time click the mouse at a random point."""
    for _ in range(count):
        code = rng.choice(KEYS)
        for kind in (pygame.KEYDOWN, pygame.KEYUP):
            pygame.event.post(pygame.Event(kind, key=0, scancode=code, mod=0))
    if rng.random() < 0.05:
        at = rng.randrange(1920), rng.randrange(1080)
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=at, button=1))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
