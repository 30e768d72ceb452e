"""Robots of an emulated arena whose boards run their own programs: on Wi-Fi, with XBees, or micro:bits.

Each takes the place of the arena's radio, so the same faults can be injected; the boards drive the arena's motors.
"""

import socket
from contextlib import suppress
from functools import partial

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.firmware import Firmware
from pigaming_app.hardware.emulator.radio import EmulatedRadio, RadioChannel
from pigaming_app.hardware.emulator.robots import STEP
from pigaming_app.hardware.emulator.wifi.air import LOOPBACK, Air, WifiChannel
from pigaming_app.hardware.emulator.wifi.boards import BoardConfig, Boards, MicrobitConfig
from pigaming_app.hardware.emulator.wifi.relay import LARGEST, MicrobitAir

CELLS_EVERY = 0.02  # s between two looks at the batteries
BOARDS = ("board_esp32", "board_pico_w")  # in turn


class BoardRadio(EmulatedRadio):
    """The wires of boards to motors and batteries. `first`: the board of the first robot."""

    boards: Boards
    first = 0

    def __init__(self, arena: EmulatedArena, channel: RadioChannel, seed: int) -> None:
        super().__init__(arena.firmwares, channel, arena.clock, seed)
        self._arena = arena
        self._powered = [True] * len(arena.robots)
        self._cells = [0] * len(arena.robots)  # mV
        self._cells_at = float("-inf")

    def supply(self) -> None:
        """Batteries of the arena's robots, and their switches, if it is time to look at them."""
        if (now := self._arena.clock()) < self._cells_at:
            return
        self._cells_at = now + CELLS_EVERY
        for robot, body in enumerate(self._arena.robots):
            if body.alive != self._powered[robot]:
                self._powered[robot] = body.alive
                self.boards.disturb(self.first + robot, do="reboot" if body.alive else "off")
            if (millivolts := round(1000 * body.battery)) != self._cells[robot]:
                self._cells[robot] = millivolts
                self.boards.disturb(self.first + robot, battery=millivolts)

    def drive(self) -> None:
        """Apply the outputs of all boards."""
        for robot, body in enumerate(self._arena.robots):
            body.left, body.right = self.boards.motors(self.first + robot) if body.alive else (0.0, 0.0)


class WifiRadio(BoardRadio):
    """Four boards, and the network to an arcade at UDP port `arcade`.

    `number` and `key` are those of the arena. The boards' time is the arena's if `paced`, else the system's. Raises
    NoMicroPython.
    """

    def __init__(
        self, arena: EmulatedArena, channel: WifiChannel, arcade: int, number: int, key: bytes, paced: bool = True
    ) -> None:
        super().__init__(arena, RadioChannel(), number)
        self.air = Air(len(arena.robots), arcade, channel, number)
        configs = [
            BoardConfig(i + 1, number, key, self.air.port(i), f"Robot {i + 1}", BOARDS[i % len(BOARDS)])
            for i in range(len(arena.robots))
        ]
        self._paced, self.boards = paced, Boards(configs, paced)
        self.air.robots = self.boards.ports

    def step(self) -> None:
        """Advance paced boards to the arena's time and apply the outputs of all."""
        arena, now = self._arena, self._arena.clock()
        self.air.dead, self.air.extra_loss = self.dead, self.extra_loss
        self.air.mute = {robot for robot, firmware in enumerate(arena.firmwares) if firmware.mute}
        self.air.pump(now)
        self.supply()
        if self._paced:
            self.boards.advance(now - arena.begin, self.air.delivered)
        self.drive()

    def end(self) -> None:
        """End boards and network. Idempotent."""
        self.boards.close()
        self.air.close()


class _WiredBoard(Firmware):
    """The serial line of a board in place of a firmware: a datagram a packet, either way."""

    port, sent = 0, 0  # of the board; packets on the way to it so far

    def __init__(self, other: Firmware) -> None:
        super().__init__(other.robot, other.address, other.arena)
        self.line = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.line.bind((LOOPBACK, 0))
        self.line.setblocking(False)

    def receive(self, data: bytes, now: float) -> None:
        self.line.sendto(data, (LOOPBACK, self.port))
        self.sent += 1

    def tick(self, now: float) -> bytes:
        with suppress(BlockingIOError):
            report = self.line.recv(LARGEST)
            return b"" if self.mute else report
        return b""


class XBeeBoardRadio(BoardRadio):
    """Four boards of a kind with XBees. Raises NoMicroPython."""

    def __init__(self, arena: EmulatedArena, channel: RadioChannel, board: str, seed: int = 1) -> None:
        super().__init__(arena, channel, seed)
        self._wires = [_WiredBoard(firmware) for firmware in arena.firmwares]
        self.firmwares[:] = self._wires
        configs = [
            BoardConfig(i + 1, arena.arena_id, b"", 0, board=board, radio="serial_radio")
            for i in range(len(arena.robots))
        ]
        self.boards = Boards(configs, paced=True)
        for wire, port in zip(self._wires, self.boards.ports, strict=True):
            wire.port = port

    def step(self) -> None:
        super().step()
        self.supply()
        self.boards.advance(self._arena.clock() - self._arena.begin, [wire.sent for wire in self._wires])
        self.drive()

    def end(self) -> None:
        """End the boards. Idempotent."""
        self.boards.close()
        for wire in self._wires:
            wire.line.close()


class MicrobitRadio(BoardRadio):
    """Four micro:bits, on this chassis, and a relay at the computer's USB. Raises NoMicroPython."""

    first = 1

    def __init__(self, arena: EmulatedArena, board: str = "microbit", seed: int = 1) -> None:
        super().__init__(arena, RadioChannel(), seed)
        self.air = MicrobitAir(len(arena.robots), arena.arena_id, seed, partial(MicrobitConfig, board=board))
        self.boards = self.air.boards

    @property
    def in_waiting(self) -> int:
        self._require_port()
        return self.air.in_waiting

    def read(self, size: int = 1) -> bytes:
        self._require_port()
        return self.air.read(size)

    def write(self, data: bytes) -> int:
        self._require_port()
        return self.air.write(data)

    def step(self) -> None:
        air = self.air
        air.dead, air.loss = self.dead, self.extra_loss
        air.mute = {self.first + robot for robot, firmware in enumerate(self._arena.firmwares) if firmware.mute}
        self.supply()
        air.advance(STEP)
        self.drive()

    def end(self) -> None:
        """End the boards. Idempotent."""
        self.air.end()
