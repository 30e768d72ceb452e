"""The floors of arenas: faint, different, chosen by the file or by the name."""

from dataclasses import replace
from zlib import crc32

import pygame
import pytest

from pigaming_app.games.arenas import load, parse, shipped_arenas
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.scenes.bench.frame_times import AllEffects
from pigaming_app.scenes.views.pitanks.view import PiTanksView
from pigaming_app.scenes.views.sprites.floors import BRIGHTEST, FLOORS, pattern_of
from pigaming_app.sim import arena as arenas
from pigaming_app.sim.arena import ArenaError
from pigaming_app.ui.draw import GlowCanvas
from tests.matches import match_of

TITLE = '[title]\nen = "One"\npt = "Um"\n'
NAMES = shipped_arenas("pitanks")


@pytest.fixture(autouse=True)
def _display():
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))


def drawn(pattern):
    ink = GlowCanvas(1600, 900)
    FLOORS[pattern](ink)
    return pygame.surfarray.array3d(ink.plain())


def test_every_pattern_of_a_file_can_be_drawn():
    assert tuple(FLOORS) == arenas.FLOORS


@pytest.mark.parametrize("pattern", FLOORS)
def test_a_floor_leaves_the_light_to_the_robots(pattern):
    """A grey disc of 112 lies under a marker; a floor is darker, and on average nearly black."""
    pixels = drawn(pattern)
    assert 30 <= pixels.max() <= BRIGHTEST < 112
    assert pixels.mean() < 14
    if pattern != "turf":
        assert (pixels.max(axis=2) < 8).mean() > 0.9


def test_a_turf_is_green_and_has_stripes():
    row = drawn("turf")[:, 450].astype(int)
    assert all(row[:, 1] > row[:, 0] + 8)
    assert all(row[:, 1] > row[:, 2] + 8)
    assert [int(row[80 + 160 * i, 1] > row[80 + 160 * (i - 1), 1]) for i in range(1, 10)] == [1, 0] * 4 + [1]


def test_the_arenas_of_pitanks_differ_in_their_floors():
    patterns = [pattern_of(load("pitanks", name)) for name in NAMES]
    assert len({*patterns}) == len(NAMES) == 5
    pixels = []
    for name in NAMES:
        match = match_of("pitanks", ["idle"] * 4, name)
        view = PiTanksView(match.arena, match.state, ["idle"] * 4, AllEffects())
        pixels.append(pygame.image.tobytes(view.background.bare.subsurface((200, 440, 300, 120)), "RGB"))
    assert len({*pixels}) == len(NAMES)


def test_an_arena_without_a_floor_has_one_by_its_name():
    plain = replace(load("pitanks", "classic"), floor="")
    names = ["grid", "paving", "waves", "hexagons", "strata", "circuit", "diamonds"]
    for name in ("mine", "surprise-1", "surprise-2"):
        assert pattern_of(replace(plain, name=name)) == names[crc32(name.encode()) % 7]


def test_a_file_names_a_floor_and_a_drawing_keeps_it():
    source = load("pitanks", "islands").source
    again = parse("pitanks", drawing_of(source).text(), "again.toml")
    assert again.floor == "waves"
    for wrong in ('"lava"', "3", '["waves"]'):
        with pytest.raises(ArenaError, match=r"floor\.pattern: .*possible are grid, paving"):
            parse("pitanks", source.replace('"waves"', wrong), "wrong.toml")
    with pytest.raises(ArenaError, match=r"floor\.colour: unknown key"):
        parse("pitanks", source.replace('pattern = "waves"', 'colour = "red"'), "wrong.toml")


def test_every_pitch_is_mown():
    for name in shipped_arenas("football"):
        assert pattern_of(load("football", name)) == "turf"
