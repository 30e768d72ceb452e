"""Random presses on every screen of the tests: `python -m tests.bench.presses [PRESSES EACH]`. Exit code 1 where open
files, threads or memory of the process do not stay level.
"""

import gc
import os
import random
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from pigaming_app.events.spec import Format
from pigaming_app.jobs.bench.memory import resident_mb
from pigaming_app.scenes.events.poster import drawn, encoded
from pigaming_app.scenes.flow.stack import Home, Stack
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.draw.frame_budget import drop_paused
from pigaming_app.ui.draw.surface_cache import surfaces
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.memory import return_freed_blocks, return_large_blocks
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.screens import SCREENS, event

BUTTONS = tuple(set(Button) - {Button.POINT, Button.CLICK, Button.FOUND, Button.LOST})
MOST_MB = 24.0  # growth


@dataclass(frozen=True)
class Usage:
    """Open files, threads, and resident memory, MB."""

    presses: int
    files: int
    threads: int
    mb: float


def usage(presses: int) -> Usage:
    """What this process uses now, without the caches of sprites."""
    surfaces.clear()
    drop_paused()
    gc.collect()
    return_freed_blocks()
    return Usage(presses, len(os.listdir("/proc/self/fd")), threading.active_count(), resident_mb() or 0.0)


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

    `each`: presses on a screen, or on those to which they lead. PIGAMING_HOME is a folder of its own.
    """
    chance, made = random.Random(seed), 0
    canvas = Canvas.open(Settings(fullscreen=False), headless=True)
    controls = Controls(canvas.to_canvas)
    encoded(drawn(event(Format.ROUND_ROBIN, 4, 2, 1).event, Words("en")), Path("poster.pdf"))  # loads a library
    while made < presses:
        for make in SCREENS.values():
            arcade = Arcade(controls)
            arcade.context.canvas = canvas
            arcade.stack = Stack(Title(arcade.context))
            with stand_ins():
                arcade.open(make(arcade))
                for _ in range(each):
                    made += 1
                    press(arcade, chance)
            with stand_ins():
                arcade.stack.apply(Home())
            arcade.context.shared(phone_host).close()
        read_large(False)
        yield usage(made)


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


def press(arcade: Arcade, chance: random.Random) -> None:
    """Press a button, and draw a frame of some length."""
    arcade.press(chance.choice(BUTTONS), chance.choice(KEYS[:2]))
    if arcade.stack.scenes:
        arcade.frame(chance.choice((0.02, 0.1, 0.6)), draw=chance.random() < 0.3)
    else:
        arcade.stack = Stack(Title(arcade.context))


def growth(found: Sequence[Usage]) -> list[str]:
    """What has grown since the second round, by when all that is kept has been loaded; empty: nothing."""
    first, last = found[1], found[-1]
    changes = {"open files": last.files - first.files, "threads": last.threads - first.threads}
    grown = [f"{more} more {name}" for name, more in changes.items() if more > 0]
    return [*grown, *([f"{last.mb - first.mb:.0f} MB more"] if last.mb - first.mb > MOST_MB else [])]


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
