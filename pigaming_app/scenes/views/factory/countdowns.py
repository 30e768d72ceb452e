"""Countdowns at machines: to the moment when a worker clears an output, and when a machine jams.

A machine jams when it finishes a pallet while the next one already lies in its input: it cannot go on until somebody
takes the finished one.
"""

from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

from pigaming_app.games.factory.state import MACHINE_SLOTS, MACHINES, Factory
from pigaming_app.games.factory.workers import clears_in, jams_in
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.scenes.views.view import SoundCue
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import Batch, put

CLEARING, JAMMING = "clearing", "jamming"  # also the names of their sounds
SHOWN = {CLEARING: 10, JAMMING: 3}  # s left from which a countdown is shown
HEARD = {CLEARING: 5, JAMMING: 3}  # s left from which each second is heard, and shown as a number
BLINK = 9  # ticks for which a jammed machine is bright, then dark: less than three blinks a second
CORNER = 58.0  # px from a machine's centre to its warning sign, across and down
OUTSIDE = 0.46  # distance from a slot to its number, as a share of the way from the machine to the slot


class MachineCountdown(NamedTuple):
    """A countdown at machine `machine`'s output slot (x, y), arena px; `left`: ticks."""

    kind: str
    machine: int
    x: float
    y: float
    left: int

    @property
    def seconds(self) -> int:
        return -(-self.left // HZ)


def countdowns(state: Factory) -> Iterator[MachineCountdown]:
    """The countdowns that are shown now."""
    for m in range(MACHINES):
        output = state.slots[MACHINE_SLOTS + 2 * m + 1]
        for kind, left in ((CLEARING, clears_in(state, m)), (JAMMING, jams_in(state, m))):
            if 0 < left <= SHOWN[kind] * HZ:
                yield MachineCountdown(kind, m, output.x, output.y, left)


def sounds(state: Factory) -> list[SoundCue]:
    """The countdowns that are heard on this tick, at most one of each kind."""
    heard = {c.kind: c.x for c in countdowns(state) if c.left % HZ == 0 and c.seconds <= HEARD[c.kind]}
    return [(kind, None, x) for kind, x in heard.items()]


def draw(light: Batch, top: Batch, state: Factory) -> None:
    """Collect the numbers, the rings around outputs to be cleared, and the outlines of jammed machines."""
    for m, machine in enumerate(state.machines):
        if jams_in(state, m) == 0:
            put(light, signs.stuck(state.tick // BLINK % 2 == 0), LEFT + machine.x, TOP + machine.y)
            put(top, signs.jam(), LEFT + machine.x - CORNER, TOP + machine.y - CORNER)
    for countdown in countdowns(state):
        kind, machine = countdown.kind, state.machines[countdown.machine]
        urgent = countdown.seconds <= HEARD[kind]
        x, y = LEFT + countdown.x, TOP + countdown.y
        if kind == CLEARING:
            part = -(-crates.COUNTS * countdown.left // (SHOWN[kind] * HZ))
            put(light, signs.time_left(part, urgent), x, y)
        if urgent:
            dx, dy = countdown.x - machine.x, countdown.y - machine.y
            put(top, signs.seconds_left(countdown.seconds), x + OUTSIDE * dx, y + OUTSIDE * dy)


def jobs() -> Iterator[Job]:
    """Prewarm jobs for the signs."""
    for part in range(1, crates.COUNTS + 1):
        yield partial(signs.time_left, part, part * SHOWN[CLEARING] <= crates.COUNTS * HEARD[CLEARING])
    yield from (partial(signs.seconds_left, number) for number in range(1, max(HEARD.values()) + 1))
    yield from (partial(signs.stuck, bright) for bright in (False, True))
    yield signs.jam
