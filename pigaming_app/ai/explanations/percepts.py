"""The subjects of all games: topics of the inputs, and the places of perceived things."""

from collections.abc import Iterator, Sequence

from pigaming_app.ai.brain.thoughts import BULLET, MATE, OPPONENT, PRIZE
from pigaming_app.ai.networks import pitanks
from pigaming_app.ai.networks.pitanks_things import MINE_NEAR
from pigaming_app.ai.networks.subject import Sight, Subject, distance_of
from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.games.registry import OURS as GAMES
from pigaming_app.storage.optional import optional
from pigaming_app.storage.plugins.parts import Registry


def in_pitanks(match: PiTanks, inputs: Sequence[float]) -> Iterator[Sight]:
    """Robots, bullets, pick-up and mine. A bullet so far aside that its distance saturates has no place."""
    for k in range(pitanks.OTHERS, pitanks.PICKUP, pitanks.OTHER):
        if inputs[k]:
            place = (800.0 * (inputs[k + 2] + 1.0), inputs[k + 4], inputs[k + 5])
            kind = MATE if inputs[k + 1] else OPPONENT
            yield Sight("near" if k == pitanks.OTHERS else "others", kind, *place, bool(inputs[k + 11]))
    for k in range(pitanks.BULLETS, pitanks.MINE, 5):
        if inputs[k] and abs(inputs[k + 2]) < 1.0:
            flight, aside = distance_of(inputs[k + 1], 1.0 / 3.0) * match.rules.bullet_speed, 60.0 * inputs[k + 2]
            along, across = inputs[k + 3], inputs[k + 4]
            yield Sight("bullets", BULLET, 1.0, flight * along - aside * across, flight * across + aside * along)
    k = pitanks.PICKUP
    if inputs[k + 2]:
        yield Sight("pickups", PRIZE, distance_of(inputs[k + 2], 300.0), inputs[k], inputs[k + 1])
    k = pitanks.MINE
    if inputs[k + 2]:
        yield Sight("mines", BULLET, MINE_NEAR * (1.0 - inputs[k + 2]), inputs[k], inputs[k + 1])


OURS = {
    "pitanks": Subject(
        {
            "near": ("first",),
            "others": ("second", "third"),
            "bullets": ("bullets",),
            "mines": ("mine",),
            "pickups": ("pickup",),
            "walls": ("place", "way", "room"),
            "self": ("motion", "gun", "powers", "habits"),
            "score": ("score", "rules"),
        },
        (-1.0, 0.0, 1.0),
        pitanks.TURNS,
        "shoot",
        in_pitanks,
        pitanks.PLACE,
    ),
    **{game: room.SUBJECT for game in GAMES if (room := optional(f"ai.explanations.{game}"))},
}
SUBJECTS = Registry(OURS, "network", "SUBJECT", Subject)  # by game
