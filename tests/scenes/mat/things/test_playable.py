"""The things that are in the way in an arena are found, so that the page can show them."""

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.scenes.mat.things import playable
from pigaming_app.scenes.mat.things.playable import PlayableArenas
from pigaming_app.sim.things.spec import ThingSpec, Use


def crate(x: float, y: float, wide: float = 60.0, high: float = 60.0) -> ThingSpec:
    return ThingSpec(Use.WALL, ((x, y), (x + wide, y), (x + wide, y + high), (x, y + high)), 3.0)


def slot_of_hall() -> ThingSpec:
    slot = load("factory", "hall").plan.slots[0]
    return crate(slot.x - 30.0, slot.y - 30.0)


@pytest.mark.parametrize(
    ("game", "name", "things", "culprits"),
    [
        ("factory", "hall", [crate(760.0, 300.0), slot_of_hall(), crate(800.0, 500.0)], {1}),
        ("pitanks", "classic", [crate(760.0, -20.0, 30.0, 500.0), crate(760.0, 440.0, 30.0, 480.0)], {0, 1}),
        ("pitanks", "classic", [crate(760.0, 300.0)], set()),
    ],
    ids=["one covers a slot", "two close the way together", "none"],
)
def test_things_in_the_way_are_found(
    monkeypatch: pytest.MonkeyPatch, game: str, name: str, things: list[ThingSpec], culprits: set[int]
) -> None:
    monkeypatch.setattr(playable, "games", lambda: [game])
    monkeypatch.setattr(playable, "playable_arenas", lambda _: [name])
    arenas = PlayableArenas(things)
    arenas._thread.join(10.0)
    assert arenas.done
    assert arenas.blocked == ({game: [name]} if culprits else {})
    assert arenas.culprits == culprits
