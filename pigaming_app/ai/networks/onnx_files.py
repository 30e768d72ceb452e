"""Policies from elsewhere: ONNX models as brains of a game's networks. Plain play only; needs onnxruntime.

Contract in docs/networks.md: input float32 (1, inputs) from -1 to 1; output float32 logits (1, choices of all heads),
or one output a head, (1, choices), in the order of the heads.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from pigaming_app.ai.brain.archive import BrainFileError, read
from pigaming_app.ai.brain.kind import BrainKind
from pigaming_app.ai.networks.encoding import UNIT, Encoding
from pigaming_app.ai.networks.policy import network_brain
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.networks.thoughts import make_explain

MAX_BYTES = 20_000_000
LARGEST = 1e4  # limit of logits; beyond it nothing changes
SILENT = 4  # log level of onnxruntime: fatal errors only


class OnnxPolicy:
    """A model in place of `layers.Layers`."""

    def __init__(self, encoding: Encoding, session: Any) -> None:
        """Raises BrainFileError for a model of other shapes."""
        self.session, self.size = session, encoding.size
        inputs, outputs = session.get_inputs(), session.get_outputs()
        if len(inputs) != 1 or inputs[0].type != "tensor(float)" or not _fits(inputs[0].shape, encoding.size):
            raise BrainFileError(f"its input is {_layout(inputs)}; {encoding.game} needs float (1, {encoding.size})")
        self.input = inputs[0].name
        wanted = [encoding.outputs] if len(outputs) == 1 else [count for _, count in encoding.heads]
        if len(outputs) != len(wanted) or not all(
            output.type == "tensor(float)" and _fits(output.shape, count)
            for output, count in zip(outputs, wanted, strict=True)
        ):
            heads = ", ".join(f"(1, {count})" for _, count in encoding.heads)
            raise BrainFileError(
                f"its output is {_layout(outputs)}; {encoding.game} needs float (1, {encoding.outputs}), or {heads}"
            )
        try:
            count = len(self.logits([0.0] * encoding.size))
        except Exception as error:  # onnxruntime raises many kinds of exceptions
            raise BrainFileError(f"the model fails ({type(error).__name__})") from None
        if count != encoding.outputs:
            raise BrainFileError(f"its output has {count} numbers; {encoding.game} needs {encoding.outputs}")

    def logits(self, inputs: Sequence[float]) -> list[float]:
        """As `Layers.logits`: inputs in units of 1/UNIT, outputs as sums."""
        import numpy as np

        row = np.array([inputs], np.float32) / np.float32(UNIT)
        x = np.concatenate([output.ravel() for output in self.session.run(None, {self.input: row})])
        logits: list[float] = (UNIT * UNIT * np.nan_to_num(x.astype(float)).clip(-LARGEST, LARGEST)).tolist()
        return logits

    def logits_of(self, rows: Sequence[Sequence[float]]) -> list[list[float]]:
        """As `Layers.logits_of`."""
        return [self.logits(row) for row in rows]


def read_model(path: Path, game: str) -> BrainKind:
    """The brain of a model that plays a game. Raises BrainFileError, whose message begins with the file's name."""
    name = path.name
    read(path, MAX_BYTES)
    try:
        encoding = ENCODINGS.get(game)
        if encoding is None:
            raise BrainFileError(f"networks play {', '.join(ENCODINGS)}, not {game}")
        row = [OnnxPolicy(encoding, _session(path))]
    except BrainFileError as error:
        raise BrainFileError(f"{name}: {error}") from None
    kind = network_brain(name, encoding, lambda fast: row)
    return replace(kind, explain=make_explain(encoding), plain=True)


def _session(path: Path) -> Any:
    """A model on one thread; its weights may lie in a file beside it. Raises BrainFileError."""
    try:
        import onnxruntime
    except ImportError:
        raise BrainFileError("onnxruntime is missing (extra `onnx`)") from None
    onnxruntime.set_default_logger_severity(SILENT)
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = SILENT
    try:
        return onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
    except Exception:  # onnxruntime raises many kinds of exceptions for damaged files
        raise BrainFileError("not an ONNX model, or damaged, or of a newer version than onnxruntime") from None


def _fits(shape: Sequence[Any], count: int) -> bool:
    """True for (1, count), where a name stands for any length."""
    return len(shape) == 2 and all(
        part in (wanted, None) or isinstance(part, str) for part, wanted in zip(shape, (1, count), strict=True)
    )


def _layout(values: Sequence[Any]) -> str:
    """Types and shapes of inputs or outputs, in one line."""
    parts = [f"{one.type} ({', '.join(str(part)[:12] for part in one.shape)})" for one in values]
    return "".join(char if char.isprintable() else "?" for char in ", ".join(parts))[:100] or "empty"
