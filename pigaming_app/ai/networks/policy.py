"""Networks as brains: two hidden layers of as many units each, 64 as a rule, in whole numbers.

Weights, inputs and activations are whole numbers in units of 1/256, so that sums are exact. What remains is arithmetic
on single numbers, which IEEE 754 rounds alike everywhere: plain and compiled play agree to the last bit on every
platform. The squashing function is Padé's approximation of tanh. A choice is drawn with a probability proportional to
exp(sharpness * logit), where exp is (1 + x/64)**64.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import floor
from typing import TYPE_CHECKING, Annotated, Any

from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import PERIOD, UNIT, Encoding, NetworkSenses
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import quantise
from pigaming_app.sim.kernel import kernel, kernel_with_loops
from pigaming_app.sim.record import dtype, record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.world import HZ
from pigaming_app.storage.schema import Share, between

if TYPE_CHECKING:
    from pigaming_app.ai.networks.layers import Layers

HIDDEN = 64  # units of each hidden layer, as a rule
SIZES = range(8, 129, 8)  # possible numbers of them
LOGIT = 1.0 / (UNIT * UNIT)  # 1 in sums
DRAWN_FOR = HZ // 2  # ticks for which an aiming error lasts


@dataclass(frozen=True)
class Handicap:
    """What makes a network weaker than it is. The default leaves it as strong as it can be."""

    delay: Share = 0.0  # s, age of the poses of others
    error: Share = 0.0  # rad, standard deviation of the bearing of others, redrawn every half second
    sharpness: Annotated[float, between(0.0, 10.0)] = 1.0  # factor of the logits: below 1 it chooses less surely
    thrift: Share = 0.0  # cost of a shot that it has in mind, in points
    speed: Annotated[float, between(0.1, 1.0)] = 1.0  # share of full speed that it drives at most
    form: Annotated[float, between(0.0, 0.9)] = 0.0  # share of that which it may lack on a bad day, drawn by match
    reluctance: Annotated[float, between(-20.0, 20.0)] = 0.0  # logits by which it prefers not to shoot, if above 0
    turns: float = 0.0  # s, at most, for which it goes for one opponent before the next has its turn; 0: no turns


NO_HANDICAP = Handicap()


@cache
def weights_record(size: int, outputs: int, units: int = HIDDEN) -> type:
    """The record of a compiled network's parameters."""
    hints = {
        "first": Annotated[list[float], size * units, "f"],
        "first_bias": Annotated[list[float], units, "f"],
        "second": Annotated[list[float], units * units, "f"],
        "second_bias": Annotated[list[float], units, "f"],
        "last": Annotated[list[float], units * outputs, "f"],
        "last_bias": Annotated[list[float], outputs, "f"],
    }
    return record(type("NetworkWeights", (), {"__annotations__": hints, "__module__": __name__}))


@record
class NetworkMind:
    """A network's memory, with lists as long as `mind_record` makes them: those of the last decision."""

    senses: NetworkSenses
    wait: int  # ticks until the next decision
    random: int
    error: float  # see Handicap
    sharpness: float
    reluctance: float
    speed: float  # share of full speed in this match
    error_left: int  # ticks until the aiming error is redrawn
    inputs: Annotated[list[float], 2, "f"]
    hidden: Annotated[list[float], 2, "f"]  # scratch space of compiled code, else 0
    logits: Annotated[list[float], 2, "f"]
    choices: Annotated[list[int], 1]


@cache
def mind_record(encoding: Encoding, units: int = HIDDEN) -> type[NetworkMind]:
    """The record of the memory of a game's networks of one size."""
    hints = {
        "senses": encoding.senses,
        "inputs": Annotated[list[float], encoding.size, "f"],
        "hidden": Annotated[list[float], 2 * units, "f"],
        "logits": Annotated[list[float], encoding.outputs, "f"],
        "choices": Annotated[list[int], len(encoding.heads)],
    }
    name = "NetworkMind" if units == HIDDEN else f"NetworkMind{units}"  # casts sort their families by name
    return record(type(name, (NetworkMind,), {"__annotations__": hints, "__module__": __name__}))


def is_network_mind(kind: type, encoding: Encoding) -> bool:
    """True for the memory of a game's networks, of whatever size."""
    return any(kind is mind_record(encoding, units) for units in SIZES)


def _forward_loops(mind: NetworkMind, weights: Any) -> None:
    """`forward` in compiled code: no sum over a row, so that the inner loops are vectorised as they stand.

    Each adds four inputs at once, which saves most loads and stores of the sums; whole numbers allow any order.
    """
    inputs, hidden, logits = mind.inputs, mind.hidden, mind.logits
    size, outputs, units = len(inputs), len(logits), len(hidden) // 2
    for unit in range(units):
        hidden[unit] = weights.first_bias[unit]
        hidden[units + unit] = weights.second_bias[unit]
    for unit in range(outputs):
        logits[unit] = weights.last_bias[unit]
    for i in range(0, size - 3, 4):
        a, b, c, d = inputs[i], inputs[i + 1], inputs[i + 2], inputs[i + 3]
        if a != 0.0 or b != 0.0 or c != 0.0 or d != 0.0:
            for unit in range(units):
                k = i * units + unit
                near = a * weights.first[k] + b * weights.first[k + units]
                far = c * weights.first[k + 2 * units] + d * weights.first[k + 3 * units]
                hidden[unit] += near + far
    for i in range(size - size % 4, size):
        a = inputs[i]
        for unit in range(units):
            hidden[unit] += a * weights.first[i * units + unit]
    for unit in range(units):
        hidden[unit] = squash(hidden[unit])
    for i in range(0, units, 4):
        a, b, c, d = hidden[i], hidden[i + 1], hidden[i + 2], hidden[i + 3]
        for unit in range(units):
            k = i * units + unit
            near = a * weights.second[k] + b * weights.second[k + units]
            far = c * weights.second[k + 2 * units] + d * weights.second[k + 3 * units]
            hidden[units + unit] += near + far
    for unit in range(units, 2 * units):
        hidden[unit] = squash(hidden[unit])
    for i in range(0, units, 2):
        a, b = hidden[units + i], hidden[units + i + 1]
        for unit in range(outputs):
            k = i * outputs + unit
            logits[unit] += a * weights.last[k] + b * weights.last[k + outputs]
    for unit in range(2 * units):
        hidden[unit] = 0.0


