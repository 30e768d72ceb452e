"""Where the processor time of an update of `train ppo` goes: a table of shares, which other programs do not change.

    python -m tests.bench.ppo_profile --game pitanks --updates 10

Needs the extra train.
"""

import argparse
import os
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from time import process_time, thread_time
from typing import Any
from unittest.mock import patch

from pigaming_app.storage.background import BLAS

os.environ.update(dict.fromkeys(BLAS, "1"))  # before NumPy is imported

from pigaming_app.ai.ppo.learner import Learner, PolicyNetwork
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.shard import Shard
from pigaming_app.ai.ppo.training import Training, in_threads

WARM = 2  # updates before the clock starts
PARTS = {  # and what they are within
    "play": (Shard, "collect", ""),
    "advantages": (Training, "_digested", ""),
    "policy": (Learner, "_improve", ""),
    "value": (Learner, "_estimate", ""),
    "layers": (PolicyNetwork, "forward", "policy, value, advantages"),
    "gradients": (PolicyNetwork, "gradient", "policy, value"),
    "Adam": (PolicyNetwork, "descend", "policy, value"),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--game", default="pitanks", choices=list(TASKS))
    parser.add_argument("--updates", type=int, default=10)
    arguments = parser.parse_args()
    training, spent = Training(TASKS[arguments.game], 1, WARM + arguments.updates), Counter[str]()
    with ThreadPoolExecutor(2) as threads, ExitStack() as stack:
        for part, (owner, method, _) in PARTS.items():
            stack.enter_context(patch.object(owner, method, timed(getattr(owner, method), part, spent)))
        for _ in range(WARM):
            training.update(in_threads(training, threads), threads)
        spent.clear()
        before, began = training.decisions, process_time()
        for _ in range(arguments.updates):
            training.update(in_threads(training, threads), threads)
        total, decisions = process_time() - began, training.decisions - before
    print(f"{1e6 * total / decisions:.1f} µs of a processor for each of {decisions:,} decisions")
    for part, (_, _, within) in PARTS.items():
        print(f"{part:>10} {spent[part] / total:4.0%}" + (f"  within {within}" if within else ""))


def timed(method: Callable[..., Any], part: str, spent: Counter[str]) -> Callable[..., Any]:
    """The method, whose processor time is added to a part."""

    def timing(*arguments: Any) -> Any:
        began = thread_time()
        try:
            return method(*arguments)
        finally:
            spent[part] += thread_time() - began  # type: ignore[assignment]  # a Counter of seconds

    return timing


if __name__ == "__main__":
    main()
