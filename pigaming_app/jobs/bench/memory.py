"""Resident memory of the arcade in its usual states, each measured in a separate process without a window.

A match is reached over the title and the lobby, as in use. Time is simulated: a minute takes seconds.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.jobs.bench.processes import figures_of

if TYPE_CHECKING:
    from pigaming_app.scenes.flow.scene import Context, Scene

STATES = ("title", "lobby", *games())
STEP = 1 / 30  # s of a frame
SECONDS = {"title": 10.0, "lobby": 15.0, "match": 60.0}  # until memory is read
MINUTES = 5.0  # of a match: it is still running then


def measure() -> dict[str, float | None]:
    """Megabytes (2^20 bytes) by state: title, lobby, and a match of each game; None where unknown."""
    with ThreadPoolExecutor(2) as pool:
        return dict(zip(STATES, pool.map(measured_alone, STATES), strict=True))


def measured_alone(state: str) -> float | None:
    """Megabytes of a fresh process in one of STATES. Raises subprocess.CalledProcessError."""
    found: float | None = figures_of("jobs.bench.memory", state)
    return found


def resident_mb() -> float | None:
    """Resident memory of this process, MB (2^20 bytes); None where unknown."""
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
    """Run the arcade into one of STATES and stay there for a while; returns the memory at the end, MB."""
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.start import run

    route = ROUTES.get(state, ROUTES["match"])
    frames = sum(round(seconds / STEP) for seconds, _ in route)
    readings: list[float | None] = []

    def over() -> bool:
        readings.append(None if len(readings) < frames - 1 else resident_mb())
        return len(readings) == frames

    run(Options(first_scene=lambda context: Tour(context, state, route), headless=True, step=STEP, should_close=over))
    return readings[-1]


class Tour:
    """Shows one scene after the other, each for some seconds; the stack operations of a scene are ignored."""

    def __init__(self, context: "Context", state: str, route: "Route") -> None:
        self.context, self.state, self.route = context, state, list(route)
        self._next()

    def on_enter(self) -> None:
        """No effect: each scene is entered when its turn comes."""

    def handle(self, press: Any) -> None:
        """Input is ignored."""

    def update(self, seconds: float) -> None:
        """Update the present scene; switch to the next when its time is over."""
        self.remaining -= seconds
        if self.remaining <= 0.0 and self.route:
            self._next()
        self.scene.update(seconds)

    def draw(self, screen: Any) -> None:
        self.scene.draw(screen)

    def _next(self) -> None:
        self.remaining, make = self.route.pop(0)
        self.scene = make(self.context, self.state)
        self.scene.on_enter()


def title(context: "Context", state: str) -> "Scene":
    from pigaming_app.scenes.title.scene import Title

    return Title(context)


def lobby(context: "Context", state: str) -> "Scene":
    """The lobby of the game `state`, or of the first game."""
    from pigaming_app.scenes.lobby.scene import Lobby

    return Lobby(context, state if state in games() else next(iter(games())))


def driver(game: str) -> str:
    """The AI that drives in benchmarks."""
    return "hand2" if "hand2" in BRAINS[game] else "level3"


def match(context: "Context", state: str) -> "Scene":
    """A match of four AIs in the first arena of the game `state`."""
    from pigaming_app.scenes.play.scene import MatchScene

    rules = games()[state].default
    one, two, three, four = (Seat(driver(state), team) for team in rules.teams)
    goal = max(rules.goals, default=0)
    return MatchScene(context, Setup(state, arenas(state)[0], (one, two, three, four), MINUTES, 1, rules.name, goal))


Route = tuple[tuple[float, Callable[["Context", str], "Scene"]], ...]  # seconds, and the scene in which they pass
ROUTES: dict[str, Route] = {
    "title": ((SECONDS["title"], title),),
    "lobby": ((2.0, title), (SECONDS["lobby"], lobby)),
    "match": ((2.0, title), (4.0, lobby), (SECONDS["match"], match)),
}

if __name__ == "__main__":
    print(json.dumps(visit(sys.argv[1])))
