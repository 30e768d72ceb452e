"""Drawings: arena files as values, and back, with nothing lost."""

import pytest

from pigaming_app import ASSETS
from pigaming_app.games.arenas import load, parse, read_source, shipped_arenas
from pigaming_app.games.drawing.values import Drawing, Part, drawing_of
from pigaming_app.games.registry import games
from pigaming_app.sim.record import to_bytes
from pigaming_app.sim.toml_table import FieldError

SHIPPED = [(game, name) for game in games() for name in shipped_arenas(game)]
MADE = [(game, f"surprise-{seed}") for game in games() for seed in range(3)]


def source_of(game: str, name: str) -> str:
    return read_source(ASSETS / "arenas" / game / f"{name}.toml")


@pytest.mark.parametrize(("game", "name"), SHIPPED + MADE)
def test_a_drawing_writes_the_same_arena_again(game: str, name: str) -> None:
    before = load(game, name)
    drawing = drawing_of(before.source)
    after = parse(game, drawing.text(), f"{before.name}.toml")
    assert drawing_of(drawing.text()) == drawing
    assert (after.title, after.walls, after.starts, after.things) == (
        before.title,
        before.walls,
        before.starts,
        before.things,
    )
    if game == "race":
        assert to_bytes(after.plan.course) == to_bytes(before.plan.course)
        assert after.plan.lines == before.plan.lines
    else:
        assert after.plan == before.plan


def test_every_value_of_toml_that_an_arena_has_survives() -> None:
    entries = ("use", 'a "b"\\\n\x7fé'), ("margin", 1e-7), ("n", -3), ("yes", True), ("outline", ((1, 2.5), ()))
    part = Part("thing", entries)
    drawing = Drawing((Part("a key", (("b.c", 1),), several=False), part, part))
    assert drawing_of(drawing.text()) == drawing


def test_changes_make_new_drawings() -> None:
    drawing = drawing_of(source_of("pitanks", "classic"))
    walls = drawing.of("wall")
    thicker = drawing.changed("wall", 2, walls[2].changed("thick", 60))
    assert drawing.of("wall") == walls
    assert thicker.of("wall")[2].get("thick") == 60
    assert thicker.changed("wall", 2, walls[2]) == drawing
    assert len(drawing.changed("wall", 0, None).of("wall")) == len(walls) - 1
    assert drawing.added(walls[0]).of("wall") == (*walls, walls[0])
    assert walls[2].changed("thick", 60).changed("thick", None).get("thick") == ()
    assert hash(thicker) != hash(drawing)


@pytest.mark.parametrize("source", ["x = 1", "[wall]\na = {b = 1}", "wall = [1]", "[[wall]]\nat = 1979-05-27", "x = ["])
def test_other_files_are_no_drawings(source: str) -> None:
    with pytest.raises(FieldError):
        drawing_of(source)


def test_every_game_can_be_drawn() -> None:
    for game in games():
        for name in shipped_arenas(game):
            assert drawing_of(load(game, name).source).of("title")
