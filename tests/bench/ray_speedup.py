"""Speed of `train ppo` on Ray workers, measured and by a model, on an idle machine with two processors or more.

    python -m tests.bench.ray_speedup --updates 30
    python -m tests.bench.ray_speedup --model --rate 1000

Prints a JSON object: decisions per second in all, and while experience is gathered, without Ray and with 1 and 2
workers; with --model the measured costs of an update, and by them the speed with up to 1,000 workers. An update waits
for all shards, then learns, so its costs add up:

    T(w) = play + w (message + transfer + learner)        a shard of today's size for each worker
    T(w) = s play / w + w message + s (transfer + learner)    today's s shards, divided among w workers

`rate`: of the network at the learner, Mbit/s; a transfer takes at least the time that its bytes need there.
Needs the extras train and ray.
"""

import argparse
import json
import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from time import perf_counter, thread_time
from typing import Any, NamedTuple

from pigaming_app.storage.background import BLAS

os.environ.update(dict.fromkeys(BLAS, "1"))  # before NumPy is imported

from pigaming_app.ai.ppo.ray_workers import LOCAL, RayShards
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.task import SHARDS
from pigaming_app.ai.ppo.training import Training, in_threads

WARM = 3  # updates before the clock starts
WORKERS = (1, 2, 4, 8, 16, 32, 64, 125, 250, 500, 1000)  # of the model


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--game", default="pitanks", choices=list(TASKS))
    parser.add_argument("--updates", type=int, default=30)
    parser.add_argument("--model", action="store_true")
    parser.add_argument("--rate", type=float, default=1000.0)
    arguments = parser.parse_args()
    if arguments.model:
        costs = costs_of(arguments)
        found = {"costs": costs._asdict(), "model": [prediction(costs, count) for count in WORKERS]}
    else:
        found = {str(workers): measured(arguments, workers) for workers in (0, 1, 2)}
    print(json.dumps(found, indent=2))


def measured(arguments: argparse.Namespace, workers: int) -> dict[str, float]:
    """Decisions per second; 0 workers: threads of this process."""
    with ThreadPoolExecutor(2) as threads:
        training = Training(TASKS[arguments.game], 1, WARM + arguments.updates)
        with RayShards(training, LOCAL, workers) if workers else nullcontext() as shards:
            gather, gathering = shards.gather if shards else in_threads(training, threads), 0.0

            def timed(*chunk: Any) -> Any:
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


class Costs(NamedTuple):
    """Of an update, s, for one shard of today's size.

    Playing and learning are times of a processor: of the thread that plays, and of the one that improves the policy,
    while another, with less to do, improves the value function. Other programs hardly change them.
    """

    decisions: float  # in a shard
    play: float
    message: float  # a request to a worker, and its answer
    transfer: float  # the policies to a worker, and its experience to the learner
    learner: float


def costs_of(arguments: argparse.Namespace) -> Costs:
    """The costs, measured on this machine."""
    training, chunks, playing = Training(TASKS[arguments.game], 1, WARM + arguments.updates), list[Any](), 0.0

    def timed(*chunk: Any) -> Any:
        nonlocal playing
        chunks[:], began = [chunk], thread_time()
        experiences = [shard.collect(*chunk) for shard in training.shards]
        playing += thread_time() - began
        return experiences

    with ThreadPoolExecutor(2) as threads:
        for _ in range(WARM):
            training.update(timed, threads)
        playing, before, began = 0.0, training.decisions, thread_time()
        for _ in range(arguments.updates):
            training.update(timed, threads)
        learning, played = thread_time() - began - playing, training.decisions - before
    shards = SHARDS * arguments.updates
    message, transfer = crossings(chunks[0], training.shards[0].collect(*chunks[0]), arguments.rate)
    return Costs(played / shards, playing / shards, message, transfer, learning / shards)


def crossings(chunk: Any, experience: Any, rate: float) -> tuple[float, float]:
    """The times of a message without content, and of policies out and experience in, s; `rate` in Mbit/s."""
    import ray

    class Echo:
        def empty(self) -> None:
            pass

        def exchange(self, chunk: Any) -> Any:
            return experience

    ray.init(address=LOCAL, num_cpus=1, include_dashboard=False, log_to_driver=False)
    worker = ray.remote(Echo).remote()
    message = fastest(lambda: ray.get(worker.empty.remote()))
    exchange = fastest(lambda: ray.get(worker.exchange.remote(ray.put(chunk))))
    ray.shutdown()
    wire = 8.0 * (sum(map(size_of, chunk)) + size_of(experience)) / (1e6 * rate)
    return message, max(exchange - message, wire)


def fastest(call: Callable[[], object], times: int = 30) -> float:
    """The least time of a call, s."""

    def seconds() -> Iterator[float]:
        for _ in range(times):
            began = perf_counter()
            call()
            yield perf_counter() - began

    return min(seconds())


def size_of(content: Any) -> int:
    """Bytes of the arrays in some content."""
    if isinstance(content, (tuple, list)):
        return sum(map(size_of, content))
    return int(getattr(content, "nbytes", 0))


def prediction(costs: Costs, workers: int) -> dict[str, Any]:
    """Decisions per second with some workers, of both kinds, and what takes most of an update of the first."""
    shares = {
        "play": costs.play,
        "transfer": workers * (costs.message + costs.transfer),
        "learner": workers * costs.learner,
    }
    fixed = SHARDS * (costs.play / workers + costs.transfer + costs.learner) + workers * costs.message
    return {
        "workers": workers,
        "decisions_per_second": round(workers * costs.decisions / sum(shares.values())),
        "of_todays_shards": round(SHARDS * costs.decisions / fixed),
        "most": max(shares, key=lambda name: shares[name]),
    }


if __name__ == "__main__":
    main()
