"""File format of trained networks: one .npz of at most 100 kB with whole-number weights and a JSON head.

Weights and biases are int16 in units of 1/256. The head holds what the training was (recipe, seed, curve), the licence,
the hash of the engine, and a handicap: a level is a network with a handicap.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any

from msgspec import Meta

from pigaming_app import ASSETS
from pigaming_app.ai.brain.archive import HEAD, BrainFileError, pack, unpack, verify
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.policy import HIDDEN, NO_HANDICAP, SIZES, Handicap, Policy, network_brain
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.storage.parsing import ParseError
from pigaming_app.storage.schema import Count, Finite, to_plain, typed

BRAINS = ASSETS / "brains"
FORMAT = "pigaming-network-1"
LICENCE = "MIT"
MAX_BYTES = 100_000  # size limit of a file
MAX_HEAD, MAX_MATRIX, MAX_BIAS = 400_000, 100_000, 2_000  # limits of unpacked sizes, bytes; a character has four
MATRICES, BIASES = ("first", "second", "last"), ("first_bias", "second_bias", "last_bias")
PARTS = {HEAD: MAX_HEAD, **dict.fromkeys(MATRICES, MAX_MATRIX), **dict.fromkeys(BIASES, MAX_BIAS)}
Text = Annotated[str, Meta(max_length=4_000)]
Scalar = Annotated[str, Meta(max_length=50_000)] | Finite | int | bool | None
Values = Scalar | list[Scalar]


class NetworkError(BrainFileError):
    """A file is not a valid network; the message is one line."""


@dataclass(frozen=True)
class TrainingCurve:
    """The course of a training: numbers by row and column, such as updates and shares of wins."""

    columns: Annotated[tuple[Text, ...], Meta(max_length=20)] = ()
    rows: Annotated[tuple[tuple[Finite, ...], ...], Meta(max_length=1_000)] = ()

    def __post_init__(self) -> None:
        if any(len(row) != len(self.columns) for row in self.rows):
            raise ValueError("rows and columns do not fit")


@dataclass(frozen=True, eq=False)
class TrainedNetwork:
    """A network with the parameters of its training.

    `matrices`: int16, (inputs, n), (n, n), (n, outputs), in units of 1/256; `biases`: int16, one for each column.
    """

    name: Text
    game: Text
    matrices: Sequence[Any]
    biases: Sequence[Any]
    recipe: Annotated[Mapping[Text, Values], Meta(max_length=100)]  # hyper-parameters, opponents
    seed: int
    updates: Count
    decisions: Count  # of the learner's robots, over the whole training
    curve: TrainingCurve = TrainingCurve()
    licence: Text = LICENCE
    engine: Text = ""  # hash of the engine it was trained with; "": the present one
    handicap: Handicap = NO_HANDICAP

    def __post_init__(self) -> None:
        object.__setattr__(self, "engine", self.engine or engine_hash(self.game))

    @property
    def units(self) -> int:
        """Units of each hidden layer."""
        return int(self.matrices[0].shape[1])

    @property
    def other_engine(self) -> bool:
        """True if it was trained with another version of the engine, so that results may differ."""
        return self.engine != engine_hash(self.game)


def encode(trained: TrainedNetwork) -> bytes:
    """Content of the file of a network. Raises NetworkError for one that `decode` would refuse."""
    parts = {key: value for key, value in vars(trained).items() if key not in ("matrices", "biases")}
    head = {"format": FORMAT, **to_plain(parts)}
    arrays = dict(zip((*MATRICES, *BIASES), (*trained.matrices, *trained.biases), strict=True))
    raw = pack(head, arrays)
    decode(raw, trained.name)
    return raw


def decode(raw: bytes, name: str) -> TrainedNetwork:
    """Validate and unpack the content of the file `name`. Raises NetworkError, whose message begins with the name."""
    try:
        if len(raw) > MAX_BYTES:
            raise NetworkError(f"it is larger than {MAX_BYTES:,} bytes")
        head, arrays = unpack(raw, "network", FORMAT, PARTS)
        return _trained(head, arrays)
    except BrainFileError as error:
        raise NetworkError(f"{name}: {error}") from None


def brain_of(trained: TrainedNetwork) -> BrainKind:
    """The brain that plays by a network, with its handicap."""
    return network_brain(trained.name, ENCODINGS[trained.game], policy_of(trained), trained.handicap, trained.units)


def policy_of(trained: TrainedNetwork) -> Policy:
    """The parameters of a network, for brains."""
    from pigaming_app.ai.networks.layers import Layers

    return Policy(Layers(trained.matrices, trained.biases))


@cache
def shipped(name: str, folder: Path = BRAINS) -> TrainedNetwork:
    """A network that ships with the arcade, or with a plug-in in its folder, cached. Raises OSError, NetworkError."""
    path = folder / f"{name}.npz"
    return decode(path.read_bytes(), path.name)


def shipped_brain(
    name: str,
    game: str,
    file: str,
    folder: Path = BRAINS,
    handicap: Mapping[str, float] = MappingProxyType({}),
    units: int = HIDDEN,
) -> BrainKind:
    """A brain `name` by a network that ships as `file`.npz in a folder, read on first use.

    `handicap`: what makes it weaker, by name: `delay` (s, age of the poses of others), `error` (rad, of their bearing),
    `sharpness` (below 1 it chooses less surely), `thrift` (points that a shot costs), `speed` (share of full speed),
    `form` (share of that which it lacks on a bad day), `turns` (s for which it goes for one opponent),
    `reluctance` (off the logit of a shot). `units`: of each hidden layer, as in the file.
    """

    @cache
    def policy() -> Policy:
        return policy_of(shipped(file, folder))

    kind = network_brain(name, ENCODINGS[game], lambda fast: policy()(fast), Handicap(**handicap), units)
    return replace(kind, file=folder / f"{file}.npz")


def _trained(head: Mapping[str, Any], arrays: Mapping[str, Any]) -> TrainedNetwork:
    """The network after validation. Raises BrainFileError."""
    from pigaming_app.ai.networks.layers import EXACT, Layers

    encoding = ENCODINGS.get(str(head.get("game")))
    if encoding is None:
        raise NetworkError(f"a network for another game; networks play {', '.join(ENCODINGS)}")
    units = arrays["first_bias"].size
    if units not in SIZES:
        raise NetworkError(f"its hidden layers have {units} units; possible are {', '.join(map(str, SIZES))}")
    sizes = (encoding.size, units, units, encoding.outputs)
    shapes = [*pairwise(sizes), *((size,) for size in sizes[1:])]
    if any(array.dtype.str != "<i2" for array in arrays.values()):
        raise NetworkError("its weights are not whole numbers of 16 bits")
    if [array.shape for array in arrays.values()] != shapes:
        raise NetworkError(f"the network has another shape than those of {encoding.game}")
    verify(head, arrays)
    matrices, biases = tuple(arrays[part] for part in MATRICES), tuple(arrays[part] for part in BIASES)
    if Layers(matrices, biases).largest_sum() >= EXACT:
        raise NetworkError("its weights are too large")
    try:
        trained = typed({**head, "matrices": matrices, "biases": biases}, TrainedNetwork)
    except ParseError as error:
        raise NetworkError(f"its head: {error}") from None
    if trained.handicap.turns:
        raise NetworkError("its head: handicap.turns: only some encodings have them, in code")
    return trained
