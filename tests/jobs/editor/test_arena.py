"""`main.py arena`: the user's arenas as files, and hostile files in one line."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app import ASSETS
from pigaming_app.games.arenas import MAX_BYTES, MOST_OWN, load, own_arenas, own_folder, shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.jobs.cli import main

Refused = Callable[..., str]
SHIPPED = [(game, name) for game in games() for name in shipped_arenas(game)[:1]]


@pytest.mark.parametrize(("game", "name"), SHIPPED)
def test_an_arena_goes_out_and_comes_in(
    game: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = str(tmp_path / "Shared.toml")
    assert main(["arena", "export", game, name, file]) == 0
    assert main(["arena", "check", file]) == 0
    assert f"an arena of {game}, good" in capsys.readouterr().out
    assert main(["arena", "import", file]) == 0
    assert own_arenas(game) == ["shared"]
    assert load(game, "shared").source == load(game, name).source
    capsys.readouterr()
    assert main(["arena", "list", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[game] == {"arenas": [*shipped_arenas(game), "shared"], "own": ["shared"]}


@pytest.mark.parametrize(("game", "name"), SHIPPED)
def test_of_a_file_with_a_slip_the_error_is_that_of_its_own_game(
    game: str, name: str, tmp_path: Path, refused: Refused
) -> None:
    """Other games miss tables in it, and know nothing of some that it has."""
    table = {"pitanks": "wall", "factory": "machine", "race": "corner", "football": "drop"}[game]
    file = tmp_path / "a.toml"
    file.write_text(load(game, name).source.replace(f"[[{table}]]", f"[[{table}]]\nhigh = 3", 1), encoding="utf-8")
    assert f"a.toml: {table}[1].high: unknown key" in refused("arena", "check", str(file))


def test_nothing_is_replaced_unasked(refused: Refused) -> None:
    words = ["arena", "import", str(ASSETS / "arenas" / "pitanks" / "labyrinth.toml")]
    refused(*words)
    refused(*words, "--as", "../../evil")
    assert main([*words, "--as", "mine"]) == 0
    refused(*words, "--as", "mine")
    assert main([*words, "--as", "mine", "--replace"]) == 0
    refused(*words, "--of", "race", "--as", "other")
    assert own_arenas("pitanks") == ["mine"]


@pytest.mark.parametrize("folder", ["arenas/race", "drafts/race", "shared"])
def test_what_a_killed_program_left_there_is_deleted_by_the_next_one(folder: str, tmp_path: Path) -> None:
    left = tmp_path / "home" / "data" / folder / ".pigaming-0a1b2c3d.tmp"
    left.parent.mkdir(parents=True)
    left.write_bytes(b"[title]\n")
    assert main(["arena", "check", str(ASSETS / "arenas" / "pitanks" / "classic.toml")]) == 0
    assert not left.exists()


def test_no_more_come_in_than_the_lobby_lists(refused: Refused) -> None:
    file = ASSETS / "arenas" / "pitanks" / "classic.toml"
    own_folder("pitanks").mkdir(parents=True)
    for i in range(MOST_OWN):
        (own_folder("pitanks") / f"own-{i}.toml").write_bytes(file.read_bytes())
    refused("arena", "import", str(file), "--as", "zebra")
    assert main(["arena", "import", str(file), "--as", "own-3", "--replace"]) == 0
    assert len(own_arenas("pitanks")) == MOST_OWN


@pytest.mark.parametrize(
    "content",
    [
        b"", b"\xff\xfe", b"x = [", b"#" * (MAX_BYTES + 1), b"a = " + b"[" * 5000, b"a." * 5000 + b"b = 1", b"x = 1\n",
        b'[title]\nen = "a\\nb"\npt = "a"', b'[title]\nen = "a"\npt = "a"\n"\\u001b[2J" = 1', b"wall = 9" + b"9" * 5000,
    ],
)  # fmt: skip
def test_damaged_files_are_refused_in_one_line(content: bytes, tmp_path: Path, refused: Refused) -> None:
    file = tmp_path / "bad.toml"
    file.write_bytes(content)
    for word in ("check", "import"):
        refused("arena", word, str(file))
    assert not (tmp_path / "home" / "data" / "arenas").exists()


@pytest.mark.parametrize(
    "words",
    [["check"], ["export", "pitanks"], ["import", "a", "b"], ["list", "x"], ["check", "/nowhere.toml"], ["check", "."],
     ["export", "chess", "a", "b"], ["export", "pitanks", "nothing", "b"],
     ["export", "pitanks", "classic", str(ASSETS / "arenas" / "pitanks" / "classic.toml" / "b")]],
)  # fmt: skip
def test_other_requests_are_refused_in_one_line(words: list[str], refused: Refused) -> None:
    refused("arena", *words)
