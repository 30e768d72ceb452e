"""A scripted walk through every screen of the arcade, which measures the CPU time of each frame.

A frame is: events, update, draw; without the flip, which waits for the display. Only the thread of the frames counts.
The walk is the cold case: it runs in a fresh process with empty folders, so nothing is cached but what the arcade
itself has prepared. Time is made up, 1/60 s a frame; keys are real events.
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import thread_time
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
FPS = 60
PATIENCE = 30.0  # s of made-up time to wait for a screen
SETTLED = 1.5  # s spent on a page, so that its animations and what it prepares are measured as well


def worst_frames() -> dict[str, float]:
    """Walk in a fresh process: the longest frame of each screen, ms of CPU time, the longest first."""
    with tempfile.TemporaryDirectory() as home:
        unseen = {**os.environ, "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": home}
        command = [sys.executable, "-m", __name__]
        done = subprocess.run(command, cwd=ROOT, env=unseen, stdout=subprocess.PIPE, check=True)
    found: dict[str, float] = json.loads(done.stdout)
    return dict(sorted(found.items(), key=lambda screen: -screen[1]))


class Walker:
    """Somebody at the keyboard of an arcade; `worst`: ms of the longest frame of each screen."""

    def __init__(self, app: Any) -> None:
        self.app, self.house = app, app.house
        self.screen = "title"
        self.worst: dict[str, float] = {}
        self.frames: list[tuple[str, float]] = []

    @property
    def top(self) -> Any:
        return self.app.stack.top

    def frame(self) -> None:
        """One frame of the arcade."""
        began = thread_time()
        painted = self.app.compose(1 / FPS)
        spent = 1000.0 * (thread_time() - began)
        self.frames.append((self.screen, spent))
        self.worst[self.screen] = max(spent, self.worst.get(self.screen, 0.0))
        if painted:
            self.house.canvas.flip()

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds * FPS)):
            self.frame()

    def press(self, *keys: str, pause: float = 0.2) -> None:
        """Tap keys one after the other."""
        import pygame

        for key in keys:
            code = pygame.key.key_code(key)
            scancode = SCANCODES[key]
            for kind in (pygame.KEYDOWN, pygame.KEYUP):
                pygame.event.post(pygame.Event(kind, key=code, scancode=scancode, mod=0, unicode=""))
                self.wait(2 / FPS)
            self.wait(pause)

    def go(self, screen: str, *keys: str, stay: float = SETTLED) -> None:
        """Press what leads to a screen, and stay there."""
        self.screen = screen
        self.press(*keys)
        self.wait(stay)

    def until(self, true: Callable[[], bool]) -> None:
        for _ in range(round(PATIENCE * FPS)):
            if true():
                return
            self.frame()
        raise RuntimeError(f"{self.screen}: {type(self.top).__name__} is still on top")

    def on(self, kind: str) -> bool:
        return type(self.top).__name__ == kind

    def home(self) -> None:
        """Back to the title."""
        self.screen = "title"
        for _ in range(12):
            if self.on("Title"):
                break
            self.press("escape", pause=0.5)
        self.until(lambda: self.on("Title"))


SCANCODES: dict[str, int] = {}


def _codes() -> None:
    import pygame

    for key in (
        "w",
        "a",
        "s",
        "d",
        "x",
        "p",
        "space",
        "return",
        "escape",
        "tab",
        "f4",
        "f1",
        "up",
        "down",
        "left",
        "right",
    ):
        SCANCODES[key] = getattr(pygame, f"KSCAN_{key.upper()}")


def tour(w: Walker) -> None:
    w.wait(4.0)
    for language in ("en", "pt"):
        pages(w, language)
        for game in ("pitanks", "factory", "race"):
            play(w, game, language)
        lab(w, language)
        w.home()
        w.go(f"title {language}", "tab")
    attract(w)


def pages(w: Walker, language: str) -> None:
    from pigaming_app.scenes.howto import HowTo
    from pigaming_app.scenes.stack import Push

    for game in ("pitanks", "factory", "race"):
        w.screen = f"how to play {game} {language}"
        w.app.stack.turn(Push(HowTo(w.house, game)))
        w.wait(12.0)
        w.go(w.screen, "d", stay=3.0)
        w.home()
    choose(w, "options")
    w.go(f"options {language}", "space")
    rows = list(w.top.rows)
    for name in rows:
        if name in ("padtest", "robots"):
            w.go(f"options {name} {language}", "space")
            if name == "robots":
                robots(w, language)
            w.press("escape")
        elif name not in ("display", "fullscreen"):
            w.press("d", "a")
            w.press("space", "d") if name == "reset" else None
        w.screen = f"options {language}"
        w.press("s")
    w.press("a", "w")
    w.home()


def robots(w: Walker, language: str) -> None:
    rows = 5
    for i in range(rows):
        w.go(f"robots menu {i} {language}", "space", stay=2.0)
        if not w.on("RobotsMenu"):
            w.press("d", "s", "space")
            for _ in range(4):
                if w.on("RobotsMenu"):
                    break
                w.press("escape", pause=0.5)
        w.screen = f"robots menu {language}"
        w.press("s")


def choose(w: Walker, name: str) -> None:
    """Put the focus of the title on something."""
    w.screen = "title"
    w.until(lambda: w.on("Title"))
    for _ in range(40):
        if w.top.focus.name == name:
            return
        spots = [spot.name for spot in w.top.focus.spots]
        at, to = spots.index(w.top.focus.name), spots.index(name)
        low = at >= 3
        if (to >= 3) != low:
            w.press("s" if to >= 3 else "w", pause=0.05)
        else:
            w.press("d" if to > at else "a", pause=0.05)
    raise RuntimeError(name)


def play(w: Walker, game: str, language: str) -> None:
    choose(w, game)
    w.go(f"{game} lobby {language}", "space", stay=0.5)
    w.press("space")
    w.press("tab", "tab", "tab", "tab", "tab", "tab")
    if game != "factory":
        w.press("x", "d", "a", "x")
    w.wait(3.5)
    w.press("d", "a")
    w.wait(3.5)
    w.press("space")
    w.screen = f"{game} setup {language}"
    w.until(lambda: w.on("SetupPage"))
    w.wait(0.5)
    for _ in w.top.arenas:
        w.press("d", pause=0.5)
    for _ in range(3):
        w.press("s", "d", "d", "a", "a", pause=0.1)
    w.press("w", "w", "w")
    for _ in range(20):
        w.press("a", pause=0.05)
    for arena in range(len(w.top.arenas)):
        w.screen = f"{game} setup {language}"
        if arena:
            w.until(lambda: w.on("SetupPage"))
            w.wait(0.5)
            w.press("d")
        w.screen = f"{game} match {language}"
        w.press("return")
        w.until(lambda: w.on("MatchScene"))
        w.wait(6.5)
        if arena == 0:
            for _ in range(5):
                w.go(f"{game} F4 {language}", "f4", stay=2.0)
            w.go(f"{game} pause {language}", "return", stay=1.0)
            w.press("s", "s")
            w.go(f"{game} controls {language}", "space", stay=1.0)
            w.press("escape", pause=0.5)
            w.press("escape")
            w.screen = f"{game} match {language}"
            w.wait(10.0)
            state = w.top.match.state
            state.robots[0].score = 3
            state.rules.ticks = min(state.rules.ticks, state.tick + 12 * 50)
            if hasattr(w.top.match.state, "racers"):
                pass
            w.until(lambda: w.on("Results"))
            w.screen = f"{game} results {language}"
            w.wait(5.0)
            if w.on("Initials"):
                w.screen = f"{game} initials {language}"
                w.press("w", "space", "s", "space", "space", "return")
                w.wait(4.0)
                if w.on("Best"):
                    w.press("return")
            w.screen = f"{game} best {language}"
            w.press("tab")
            w.wait(4.0)
            w.press("escape", pause=0.6)
            w.screen = f"{game} rematch {language}"
            w.until(lambda: w.on("Results"))
            w.wait(3.0)
            w.press("return")
            w.until(lambda: w.on("MatchScene"))
            w.wait(3.0)
        w.screen = f"{game} pause {language}"
        w.press("return")
        w.press("w")
        w.screen = f"{game} results {language}"
        w.press("space")
        w.until(lambda: w.on("Results"))
        w.wait(3.5)
        w.press("x")
    w.home()


def lab(w: Walker, language: str) -> None:
    choose(w, "lab")
    w.go(f"lab {language}", "space", stay=6.0)
    w.press("tab", "tab", "d", "s", "space", "d", "d", "space")
    w.wait(6.0)
    for item in range(3):
        w.go(f"lab menu {language}", "return", stay=0.5)
        w.press(*["s"] * item)
        w.go(f"lab menu {item} {language}", "space", stay=3.0)
        w.press("w", "d", "return" if item == 0 else "escape")
        w.press("escape") if not w.on("Lab") else None
        w.until(lambda: w.on("Lab"))
        w.screen = f"lab {language}"
        w.wait(1.0)
    w.go(f"lab match {language}", "x", stay=8.0)
    w.top.inner.match.state.rules.ticks = w.top.inner.match.state.tick + 50
    w.wait(5.0)
    w.press("escape")
    w.screen = f"lab {language}"
    w.until(lambda: w.on("Lab"))
    w.wait(2.0)
    w.press("escape")


def another(w: Walker, show: object) -> bool:
    return w.top.show is not show


def attract(w: Walker) -> None:
    w.home()
    w.house.settings.attract_seconds = 5.0
    w.screen = "attract"
    w.until(lambda: w.on("Attract"))
    for _ in range(9):
        show = w.top.show
        w.wait(10.0)
        if hasattr(show, "stage"):
            show.stage.match.state.rules.ticks = show.stage.match.state.tick + 50
        w.until(partial(another, w, show))
    w.home()


def walk() -> dict[str, float]:
    from pigaming_app.scenes.app import Options, opened

    with opened(Options(headless=True)) as app:
        walker = Walker(app)
        walker.frame()
        walker.worst.clear()
        walker.frames.clear()
        _codes()
        tour(walker)
    if name := os.environ.get("WALK_FRAMES"):
        Path(name).write_text("\n".join(f"{ms:.1f} {screen}" for screen, ms in walker.frames))
    return walker.worst


if __name__ == "__main__":
    os.environ["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"
    print(json.dumps(walk()))