@kernel
def squash(total: float) -> float:
    """A sum, bent by Padé's tanh x (27 + x^2) / (27 + 9 x^2) into whole units; here y = x / 3."""
    y = total * (LOGIT / 3.0)
    if y > 1.0:
        y = 1.0
    elif y < -1.0:
        y = -1.0
    square = y * y
    return floor((square + 3.0) * y / (square * (3.0 / UNIT) + 1.0 / UNIT) + 0.5)


@kernel_with_loops(_forward_loops)
def forward(mind: NetworkMind, weights: "Layers") -> None:
    """Fill in the logits from the inputs."""
    mind.logits[:] = weights.logits(mind.inputs)


@kernel
def odds(logit: float, best: float, sharpness: float) -> float:
    """exp(sharpness * (logit - best)), approximately, by arithmetic alone; logits as sums."""
    x = 1.0 + sharpness * (logit - best) * LOGIT / 64.0
    if x <= 0.0:
        return 0.0
    for _ in range(6):
        x *= x
    return x


@kernel
def draw(mind: NetworkMind, first: int, count: int) -> int:
    """A choice of the head whose logits begin at `first`."""
    best = mind.logits[first]
    for i in range(1, count):
        if mind.logits[first + i] > best:
            best = mind.logits[first + i]
    total = 0.0
    for i in range(count):
        total += odds(mind.logits[first + i], best, mind.sharpness)
    left = uniform(mind) * total
    for i in range(count):
        left -= odds(mind.logits[first + i], best, mind.sharpness)
        if left < 0.0:
            return i
    return count - 1


@kernel
def misjudge(mind: NetworkMind) -> None:
    """Redraw the aiming error when its time is over."""
    mind.error_left -= PERIOD
    if mind.error_left <= 0:
        mind.error_left = DRAWN_FOR
        mind.senses.error = 2.0 * mind.error * bell(mind)


@cache
def make_think(encoding: Encoding) -> Callable[[Any, int, Any, Any], None]:
    """The decision function of a game's networks."""
    encode, act = encoding.encode, encoding.act
    names, counts = zip(*encoding.heads, strict=True)
    heads = len(counts)
    shot = 1 + sum(counts[: names.index("fire")]) if "fire" in names else -1  # logit of a shot

    def think(match: MatchState, seat: int, mind: NetworkMind, weights: Any) -> None:
        mind.wait -= 1
        if mind.wait > 0:
            return
        mind.wait = PERIOD
        if mind.error:
            misjudge(mind)
        encode(match, seat, mind.senses, mind.inputs)
        forward(mind, weights)
        if shot >= 0 and mind.reluctance > 0.0:
            mind.logits[shot] -= mind.reluctance / LOGIT
        first = 0
        for head in range(heads):
            mind.choices[head] = draw(mind, first, counts[head])
            first += counts[head]
        act(match, seat, mind.choices)
        if mind.speed < 1.0:
            match.actions[seat].linear = quantise(mind.speed * match.actions[seat].linear)

    return kernel(think)


class Policy:
    """A network as the `weights` of a brain."""

    def __init__(self, layers: "Layers") -> None:
        self.layers = layers
        self._row: Any = None

    def __call__(self, fast: bool) -> Any:
        """A row of one: the matrices, or (`fast`) a NumPy record of them."""
        if not fast:
            return [self.layers]
        if self._row is None:
            self._row = packed_layers(self.layers)
        return self._row


def packed_layers(layers: "Layers") -> Any:
    """A row of one NumPy record with the parameters of a network."""
    import numpy as np

    size, outputs = len(layers.matrices[0]), layers.matrices[2].shape[1]
    row = np.zeros(1, dtype(weights_record(size, outputs, layers.units)))
    for name, matrix, bias in zip(("first", "second", "last"), layers.matrices, layers.biases, strict=True):
        row[name][0], row[f"{name}_bias"][0] = matrix.ravel(), bias
    return row


def network_brain(
    name: str,
    encoding: Encoding,
    weights: Callable[[bool], Any],
    handicap: Handicap = NO_HANDICAP,
    units: int = HIDDEN,
) -> BrainKind:
    """A brain that plays by a network with so many units in each hidden layer."""

    def reset(mind: NetworkMind, seed: int) -> None:
        mind.random, mind.sharpness, mind.error = seeded(seed), handicap.sharpness, handicap.error
        mind.reluctance = handicap.reluctance
        mind.senses.delay, mind.senses.thrift, mind.senses.turns = handicap.delay, handicap.thrift, handicap.turns
        mind.wait = 1 + int(uniform(mind) * PERIOD)
        mind.speed = handicap.speed * (1.0 - handicap.form * uniform(mind))

    return BrainKind(name, mind_record(encoding, units), make_think(encoding), reset, weights)
