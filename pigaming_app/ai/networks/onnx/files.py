"""Policies from elsewhere: ONNX models as brains of a game's networks. Plain play only; needs onnxruntime.

Contract in docs/networks.md: input float32 (1, inputs) from -1 to 1; output float32 logits (1, choices of all heads),
or one output a head, (1, choices), in the order of the heads. A model that fails in a match leaves its seat idle.
"""

import json
import logging
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from pigaming_app.ai.brain.archive import BrainFileError, failed, read
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import UNIT, Encoding
from pigaming_app.ai.networks.onnx.child import BUDGET
from pigaming_app.ai.networks.onnx.process import NO_MODEL, TOO_LONG, ModelFails, ModelProcess
from pigaming_app.ai.networks.policy import network_brain
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action

DEPTH = 32  # of subgraphs within subgraphs
LOCATION, EXTERNAL_DATA = 14, 13  # of a tensor
INSIDE = {  # messages in the fields of a message
    "model": {7: "graph", 25: "function"},
    "graph": {1: "node", 5: "tensor", 15: "sparse"},
    "function": {7: "node", 11: "attribute"},
    "node": {5: "attribute"},
    "attribute": {5: "tensor", 6: "graph", 10: "tensor", 11: "graph", 22: "sparse", 23: "sparse"},
    "sparse": {1: "tensor", 2: "tensor"},
    "tensor": {},
}

MAX_BYTES = 20_000_000
LARGEST = 1e4  # limit of logits; beyond it nothing changes
TRIALS = 3  # at load; the fastest counts

log = logging.getLogger("pigaming")


def has_external_data(model: bytes) -> bool:
    """Whether a tensor lies in another file. Raises ValueError for bytes that are no model."""
    return any(_externals(memoryview(model), "model", DEPTH))


def _externals(message: memoryview, kind: str, depth: int) -> Iterator[bool]:
    """True for each tensor in another file."""
    if not depth:
        raise ValueError("nested too deep")
    for number, value in _fields(message):
        if isinstance(value, memoryview):
            if kind == "tensor" and number == EXTERNAL_DATA:
                yield True
            elif number in INSIDE[kind]:
                yield from _externals(value, INSIDE[kind][number], depth - 1)
        elif kind == "tensor" and number == LOCATION and value:
            yield True


def _fields(message: memoryview) -> Iterator[tuple[int, int | memoryview]]:
    """Number and content of each field: a whole number, or bytes. Raises ValueError."""
    at = 0
    while at < len(message):
        key, at = _varint(message, at)
        wire = key & 7
        if wire == 0:
            value, at = _varint(message, at)
            yield key >> 3, value
            continue
        if wire not in (1, 2, 5):
            raise ValueError("no protocol buffer")
        length, at = _varint(message, at) if wire == 2 else (8 if wire == 1 else 4, at)
        if at + length > len(message):
            raise ValueError("cut off")
        if wire == 2:
            yield key >> 3, message[at : at + length]
        at += length


def _varint(message: memoryview, at: int) -> tuple[int, int]:
    """A whole number and the place after it. Raises ValueError."""
    value = 0
    for shift in range(0, 70, 7):
        if at >= len(message):
            break
        byte = message[at]
        at += 1
        value |= (byte & 127) << shift
        if byte < 128:
            return value, at
    raise ValueError("cut off")


