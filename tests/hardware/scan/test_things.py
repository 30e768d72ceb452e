"""Things as games get them: outlines, their file, removal by hand."""

from dataclasses import replace

import numpy as np
import pytest

from pigaming_app.games.arenas import load, with_things
from pigaming_app.hardware.scan.things import (
    MOST,
    LayoutError,
    ProjectorPlace,
    Thing,
    ThingKind,
    ThingLayout,
    largest,
    moved_outwards,
    read,
    to_toml,
)
from pigaming_app.hardware.session.store import load_things, save_things
from pigaming_app.sim.things.convex import is_convex
from pigaming_app.sim.things.spec import Use
from tests.hardware.sentences import refused

BOX = Thing(ThingKind.TALL, ((100.0, 100.0), (200.0, 110.0), (190.0, 180.0), (95.0, 170.0)), 82.5, 3.25)
TAPE = Thing(ThingKind.FLAT, ((500.0, 500.0), (700.0, 500.0), (700.0, 519.0), (500.0, 519.0)), 0.0, 3.0)
LAYOUT = ThingLayout((BOX, TAPE), ProjectorPlace((712.0, 23.0), 2700.0))


def test_a_square_grows_by_the_same_distance_on_every_side():
    square = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)])
    grown = [(-2.0, -2.0), (12.0, -2.0), (12.0, 12.0), (-2.0, 12.0)]
    assert moved_outwards(square, 2.0) == pytest.approx(np.array(grown))
    assert moved_outwards(square[::-1], 2.0) == pytest.approx(np.array(grown[::-1]))


def test_a_thing_is_removed_by_pointing_at_it():
    pointed = [thing for thing in LAYOUT.things if thing.contains(150.0, 140.0)]
    assert LAYOUT.without(pointed[0]).things == (TAPE,)
    assert LAYOUT.without(pointed[0]).projector == LAYOUT.projector


def test_the_things_stay_on_the_mat_until_the_next_start(tmp_path):
    path = tmp_path / "things.toml"
    assert load_things(path) == ThingLayout()
    save_things(LAYOUT, path)
    assert load_things(path) == LAYOUT


def test_tape_is_mud_by_choice_and_everything_tall_a_wall():
    chosen = read(to_toml(LAYOUT.replaced(TAPE, TAPE.as_mud(True))))
    assert [thing.use for thing in chosen.things] == [Use.WALL, Use.MUD]
    assert BOX.as_mud(True).use is Use.WALL


def test_an_arena_gets_things_with_straight_sides_in_either_order_of_corners():
    noisy = Thing(ThingKind.TALL, ((0.0, 0.0), (50.0, 0.04), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)), 80.0, 3.0)
    spec = noisy.spec
    assert is_convex(spec.outline)
    assert len(spec.outline) == 4
    assert replace(noisy, outline=noisy.outline[::-1]).spec == spec
    arena = load("pitanks", "classic")
    assert with_things("pitanks", arena, [spec]).things == (spec,)
    assert with_things("pitanks", arena, []) is arena


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("version = 1", "version = 9"),
        ('"tall"', '"huge"'),
        ("82.5", "-1.0"),
        ("110.0", "300.0"),  # not convex
        ("2700.0", "nan"),
        ("version = 1", "version = "),
        ("margin_px", "margin"),
    ],
)
def test_a_damaged_file_asks_for_a_new_scan(old, new):
    with refused(LayoutError, "scan again"):
        read(to_toml(LAYOUT).replace(old, new))


def test_of_too_many_things_the_tall_and_large_ones_stay():
    kept = largest([TAPE] * MOST + [BOX] * 2)
    assert kept[:2] == (BOX, BOX)
    assert len(kept) == MOST
