"""Thymios on a dongle: a second reading of Aseba's published messages and machine, in simulated time.

It shares nothing with `radio/aseba.py`. Lengths of messages are in bytes, addresses and programs in words of 16 bits.
"""

import struct
from collections import deque
from collections.abc import Callable, Mapping
from operator import add, eq, gt, ne, sub
from random import Random
from typing import Self

from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.radio import EmulatedRadio, RadioChannel

STEP = 0.002  # s
DELAY = 0.09  # s on the way to a robot, or back
INIT, LOCAL = 0xFFFF, 0xFFFE  # numbers of events: the program's start; the first event of the robot itself
FIRMWARE_5: tuple[tuple[str, int], ...] = (  # of variables, their sizes; published in the firmware's skel-usb-user.c
    ("_id", 1), ("event.source", 1), ("event.args", 32), ("_fwversion", 2), ("_productId", 1), ("buttons._raw", 5),
    ("button.backward", 1), ("button.left", 1), ("button.center", 1), ("button.forward", 1), ("button.right", 1),
    ("buttons._mean", 5), ("buttons._noise", 5), ("prox.horizontal", 7), ("prox.ground.ambiant", 2),
    ("prox.ground.reflected", 2), ("prox.ground.delta", 2), ("motor.left.target", 1), ("motor.right.target", 1),
    ("_vbat", 2), ("motor.left.speed", 1), ("motor.right.speed", 1), ("motor.left.pwm", 1), ("motor.right.pwm", 1),
    ("acc", 3), ("temperature", 1), ("rc5.address", 1), ("rc5.command", 1), ("mic.intensity", 1), ("mic.threshold", 1),
    ("mic._mean", 1), ("timer.period", 2), ("acc._tap", 1),
)  # fmt: skip
EVENTS_5: tuple[str, ...] = (
    "button.left", "button.right", "button.forward", "button.backward", "button.center", "buttons", "prox", "tap",
    "acc", "mic", "sound.finished", "temperature", "rc5", "motor", "timer0", "timer1",
)  # fmt: skip
SIZE, PROGRAM, STACK = 600, 1534, 32  # words
FASTEST = 500  # target of a motor that turns at full speed
CELLS = 1.3  # voltage of the arena's robots, of four cells, in that of a Thymio's only one
VBAT = 198.9  # units of each word of `_vbat` in a volt, by the firmware's behavior.c


def _signed(word: int) -> int:
    return (word + 0x8000 & 0xFFFF) - 0x8000


OPERATORS: Mapping[int, Callable[[int, int], int]] = {  # those that our program uses
    2: add,
    3: sub,
    10: eq,
    11: ne,
    12: gt,
    17: lambda first, second: bool(first and second),
}


