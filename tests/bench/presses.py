"""Random presses on every screen of the tests: open files, threads and memory of this process stay level."""

import gc
import os
import random
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from pigaming_app.jobs.bench.memory import resident_mb
from pigaming_app.scenes.flow.stack import Home, Stack
from pigaming_app.scenes.title.scene import Title
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.memory import return_freed_blocks
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.screens import SCREENS

BUTTONS = tuple(set(Button) - {Button.POINT, Button.CLICK, Button.FOUND, Button.LOST})
EACH = 12  # presses on a screen, or on those to which they lead
SETTLED = 1  # rounds after which all that is kept has been loaded


@dataclass(frozen=True)
class Usage:
    """Open files, threads, and resident memory, MB."""

    presses: int
    files: int
    threads: int
    mb: float


def usage(presses: int) -> Usage:
    """What this process uses now."""
    gc.collect()
    return_freed_blocks()
    return Usage(presses, len(os.listdir("/proc/self/fd")), threading.active_count(), resident_mb() or 0.0)


def rounds(presses: int, seed: int = 1) -> Iterator[Usage]:
    """The usage on the title after each round over all screens, until there were so many presses.

    PIGAMING_HOME is a folder of its own.
    """
    chance, made = random.Random(seed), 0
    canvas = Canvas.open(Settings(fullscreen=False), headless=True)
    arcade = Arcade(Controls(canvas.to_canvas))
    arcade.context.canvas = canvas
    while made < presses:
        for make in SCREENS.values():
            arcade.stack = Stack(Title(arcade.context))
            with stand_ins():
                arcade.open(make(arcade))
                for _ in range(EACH):
                    made += 1
                    press(arcade, chance)
            with stand_ins():
                arcade.stack.apply(Home())
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


def grown(found: Sequence[Usage]) -> Usage:
    """How much more is used at the end than once all screens have been loaded."""
    first, last = found[SETTLED], found[-1]
    return Usage(last.presses, last.files - first.files, last.threads - first.threads, last.mb - first.mb)
