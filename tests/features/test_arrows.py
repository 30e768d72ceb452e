"""Imports, late ones included, between the core and its features."""

from pigaming_app.games.registry import OURS
from pigaming_app.jobs.features import every_feature
from tests.test_layers import graph

BENCH = "bench"  # it measures all of them
ROOMS = {f"pigaming_app.{room}": one.name for one in every_feature() for room in one.rooms}
FACE = "api"  # of all rooms towards plug-ins; none of these imports it
ROOMS["pigaming_app.api"] = FACE
CORE = "core"
ALLOWED = {
    ("ladder", "events"): "the rules of a climb, and the ratings of leagues",
    ("lab", "learning"): "it shows what learns",
    ("lab", "brain"): "the rose of directions",
    ("gym", "learning"): "its compiled loops",
    ("editor", "factory"): "its tools for this game",
    ("brain", "factory"): "its explanations of this game, and the signs of its crates",
    ("gym", "factory"): "its rewards of this game",
    ("editor", "race"): "its tools for this game",
    ("brain", "race"): "its explanations of this game",
    ("learning", "race"): "its task in this game",
    ("learning", "factory"): "its task in this game",
    ("balance", "race"): "tricks in this game",
    ("balance", "learning"): "its compiled loops",
    ("balance", "factory"): "tricks in this game",
    ("events", "learning"): "its compiled loops, for `event run --headless`",
}
GUARDED = {"pigaming_app.scenes.brain.panels"}  # asks whether the game is there before it imports its crates late


def owner(module: str) -> str:
    """The feature of a module, or the core."""
    rooms = [room for room in ROOMS if f"{module}.".startswith(f"{room}.")]
    return ROOMS[max(rooms, key=len)] if rooms else CORE


def test_no_arrow_leads_from_the_core_to_a_feature_or_between_two_features() -> None:
    arrows = {
        (owner(name), owner(other)): f"{name} imports {other}" for name, others in graph().items() for other in others
    }
    found = {ends: arrow for ends, arrow in arrows.items() if ends[0] not in (ends[1], BENCH, FACE) and ends[1] != CORE}
    assert found.keys() == ALLOWED.keys(), [arrow for ends, arrow in found.items() if ends not in ALLOWED]


def test_what_another_feature_has_for_a_game_is_a_module_named_after_it_that_no_other_imports() -> None:
    arrows = [(name, owner(other)) for name, others in graph().items() for other in others]
    made = {(name, game) for name, game in arrows if game in OURS and owner(name) != game and name not in GUARDED}
    assert {game for _, game in made} == {*ROOMS.values()} & {*OURS}
    assert [name for name, game in made if name.rpartition(".")[2].removeprefix("busy_") != game] == []
    assert {name for name, _ in made} & {other for others in graph().values() for other in others} == set()
