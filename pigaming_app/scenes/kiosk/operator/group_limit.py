"""The time limit of a group: from the title to the title. A match that has begun is played to its end.

An event has no limit: its entrants would have to open it again every few minutes, and half a list would be lost.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from pigaming_app.scenes.features.registry import without_limit
from pigaming_app.scenes.flow.scene import Context, Home, Scene, StackOperation

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.scenes.play.drivers import Drivers
    from pigaming_app.scenes.play.pause import Robots

WARNED = 60.0  # s before the limit, from which the rest is shown
STEP = 10  # s between two sentences: each new one costs a few milliseconds of a match
FAREWELL = 20.0  # s from the limit, or from the end of the last match, to the title


@runtime_checkable
class Untimed(Protocol):
    """A scene during which the time of a group stands still if `untimed`: attract mode, the operator's pages, and the
    set-up of an event.
    """

    untimed: bool


@runtime_checkable
class InMatch(Protocol):
    """A match that is being played."""

    drivers: "Drivers"
    robots: "Robots"


class GroupLimit:
    """`seconds`: since the group left the title; `farewell`: s to the title, None before the limit.

    `event`: one is being played, from the first of its pages to the title; `still`: time stands still.
    """

    def __init__(self, context: Context) -> None:
        self.context = context
        self.seconds = 0.0
        self.farewell: float | None = None
        self.in_match = self.event = self.still = False

    @property
    def left(self) -> float:
        """Seconds to the limit; infinite without one."""
        minutes = self.context.settings.group_minutes
        return 60.0 * minutes - self.seconds if minutes else math.inf

    def update(self, seconds: float, scenes: Sequence[Scene]) -> StackOperation:
        """Advance by `seconds` with these scenes on the stack; returns to the title when the time is over."""
        self.event = len(scenes) > 1 and (self.event or without_limit(scenes))
        if self.event or len(scenes) < 2:
            self.seconds, self.farewell, self.still = 0.0, None, False
            return None
        self.still = any(isinstance(scene, Untimed) and scene.untimed for scene in scenes)
        if self.still:
            return None
        self.seconds += seconds
        self.in_match = any(isinstance(scene, InMatch) for scene in scenes)
        if self.left > 0.0:
            self.farewell = None
        elif self.farewell is not None:
            self.farewell -= seconds
        elif not self.in_match:
            self.farewell = FAREWELL
        return Home() if self.farewell is not None and self.farewell <= 0.0 else None

    @property
    def sentence(self) -> str:
        """What the group is told now; empty: nothing."""
        words = self.context.words
        if self.still:
            return ""
        if self.farewell is not None:
            return words("operator.farewell", seconds=max(1, math.ceil(self.farewell)))
        if self.left <= 0.0:
            return words("operator.last_match")
        return words("operator.soon", seconds=STEP * math.ceil(self.left / STEP)) if self.left <= WARNED else ""
