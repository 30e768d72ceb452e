"""Training on several machines: nodes of a Ray cluster, of which some are lost in the middle of an update.

The extra `ray` is large; `main.py test --long` installs it. What needs no cluster is proved on a stand-in.
"""

import pickle
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from types import ModuleType, SimpleNamespace

import pytest

from pigaming_app.ai.ppo import ray_workers, shard
from pigaming_app.ai.ppo import training as training_module
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.ray_workers import LOCAL, SYNCED_EVERY, NoCluster, RayShards, ShardWorker
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.training import Training, in_threads
from tests.ai.ppo import plain
from tests.ai.ppo.plain import TASK as PLAIN
from tests.ai.ppo.plain import TINY, play_plain, same

TASK = TASKS["race"]  # compiled in half the time of the others
UPDATES = SYNCED_EVERY + 3
SMALL = Hyper(matches=32, decisions=8, minibatch=128)


def after_last_request(shards, disaster):
    """Let something happen once, when all shards of the next update have been asked for but have not answered."""
    ask = shards._ask

    def asking(request):
        def requested(worker, number):
            answer = request(worker, number)
            if number == len(shards._training.shards) - 1 and shards._ask is asking:
                shards._ask = ask
                disaster()
            return answer

        return ask(requested)

    shards._ask = asking


@pytest.mark.long
@pytest.mark.again  # five minutes on two slow cores
@pytest.mark.filterwarnings("ignore")
def test_a_lost_worker_and_a_lost_node_change_no_bit_of_the_training():
    import ray
    from ray.cluster_utils import Cluster

    with ThreadPoolExecutor(2) as threads:
        alone = Training(TASK, 5, UPDATES, SMALL)
        for _ in range(UPDATES):
            alone.update(in_threads(alone, threads), threads)
        cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
        second = cluster.add_node(num_cpus=1)
        try:
            training = Training(TASK, 5, UPDATES, SMALL)
            with RayShards(training, cluster.address, workers=2) as shards:
                first = list(shards._workers)
                for update in range(UPDATES):
                    if update == 3:
                        after_last_request(shards, lambda: ray.kill(shards._workers[0]))
                    if update == SYNCED_EVERY + 1:
                        kept = list(shards._workers)
                        after_last_request(shards, lambda: cluster.remove_node(second, allow_graceful=False))
                    training.update(shards.gather, threads)
                shards.sync()
                assert shards._workers[0] is not first[0]
                assert shards._workers != kept  # the node had one of them
        finally:
            cluster.shutdown()
    assert same(training, alone)


class PlainWorker(ShardWorker):
    """Plays uncompiled; other nodes have no tests, so the class is sent with what it uses of them."""

    def __init__(self, task):
        vars(shard)["loop_of"] = plain.plain_loop
        super().__init__(task)


@pytest.mark.long
@pytest.mark.again  # a minute: nine processes of Ray begin
@pytest.mark.filterwarnings("ignore")
def test_half_of_four_nodes_are_lost_and_the_rest_is_resumed_bit_for_bit(monkeypatch):
    """A population: the exploiter and the pool play in the hands of the workers, too."""
    import ray
    from ray import cloudpickle
    from ray.cluster_utils import Cluster

    def lose_half():
        """Two nodes with whoever plays there, and two of four workers wherever they play."""
        for node in nodes[:2]:
            cluster.remove_node(node, allow_graceful=False)
        for worker in shards._workers[:2]:
            ray.kill(worker)

    for module in (plain, sys.modules[__name__]):
        cloudpickle.register_pickle_by_value(module)
    play_plain(monkeypatch)
    monkeypatch.setattr(ray_workers, "ShardWorker", PlainWorker)
    alone, training, resumed = (Training(PLAIN.populated(), 5, 8, TINY) for _ in range(3))
    with ThreadPoolExecutor(1) as threads:
        for _ in range(8):
            alone.update(in_threads(alone, threads), threads)
        cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
        nodes = [cluster.add_node(num_cpus=1) for _ in range(3)]
        try:
            with RayShards(training, cluster.address, workers=4) as shards:
                first = list(shards._workers)
                training.update(shards.gather, threads)
                after_last_request(shards, lose_half)
                for _ in range(3):
                    training.update(shards.gather, threads)
                shards.sync()
                assert sum(now is not then for now, then in zip(shards._workers, first, strict=True)) >= 2
            resumed.restore(*training.state())
            with RayShards(resumed, cluster.address, workers=2) as shards:
                for _ in range(4):
                    resumed.update(shards.gather, threads)
                shards.sync()
        finally:
            cluster.shutdown()
    assert same(resumed, alone)


