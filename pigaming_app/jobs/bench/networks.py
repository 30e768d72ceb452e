"""The cost of a network's decision on one core: its observation and its forward pass, plain and compiled.

Matches of four `hand2` from the start on; at every fifth tick each robot observes as if a network sat on its seat, so
what robots share and what lasts from one decision to the next counts as in play. The network has random weights.
Of several runs the best counts.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from time import perf_counter
from typing import Any

import numpy as np

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.networks.encoding import PERIOD, Encoding
from pigaming_app.ai.networks.layers import Layers
from pigaming_app.ai.networks.policy import HIDDEN, forward, mind_record, packed_layers
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.sim.kernel import compiled
from pigaming_app.sim.record import packed
from pigaming_app.sim.world import ROBOTS

DECISIONS = 120  # of every robot: 12 s of play
RUNS = 5


def measure(game: str, scene: Batch, fast_scene: Batch | None) -> dict[str, float | None]:
    """Costs in µs a decision. `scene`: one plain match; `fast_scene`: compiled ones, None without numba."""
    encoding = ENCODINGS[game]
    plain = _plain(encoding, scene)
    fast = _compiled(encoding, fast_scene) if fast_scene else (None, None)
    names = "observation_plain_us", "forward_plain_us", "observation_compiled_us", "forward_compiled_us"
    return dict(zip(names, (*plain, *fast), strict=True))


def _layers(encoding: Encoding) -> Layers:
    random = np.random.default_rng(1)
    sizes = encoding.size, HIDDEN, HIDDEN, encoding.outputs
    matrices = [random.integers(-100, 101, size) for size in pairwise(sizes)]
    return Layers(matrices, [np.zeros(size) for size in sizes[1:]])


def _plain(encoding: Encoding, scene: Batch) -> tuple[float, float]:
    match, layers, make_mind = scene.matches[0], _layers(encoding), mind_record(encoding)
    minds = [make_mind() for _ in range(ROBOTS)]
    observing = []
    for _ in range(DECISIONS):
        scene.play(PERIOD)
        for seat, mind in enumerate(minds):
            observing.append(_timed(encoding.encode, match, seat, mind.senses, mind.inputs))

    def decide() -> None:
        for _ in range(DECISIONS):
            forward(minds[0], layers)

    deciding = min(_timed(decide) for _ in range(RUNS)) / DECISIONS
    return 1e6 * float(np.mean(_lowest(observing))), 1e6 * deciding


def _lowest(seconds: Sequence[float]) -> Any:
    """All but the slowest hundredth, in which other programs ran."""
    return np.sort(seconds)[: len(seconds) * 99 // 100]


def _compiled(encoding: Encoding, scene: Batch) -> tuple[float, float]:
    moments = []
    for _ in range(DECISIONS):
        scene.play(PERIOD)
        moments.append(scene.matches.copy())
    rows, weights = np.stack(moments), packed_layers(_layers(encoding))
    minds = packed([mind_record(encoding)() for _ in range(rows.shape[1] * ROBOTS)]).reshape(-1, ROBOTS)
    observe, decide = _loops(encoding)
    observe(rows[:1], minds)
    decide(minds, weights, 1)
    seconds = [(_timed(observe, rows, minds), _timed(decide, minds, weights, DECISIONS)) for _ in range(RUNS)]
    observing, deciding = (1e6 * min(run) / (DECISIONS * minds.size) for run in zip(*seconds, strict=True))
    return observing, deciding


def _loops(encoding: Encoding) -> tuple[Callable[..., None], Callable[..., None]]:
    encode = encoding.encode

    def observe(rows: Any, minds: Any) -> None:
        for t in range(len(rows)):
            for i in range(len(minds)):
                for seat in range(ROBOTS):
                    encode(rows[t, i], seat, minds[i, seat].senses, minds[i, seat].inputs)

    def decide(minds: Any, weights: Any, times: int) -> None:
        for _ in range(times):
            for i in range(len(minds)):
                for seat in range(ROBOTS):
                    forward(minds[i, seat], weights[0])

    return compiled(observe), compiled(decide)


def _timed(function: Callable[..., None], *arguments: Any) -> float:
    began = perf_counter()
    function(*arguments)
    return perf_counter() - began
