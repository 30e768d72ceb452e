"""Performance on this machine: the simulator, frames, start and memory; `phones` as pads; `robots`, the proof of the
robot loop. Or that of agents: `tasks` lists those of PiGaming-Bench, TASK AGENT … evaluates, `verify FILE` replays.
"""

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pigaming_app.jobs.terminal.options import DEFAULT_GAME, JsonOption, argument, flag, games_and, option, path
from pigaming_app.jobs.terminal.refusal import Refusal, missing, module_of, refused, require

ROBOTS, PHONES = "robots", "phones"
TASKS, VERIFY = "tasks", "verify"  # of PiGaming-Bench; names of its tasks have a hyphen


@dataclass(frozen=True, kw_only=True)
class BenchOptions(JsonOption):
    """What to measure."""

    game: str = argument(
        games_and(ROBOTS, PHONES, TASKS, VERIFY, "TASK", default=DEFAULT_GAME),
        default=DEFAULT_GAME,
        nargs="?",
        metavar="GAME",
    )
    agents: tuple[str, ...] = argument(
        "TASK: the agents; verify: the file of results", default=(), nargs="*", metavar="AGENT"
    )
    arcade: bool = flag("robots: only the failures of a whole arcade")
    variant: str | None = option("set of rules; default: the game's first")
    method: str = option("TASK: how the agents learned, in a few words", default="", metavar="TEXT")
    out: Path | None = option("TASK: the file of results (JSON), beside the agents", path, metavar="FILE")


def run(options: BenchOptions) -> int:
    """Measure and print the figures. Raises Refusal."""
    if options.arcade and options.game != ROBOTS:
        raise Refusal("--arcade: only for robots")
    if options.game in (TASKS, VERIFY) or "-" in options.game or options.agents:
        return _benchmark(options)
    special = {ROBOTS: lambda: _robots(options.arcade), PHONES: _phones}
    figures = special.get(options.game, lambda: _game(options.game, options.variant))()
    if options.json:
        print(json.dumps(figures))
    else:
        _print(figures)
        if options.game != PHONES and (lacks := missing("bench")):
            print(lacks)
    return 0


def _benchmark(options: BenchOptions) -> int:
    """PiGaming-Bench. Raises Refusal."""
    with refused(ImportError):
        benchmark = module_of("bench.benchmark", "PiGaming-Bench")
    if options.game == TASKS:
        return int(benchmark.list_tasks(options.json))
    if options.game == VERIFY:
        return int(benchmark.check(options.agents, options.json))
    return int(benchmark.evaluate(options.game, options.agents, options.method, options.out, options.json))


def _game(game: str, variant: str | None) -> dict[str, Any]:
    from pigaming_app.games.registry import games
    from pigaming_app.games.setup import ChoiceError, require_one_of

    with refused(ChoiceError):
        require_one_of("game", game, [*games(), ROBOTS, PHONES])
        variant = variant or games()[game].default.name
        require_one_of("variant", variant, list(games()[game].variants))
    from pigaming_app.jobs.bench.figures import measure

    return measure(game, variant)


def _robots(arcade: bool) -> dict[str, Any]:
    """The proof of the robot loop; its findings go to standard error as they come."""
    require("hardware")
    from pigaming_app.hardware.vision.markers import OpenCVMissing, opencv
    from pigaming_app.jobs.bench.robots import Unproven, arcade_figures, measure, reached, stops_outside

    def note(line: str) -> None:
        print(line, file=sys.stderr, flush=True)

    with refused(OpenCVMissing, Unproven):
        opencv()
        figures = arcade_figures(*stops_outside(note)) if arcade else measure(note)
    missed = [key for key, good in reached(figures).items() if not good]
    note(f"not reached: {', '.join(missed)}" if missed else "everything is reached")
    return figures


def _phones() -> dict[str, Any]:
    """The latency of phones as pads."""
    require("phones")
    from pigaming_app.jobs.bench.phones import measure
    from pigaming_app.ui.i18n import english
    from pigaming_app.ui.web.network import ServerUnavailable

    try:
        return measure()
    except ServerUnavailable as trouble:
        raise Refusal(english()(f"phones.{trouble.key}", **trouble.values)) from None


def _print(figures: dict[str, Any], indent: str = "") -> None:
    """A line for each figure; those of a group are indented below its name."""
    for key, value in figures.items():
        if isinstance(value, dict):
            print(indent + key)
            _print(value, indent + "  ")
        else:
            print(f"{indent + key:40} {value if not isinstance(value, float) else f'{value:,.3f}'}")
