"""The figures of `bench`: speed of the engine, frames, start and memory on this machine.

Each speed is the best of several runs: other programs can only slow a run down, so the best is nearest to the cost of
the code itself. The scene is a full match: the game's first arena, full rules, four hand2 AIs and the longest goal, so
that it does not end during the measurement.
"""

import os
import platform
import subprocess
from itertools import count
from statistics import median
from time import perf_counter, process_time, time
from typing import Any

from pigaming_app import ROOT
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.plugin_faults import check
from pigaming_app.ai.registry import BRAINS
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.jobs.bench import environments, networks, yardsticks
from pigaming_app.jobs.bench.memory import driver
from pigaming_app.jobs.bench.memory import measure as measure_memory
from pigaming_app.jobs.bench.processes import figures_of, processes
from pigaming_app.jobs.terminal.command import own_command
from pigaming_app.jobs.terminal.interrupt import OWN_GROUP
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.world import HZ

RUNS = 5  # of each speed
PLAIN_TICKS = 3000  # of a match in plain Python
MATCHES = 32  # of a compiled batch
TICKS = 6000  # of each of its matches
FRAMES = 600  # of the frame times
STARTS = 3  # of the program


def measure(game: str, variant: str) -> dict[str, Any]:
    """All figures by name, of matches under the rules of `variant`. Without numba those of compiled play are None."""
    plain = min(_plain_run(game, variant, seed) for seed in range(1, RUNS + 1))
    single = both = None
    if can_compile():
        compiled_ticks(game, variant, 0)
        single = min(1.0 / rate for rate in (compiled_ticks(game, variant, seed) for seed in range(1, RUNS + 1)))
        both = max(1.0 / single, *(_two_processes(game, variant) for _ in range(3)))
    frames = _frames(game, variant)
    slowest = dict(sorted(figures_of("scenes.walk.walker").items(), key=lambda screen: -screen[1]))  # ms by screen
    return {
        "game": game,
        "variant": variant,
        "plain_us_per_tick": 1e6 * plain,
        "compiled_us_per_tick": None if single is None else 1e6 * single,
        "compiled_ticks_per_second": both,
        "network": _network(game, variant),
        "environments": environments.measure(game),
        "comparison": _comparison(variant) if game == yardsticks.GAME else None,
        "real_time_factor_plain": 1.0 / (HZ * plain),
        "real_time_factor_compiled": None if single is None else 1.0 / (HZ * single),
        "frame_ms": {"median": median(frames), "p99": frames[int(0.99 * len(frames))]},
        "worst_frame_ms": max(slowest.values()),
        "worst_frame_ms_by_screen": slowest,
        "second_screen_frame_ratio": figures_of("scenes.walk.second_screen"),
        "start_s": min(start() for _ in range(STARTS)),
        "rss_mb": measure_memory(),
        "machine": machine(),
    }


def _network(game: str, variant: str) -> dict[str, float | None] | None:
    """Costs of a network's decision; None for a game without networks."""
    if game not in ENCODINGS:
        return None
    fast = batch(game, variant, 1, MATCHES, True) if can_compile() else None
    return networks.measure(game, batch(game, variant, 1, 1, False), fast)


def batch(game: str, variant: str, seed: int, matches: int, fast: bool) -> Batch:
    """The scene as a batch of `matches` matches."""
    rules = games()[game].variants[variant]
    one, two, three, four = (Seat(driver(game), team) for team in rules.teams)
    arena, goal = arenas(game)[0], max(rules.goals, default=0)
    setups = [Setup(game, arena, (one, two, three, four), 5.0, seed + i, variant, goal) for i in range(matches)]
    return Batch(setups, [BRAINS[game][driver(game)]] * 4, fast)


def compiled_ticks(game: str, variant: str, seed: int) -> float:
    """Ticks a second of one compiled loop. Seed 0 only compiles."""
    matches = batch(game, variant, 1000 * seed + 1, MATCHES, True)
    if seed == 0:
        matches.play(0)
        return 0.0
    began = perf_counter()
    matches.play(TICKS)
    return matches.ticks() / (perf_counter() - began)


def work(game: str, variant: str, seed: int, start_at: float) -> tuple[float, float, int]:
    """Play in a separate process from `start_at` on; returns begin, end (s since the epoch) and ticks played."""
    matches = batch(game, variant, 1000 * seed + 1, 2 * MATCHES, True)
    matches.play(0)
    while time() < start_at:
        pass
    began = time()
    matches.play(TICKS)
    return began, time(), matches.ticks()


def start() -> float:
    """Seconds from the command that starts the arcade to the end of its first frame (and of the program)."""
    environment = {**os.environ, "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    began = perf_counter()
    subprocess.run(own_command(["--frames", "1"], prepared=False), cwd=ROOT, env=environment, check=True, **OWN_GROUP)
    return perf_counter() - began


def machine() -> str:
    """The machine: system, architecture, cores, Python."""
    python = f"Python {platform.python_version()}"
    return f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, {python}"


def _plain_run(game: str, variant: str, seed: int) -> float:
    matches = batch(game, variant, seed, 1, False)
    began = perf_counter()
    matches.play(PLAIN_TICKS)
    check(game, matches.matches, over=False)
    return (perf_counter() - began) / matches.ticks()


def _comparison(variant: str) -> dict[str, float | None]:
    """CPU time, us a tick, of a match with its rules and brains, and of the yardsticks, which have neither.

    `pymunk_ratio` is the faster of the two forms in pymunk over the match. None: numba or pymunk is missing.
    """
    seeds = count(1000, 1000)

    def four_hand2() -> float:
        matches = batch(yardsticks.GAME, variant, next(seeds), 4, True)
        began = process_time()
        matches.play(TICKS)
        return (process_time() - began) / matches.ticks()

    best = yardsticks.best_of(yardsticks.runs() | ({"four_hand2": four_hand2} if can_compile() else {}))
    names = ("four_hand2", "pymunk_bodies", "pymunk_queries", "numpy_batch")
    figures = {f"{name}_us_per_tick": 1e6 * best[name] if name in best else None for name in names}
    ratio = min(best["pymunk_bodies"], best["pymunk_queries"]) / best["four_hand2"] if len(best) == len(names) else None
    return {**figures, "pymunk_ratio": ratio}


def _two_processes(game: str, variant: str) -> float:
    """Ticks a second of two processes together, from the first start to the last end."""
    with processes(2) as pool:
        start_at = time() + 4.0
        spans = [job.result() for job in [pool.submit(work, game, variant, seed, start_at) for seed in (1, 2)]]
    ticks = sum(ticks for _, _, ticks in spans)
    return ticks / (max(end for _, end, _ in spans) - min(begin for begin, _, _ in spans))


def _frames(game: str, variant: str) -> list[float]:
    """Milliseconds of each frame of a busy match, sorted, on a dummy display."""
    os.environ["SDL_VIDEODRIVER"] = os.environ["SDL_AUDIODRIVER"] = "dummy"
    from pigaming_app.scenes.bench.frame_times import frame_times

    return sorted(frame_times(game, variant, FRAMES))
