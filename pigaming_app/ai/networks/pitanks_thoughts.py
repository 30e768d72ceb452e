"""The inputs of PiTanks' networks by topic, and the places at which a network perceives things."""

from collections.abc import Iterator, Sequence
from typing import Any

from pigaming_app.ai.brain.thoughts import BULLET, MATE, OPPONENT, PRIZE, Percept
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.pitanks import BULLETS, MINE, MINE_NEAR, OTHER, OTHERS, PICKUP, PLACE
from pigaming_app.sim.world import HEIGHT, WIDTH

TOPICS = {
    "near": ("first",),
    "others": ("second", "third"),
    "bullets": ("bullets",),
    "mines": ("mine",),
    "pickups": ("pickup",),
    "walls": ("place", "way", "room"),
    "self": ("motion", "gun", "powers"),
    "score": ("score", "rules"),
}  # groups of inputs, in the order of their bars


def percepts(match: Any, inputs: Sequence[float]) -> Iterator[tuple[str, Percept]]:
    """Topics and things, where the network perceived them at its last decision: with its delay and its aiming error.

    Bullets that pass so far away that their distance saturates have no place.
    """
    here = [value / UNIT for value in inputs]
    x, y = 0.5 * (here[PLACE] + 1.0) * WIDTH, 0.5 * (here[PLACE + 1] + 1.0) * HEIGHT
    ahead_x, ahead_y = here[PLACE + 2], here[PLACE + 3]

    def at(distance: float, along: float, across: float) -> tuple[float, float]:
        """The point at a distance in a direction relative to the heading."""
        return (
            x + distance * (along * ahead_x - across * ahead_y),
            y + distance * (along * ahead_y + across * ahead_x),
        )

    for k in range(OTHERS, PICKUP, OTHER):
        if here[k]:
            kind, topic = MATE if here[k + 1] else OPPONENT, "near" if k == OTHERS else "others"
            yield topic, Percept(kind, *at(800.0 * (here[k + 2] + 1.0), here[k + 4], here[k + 5]), bool(here[k + 11]))
    for k in range(BULLETS, MINE, 5):
        if here[k] and abs(here[k + 2]) < 1.0:
            seconds = (1.0 / max(here[k + 1], 1.0 / UNIT) - 1.0) / 3.0
            bullet_x, bullet_y = at(seconds * match.rules.bullet_speed, here[k + 3], here[k + 4])
            aside_x, aside_y = at(60.0 * here[k + 2], -here[k + 4], here[k + 3])
            yield "bullets", Percept(BULLET, bullet_x + aside_x - x, bullet_y + aside_y - y)
    if here[PICKUP + 2]:
        yield "pickups", Percept(PRIZE, *at(300.0 / here[PICKUP + 2] - 300.0, here[PICKUP], here[PICKUP + 1]))
    if here[MINE + 2]:
        yield "mines", Percept(BULLET, *at(MINE_NEAR * (1.0 - here[MINE + 2]), here[MINE], here[MINE + 1]))
