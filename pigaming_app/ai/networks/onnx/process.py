"""A running ONNX model, seen from the arcade: it answers in time, or its process is ended with a reason."""

import os
import struct
import subprocess
import sys
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread
from typing import IO, Any
from weakref import finalize

from pigaming_app import ROOT
from pigaming_app.ai.networks.onnx import child
from pigaming_app.ai.networks.onnx.child import BUDGET, MEMORY

STARTING, LOADING, ANSWERING = 30.0, 3.0, 0.5  # s: for onnxruntime, for a model, and for an answer on a busy machine
TOO_LONG = f"a decision takes longer than {1000 * BUDGET:g} ms"
TOO_LARGE = f"it needs more than {MEMORY // 1_000_000} MB of memory"
NO_MODEL = "not an ONNX model, or damaged, or of a newer version than onnxruntime"
FAULTS = {child.NO_MEMORY: TOO_LARGE, child.UNREADABLE: NO_MODEL, child.FAILS: "the model fails"}


class ModelFails(Exception):
    """The model cannot be used any more; the text is the reason."""


class ModelProcess:
    """The process of one model. It ends with this object, and with the program."""

    def __init__(self, model: bytes, size: int) -> None:
        """`size`: of a row. Raises ModelFails."""
        self._process = subprocess.Popen(
            [sys.executable, "-m", child.__name__, str(size)],
            cwd=ROOT,
            env={**os.environ, "PYTHONUNBUFFERED": ""},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self._answers: SimpleQueue[tuple[int, bytes] | None] = SimpleQueue()
        self.end = finalize(self, _end, self._process)
        Thread(target=_read, args=(self._process.stdout, self._answers), name="onnx", daemon=True).start()
        self._receive(STARTING, "onnxruntime does not start")
        self.layout = self._ask(child.MODEL, model, LOADING, f"it is not loaded after {LOADING:g} s")

    def outputs(self, rows: bytes, trial: bool = False) -> tuple[float, bytes]:
        """The longest time of a row, s, and the float32 outputs for float32 rows. Raises ModelFails."""
        kind, most = (child.TRY, LOADING) if trial else (child.PLAY, ANSWERING)
        body = self._ask(kind, rows, most, TOO_LONG)
        return struct.unpack_from("<d", body)[0], body[8:]

    def _ask(self, kind: int, body: bytes, seconds: float, reason: str) -> bytes:
        assert self._process.stdin
        with suppress(OSError):  # it has ended, which the answer tells
            child.send(self._process.stdin, kind, body)
        return self._receive(seconds, reason)

    def _receive(self, seconds: float, reason: str) -> bytes:
        try:
            answer = self._answers.get(timeout=seconds)
        except Empty:
            self.end()
            raise ModelFails(reason) from None
        if answer and answer[0] != child.FAULT:
            return answer[1]
        code = self._process.wait()
        self.end()
        if answer:
            raise ModelFails(FAULTS[answer[1].decode()])
        reasons = {child.TOO_LONG: TOO_LONG, child.TOO_LARGE: TOO_LARGE}
        raise ModelFails(reasons.get(code, f"it has ended its process (exit code {code})"))


def _read(stream: IO[bytes], answers: "SimpleQueue[Any]") -> None:
    """Thread body: queue the answers, and None at the end."""
    with suppress(OSError, ValueError):
        while answer := child.receive(stream):
            answers.put(answer)
    answers.put(None)


def _end(process: "subprocess.Popen[bytes]") -> None:
    process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream:
            with suppress(OSError):
                stream.close()
