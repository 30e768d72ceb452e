"""Speed of `train ppo` with 1 and 2 Ray workers, and without Ray, on an idle machine with two processors or more.

    python -m tests.bench.ray_speedup --updates 30

Prints a JSON object: decisions per second in all, and while experience is gathered. Needs the extras train and ray.
"""

import argparse
import json
import os
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from time import perf_counter

from pigaming_app.storage.background import BLAS

os.environ.update(dict.fromkeys(BLAS, "1"))  # before NumPy is imported

from pigaming_app.ai.ppo.ray_workers import LOCAL, RayShards
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.training import Training, in_threads

WARM = 3  # updates before the clock starts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--game", default="pitanks", choices=list(TASKS))
    parser.add_argument("--updates", type=int, default=30)
    arguments = parser.parse_args()
    results = {str(workers): measured(arguments, workers) for workers in (0, 1, 2)}
    print(json.dumps(results, indent=2))


def measured(arguments: argparse.Namespace, workers: int) -> dict[str, float]:
    """Decisions per second; 0 workers: threads of this process."""
    with ThreadPoolExecutor(2) as threads:
        training = Training(TASKS[arguments.game], 1, WARM + arguments.updates)
        with RayShards(training, LOCAL, workers) if workers else nullcontext() as shards:
            gather, gathering = shards.gather if shards else in_threads(training, threads), 0.0

            def timed(*chunk):
                nonlocal gathering
                began = perf_counter()
                experiences = gather(*chunk)
                gathering += perf_counter() - began
                return experiences

            for _ in range(WARM):
                training.update(timed, threads)
            gathering, before, began = 0.0, training.decisions, perf_counter()
            for _ in range(arguments.updates):
                training.update(timed, threads)
            played, seconds = training.decisions - before, perf_counter() - began
    return {"decisions_per_second": round(played / seconds), "while_gathering": round(played / gathering)}


if __name__ == "__main__":
    main()