def crossed(content):
    """What arrives elsewhere of something that was sent: a copy, whose arrays cannot be written."""
    buffers: list[pickle.PickleBuffer] = []
    sent = pickle.dumps(content, protocol=5, buffer_callback=buffers.append)
    return pickle.loads(sent, buffers=[bytes(buffer.raw()) for buffer in buffers])


class Lost(Exception):
    """Of a stand-in for Ray: an actor that has died."""


class Actor:
    """Of a stand-in for Ray: an actor in this process, which is `lost` at its request of that number."""

    def __init__(self, kind, task, lost):
        self.worker, self.requests, self.lost = kind(crossed(task)), 0, lost

    def __getattr__(self, name):
        def remote(*arguments):
            self.requests += 1
            if self.lost and self.requests >= self.lost:
                return Lost()
            return crossed(getattr(self.worker, name)(*crossed(arguments)))

        return SimpleNamespace(remote=remote)


def stand_in(monkeypatch, losses):
    """Ray in this process. `losses`: of the actors, in the order in which they are started; then none."""

    def get(answer):
        if isinstance(answer, list):
            return [get(one) for one in answer]
        if isinstance(answer, Lost):
            raise answer
        return answer

    left, started = list(losses), []

    def actor_of(kind):
        def remote(task):
            started.append(Actor(kind, task, left.pop(0) if left else 0))
            return started[-1]

        return SimpleNamespace(options=lambda **_: SimpleNamespace(remote=remote))

    ray, exceptions = ModuleType("ray"), ModuleType("ray.exceptions")
    vars(ray).update(init=lambda **_: None, shutdown=lambda: None, put=crossed, get=get, remote=actor_of)
    vars(exceptions).update(NodeDiedError=Lost, ObjectLostError=Lost, RayActorError=Lost, RayError=Lost)
    for module in (ray, exceptions):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return started


def test_a_population_plays_in_the_hands_of_workers_bit_for_bit_though_half_are_lost(monkeypatch):
    play_plain(monkeypatch)
    monkeypatch.setattr(training_module, "SELF_EVERY", 1)
    started = stand_in(monkeypatch, losses=(0, 5, 0, 6))
    task = replace(PLAIN.populated(), variants=("plain",), arenas=("islands",), minutes=(0.003,))  # nine ticks
    hyper = replace(TINY, decisions=1)
    alone, training = (Training(task, 5, 3, hyper) for _ in range(2))
    with ThreadPoolExecutor(1) as threads, RayShards(training, LOCAL, workers=4) as shards:
        for _ in range(3):
            alone.update(in_threads(alone, threads), threads)
            training.update(shards.gather, threads)
        shards.sync()
    assert len(started) == 4 + 2
    assert len(training.pools[0]) == 4, "the network as it began, and three copies"
    assert same(training, alone)


@pytest.mark.long
def test_a_cluster_that_is_not_there_is_named_in_one_line():
    with pytest.raises(NoCluster, match=r"^--ray: 127.0.0.1:1: .*[Rr]efused[^\n]*$"):
        RayShards(Training(TASK, 5, 1, SMALL), "127.0.0.1:1", workers=1)
