"""The speed of the simulator on this machine, by the functions of the job `bench`."""

from statistics import median

from pigaming_app.games.registry import games
from pigaming_app.jobs.bench import figures, memory
from pigaming_app.scenes.bench.frame_times import frame_times
from pigaming_app.sim.kernel import can_compile

GAME = "pitanks"
HEAD = ["a tick, plain Python", "compiled", "ticks a second, all cores", "frame at 1920 × 1080: median, 99 %", "memory"]


def table(share: float) -> list[list[str]]:
    """Figures of PiTanks; of a small run, only those that need neither the compiler nor a process of their own."""
    rules, whole = games()[GAME].default.name, share == 1.0
    plain = min(figures._plain_run(GAME, rules, seed) for seed in range(1, figures.RUNS + 1 if whole else 2))
    frames = sorted(frame_times(GAME, rules, figures.FRAMES if whole else 5))
    compiled, both = speeds(rules) if whole and can_compile() else (0.0, 0.0)
    used = memory.measure() if whole else dict.fromkeys(memory.STATES, 0.0)
    most = max(used[name] or 0.0 for name in games())
    return [
        HEAD,
        [
            f"{1e6 * plain:.0f} µs",
            f"{1e6 * compiled:.2f} µs",
            f"{both / 1e6:.1f} million",
            f"{median(frames):.1f}, {frames[int(0.99 * len(frames))]:.1f} ms",
            f"{used['title']:.0f} MB on the title, at most {most:.0f} MB in a match",
        ],
    ]


def speeds(rules: str) -> tuple[float, float]:
    """Seconds a tick of one compiled loop, and ticks a second of two processes."""
    figures.compiled_ticks(GAME, rules, 0)
    best = max(figures.compiled_ticks(GAME, rules, seed) for seed in range(1, figures.RUNS + 1))
    return 1.0 / best, max(figures._two_processes(GAME, rules) for _ in range(3))
