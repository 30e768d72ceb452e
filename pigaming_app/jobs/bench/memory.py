"""Resident memory of the arcade in its usual states, each measured in a process of its own without a window.

A match is reached as by a visitor, over the title and the lobby. Time is simulated, so that a minute takes seconds.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from pigaming_app.games import GAMES
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup

if TYPE_CHECKING:
    from pigaming_app.scenes.flow.context import Context
    from pigaming_app.scenes.flow.stack import Scene

STATES = ("title", "lobby", *GAMES)
STEP = 1 / 30  # s of a frame
SECONDS = {"title": 10.0, "lobby": 15.0, "match": 60.0}  # until memory is read
MINUTES = 5.0  # of a match: it is still running then
ROOT = Path(__file__).resolve().parents[3]


def measure() -> dict[str, float | None]:
    """Megabytes (2^20 bytes) by state: title, lobby, and a match of each game. None where the system does not tell."""
    with ThreadPoolExecutor(2) as pool:
        return dict(zip(STATES, pool.map(measured_alone, STATES), strict=True))


def measured_alone(state: str) -> float | None:
    """Megabytes of a fresh process in one of STATES. Raises subprocess.CalledProcessError."""
    with TemporaryDirectory() as home:
        unseen = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": home}
        command = [sys.executable, "-m", "pigaming_app.jobs.bench.memory", state]
        done = subprocess.run(
            command, env={**os.environ, **unseen}, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
        )
    found: float | None = json.loads(done.stdout.splitlines()[-1])
    return found


def resident_mb() -> float | None:
    """Megabytes of memory that this process occupies now; None where the system does not tell."""
    try:
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
        return round(pages * os.sysconf("SC_PAGE_SIZE") / 2**20, 1)
    except (OSError, AttributeError):
        pass
    try:
        found = subprocess.run(["ps", "-o", "rss=", "-p", str(os.getpid())], stdout=subprocess.PIPE, text=True).stdout
        return round(int(found) / 2**10, 1)
    except (OSError, ValueError):
        return None


def visit(state: str) -> float | None:
    """Be in one of STATES for a while; the megabytes at its end."""
    from pigaming_app.scenes.app import Options, run

    way = WAY.get(state, WAY["match"])
    frames = sum(round(seconds / STEP) for seconds, _ in way)
    found: list[float | None] = []

    def over() -> bool:
        found.append(None if len(found) < frames - 1 else resident_mb())
        return len(found) == frames

    run(Options(first=lambda context: Tour(context, state, way), headless=True, step=STEP, over=over))
    return found[-1]


class Tour:
    """One scene after the other, each for some seconds; whatever a scene asks of the stack is ignored."""

    def __init__(self, context: "Context", state: str, way: "Way") -> None:
        self.context, self.state, self.way = context, state, list(way)
        self._next()

    def entered(self) -> None:
        """Nothing to begin: each scene is entered in its turn."""

    def on(self, press: Any) -> None:
        """Nobody presses anything."""

    def update(self, seconds: float) -> None:
        """Let time pass for the present scene, or go on to the next."""
        self.remaining -= seconds
        if self.remaining <= 0.0 and self.way:
            self._next()
        self.scene.update(seconds)

    def draw(self, screen: Any) -> None:
        """The present scene."""
        self.scene.draw(screen)

    def _next(self) -> None:
        self.remaining, make = self.way.pop(0)
        self.scene = make(self.context, self.state)
        self.scene.entered()


def title(context: "Context", state: str) -> "Scene":
    """The title."""
    from pigaming_app.scenes.title.scene import Title

    return Title(context)


def lobby(context: "Context", state: str) -> "Scene":
    """The lobby of a game, of the first one if the state is none."""
    from pigaming_app.scenes.lobby.scene import Lobby

    return Lobby(context, state if state in GAMES else next(iter(GAMES)))


def match(context: "Context", state: str) -> "Scene":
    """A match of four normal AIs in a game's first arena."""
    from pigaming_app.scenes.play.scene import MatchScene

    rules = GAMES[state]
    one, two, three, four = (Seat("normal", team) for team in rules.teams)
    goal = max(rules.goals, default=0)
    return MatchScene(
        context, Setup(state, arenas(state)[0], (one, two, three, four), MINUTES, 1, rules.variants[0], goal)
    )


Way = tuple[tuple[float, Callable[["Context", str], "Scene"]], ...]  # seconds, and the scene in which they pass
WAY: dict[str, Way] = {
    "title": ((SECONDS["title"], title),),
    "lobby": ((2.0, title), (SECONDS["lobby"], lobby)),
    "match": ((2.0, title), (4.0, lobby), (SECONDS["match"], match)),
}

if __name__ == "__main__":
    print(json.dumps(visit(sys.argv[1])))
