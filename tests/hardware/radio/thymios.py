"""Thymios whose machine is Aseba's own, in simulated time; Aseba's compiler, simulator and switch, all of Debian."""

import ctypes
import os
import shutil
import socket
import struct
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest

from pigaming_app.hardware.emulator.thymio import Dongle, EmulatedThymio

TOOLS = ("asebamassloader", "asebaplayground", "asebaswitch", "xvfb-run", "gcc")
MISSING = [tool for tool in TOOLS if shutil.which(tool) is None]
needs_aseba = pytest.mark.skipif(
    bool(MISSING),
    reason=f"no {', '.join(MISSING)}: apt-get install --no-install-recommends aseba xvfb gcc libc6-dev",
)
HERE = Path(__file__).parent
SEND = ctypes.CFUNCTYPE(None, ctypes.c_uint16, ctypes.POINTER(ctypes.c_uint8), ctypes.c_uint16)


@cache
def machine() -> Any:
    """Debian's machine of Aseba, with the variables and events of an EmulatedThymio."""
    built = Path(mkdtemp()) / "node.so"
    sources = ["-I/usr/include/aseba", str(HERE / "thymio_node.c"), "-lasebavmbuffer", "-lasebavm"]
    subprocess.run(["gcc", "-shared", "-fPIC", "-O1", *sources, "-o", str(built)], check=True)
    library = ctypes.CDLL(str(built))
    shutil.rmtree(built.parent)
    library.make.restype, library.variables.restype = ctypes.c_void_p, ctypes.POINTER(ctypes.c_int16)
    names, sizes = zip(*EmulatedThymio.layout, strict=True)

    def texts(words: tuple[str, ...]) -> Any:
        return (ctypes.c_char_p * (len(words) + 1))(*(word.encode() for word in words), None)

    library.describe(texts(names), (ctypes.c_uint16 * len(sizes))(*sizes), texts(EmulatedThymio.events))
    return library


class AsebaThymio(EmulatedThymio):
    """A Thymio in Aseba's own machine."""

    def __init__(self, number: int, send: Callable[[int, bytes], None]) -> None:
        def take(node: int, data: Any, length: int) -> None:
            assert node == number
            whole = bytes(data[:length])
            send(struct.unpack_from("<H", whole)[0], whole[2:])

        self._take = SEND(take)
        super().__init__(number, send)

    def start(self) -> None:
        self._node = ctypes.c_void_p(machine().make(self.number, self._take))
        self.variables = machine().variables(self._node)
        self._elapsed = 0.0

    def event(self, name: str) -> None:
        machine().event(self._node, self.events.index(name))

    def receive(self, source: int, kind: int, data: bytes) -> None:
        message = struct.pack("<H", kind) + data
        machine().receive(self._node, source, message, len(message))


def compiled(source: str, dongle: Dongle, scratch: Path) -> list[int]:
    """The words that Aseba's compiler makes of a program, as loaded to the only robot on a dongle."""
    file = scratch / "program.aesl"
    file.write_text(source, "utf-8")
    (scratch / "en_US.UTF-8").symlink_to("/usr/lib/locale/C.utf8")  # the compiler asks for this one
    with socket.create_server(("127.0.0.1", 0)) as server:
        target = f"tcp:127.0.0.1;{server.getsockname()[1]}"
        loader = subprocess.Popen(
            ["asebamassloader", "--once", str(file), target],
            env={**os.environ, "LOCPATH": str(scratch)},
            stderr=subprocess.PIPE,
        )
        port, _ = server.accept()
        port.setblocking(False)
        with port, loader:
            while not any(dongle.robots[0].program) and loader.poll() is None:
                time.sleep(0.01)
                with suppress(BlockingIOError):
                    dongle.write(port.recv(4096))
                dongle.advance(0.02)
                port.sendall(dongle.read(dongle.in_waiting))
            loader.kill()
            assert loader.stderr is not None
            assert any(dongle.robots[0].program), loader.stderr.read()
    program = dongle.robots[0].program
    return program[: len(program) - next(i for i, word in enumerate(reversed(program)) if word) + 1]


def free_ports(count: int) -> list[int]:
    """TCP ports that are free now."""
    servers = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [server.getsockname()[1] for server in servers]
    for server in servers:
        server.close()
    return ports


@contextmanager
def running(*command: str, ports: list[int], scratch: Path) -> Iterator[None]:
    """A program that listens at these ports, until the end."""
    environment = {**os.environ, "HOME": str(scratch), "XDG_RUNTIME_DIR": str(scratch)}
    environment.pop("SDL_VIDEODRIVER", None)
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    ) as program:
        try:
            for port in ports:
                _await(port, program)
            yield
        finally:
            os.killpg(program.pid, 15)


def _await(port: int, program: "subprocess.Popen[bytes]") -> None:
    for _ in range(400):
        if f":{port:04X} " in Path("/proc/net/tcp").read_text():  # to connect would take the robot's only client
            return
        assert program.poll() is None
        time.sleep(0.05)
    raise AssertionError(f"nobody listens at port {port}")


def playground(ports: list[int], scratch: Path) -> list[str]:
    """The command that runs Aseba's simulator with a Thymio at each of these ports."""
    robots = "".join(
        f'<robot type="thymio2" x="{40 + 60 * i}" y="40" port="{port}" angle="0" nodeId="{11 + i}"/>'
        for i, port in enumerate(ports)
    )
    file = scratch / "four.playground"
    file.write_text(
        f'<!DOCTYPE aseba-playground><aseba-playground><color name="white" r="1" g="1" b="1"/>'
        f'<world w="300" h="100" color="white"/>{robots}</aseba-playground>'
    )
    return ["xvfb-run", "-a", "asebaplayground", str(file)]