class EmulatedThymio:
    """One robot: Aseba's machine, and the variables of firmware 5; `send(type, data)` takes its messages."""

    layout, events = FIRMWARE_5, EVENTS_5

    def __init__(self, number: int, send: Callable[[int, bytes], None]) -> None:
        self.number, self._send = number, send
        places, self.places = 0, dict[str, int]()
        for name, size in self.layout:
            self.places[name] = places
            places += size
        self.start()

    def start(self) -> None:
        """Switch on, without a program."""
        self.program, self.running, self._elapsed = [0] * PROGRAM, True, 0.0
        self._clear()

    def _clear(self) -> None:
        self.variables = [0] * SIZE
        self["_id"], self["_vbat"], self.variables[self.places["_vbat"] + 1] = self.number, 780, 780  # 3.92 V

    def __getitem__(self, name: str) -> int:
        return self.variables[self.places[name]]

    def __setitem__(self, name: str, value: int) -> None:
        self.variables[self.places[name]] = value

    def advance(self) -> None:
        """Let STEP pass for the timer."""
        period, self._elapsed = self["timer.period"] / 1000, self._elapsed + STEP
        if period and self._elapsed >= period - 1e-9:
            self._elapsed = 0.0
            self.event("timer0")

    def event(self, name: str) -> None:
        """An event of the robot itself."""
        if self.running:
            self["event.source"] = self.number
            self.run(LOCAL - self.events.index(name))

    def receive(self, source: int, kind: int, data: bytes) -> None:
        """A message."""
        words = struct.unpack(f"<{len(data) // 2}H", data)
        if kind < 0x8000:
            if self.running:
                start = self.places["event.args"]
                self["event.source"] = source
                self.variables[start : start + len(words)] = map(_signed, words)
                self.run(kind)
        elif kind == 0xA011:
            self._send(0x900C, struct.pack("<H", 5))
        elif words and words[0] == self.number:
            self._obey(kind, words[1:])

    def _obey(self, kind: int, words: tuple[int, ...]) -> None:
        if kind == 0xA010:
            self._describe()
        elif kind in (0xA001, 0xA002):
            if kind == 0xA001:
                self.program[words[0] : words[0] + len(words) - 1] = words[1:]
            self._clear()
            self._switch(False)
        elif kind == 0xA003:
            self._switch(True)
            self.run(INIT)
        elif kind in (0xA004, 0xA006):
            self._switch(False)
        elif kind == 0xA00B:
            start, size = words
            values = struct.pack(f"<{size}h", *self.variables[start : start + size])
            self._send(0x9005, struct.pack("<H", start) + values)
        elif kind == 0xA00C:
            self.variables[words[0] : words[0] + len(words) - 1] = map(_signed, words[1:])

    def _switch(self, running: bool) -> None:
        self.running = running
        self._send(0x900A, struct.pack("<HH", 0, 0 if running else 2))

    def _describe(self) -> None:
        sizes = (5, PROGRAM, STACK, SIZE, len(self.layout), len(self.events), 0)
        self._send(0x9000, b"\x09thymio-II" + struct.pack("<7H", *sizes))
        for name, size in self.layout:
            self._send(0x9001, struct.pack("<HB", size, len(name)) + name.encode())
        for name in self.events:
            self._send(0x9002, bytes([len(name)]) + name.encode() + b"\x00")

    def run(self, event: int) -> None:
        """Run the program's answer to an event to its end. Raises ValueError for words that our program has not."""
        table = self.program[1 : self.program[0]]
        place = dict(zip(table[::2], table[1::2], strict=True)).get(event, 0)
        stack: list[int] = []
        while place:
            word = self.program[place]
            code, operand, following = word >> 12, word & 0xFFF, self.program[place + 1]
            step = 1
            if code == 0:
                return
            if code == 1:
                stack.append((operand + 0x800 & 0xFFF) - 0x800)
            elif code == 2:
                stack.append(_signed(following))
                step = 2
            elif code == 3:
                stack.append(self.variables[operand])
            elif code == 4:
                self.variables[operand] = stack.pop()
            elif code in (8, 10):
                second, first = stack.pop(), stack.pop()
                result = _signed(int(OPERATORS[operand & 0xFF](first, second)))
                if code == 8:
                    stack.append(result)
                else:
                    step = 2 if result else _signed(following)
            elif code == 9:
                step = (operand + 0x800 & 0xFFF) - 0x800
            elif code == 11:
                size = self.program[place + 2]
                values = self.variables[following : following + size]
                self._send(operand, struct.pack(f"<{size}h", *values))
                step = 3
            else:
                raise ValueError(f"word {word:04x} at {place}")
            place += step


