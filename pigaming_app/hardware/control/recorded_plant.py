"""Recorded robots as a plant: what the camera saw of them cannot be simulated again, so every tick has their record."""

import sys
import zlib
from array import array
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from math import isfinite
from typing import Any

from pigaming_app.hardware.control.moving_things import Reroute, ThingsMove
from pigaming_app.sim.arena import replace_things
from pigaming_app.sim.drivetrain import MM
from pigaming_app.sim.plant import Pose, Sighting, Twist
from pigaming_app.sim.toml_table import FieldError
from pigaming_app.sim.world import ROBOTS, World

FIELDS = ("x", "y", "heading", "linear", "angular", "requested_linear", "requested_angular", "recover")
ROW = ROBOTS * len(FIELDS)  # numbers a tick
MAX_NUMBER = 1e6  # px, px/s, rad, rad/s
SIZE = 8  # bytes of a number


class RobotTrack:
    """The fields of all robots that a plant changes, at the beginning of every tick, exact to the last bit."""

    def __init__(self, numbers: Sequence[float] = ()) -> None:
        self._numbers = array("d", numbers)

    def __len__(self) -> int:
        """Number of rows."""
        return len(self._numbers) // ROW

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RobotTrack) and self._numbers == other._numbers

    __hash__ = None  # type: ignore[assignment]

    def add(self, robots: Sequence[Any], seen: Sequence[Sighting] = ()) -> None:
        """Append a row: the robots of a world at the poses `seen`, by default at their own."""
        for i, robot in enumerate(robots):
            x, y, heading, _ = seen[i] if seen else (robot.x, robot.y, robot.heading, 0.0)
            self._numbers.extend((x, y, heading, *(getattr(robot, field) for field in FIELDS[3:])))

    def first(self, rows: int) -> "RobotTrack":
        """A copy of the first rows."""
        return RobotTrack(self._numbers[: rows * ROW])

    def apply(self, world: Any, row: int) -> None:
        """Set the robots of a world to a row; to the last one beyond the end."""
        first = ROW * min(row, len(self) - 1)
        for i, robot in enumerate(world.robots):
            begin = first + i * len(FIELDS)
            for field, number in zip(FIELDS, self._numbers[begin : begin + len(FIELDS)], strict=True):
                setattr(robot, field, int(number) if field == "recover" else number)

    def pack(self) -> bytes:
        """Compressed: first byte of the first number of all rows, then its second byte, and so on."""
        numbers = self._numbers[:]
        if sys.byteorder == "big":
            numbers.byteswap()
        raw, width = numbers.tobytes(), ROW * SIZE
        return zlib.compress(b"".join(raw[i::width] for i in range(width)), 6)

    @classmethod
    def unpack(cls, packed: bytes, rows: int) -> "RobotTrack":
        """Inverse of `pack`. Raises ValueError unless it has that many rows of plausible numbers."""
        width = ROW * SIZE
        try:
            planes = zlib.decompressobj().decompress(packed, width * rows + 1)
        except zlib.error as error:
            raise ValueError(str(error)) from None
        if rows < 1 or len(planes) != width * rows:
            raise ValueError("the number of poses")
        raw = bytearray(len(planes))
        for i in range(width):
            raw[i::width] = planes[i * rows : (i + 1) * rows]
        numbers = array("d", bytes(raw))
        if sys.byteorder == "big":
            numbers.byteswap()
        if not all(isfinite(number) and abs(number) <= MAX_NUMBER for number in numbers):
            raise ValueError("a pose")
        return cls(numbers)


class RecordedPlant:
    """Robots that repeat a track, row by row with the ticks of the world, among things that move as they did.

    `moves`: of the things, in order; `first`: index of their first wall; `reroute`: see MovingThings.
    """

    mm = MM

    def __init__(
        self,
        world: World,
        track: RobotTrack,
        moves: Sequence[ThingsMove] = (),
        first: int = 0,
        reroute: Reroute | None = None,
    ) -> None:
        self.world: Any = world
        self.track, self.first, self.reroute = track, first, reroute
        walls, done = [move for move in moves if not move.routed], self.world.shifts
        self.shown_things = walls[done - 1].things if 0 < done <= len(walls) else None  # None: those of the arena
        self._moves = deque(walls[done:])
        self._routes = deque(move for move in moves if move.routed and move.tick >= self.world.tick)
        track.apply(world, self.world.tick)

    def sense(self) -> list[Sighting]:
        self._move_things()
        self.track.apply(self.world, self.world.tick)
        return [Sighting(robot.x, robot.y, robot.heading, 0.0) for robot in self.world.robots]

    def drive(self, twists: Sequence[Twist], dt: float) -> None:
        """The rules have counted the tick: robots and things are where the next one begins."""
        self._move_things()
        self.track.apply(self.world, self.world.tick)

    def place(self, poses: Sequence[Pose]) -> None:
        """No effect: the track has the places."""

    def _move_things(self) -> None:
        while self._moves and self._moves[0].tick <= self.world.tick:
            self.shown_things = self._moves.popleft().things
            with suppress(FieldError):  # too many for this arena: an edited file
                replace_things(self.world, self.shown_things, self.first)
        while self._routes and self._routes[0].tick <= self.world.tick:
            things = self._routes.popleft().things
            if self.reroute is not None:
                with suppress(FieldError):
                    self.reroute(things)(self.world)
