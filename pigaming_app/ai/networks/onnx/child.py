"""The process that runs one ONNX model: what the model costs, it costs here.

Messages are a head (kind, bytes) and a body. In: the model, then requests, each a number of rows. Out: the layout of
inputs and outputs, then for each request the longest time of a row, in s, and the outputs of all rows; or a fault.
"""

import json
import os
import struct
import sys
from threading import Event, Thread
from time import process_time, sleep
from typing import IO, Any

HEAD = struct.Struct("<BI")
READY, LAYOUT, OUTPUTS, FAULT, MODEL, TRY, PLAY = range(7)  # kinds of messages
BUDGET = 0.020  # s of a core for a decision
TRIED = 0.5  # s of a core for a decision while it is tried
MEMORY = 256_000_000  # bytes beyond those of onnxruntime itself
TOO_LONG, TOO_LARGE = 3, 4  # exit codes
NO_MEMORY, UNREADABLE, FAILS = "memory", "unreadable", "fails"  # faults
SILENT = 4  # log level of onnxruntime: fatal errors only


class ModelGuard:
    """Ends the process when a decision takes too long or the model takes too much memory, within its code too."""

    def __init__(self) -> None:
        self._began: float | None = None
        self._limit = 0.0
        self._woken = Event()
        self._most = _peak_memory() + MEMORY
        Thread(target=self._watch, name="guard", daemon=True).start()

    def begin(self, limit: float) -> float:
        """Begin a decision of at most `limit` s of a core. Returns the time."""
        self._limit, self._began = limit, process_time()
        self._woken.set()
        return self._began

    def end(self) -> float:
        """End the decision. Returns the time."""
        self._began = None
        return process_time()

    def _watch(self) -> None:
        while True:
            began = self._began
            if began is None:
                self._woken.wait()
                self._woken.clear()
                continue
            left = began + self._limit - process_time()
            if self._began == began and left <= 0.0:
                os._exit(TOO_LONG)
            if _peak_memory() > self._most:
                os._exit(TOO_LARGE)
            sleep(min(max(left, 0.001), 0.01))


def limit_memory() -> None:
    """Refuse this process more than MEMORY bytes beyond what it has, where the system can."""
    try:
        import resource

        with open("/proc/self/status", encoding="ascii") as status:
            (data,) = (int(line.split()[1]) * 1024 for line in status if line.startswith("VmData"))
        resource.setrlimit(resource.RLIMIT_DATA, (data + MEMORY, data + MEMORY))
    except (ImportError, OSError, ValueError):
        return  # the guard watches what it uses


def _peak_memory() -> int:
    """Bytes that this process has used at most; 0 on Windows."""
    if sys.platform == "win32":
        return 0
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def send(stream: IO[bytes], kind: int, body: bytes = b"") -> None:
    """Write a message. Raises OSError."""
    stream.write(HEAD.pack(kind, len(body)) + body)
    stream.flush()


def receive(stream: IO[bytes]) -> tuple[int, bytes] | None:
    """Read a message; None at the end. Raises OSError."""
    head = stream.read(HEAD.size)
    if len(head) < HEAD.size:
        return None
    kind, length = HEAD.unpack(head)
    body = stream.read(length)
    return (kind, body) if len(body) == length else None


def _session(model: bytes) -> Any:
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = SILENT
    options.enable_cpu_mem_arena = False
    return onnxruntime.InferenceSession(model, options, providers=["CPUExecutionProvider"])


def _layout(values: Any) -> list[Any]:
    """Type and shape of inputs or outputs."""
    return [[one.type, [part if isinstance(part, int) else str(part) for part in one.shape]] for one in values]


def _is_memory(error: Exception) -> bool:
    return isinstance(error, MemoryError) or any(word in str(error).lower() for word in ("alloc", "memory"))


def main(size: int) -> None:
    """Answer until standard input ends. `size`: of a row."""
    import numpy as np
    import onnxruntime

    onnxruntime.set_default_logger_severity(SILENT)
    source, target = sys.stdin.buffer, sys.stdout.buffer
    send(target, READY)
    guard = ModelGuard()
    limit_memory()
    fault = UNREADABLE
    try:
        message = receive(source)
        session = _session(message[1] if message else b"")
        inputs = session.get_inputs()
        send(target, LAYOUT, json.dumps([_layout(inputs), _layout(session.get_outputs())]).encode())
        fault = FAILS
        while message := receive(source):
            kind, body = message
            longest, outputs = 0.0, []
            for row in np.frombuffer(body, np.float32).reshape(-1, 1, size):
                began = guard.begin(TRIED if kind == TRY else BUDGET)
                found = session.run(None, {inputs[0].name: row})
                longest = max(longest, guard.end() - began)
                outputs.append(np.concatenate([np.asarray(one, np.float32).ravel() for one in found]))
            send(target, OUTPUTS, struct.pack("<d", longest) + np.concatenate(outputs).tobytes())
    except Exception as error:  # onnxruntime raises many kinds of exceptions
        send(target, FAULT, (NO_MEMORY if _is_memory(error) else fault).encode())


if __name__ == "__main__":
    main(int(sys.argv[1]))
