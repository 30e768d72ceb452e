"""The face of a game towards a network: inputs from a match, choices to an action.

Inputs are whole numbers from -UNIT to UNIT, carried as floats. All later sums are sums of whole numbers and therefore
exact, whatever the order of their terms: NumPy, compiled loops and every processor give the same bits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import floor
from typing import Any

from pigaming_app.games.simple import MatchState
from pigaming_app.sim.grid import BLOCKED, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS, Robot

UNIT = 256.0  # 1.0 in inputs, activations and weights
STEP = 40.0  # px, by which a robot looks for room to drive
ANYWHERE = 1e18  # px², more than any distance
Inputs = list[float]  # of a network, of the length `Encoding.size`

PERIOD = 5  # ticks between decisions: 10 Hz


@record
class NetworkSenses:
    """Parameters of a network's observation; those of a game add memory between decisions."""

    delay: float  # s, age of the poses of others
    error: float  # rad by which others appear beside where they are
    thrift: float  # cost of a shot, in points, that it has in mind; nothing in a game without shots
    turns: float  # s for which it goes for one opponent at most, before the next has its turn; 0: no turns


@dataclass(frozen=True)
class Encoding:
    """Inputs and outputs of a game's networks, an even number each. `encode` and `act` are kernels.

    - `encode(match, seat, senses, inputs)` fills `inputs`, which has the length `size`.
    - `act(match, seat, choices)` sets the seat's action from one choice for each head.
    """

    game: str
    groups: tuple[tuple[str, int], ...]  # names and lengths of the groups of inputs, in order
    heads: tuple[tuple[str, int], ...]  # names and numbers of choices, in order
    encode: Callable[[Any, int, Any, Any], None]
    act: Callable[[Any, int, Any], None]
    senses: type[NetworkSenses] = NetworkSenses  # record: what a level lacks, and scratch space of `encode`

    def __post_init__(self) -> None:
        if self.size % 2 or self.outputs % 2:
            raise ValueError(f"{self.size} inputs, {self.outputs} choices; both must be even")

    @property
    def size(self) -> int:
        """Number of inputs."""
        return sum(length for _, length in self.groups)

    @property
    def outputs(self) -> int:
        """Number of choices of all heads together."""
        return sum(choices for _, choices in self.heads)


@kernel
def whole(value: float) -> float:
    """A value clamped to [-1, 1], in whole units."""
    if value >= 1.0:
        return UNIT
    if value <= -1.0:
        return -UNIT
    return floor(value * UNIT + 0.5)


@kernel
def saturating(value: float) -> float:
    """A smooth bend of any number into (-1, 1): 1/2 at 1."""
    return value / (1.0 + value) if value >= 0.0 else value / (1.0 - value)


@kernel
def nearest_robot(match: MatchState, seat: int, told: int, within2: float = ANYWHERE) -> int:
    """The nearest of the other robots whose bit in `told` is 0, -1 if none; `within2`: square of the range, px²."""
    me = match.robots[seat]
    best, nearest2 = -1, within2
    for i in range(1, ROBOTS):
        j = (seat + i) % ROBOTS
        robot = match.robots[j]
        if robot.present and not (told >> j) & 1:
            dx, dy = robot.x - me.x, robot.y - me.y
            if dx * dx + dy * dy < nearest2:
                best, nearest2 = j, dx * dx + dy * dy
    return best


@kernel
def encode_room(
    match: MatchState,
    me: Robot,
    ahead_x: float,
    ahead_y: float,
    rays: int,
    steps: int,
    turn_cos: float,
    turn_sin: float,
    k: int,
    inputs: Inputs,
) -> None:
    """The room to drive in some directions, clockwise from ahead, from input k on. Neighbours differ by the turn."""
    x, y = STEP * ahead_x, STEP * ahead_y
    for ray in range(rays):
        free, to_x, to_y = 0, me.x, me.y
        while free < steps:
            to_x += x
            to_y += y
            if match.grid[node_at(to_x, to_y)] & BLOCKED:
                break
            free += 1
        inputs[k + ray] = whole(free / (0.5 * steps) - 1.0)
        x, y = turn_cos * x - turn_sin * y, turn_sin * x + turn_cos * y
