"""Test bench of the firmware: a simulated ATmega328P (board.c) with its serial port on a pseudo-terminal."""

import os
import shutil
import subprocess
from pathlib import Path
from typing import IO, NamedTuple, cast

from pigaming_app.hardware.radio import packets
from pigaming_app.hardware.radio.packets import PacketDecoder, drive_packet
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.wire import ARENA

HERE = Path(__file__).parent
FIRMWARE = HERE.parents[2] / "pigaming_app" / "hardware" / "firmware"
BAUD = 57600
BYTE = 10e6 / BAUD  # µs on the line
DRIVE_BYTES, REPORT_BYTES = packets.LENGTHS[packets.DRIVE], packets.LENGTHS[packets.REPORT]
AHEAD = WheelCommand(1.0, 1.0)


def missing():
    """Missing tools to build and run the firmware."""
    tools = [tool for tool in ("avr-gcc", "make", "gcc") if shutil.which(tool) is None]
    files = ["/usr/lib/avr/include/avr/io.h", "/usr/include/simavr/sim_avr.h", "/usr/include/libelf.h"]
    return tools + [file for file in files if not os.path.exists(file)]


class Event(NamedTuple):
    """An output of the board: `motors` with both duties of 256, `byte`, or `reset`."""

    at: int  # µs
    kind: str
    motors: tuple[int, ...]


class Board:
    """A simulated robot; `files` as of `build`."""

    def __init__(self, files, address, arena):
        self.process = subprocess.Popen(
            [*files, str(BAUD), str(address), str(arena)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._commands, self._output = cast(IO[str], self.process.stdin), cast(IO[str], self.process.stdout)
        lines = iter(self._output.readline, "")
        self.device = next(line for line in lines if line.startswith("/dev/")).strip()
        import serial

        self.port = serial.Serial(self.device, BAUD, timeout=10)
        self.events = []
        self.at = 0  # µs
        self._read = 0  # bytes
        self.do("battery 5000")
        self.run(50)

    def do(self, line):
        """Execute a command of the board; returns its output."""
        self._commands.write(line + "\n")
        self._commands.flush()
        new: list[Event] = []
        while not new or new[-1].kind != "done":
            at, kind, *motors = self._output.readline().split()
            new.append(Event(int(at), kind, tuple(map(int, motors))))
        self.at = new.pop().at
        self.events += new
        return new

    def run(self, milliseconds):
        """Advance simulated time; returns its events."""
        return self.do(f"run {round(1000 * milliseconds)}")

    def say(self, data):
        """Send bytes to the robot; they arrive one by one as time passes."""
        self.port.write(data)
        self.do(f"await {len(data)}")

    def drive(self, seq=1, wheels=(AHEAD,) * 4, arena=ARENA):
        self.say(drive_packet(arena, seq, wheels))

    def keep(self, numbers, wheels=(AHEAD,) * 4, arena=ARENA):
        """Send drive packets with these sequence numbers, one each 20 ms."""
        for seq in numbers:
            self.drive(seq, wheels, arena)
            self.run(20)

    @property
    def motors(self):
        return next(event.motors for event in reversed(self.events) if event.kind == "motors")

    def reports(self):
        """Reports of the robot since the last call, and the times at which they were complete."""
        times = [event.at for event in self.events if event.kind == "byte"][self._read :]
        self._read += len(times)
        decoder = PacketDecoder()
        said = decoder.feed(self.port.read(len(times)))
        assert decoder.garbage == 0
        return [
            (at, packets.report_from(packet))
            for at, packet in zip(times[REPORT_BYTES - 1 :: REPORT_BYTES], said, strict=True)
        ]

    def close(self):
        self.port.close()
        self._commands.close()
        assert self.process.wait(timeout=10) == 0
        self._output.close()


def build(folder):
    """Build the board and the firmware; returns their files."""
    board = folder / "board"
    gcc = ["gcc", "-O2", "-I/usr/include/simavr", "-o", board, HERE / "board.c", "-lsimavr", "-lelf"]
    subprocess.run(gcc, check=True)
    subprocess.run(["make", "-s", "-C", FIRMWARE, f"BUILD={folder}"], check=True, stdout=subprocess.DEVNULL)
    return board, folder / "robot.elf"
