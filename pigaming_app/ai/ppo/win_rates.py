"""Progress of a training: matches of the network, as a brain like any other, against fixed rivals and frozen copies."""

from collections.abc import Sequence
from concurrent.futures import Executor
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from pigaming_app.ai.learning.batch import matches as new_matches
from pigaming_app.ai.learning.cast import family_of
from pigaming_app.ai.learning.league import wilson
from pigaming_app.ai.networks.encoding import PERIOD
from pigaming_app.ai.plugin_faults import bound, check
from pigaming_app.ai.ppo.shard import PLAYED, cast_of, empty_experience, loop_of, nobody
from pigaming_app.ai.ppo.task import OFF, Task
from pigaming_app.ai.registry import find_brain
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.record import packed, unpack
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.plugins.endless import overseer

SEED = 1_000_000  # of the first match; no training plays it
PARTS = 4  # of the matches against a rival, for as many threads


class DuelScore(NamedTuple):
    """Ends of matches."""

    wins: int
    ties: int
    losses: int

    @property
    def share(self) -> float:
        """Share of the wins, a tie for half of one."""
        return (self.wins + 0.5 * self.ties) / sum(self)

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval of that share, 95 %."""
        return wilson(self.wins + 0.5 * self.ties, sum(self))


def win_rates(task: Task, network: Any, matches: int, threads: Executor) -> dict[str, DuelScore]:
    """Ends of `matches` duels against each rival of a task, for a network as a row of packed weights.

    Arenas and variants take turns, and every other match is played with the sides swapped.
    """
    parts = [range(k, matches, PARTS) for k in range(PARTS)]
    parts = [part for part in parts if part]
    jobs = [(rival, part) for rival in task.rivals for part in parts]
    found = [*threads.map(lambda job: _leads(task, network, *job), jobs)]
    leads = [[*chain(*found[k : k + len(parts)])] for k in range(0, len(found), len(parts))]
    return {rival: _score(some) for rival, some in zip(task.rivals, leads, strict=True)}


def points_between(task: Task, network: Any, other: Any, matches: int, threads: Executor) -> list[tuple[float, float]]:
    """The points of two networks, rows of packed weights, under each seed of as many such duels; a tie counts 1/2."""
    parts = [range(k, k + 2) for k in range(0, matches, 2)]
    scores = [_score(leads) for leads in threads.map(lambda part: _leads(task, network, other, part), parts)]
    return [(score.wins + 0.5 * score.ties, score.losses + 0.5 * score.ties) for score in scores]


def _score(leads: Sequence[float]) -> DuelScore:
    wins, losses = sum(lead > 0 for lead in leads), sum(lead < 0 for lead in leads)
    return DuelScore(wins, len(leads) - wins - losses, losses)


def _leads(task: Task, network: Any, rival: Any, numbers: range) -> list[float]:
    """By how much some of the duels were won, by their numbers. `rival`: a brain's name, or packed weights."""
    rules, arenas = games()[task.game], [*dict.fromkeys(task.arenas)]
    variants = [rules.variants[name] for name in dict.fromkeys(task.variants)]
    cast, player = cast_of(task)
    number, copied = cast.families.index(family_of(player)), not isinstance(rival, str)
    kinds = player, player if copied else find_brain(task.game, rival)
    networks = np.concatenate([cast.weights[number], rival if copied else network])
    networks[cast.mind_of(player, 0).row] = network[0]
    setups, seated, players = [], [], ROBOTS if task.pairs else 2
    for i in numbers:
        lap, stop = divmod(i // 2, len(arenas))
        variant, arena = variants[(lap + stop) % len(variants)], arenas[stop]
        one, two, three, four = (Seat("ai" if k < players else OFF, variant.teams[k]) for k in range(ROBOTS))
        seed, minutes = SEED + i // 2, task.minutes[0]
        setups.append(
            Setup(task.game, arena, (one, two, three, four), minutes, seed, variant.name, variant.default_goal)
        )
        minds = [cast.mind_of(kinds[(k + i) % 2], seed * ROBOTS + k) for k in range(players)]
        for k, mind in enumerate(minds):
            rivals = (k + i) % 2 == 1
            if copied or not rivals:
                getattr(mind, f"mind{number}").sharpness = task.sharpness
            if copied and rivals:
                mind.row = len(networks) - 1
        seated.append([*minds, *(nobody(cast) for _ in range(players, ROBOTS))])
    states = new_matches(setups)
    weights = tuple(networks if k == number else row for k, row in enumerate(cast.weights))
    longest = bound(task.game, max(round((task.minutes[0] * 60 + variant.overtime) * HZ) for variant in variants))
    nothing = empty_experience(task, 0, -(-longest // PERIOD))
    policies = [np.zeros((1, 1, 1), np.float32)] * 3
    overseer.run(
        task.game,
        states["tick"].sum,
        loop_of(task),
        states,
        packed([mind for row in seated for mind in row]).reshape(-1, ROBOTS),
        weights,
        np.full((len(numbers), ROBOTS), -1),
        *policies,
        *nothing[:PLAYED],
    )
    ends: list[Any] = [unpack(rules.state, state) for state in states]
    check(task.game, ends)
    own = [i % 2 for i in numbers]
    return [rules.ranking_key(end, k) - rules.ranking_key(end, 1 - k) for k, end in zip(own, ends, strict=True)]
