"""Choices without a use in the next decision: a gun that is not loaded, a button still held down, an empty meter.

A mask is careful: what it rules out is in vain whatever the others do, but not everything in vain is ruled out.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from pigaming_app.games.registry import OURS
from pigaming_app.gym.buttons import has_turbo
from pigaming_app.sim.kernel import compiled, kernel
from pigaming_app.storage.optional import optional

Usable = Callable[[Any, int, int], tuple[bool, bool]]
"""usable(match, seat, ticks): FIRE, turbo. A kernel."""


@kernel
def usable_in_pitanks(match: Any, seat: int, ticks: int) -> tuple[bool, bool]:
    """FIRE: the gun is loaded within the decision. A tank that is knocked out obeys no button."""
    rules, tank = match.rules, match.tanks[seat]
    fire = tank.cooldown <= ticks
    if rules.magazine and tank.spent - (rules.magazine - 1) * rules.loading > ticks * max(1, rules.rapid_loading):
        fire = False
    if tank.knocked_out > ticks:
        return False, False
    return fire, bool(rules.turbo) and has_turbo(match.robots[seat], rules.turbo_drain)


@kernel
def usable_always(match: Any, seat: int, ticks: int) -> tuple[bool, bool]:
    """Nothing is known about this game."""
    return True, True


USABLE: Mapping[str, Usable] = {
    "pitanks": usable_in_pitanks,
    **{game: room.usable for game in OURS if (room := optional(f"gym.{game}"))},
}  # by game


def make_masks(usable: Usable) -> Callable[..., None]:
    """The loop over matches (n) that fills `masks` (n, learners, 2): FIRE and turbo."""

    def fill(matches: Any, masks: Any, ticks: int) -> None:
        for i in range(len(matches)):
            for seat in range(masks.shape[1]):
                masks[i, seat, 0], masks[i, seat, 1] = usable(matches[i], seat, ticks)

    return fill


@cache
def masks_of(game: str, fast: bool) -> Callable[..., None]:
    """The loop of a game, cached; `fast`: compiled."""
    loop = make_masks(USABLE.get(game, usable_always))
    return compiled(loop) if fast else loop
