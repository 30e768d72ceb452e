"""A small task in uncompiled play: compiling the loop of a task takes longer than all tests of the learner."""

from dataclasses import replace
from typing import Any

import numpy as np

from pigaming_app.ai.learning.cast import Cast, dispatcher, family_of
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.ppo import shard, win_rates
from pigaming_app.ai.ppo.learner import Hyper
from pigaming_app.ai.ppo.registry import TASKS
from pigaming_app.ai.ppo.task import EXPLOITER, LEARNER, OFF, POOL, LineUp
from pigaming_app.games.registry import games
from pigaming_app.sim.record import packed, unpack

TASK = replace(
    TASKS["pitanks"],
    line_ups=tuple(LineUp(1, (LEARNER, name, OFF, OFF)) for name in ("hand3", LEARNER, EXPLOITER, POOL)),
    rivals=("idle",),
    minutes=(0.1,),
)
TINY = Hyper(matches=8, decisions=4, minibatch=16)
SET = ["--set", "matches=8", "--set", "decisions=4", "--set", "minibatch=16"]


def plain_loop(task):
    """The loop of a task, as `shard.loop_of` returns it, over plain copies of the records."""
    cast, network = shard.cast_of(task)
    number, state = cast.families.index(family_of(network)), games()[task.game].state
    collect = shard.make_collect(task, dispatcher(cast.families), f"mind{number}")
    weights = [*Cast(cast.kinds, fast=False).weights]

    def loop(matches, minds, rows, *more):
        own = list(weights)
        own[number] = [layers_of(row) for row in rows[number]]
        states: list[Any] = [unpack(state, match) for match in matches]
        seated: list[list[Any]] = [[unpack(cast.mind, mind) for mind in seats] for seats in minds]
        collect(states, seated, own, *more)
        matches[:] = packed(states)
        minds[:] = packed([mind for seats in seated for mind in seats]).reshape(minds.shape)

    return loop


def layers_of(row):
    """The network of packed weights."""
    parts = [(row[name], row[f"{name}_bias"]) for name in ("first", "second", "last")]
    return Layers([matrix.reshape(-1, len(bias)) for matrix, bias in parts], [bias / 256 for _, bias in parts])


def play_plain(monkeypatch):
    """Play the small task for PiTanks, uncompiled."""
    monkeypatch.setitem(TASKS, "pitanks", TASK)
    for module in (shard, win_rates):
        monkeypatch.setattr(module, "loop_of", plain_loop)


def same(one, other):
    """True if two trainings are equal in every bit that determines how they go on."""
    (numbers, arrays), (others, other_arrays) = one.state(), other.state()
    skipped = {"seconds", "points"}
    numbers, others = ({key: state[key] for key in state.keys() - skipped} for state in (numbers, others))
    return numbers == others and all(np.array_equal(arrays[key], other_arrays[key]) for key in arrays)
