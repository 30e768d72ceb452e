"""Random presses on every screen of the tests: `python -m tests.bench.presses [PRESSES EACH]`. Exit code 1 where open
files, threads or memory of the process do not stay level.
"""

import gc
import os
import random
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass
from importlib import import_module
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.ai.registry import BRAINS
from pigaming_app.events.spec import Format
from pigaming_app.jobs.bench.memory import resident_mb
from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.events.paper.poster import poster
from pigaming_app.scenes.events.paper.sheet import encoded
from pigaming_app.scenes.flow.scene import Home, Stack
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.preloaded import modules
from pigaming_app.scenes.title.scene import REST, Title
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.draw.surface_cache import RESTING, surfaces
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.memory import return_freed_blocks, return_large_blocks
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.screens import SCREENS, event, match

BUTTONS = sorted(set(Button) - {Button.POINT, Button.CLICK, Button.FOUND, Button.LOST}, key=lambda button: button.name)
IDLE = (sys.executable, "-c", "input()")  # in place of the compilers, which work for minutes
WORK = 60.0  # s for work that goes on: a poster is written by a thread of its own
MOST_MB, SETTLED = 4.0, 5  # growth; thrice as much where there are fewer rounds than SETTLED: rare code still loads
MOST_CACHED_MB = RESTING / 2**20 + 8.0  # sprites on the title; 8: painted since it has released the others


@dataclass(frozen=True)
class Usage:
    """Open files, threads, and resident memory without the cached sprites, MB; and those, MB."""

    presses: int
    files: int
    threads: int
    mb: float
    cached_mb: float


def usage(presses: int) -> Usage:
    """What this process uses now."""
    cached = surfaces.bytes / 2**20
    surfaces.clear()
    gc.collect()
    return_freed_blocks()
    files = len(os.listdir("/proc/self/fd"))
    return Usage(presses, files, threading.active_count(), resident_mb() or 0.0, round(cached, 1))


def main(presses: int = 10_000, each: int = 12) -> int:
    """Print the usage after each round; returns the exit code."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    return_large_blocks()  # as the arcade does
    found: list[Usage] = []
    with TemporaryDirectory() as home:
        os.environ["PIGAMING_HOME"] = home
        for usage_now in rounds(presses, each):
            found.append(usage_now)
            print(usage_now, flush=True)
    print(growth(found) or "all level")
    return int(bool(growth(found)))


def rounds(presses: int, each: int = 12, seed: int = 1) -> Iterator[Usage]:
    """The usage on the title after each round over all screens, until there were so many presses.

    `each`: presses on a screen, or on those to which they lead. PIGAMING_HOME is a folder of its own. As in the arcade,
    one title and one context are there all the time, and what pages leave is released by the title alone.
    """
    chance, made, threads = random.Random(seed), 0, 0
    canvas = Canvas.open(Settings(fullscreen=False), headless=True)
    arcade = Arcade(Controls(canvas.to_canvas))
    context, title = arcade.context, Title(arcade.context)
    context.canvas, arcade.stack = canvas, Stack(title)
    background = context.shared(LabBackground)
    background.compiler = background.network_compiler = Compiler(IDLE)
    background.preloaded()
    background.lab = lab = Lab(context)
    pages = {**SCREENS, "match": match, "attract": lambda arcade: Attract(context), "lab": lambda arcade: lab}
    for module in (*modules(), "cv2", "pigaming_app.ui.input.phones.server"):  # libraries that few presses lead to
        import_module(module)
    encoded(poster(event(Format.ROUND_ROBIN, 4, 2, 1).event, Words("en")), [Path("poster.pdf")])  # loads a library
    for kind in chain.from_iterable(kinds.values() for kinds in BRAINS.values()):
        kind.weights(False)  # the tables of q1 and q2 take 12 MB from their first match on
    try:
        while made < presses:
            for make in pages.values():
                with as_before(arcade), stand_ins():
                    arcade.open(make(arcade))
                    for _ in range(each):
                        made += 1
                        press(arcade, chance, title)
            arcade.wait(2 * REST, draw=True)
            end = time.monotonic() + WORK
            while threads and threading.active_count() > threads and time.monotonic() < end:
                time.sleep(0.1)
            found = usage(made)
            threads = threads or found.threads
            yield found
    finally:
        background.close()


@contextmanager
def as_before(arcade: Arcade) -> Iterator[None]:
    """Return to the title afterwards, with the settings and the parts of the context that were there before."""
    context = arcade.context
    parts, settings = dict(vars(context)), deepcopy(vars(context.settings))
    try:
        yield
    finally:
        with stand_ins():
            arcade.stack.apply(Home())
        context.shared(phone_host).close()
        vars(context).update(parts)
        vars(context.settings).update(settings)
        read_large(False)


@contextmanager
def stand_ins() -> Iterator[None]:
    """Bear with pages that were given a stand-in for a match, a session or a next page, only to be drawn."""
    try:
        yield
    except AttributeError as error:
        if "SimpleNamespace" not in str(error):
            raise
    except AssertionError as error:
        if error.args:
            raise


def press(arcade: Arcade, chance: random.Random, title: Title) -> None:
    """Press a button, and draw a frame of some length; begin again at the title where that ends the arcade."""
    arcade.press(chance.choice(BUTTONS), device=chance.choice(KEYS[:2]))
    if arcade.stack.scenes:
        arcade.frame(chance.choice((0.02, 0.1, 0.6)), draw=chance.random() < 0.3)
    else:
        arcade.stack = Stack(title)


def growth(found: Sequence[Usage]) -> list[str]:
    """What has grown since the second round, by when all that is kept has been loaded; empty: nothing.

    Memory: the least of the later rounds against the least of the earlier ones, as some of it comes and goes.
    """
    kept = found[1:]
    half = max(1, len(kept) // 2)
    changes = {"open files": kept[-1].files - kept[0].files, "threads": kept[-1].threads - kept[0].threads}
    more_mb = min(one.mb for one in kept[-half:]) - min(one.mb for one in kept[:half])
    most_mb = MOST_MB if len(found) >= SETTLED else 3 * MOST_MB
    cached = max(one.cached_mb for one in found)
    return [
        *(f"{more} more {name}" for name, more in changes.items() if more > 0),
        *([f"{more_mb:.1f} MB more"] if more_mb > most_mb else []),
        *([f"{cached:.0f} MB of sprites on the title"] if cached > MOST_CACHED_MB else []),
    ]


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
