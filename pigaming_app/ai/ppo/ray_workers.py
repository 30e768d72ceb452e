"""Shards of a training played by Ray actors, on this machine or several.

Policies go out, experience comes in. Now and then the workers hand in the states of their shards; if a worker dies, its
successor begins with these and replays what has been played since. Play depends on nothing else, so the training has
the same bits as one without Ray, as long as the machines are of one kind.
"""

import contextlib
import logging
import socket
from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any

import numpy as np

from pigaming_app import INSTALLED, ROOT
from pigaming_app.ai.ppo.population import Pool
from pigaming_app.ai.ppo.shard import Experience, Shard, ShardState
from pigaming_app.ai.ppo.task import LineUp, Task
from pigaming_app.ai.ppo.training import Training
from pigaming_app.sim.kernel import PACKAGE

LOCAL = "local"
SYNCED_EVERY = 10  # updates
REACHED = 10.0  # s, for the head of a cluster to answer
ATTEMPTS = 5  # to replace a worker, in a row
NOT_SENT = [".git", ".venv", "docs", "tests"]  # to other machines
Chunk = tuple[Sequence[Any], Pool, int]  # policies, pool and number of decisions of a call of `collect`


class NoCluster(Exception):
    """There is no such cluster, or its workers fail; the message is one line."""


class ShardWorker:
    """The actor: plays some shards."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._shards: dict[int, Shard] = {}

    def machine(self) -> str:
        """Name of the machine."""
        return socket.gethostname()

    def compile(self, line_ups: Sequence[LineUp]) -> None:
        """Leave the compiled loop in the cache of the machine."""
        Shard(self._task, line_ups, seed=0).warm()

    def begin(self, number: int, line_ups: Sequence[LineUp], state: ShardState) -> None:
        """Take over a shard in this state."""
        shard = self._shards[number] = Shard(self._task, line_ups, seed=0)
        shard.warm()
        shard.restore(state)

    def collect(self, number: int, chunk: Chunk) -> Experience:
        """Play on. Ray hands over arrays that cannot be written, which compiled code takes for another type."""
        policies, pool, decisions = chunk
        pool = pool._replace(rows=np.array(pool.rows))
        return self._shards[number].collect([np.array(matrices) for matrices in policies], pool, decisions)

    def replay(self, number: int, chunk: Chunk) -> None:
        """Play on, for the state alone."""
        self.collect(number, chunk)

    def state(self, number: int) -> ShardState:
        """The state of a shard."""
        return self._shards[number].state()


class RayShards:
    """The shards of a training in the hands of workers."""

    def __init__(self, training: Training, address: str, workers: int) -> None:
        """`address`: of a cluster, or LOCAL to start one here. Raises NoCluster; ImportError without Ray."""
        import ray
        from ray.exceptions import NodeDiedError, ObjectLostError, RayActorError, RayError

        self._ray, self._lost = ray, (RayActorError, NodeDiedError, ObjectLostError)
        self._training = training
        options: dict[str, Any] = {"address": address, "runtime_env": _sources()}
        if address == LOCAL:
            options = {"address": LOCAL, "num_cpus": workers, "include_dashboard": False}
        try:
            _reach(address)
            ray.init(log_to_driver=False, logging_level=logging.ERROR, **options)
        except (OSError, OverflowError, RuntimeError, ValueError, RayError) as error:
            raise NoCluster(f"--ray: {address}: {' '.join(str(error).split())}") from None
        self._chunks: list[Any] = []  # played since the shards of the training were up to date
        self._workers = [self._started() for _ in range(workers)]
        self._compile()
        for place, worker in enumerate(self._workers):
            self._brief(worker, place)
        self.sync()

    def __enter__(self) -> "RayShards":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ray.shutdown()

    def gather(self, policies: Sequence[Any], pool: Pool, decisions: int) -> list[Experience]:
        """Play `decisions` decisions in every shard. Raises NoCluster."""
        chunk = self._ray.put((policies, pool, decisions))
        experiences = self._ask(lambda worker, number: worker.collect.remote(number, chunk))
        self._chunks.append(chunk)
        if len(self._chunks) >= SYNCED_EVERY:
            self.sync()
        return experiences

    def sync(self) -> None:
        """Bring the training's own shards up to date. Raises NoCluster."""
        states = self._ask(lambda worker, number: worker.state.remote(number))
        for shard, state in zip(self._training.shards, states, strict=True):
            shard.restore(state)
        self._chunks.clear()

    def _ask(self, request: Callable[[Any, int], Any]) -> list[Any]:
        """The answer for every shard. Workers that have died are replaced. Raises NoCluster."""
        workers, found, attempts = len(self._workers), {}, 0
        pending = {number: request(self._workers[number % workers], number) for number in self._numbers()}
        while pending:
            number, answer = next(iter(pending.items()))
            try:
                found[number] = self._ray.get(answer)
                del pending[number]
                attempts = 0
            except self._lost as error:
                attempts += 1
                if attempts > ATTEMPTS:
                    raise NoCluster(f"--ray: workers fail: {str(error).splitlines()[0]}") from None
                place = number % workers
                worker = self._workers[place] = self._started()
                self._brief(worker, place)
                again = {other: request(worker, other) for other in self._numbers()[place::workers]}
                pending |= {other: answer for other, answer in again.items() if other not in found}
        return [found[number] for number in self._numbers()]

    def _started(self) -> Any:
        """A new worker."""
        return self._ray.remote(ShardWorker).options(scheduling_strategy="SPREAD").remote(self._training.task)

    def _compile(self) -> None:
        """Let one worker on each machine compile; the others load what it leaves in the cache."""
        with contextlib.suppress(*self._lost):  # then each compiles
            machines = self._ray.get([worker.machine.remote() for worker in self._workers])
            first = dict(zip(reversed(machines), reversed(self._workers), strict=True))
            line_ups = self._training.shards[0].line_ups[:1]
            self._ray.get([worker.compile.remote(line_ups) for worker in first.values()])

    def _brief(self, worker: Any, place: int) -> None:
        """Give a worker every shard of this place, as it was before the present request."""
        for number in self._numbers()[place :: len(self._workers)]:
            shard = self._training.shards[number]
            worker.begin.remote(number, shard.line_ups, shard.state())
            for chunk in self._chunks:
                worker.replay.remote(number, chunk)

    def _numbers(self) -> range:
        return range(len(self._training.shards))


def _reach(address: str) -> None:
    """Raises OSError unless something listens at HOST:PORT; Ray itself would try for minutes."""
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if host and port.isdecimal():
        socket.create_connection((host, int(port)), REACHED).close()


def _sources() -> dict[str, Any]:
    """This program, for machines that do not have it."""
    return {"py_modules": [str(PACKAGE)]} if INSTALLED else {"working_dir": str(ROOT), "excludes": NOT_SENT}
