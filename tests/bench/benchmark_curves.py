"""Learning curves of PiGaming-Bench: scores of `pitanks-duel` over decisions, with intervals over the trainings.

python -m tests.bench.benchmark_curves AGENT.npz …    evaluates agents, and adds them to docs/benchmark/curves.csv
python -m tests.bench.benchmark_curves                draws docs/images/benchmark.svg from that file and the results

Each agent is a training of its own, to the end of its budget; those of the budgets of the benchmark are in the results
beside the file. The table is the block `curves` of docs/benchmark.md.
"""

import argparse
import csv
from collections.abc import Iterable
from pathlib import Path
from statistics import mean
from typing import NamedTuple

from pigaming_app.ai.brain.archive import names, read
from pigaming_app.ai.networks import files as networks
from pigaming_app.ai.qlearning import table_files as tables
from pigaming_app.gym.benchmark.results import BenchmarkResults, measured, student_interval
from pigaming_app.gym.benchmark.tasks import FORMAT
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import from_json

ROOT = Path(__file__).resolve().parents[2]
CURVES, PICTURE, TASK = ROOT / "docs/benchmark/curves.csv", ROOT / "docs/images/benchmark.svg", "pitanks-duel"
LADDER = (100_000, 250_000, 500_000, 1_000_000, 10_000_000, 100_000_000)  # decisions of a training, at most
METHODS = {
    "ppo": "PPO (train ppo)",
    "sb3": "PPO (Stable-Baselines3)",
    "dqn": "DQN (Stable-Baselines3)",
    "cleanrl": "PPO (ppo_torch.py)",
    "clone": "behaviour cloning",
    "table": "Q-learning, table",
    "search": "random search",
}


class CurvePoint(NamedTuple):
    """An agent on its curve. `budget`: of the LADDER."""

    method: str
    budget: int
    seed: int
    decisions: int
    score: float


def main() -> None:
    """Add agents, or draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("agents", nargs="*", type=Path)
    if agents := parser.parse_args().agents:
        found = {point[:3]: point for point in (*filed(), *evaluated(agents))}
        rows = [CurvePoint._fields, *sorted(found.values())]
        write_atomic(CURVES, "".join(",".join(map(str, row)) + "\n" for row in rows).encode())
    else:
        draw([*filed(), *resulted()])


def resulted() -> Iterable[CurvePoint]:
    """The agents of the results."""
    for method in METHODS:
        path = CURVES.parent / f"{TASK}-{method}.json"
        for run in results_of(path).runs if path.exists() else ():
            if run.seed is not None and run.decisions is not None:
                yield CurvePoint(method, budget_of(run.decisions), run.seed, run.decisions, run.score)


def filed() -> list[CurvePoint]:
    """The agents of the file."""
    if not CURVES.exists():
        return []
    rows = csv.DictReader(CURVES.read_text("utf-8").splitlines())
    return [
        CurvePoint(row["method"], int(row["budget"]), int(row["seed"]), int(row["decisions"]), float(row["score"]))
        for row in rows
    ]


def evaluated(agents: Iterable[Path]) -> Iterable[CurvePoint]:
    """Agents with their scores."""
    for path in agents:
        (run,) = measured(TASK, path.parent, [path.name], "curve", print).runs
        assert run.seed is not None
        assert run.decisions is not None
        yield CurvePoint(method_of(path), budget_of(run.decisions), run.seed, run.decisions, run.score)


def results_of(path: Path) -> BenchmarkResults:
    """The content of a file of results."""
    return from_json(path.read_text("utf-8"), BenchmarkResults, FORMAT)


def budget_of(decisions: int) -> int:
    """The lowest of the LADDER that a training keeps."""
    return next(step for step in LADDER if decisions <= step)


def method_of(path: Path) -> str:
    """The key of METHODS for an agent's file."""
    raw = read(path, networks.MAX_BYTES)
    return "table" if names(raw) == tables.PARTS.keys() else str(networks.decode(raw, path.name).recipe["learner"])


def curves(found: Iterable[CurvePoint]) -> dict[str, dict[int, tuple[float, float, float, int]]]:
    """For each method and budget with three trainings or more: mean, interval and count; the best method first."""
    scores: dict[str, dict[int, list[float]]] = {}
    for point in sorted(found, key=lambda point: point.budget):
        scores.setdefault(point.method, {}).setdefault(point.budget, []).append(point.score)
    order = sorted(scores, key=lambda method: -mean(scores[method].get(1_000_000, [0.0])))
    drawn = {
        method: {budget: (*student_interval(row), len(row)) for budget, row in scores[method].items() if len(row) > 2}
        for method in order
    }
    return {method: steps for method, steps in drawn.items() if steps}


def draw(found: Iterable[CurvePoint]) -> None:
    """Write the picture."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams |= {"svg.hashsalt": TASK, "font.size": 12, "savefig.facecolor": "#f7f8f6"}
    from matplotlib import pyplot

    figure, plot = pyplot.subplots(figsize=(11, 5.5), layout="constrained")
    drawn = curves(found)
    for number, (method, steps) in enumerate(drawn.items()):
        budgets = [budget * 1.03 ** (number - 2) for budget in steps]  # side by side, so that no interval hides another
        middle, low, high = ([100.0 * row[k] for row in steps.values()] for k in range(3))
        below, above = ([abs(m - end) for m, end in zip(middle, ends, strict=True)] for ends in (low, high))
        marker = "osD^vP*"[number]
        plot.errorbar(budgets, middle, [below, above], marker=marker, capsize=3, label=METHODS[method])
    plot.set_xscale("log")
    ticks = sorted({budget for steps in drawn.values() for budget in steps})
    plot.set_xticks(ticks, [f"{budget / 1e6:g}" for budget in ticks])
    plot.minorticks_off()
    plot.set(xlabel="decisions of the training, millions", ylabel="pitanks-duel: share of wins, %", ylim=(0, 100))
    plot.grid(alpha=0.3)
    figure.legend(loc="outside right upper", fontsize=10)
    figure.savefig(PICTURE, metadata={"Date": None})
    pyplot.close(figure)


if __name__ == "__main__":
    main()
