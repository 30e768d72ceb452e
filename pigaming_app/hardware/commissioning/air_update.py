"""A Wi-Fi robot gets the program of this arcade over the air, in signed messages (see firmware/micropython/update.py).

The new program is written beside the one that runs, and started on trial: it is kept once it has called and its hash is
right. Otherwise the robot returns to the program before. Robots that were driven in the last seconds refuse.
"""

import hashlib
from collections.abc import Callable, Mapping

from pigaming_app.hardware.commissioning.boards.wifi import AIR_FILES
from pigaming_app.hardware.radio.wifi import WifiNetwork
from pigaming_app.hardware.robot_kinds import PROGRAM
from pigaming_app.storage.messages import OperatorError, OperatorMessage

CHUNK = 96  # bytes of a file in a message: the robot receives 128
TRIES, ANSWERS = 25, 0.2  # of a message; s for its answer
RETURNS = 90.0  # s for a robot to call after a restart: a program on trial has 60
STEP = 0.02  # s

Pause = Callable[[float], None]
Tell = Callable[[str], None]


class UpdateFailed(OperatorError):
    """A robot has not got the program; the message says why. It runs the one before."""


def program() -> dict[str, bytes]:
    """The files of the program, by name."""
    return {name: (PROGRAM / name).read_bytes() for name in AIR_FILES}


class AirUpdate:
    """The update of a robot (1 to 4) that has called. `pause`: waits, s; `tell` gets each step."""

    def __init__(self, network: WifiNetwork, robot: int, pause: Pause, tell: Tell = lambda step: None) -> None:
        self.network, self.robot, self.pause, self.tell = network, robot, pause, tell
        self._start = self._nonce()  # of the robot's present start

    def run(self, files: Mapping[str, bytes]) -> bool:
        """Give the robot these files; False if it has them. Raises UpdateFailed."""
        wanted = hashlib.sha256(b"".join(files[name] for name in AIR_FILES)).digest()
        if self._program() == (True, wanted):
            return False
        if self._program() != (False, wanted):  # one on trial that was not kept: the answer was lost
            for name in AIR_FILES:
                self.tell(name)
                self._write(name, files[name])
            self._restart(b"T")
            if self._program() != (False, wanted):
                raise self._failed("air_returned")
        self._restart(b"K")
        if self._program() != (True, wanted):
            raise self._failed("air_returned")
        return True

    def _program(self) -> tuple[bool, bytes]:
        """Whether the program that runs is kept, and its hash."""
        answer = self._asked(b"Q")
        return bool(answer[1]), answer[2:]

    def _write(self, name: str, data: bytes) -> None:
        """Write a file, from the start. Raises UpdateFailed."""
        self._asked(b"N" + name.encode())
        at = 0
        while at < len(data):
            answer = self._asked(b"D" + at.to_bytes(4, "big") + data[at : at + CHUNK])
            at = int.from_bytes(answer, "big")
        self._asked(b"E" + hashlib.sha256(data).digest())

    def _restart(self, body: bytes) -> None:
        """Send a message that restarts the robot, and wait until it calls again. Raises UpdateFailed."""
        waited = 0.0
        self.tell("restart" if body == b"T" else "keep")
        while self._nonce() in (self._start, b""):
            if waited % 3.0 < STEP and waited < 10.0:
                self.network.ask(self.robot, body)
            self._wait()
            waited += STEP
            if waited > RETURNS:
                raise self._failed("air_silent")
        self._start = self._nonce()

    def _asked(self, body: bytes) -> bytes:
        """The answer to a message, without its head. Raises UpdateFailed."""
        for _ in range(TRIES):
            self.network.ask(self.robot, body)
            for _ in range(round(ANSWERS / STEP)):
                self._wait()
                if self._nonce() not in (self._start, b""):
                    raise self._failed("air_restarted")
                answer = self.network.answer(self.robot)
                if answer is not None and answer[:1] == body[:1]:
                    if answer[1:2] != b"\1":
                        raise self._failed("air_refused")
                    return answer[2:]
        raise self._failed("air_silent")

    def _nonce(self) -> bytes:
        robots = [robot.announced for robot in self.network.robots if robot.status == "ours"]
        return next((robot.nonce for robot in robots if robot.address == self.robot), b"")

    def _wait(self) -> None:
        self.pause(STEP)
        assert self.network.in_waiting >= 0  # takes in what has come

    def _failed(self, key: str) -> UpdateFailed:
        return UpdateFailed(OperatorMessage(key, robot=self.robot))
