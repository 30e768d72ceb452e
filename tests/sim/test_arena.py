"""Arena files: all shipped ones are valid, and an invalid one raises an error of one line with key and reason."""

from functools import partial
from math import pi

import pytest

from pigaming_app.games.arenas import arenas, load
from pigaming_app.games.arenas import parse as parse_of
from pigaming_app.sim.arena import LANGUAGES, ArenaError, build
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.world import SOLID, World

STARTS = """
[[start]]
at = [110, 110]
[[start]]
at = [1490, 790]
heading = 180
[[start]]
at = [110, 790]
[[start]]
at = [1490, 110]
"""
TITLE = '[title]\nen = "Test"\npt = "Teste"\n'
WALL = "[[wall]]\nfrom = [300, 200]\nto = [300, 420]\n"
GOOD = TITLE + STARTS + WALL
parse = partial(parse_of, "pitanks")
SPLIT = "[[wall]]\nfrom = [800, 0]\nto = [800, 900]\n"


@pytest.mark.parametrize("name", arenas("pitanks"))
def test_every_shipped_arena_is_valid(name):
    arena = load("pitanks", name)
    world = World()
    build(world, arena)
    assert arena.name == name
    assert set(arena.title) == set(LANGUAGES)
    assert not any(in_wall(world, robot.x, robot.y) for robot in world.robots)


def test_classic_comes_first():
    assert arenas("pitanks")[0] == "classic"


def test_a_valid_file_is_parsed():
    arena = parse(GOOD, "good.toml")
    assert arena.name == "good"
    assert arena.starts[1].heading == pytest.approx(pi)
    (wall,) = arena.walls
    assert (wall.ax, wall.ay, wall.bx, wall.by, wall.half, wall.health) == (300, 200, 300, 420, 15, 5)
    assert parse(GOOD + "solid = true", "good.toml").walls[0].health == SOLID
    assert arena.source == GOOD


BROKEN = {
    "syntax": (GOOD + "\nthick = = 3", "syntax", "line 18"),
    "unknown key": (GOOD + "colour = 3", "wall[1].colour", "unknown key"),
    "unknown table": (GOOD + "[weather]", "weather", "unknown key"),
    "unknown language": (GOOD.replace("pt =", "xx ="), "title.xx", "unknown key"),
    "no title": (STARTS, "title", "missing"),
    "title is a text": ('title = "Test"\n' + STARTS, "title", "missing"),
    "title is a number": (TITLE.replace('"Test"', "3") + STARTS, "title.en", "missing"),
    "blank title": (TITLE.replace('"Teste"', '" "') + STARTS, "title.pt", "missing"),
    "three starts": (TITLE + STARTS.rsplit("[[start]]", 1)[0], "start", "3 starts"),
    "starts are no list": (TITLE + "[start]\nat = [1, 2]", "start", "[[start]]"),
    "walls are no tables": (TITLE.replace("[title]", "wall = [1]\n[title]") + STARTS, "wall[1]", "table"),
    "start inside a wall": (GOOD.replace("[300, 200]", "[110, 110]"), "start[1]", "inside a wall"),
    "start in the outer wall": (GOOD.replace("[110, 110]", "[20, 110]"), "start[1]", "inside a wall"),
    "start outside": (GOOD.replace("[110, 110]", "[110, -110]"), "start[1].at", "outside"),
    "starts too near": (GOOD.replace("[1490, 790]", "[140, 120]"), "start[2]", "too near"),
    "wall outside": (GOOD.replace("[300, 420]", "[300, 1420]"), "wall[1].to", "outside"),
    "no way": (GOOD + SPLIT, "start[2]", "no way"),
    "boxed in first": (
        GOOD + "[[wall]]\nfrom = [0, 220]\nto = [220, 220]\n[[wall]]\nfrom = [220, 0]\nto = [220, 220]\n",
        "start[2]",
        "no way",
    ),
    "text for a number": (GOOD + 'thick = "wide"', "wall[1].thick", "'wide'"),
    "true for a number": (GOOD + "thick = true", "wall[1].thick", "True"),
    "nan": (GOOD + "thick = nan", "wall[1].thick", "nan"),
    "infinite": (GOOD.replace("[300, 420]", "[300, inf]"), "wall[1].to", "inf"),
    "number for a point": (GOOD.replace("[300, 420]", "300"), "wall[1].to", "point"),
    "three numbers for a point": (GOOD.replace("[300, 420]", "[1, 2, 3]"), "wall[1].to", "point"),
    "no end": (GOOD.replace("to = [300, 420]\n", ""), "wall[1].to", "point"),
    "too thin": (GOOD + "thick = 1", "wall[1].thick", "10 to 200"),
    "no health": (GOOD + "health = 0", "wall[1].health", "1 to 5"),
    "half a health": (GOOD + "health = 2.5", "wall[1].health", "whole number"),
    "solid is a text": (GOOD + 'solid = "yes"', "wall[1].solid", "true or false"),
    "solid with health": (GOOD + "solid = true\nhealth = 3", "wall[1].health", "solid"),
    "heading over a turn": (GOOD.replace("= 180", "= 400"), "start[2].heading", "360"),
    "heading is a text": (GOOD.replace("= 180", '= "west"'), "start[2].heading", "west"),
    "too many walls": (GOOD + WALL * 24, "wall", "25 walls"),
    "a date": (GOOD + "thick = 2020-01-01", "wall[1].thick", "number"),
    "empty": ("", "title", "missing"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_file_is_refused_in_one_line(name):
    source, key, reason = BROKEN[name]
    with pytest.raises(ArenaError) as caught:
        parse(source, "broken.toml")
    line = str(caught.value)
    assert line.startswith(f"broken.toml: {key}: ")
    assert reason in line
    assert "\n" not in line


def test_a_file_anywhere_is_loaded_by_its_path(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(GOOD, encoding="utf-8")
    assert load("pitanks", str(path)).name == "mine"


def test_a_missing_file_or_one_that_is_not_text_is_refused(tmp_path):
    with pytest.raises(ArenaError, match=r"nowhere: no such arena for pitanks; there are classic"):
        load("pitanks", "nowhere")
    path = tmp_path / "noise.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ArenaError, match=r"noise.toml: file: cannot be read"):
        load("pitanks", str(path))
