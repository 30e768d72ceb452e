"""Training on several machines: two nodes of a Ray cluster, of which one is lost in the middle of an update.

The extra `ray` is large; `main.py test --long` installs it.
"""

from concurrent.futures import ThreadPoolExecutor

import pytest

from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.ray_workers import SYNCED_EVERY, NoCluster, RayShards
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.training import Training, in_threads
from tests.ai.ppo.plain import same

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


@pytest.mark.long
def test_a_cluster_that_is_not_there_is_named_in_one_line():
    with pytest.raises(NoCluster, match=r"^--ray: 127.0.0.1:1: .*[Rr]efused[^\n]*$"):
        RayShards(Training(TASK, 5, 1, SMALL), "127.0.0.1:1", workers=1)
