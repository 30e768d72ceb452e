"""The user's own arenas beside ours."""

import logging
from pathlib import Path

import pytest

from pigaming_app.games.arenas import (
    MAX_BYTES,
    arenas,
    is_own_name,
    load,
    own_arenas,
    own_folder,
    score_name,
    shipped_arenas,
)
from pigaming_app.sim.arena import ArenaError
from tests.matches import match_of, run


@pytest.fixture(autouse=True)
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))


def keep(game: str, name: str, source: str) -> Path:
    path = own_folder(game) / f"{name}.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(source, encoding="utf-8")
    return path


def test_they_come_after_ours_and_can_be_played() -> None:
    source = load("pitanks", "labyrinth").source
    keep("pitanks", "alpha", source)
    assert arenas("pitanks") == [*shipped_arenas("pitanks"), "alpha"]
    assert arenas("race") == shipped_arenas("race")
    assert load("pitanks", "alpha").walls == load("pitanks", "labyrinth").walls
    match = run(match_of("pitanks", "random random", "alpha"), 1)
    assert match.state.wall_count == len(load("pitanks", "labyrinth").walls)


def test_a_name_of_ours_is_never_taken() -> None:
    keep("pitanks", "classic", load("pitanks", "labyrinth").source)
    assert own_arenas("pitanks") == []
    assert len(load("pitanks", "classic").walls) != len(load("pitanks", "labyrinth").walls)
    assert score_name("pitanks", "classic") == "classic"


def test_damaged_ones_are_left_out_with_one_line(caplog: pytest.LogCaptureFixture) -> None:
    keep("pitanks", "good", load("pitanks", "classic").source)
    for name, source in {"bad": "[title]\nen = 1", "big": "#" * (MAX_BYTES + 1), "deep": "a = " + "[" * 5000}.items():
        keep("pitanks", name, source)
    with caplog.at_level(logging.WARNING):
        assert own_arenas("pitanks") == own_arenas("pitanks") == ["good"]
    assert len(caplog.records) == 3
    assert all("\n" not in record.getMessage() for record in caplog.records)
    with pytest.raises(ArenaError, match=r"bad\.toml: title"):
        load("pitanks", "bad")


def test_a_change_counts_at_once_and_begins_new_tables() -> None:
    path = keep("pitanks", "mine", load("pitanks", "classic").source)
    first = score_name("pitanks", "mine")
    assert first.startswith("mine-")
    path.write_text(load("pitanks", "labyrinth").source, encoding="utf-8")
    assert load("pitanks", "mine").walls == load("pitanks", "labyrinth").walls
    second = score_name("pitanks", "mine")
    path.write_text(load("pitanks", "classic").source, encoding="utf-8")
    assert score_name("pitanks", "mine") == first != second
    path.unlink()
    assert own_arenas("pitanks") == []
    with pytest.raises(ArenaError, match="no such arena"):
        load("pitanks", "mine")


@pytest.mark.parametrize(
    "name", ["", "a.toml", "../a", "A", "con", "com1", "surprise-3", "a" * 41, "-a", "ä", "a b", "a/b", "a\n"]
)
def test_names_that_cannot_be_used(name: str) -> None:
    assert not is_own_name("pitanks", name)


@pytest.mark.parametrize("name", ["a", "my-arena_2", "surprise", "a" * 40])
def test_names_that_can(name: str) -> None:
    assert is_own_name("pitanks", name)