class Dongle:
    """Robots on a dongle, whose port is a SerialPort; `loss`: share of the messages that do not arrive."""

    def __init__(self, numbers: tuple[int, ...], seed: int = 1, thymio: type[EmulatedThymio] = EmulatedThymio) -> None:
        self.now, self.loss, self.mute = 0.0, 0.0, set[int]()
        self.robots = [thymio(number, self._sender(number)) for number in sorted(numbers)]
        self.on = [True] * len(numbers)
        self._to: deque[tuple[float, int, bytes]] = deque()  # s, robot, message
        self._back: deque[tuple[float, bytes]] = deque()
        self._random, self._written, self._arrived = Random(f"thymios {seed}"), b"", b""

    def clock(self) -> float:
        """Simulated time, s."""
        return self.now

    def advance(self, seconds: float) -> None:
        """Let time pass, in steps of STEP."""
        for _ in range(round(seconds / STEP)):
            self.now += STEP
            while self._to and self._to[0][0] <= self.now:
                _, robot, message = self._to.popleft()
                if self.on[robot]:
                    source, kind = struct.unpack_from("<HH", message, 2)
                    self.robots[robot].receive(source, kind, message[6:])
            for each, on in zip(self.robots, self.on, strict=True):
                if on:
                    each.advance()
            while self._back and self._back[0][0] <= self.now:
                self._arrived += self._back.popleft()[1]

    def switch(self, robot: int, on: bool) -> None:
        """Switch a robot off or on."""
        self.on[robot] = on
        self.robots[robot].start()

    def motors(self, robot: int) -> tuple[int, int]:
        """Targets of the motors of a robot."""
        one = self.robots[robot]
        return one["motor.left.target"], one["motor.right.target"]

    def end(self) -> None:
        """End the robots."""

    def put(self, message: bytes) -> None:
        """Send a message to all robots in range."""
        for robot in range(len(self.robots)):
            if self._random.random() >= self.loss:
                self._to.append((self.now + DELAY, robot, message))

    def _sender(self, number: int) -> Callable[[int, bytes], None]:
        def send(kind: int, data: bytes) -> None:
            if number not in self.mute and self._random.random() >= self.loss:
                self._back.append((self.now + DELAY, struct.pack("<HHH", len(data), number, kind) + data))

        return send

    # ---- SerialPort

    def open(self) -> Self:
        """The port."""
        return self

    @property
    def in_waiting(self) -> int:
        """Bytes that have arrived."""
        return len(self._arrived)

    def read(self, size: int = 1) -> bytes:
        """Read at most `size` bytes."""
        data, self._arrived = self._arrived[:size], self._arrived[size:]
        return data

    def write(self, data: bytes) -> int:
        """Write messages, in pieces of any size."""
        self._written += data
        while 6 <= len(self._written) >= (end := 6 + int.from_bytes(self._written[:2], "little")):
            self.put(self._written[:end])
            self._written = self._written[end:]
        return len(data)

    def close(self) -> None:
        """No effect: the robots stay."""


class ThymioRadio(EmulatedRadio):
    """Four Thymios on a dongle in place of the radio of an emulated arena, whose motors they drive."""

    def __init__(self, arena: EmulatedArena, seed: int = 1) -> None:
        super().__init__(arena.firmwares, RadioChannel(), arena.clock, seed)
        self._arena = arena
        self.dongle = Dongle(tuple(range(10, 10 + len(arena.robots))), seed)

    @property
    def in_waiting(self) -> int:
        self._require_port()
        return self.dongle.in_waiting

    def read(self, size: int = 1) -> bytes:
        self._require_port()
        return self.dongle.read(size)

    def write(self, data: bytes) -> int:
        self._require_port()
        return self.dongle.write(data)

    def step(self) -> None:
        dongle, arena = self.dongle, self._arena
        dongle.loss = 1.0 if self.dead else self.extra_loss
        dongle.mute = {one.number for one, other in zip(dongle.robots, arena.firmwares, strict=True) if other.mute}
        dongle.advance(STEP)
        for robot, (body, thymio) in enumerate(zip(arena.robots, dongle.robots, strict=True)):
            if body.alive != dongle.on[robot]:
                dongle.switch(robot, body.alive)
            thymio["_vbat"] = thymio.variables[thymio.places["_vbat"] + 1] = round(VBAT * body.battery / CELLS)
            left, right = dongle.motors(robot) if body.alive else (0, 0)
            body.left, body.right = left / FASTEST, right / FASTEST