class OnnxPolicy:
    """A model in place of `layers.Layers`. `idle`: it has failed in a match."""

    def __init__(self, encoding: Encoding, model: bytes, name: str) -> None:
        """Raises BrainFileError for a model of other shapes, or one that needs more time or memory than it may."""
        self.name, self.size, self.outputs, self.idle = name, encoding.size, encoding.outputs, False
        try:
            self._process = ModelProcess(model, encoding.size)
            _check_layout(encoding, *json.loads(self._process.layout))
            self._try()
        except ModelFails as reason:
            raise BrainFileError(str(reason)) from None

    def logits(self, inputs: Sequence[float]) -> list[float]:
        """As `Layers.logits`: inputs in units of 1/UNIT, outputs as sums."""
        return self.logits_of([inputs])[0]

    def logits_of(self, rows: Sequence[Sequence[float]]) -> list[list[float]]:
        """As `Layers.logits_of`."""
        import numpy as np

        nothing = [[0.0] * self.outputs for _ in rows]
        if self.idle or not rows:
            return nothing
        try:
            _, raw = self._process.outputs((np.array(rows, np.float32) / np.float32(UNIT)).tobytes())
        except ModelFails as reason:
            self._fail(str(reason))
            return nothing
        x = np.frombuffer(raw, np.float32).reshape(len(rows), -1).astype(float)
        logits: list[list[float]] = (UNIT * UNIT * np.nan_to_num(x).clip(-LARGEST, LARGEST)).tolist()
        return logits

    def _fail(self, reason: str) -> None:
        self.idle = True
        failed.append(self.name)
        line = f"{self.name}: {reason}; its seat idles from here on"
        log.warning(line)
        print(f"PiGaming: {line}", file=sys.stderr)

    def _try(self) -> None:
        """Make some decisions, and measure them. Raises BrainFileError or ModelFails."""
        import numpy as np

        random = np.random.default_rng(1).uniform(-1.0, 1.0, (2, self.size))
        rows = np.concatenate([np.array([[0.0], [1.0], [-1.0]]) * np.ones((1, self.size)), random]).astype(np.float32)
        times, raw = zip(*(self._process.outputs(rows.tobytes(), trial=True) for _ in range(TRIALS)), strict=True)
        count = len(raw[0]) // (4 * len(rows))
        if count != self.outputs:
            raise BrainFileError(f"its output has {count} numbers; {self.outputs} are needed")
        if min(times) > BUDGET:
            raise BrainFileError(TOO_LONG)


def read_model(path: Path, game: str) -> BrainKind:
    """The brain of a model that plays a game. Raises BrainFileError, whose message begins with the file's name."""
    name, raw = path.name, read(path, MAX_BYTES)
    try:
        encoding = ENCODINGS.get(game)
        if encoding is None:
            raise BrainFileError(f"networks play {', '.join(ENCODINGS)}, not {game}")
        if not _is_installed():
            raise BrainFileError("onnxruntime is missing (extra `onnx`)")
        _check_whole(raw)
        row = [OnnxPolicy(encoding, raw, name)]
    except BrainFileError as error:
        raise BrainFileError(f"{name}: {error}") from None
    kind = network_brain(name, encoding, lambda fast: row)
    return replace(kind, think=_idling(kind.think), plain=True)


@cache
def _idling(think: Callable[[Any, int, Any, Any], None]) -> Callable[[Any, int, Any, Any], None]:
    """A decision function that leaves the seat idle once the model has failed."""

    def think_or_idle(match: MatchState, seat: int, mind: Any, weights: Any) -> None:
        if not weights.idle:
            think(match, seat, mind, weights)
        if weights.idle:
            set_action(match.actions[seat], 0.0, 0.0, 0, 0)

    return think_or_idle


def _is_installed() -> bool:
    try:
        return find_spec("onnxruntime") is not None
    except ValueError:  # a module without a specification
        return False


def _check_whole(model: bytes) -> None:
    """Raises BrainFileError for bytes that are no model, or that lack its weights."""
    try:
        external = has_external_data(model)
    except ValueError:
        raise BrainFileError(NO_MODEL) from None
    if external:
        raise BrainFileError("its weights lie in another file; export it as one file (external_data=False)")


def _check_layout(encoding: Encoding, inputs: list[Any], outputs: list[Any]) -> None:
    """Raises BrainFileError unless inputs and outputs fit an encoding."""
    if len(inputs) != 1 or not _fits(inputs[0], encoding.size):
        raise BrainFileError(f"its input is {_layout(inputs)}; {encoding.game} needs float (1, {encoding.size})")
    wanted = [encoding.outputs] if len(outputs) == 1 else [count for _, count in encoding.heads]
    if len(outputs) != len(wanted) or not all(map(_fits, outputs, wanted)):
        heads = ", ".join(f"(1, {count})" for _, count in encoding.heads)
        raise BrainFileError(
            f"its output is {_layout(outputs)}; {encoding.game} needs float (1, {encoding.outputs}), or {heads}"
        )


def _fits(value: Sequence[Any], count: int) -> bool:
    """True for floats of the shape (1, count), where a name stands for any length."""
    kind, shape = value
    return (
        kind == "tensor(float)"
        and len(shape) == 2
        and all(part in (wanted, None) or isinstance(part, str) for part, wanted in zip(shape, (1, count), strict=True))
    )


def _layout(values: Sequence[Any]) -> str:
    """Types and shapes of inputs or outputs, in one line."""
    parts = [f"{kind} ({', '.join(str(part)[:12] for part in shape)})" for kind, shape in values]
    return "".join(char if char.isprintable() else "?" for char in ", ".join(parts))[:100] or "empty"
