"""Real things that move during a match: their walls are replaced between ticks, and the changes are recorded.

A thing that covers a simulated robot waits: it becomes a wall when the robot has left.
"""

import logging
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any

from pigaming_app.sim.arena import replace_things
from pigaming_app.sim.things.convex import distance
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.sim.toml_table import FieldError

SAME = 1.5  # px by which a corner may move before a thing counts as moved
NEAR = 15.0  # px between the middles of the same mud in two scans

log = logging.getLogger("pigaming")
Things = tuple[ThingSpec, ...]


Reroute = Callable[[Things], Callable[[Any], None]]  # see `games.game.Reroute`, for one arena


@dataclass(frozen=True)
class ThingsMove:
    """From this tick on, these things stand on the mat; `routed`: AIs that plan ahead know it."""

    tick: int
    things: Things
    routed: bool = False


class MovingThings:
    """The things in a world whose own walls are the `first` ones. `wanted`: as they are on the mat, set by anybody.

    `reroute`: slow part of a new plan of the AIs, for a thread.
    """

    def __init__(
        self, world: Any, first: int, things: Sequence[ThingSpec] = (), reroute: Reroute | None = None
    ) -> None:
        self.world, self.first, self.reroute = world, first, reroute
        self.wanted: Things = tuple(things)
        self.shown: Things = self.wanted  # in the world
        self._routed = self.wanted  # known to the plan, or refused for it
        self._planned: tuple[Things, Callable[[Any], None]] | None = None  # to be applied
        self._planner: threading.Thread | None = None

    def update(self, simulated: Sequence[Any]) -> list[ThingsMove]:
        """Replace the walls if things have moved; returns the changes. `simulated`: robots that no thing may cover."""
        moves = [self._replace(simulated), self._route()]
        return [move for move in moves if move is not None]

    def _replace(self, simulated: Sequence[Any]) -> ThingsMove | None:
        free = tuple(
            thing for thing in self.wanted if not any(_covers(thing, robot, self.world.radius) for robot in simulated)
        )
        if alike(free, self.shown):
            return None
        self.shown = free
        try:
            replace_things(self.world, free, self.first)
        except FieldError as error:  # before it has changed anything
            log.warning("things on the mat: %s", error)
            return None
        return ThingsMove(int(self.world.tick), free)

    def _route(self) -> ThingsMove | None:
        """Apply a finished plan, or begin the next one."""
        if self.reroute is None or (self._planner is not None and self._planner.is_alive()):
            return None
        planned, self._planned = self._planned, None
        if planned is not None:
            planned[1](self.world)
            return ThingsMove(int(self.world.tick), planned[0], True)
        if self._routed is not self.shown:
            self._routed = self.shown
            self._planner = threading.Thread(target=self._plan, args=(self.shown,), name="route", daemon=True)
            self._planner.start()
        return None

    def _plan(self, things: Things) -> None:
        assert self.reroute is not None
        try:
            self._planned = things, self.reroute(things)
        except FieldError as error:
            log.info("things on the mat: %s", error)


def alike(one: Sequence[ThingSpec], other: Sequence[ThingSpec]) -> bool:
    """True if these are the same things at the same places."""
    return len(one) == len(other) and all(
        a.use is b.use
        and len(a.outline) == len(b.outline)
        and all(abs(p - q) < SAME for p, q in zip(sum(a.outline, ()), sum(b.outline, ()), strict=True))
        for a, b in zip(one, other, strict=True)
    )


def _covers(thing: ThingSpec, robot: Any, radius: float) -> bool:
    """True if a wall would stand where a robot of a radius, px, is."""
    return thing.use is Use.WALL and distance(thing.outline, robot.x, robot.y) < radius + thing.margin


def same_mud(one: Sequence[ThingSpec], other: Sequence[ThingSpec]) -> bool:
    """True if the mud is at the same places, as far as two scans can agree."""
    here, there = ([thing.middle for thing in things if thing.use is Use.MUD] for things in (one, other))
    return len(here) == len(there) and all(any(hypot(x - u, y - v) < NEAR for u, v in there) for x, y in here)
