"""`main.py arena`: the user's arenas as files, and hostile files in one line."""

import json
from pathlib import Path

import pytest

from pigaming_app import ASSETS
from pigaming_app.games.arenas import MAX_BYTES, MOST_OWN, load, own_arenas, own_folder, shipped_arenas
from pigaming_app.games.registry import games
from pigaming_app.jobs.cli import main

SHIPPED = [(game, name) for game in games() for name in shipped_arenas(game)[:1]]


@pytest.fixture(autouse=True)
def _home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))


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
    assert json.loads(capsys.readouterr().out)[game] == {
        "arenas": [*shipped_arenas(game), "shared"],
        "own": ["shared"],
    }


@pytest.mark.parametrize(("game", "name"), SHIPPED)
def test_of_a_file_with_a_slip_the_error_is_that_of_its_own_game(
    game: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Other games miss tables in it, and know nothing of some that it has."""
    table = {"pitanks": "wall", "factory": "machine", "race": "corner", "football": "drop"}[game]
    file = tmp_path / "a.toml"
    file.write_text(load(game, name).source.replace(f"[[{table}]]", f"[[{table}]]\nhigh = 3", 1), encoding="utf-8")
    assert main(["arena", "check", str(file)]) == 2
    assert f"a.toml: {table}[1].high: unknown key" in capsys.readouterr().err


def test_nothing_is_replaced_unasked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(ASSETS / "arenas" / "pitanks" / "labyrinth.toml")
    assert main(["arena", "import", file]) == 2
    assert main(["arena", "import", file, "--as", "../../evil"]) == 2
    assert main(["arena", "import", file, "--as", "mine"]) == 0
    assert main(["arena", "import", file, "--as", "mine"]) == 2
    assert main(["arena", "import", file, "--as", "mine", "--replace"]) == 0
    assert main(["arena", "import", file, "--of", "race", "--as", "other"]) == 2
    assert own_arenas("pitanks") == ["mine"]
    assert all(line.startswith("PiGaming: ") for line in capsys.readouterr().err.splitlines())


@pytest.mark.parametrize("folder", ["arenas/race", "drafts/race", "shared"])
def test_what_a_killed_program_left_there_is_deleted_by_the_next_one(folder: str, tmp_path: Path) -> None:
    left = tmp_path / "home" / "data" / folder / ".pigaming-0a1b2c3d.tmp"
    left.parent.mkdir(parents=True)
    left.write_bytes(b"[title]\n")
    assert main(["arena", "check", str(ASSETS / "arenas" / "pitanks" / "classic.toml")]) == 0
    assert not left.exists()


def test_no_more_come_in_than_the_lobby_lists(capsys: pytest.CaptureFixture[str]) -> None:
    file = ASSETS / "arenas" / "pitanks" / "classic.toml"
    own_folder("pitanks").mkdir(parents=True)
    for i in range(MOST_OWN):
        (own_folder("pitanks") / f"own-{i}.toml").write_bytes(file.read_bytes())
    assert main(["arena", "import", str(file), "--as", "zebra"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert main(["arena", "import", str(file), "--as", "own-3", "--replace"]) == 0
    assert len(own_arenas("pitanks")) == MOST_OWN


@pytest.mark.parametrize(
    "content",
    [
        b"", b"\xff\xfe", b"x = [", b"#" * (MAX_BYTES + 1), b"a = " + b"[" * 5000, b"a." * 5000 + b"b = 1", b"x = 1\n",
        b'[title]\nen = "a\\nb"\npt = "a"', b'[title]\nen = "a"\npt = "a"\n"\\u001b[2J" = 1', b"wall = 9" + b"9" * 5000,
    ],
)  # fmt: skip
def test_damaged_files_are_refused_in_one_line(
    content: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bad.toml"
    file.write_bytes(content)
    for word in ("check", "import"):
        assert main(["arena", word, str(file)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.isprintable()
    assert not (tmp_path / "home" / "data" / "arenas").exists()


@pytest.mark.parametrize(
    "words",
    [["check"], ["export", "pitanks"], ["import", "a", "b"], ["list", "x"], ["check", "/nowhere.toml"], ["check", "."],
     ["export", "chess", "a", "b"], ["export", "pitanks", "nothing", "b"], ["export", "pitanks", "classic", "/no/b"]],
)  # fmt: skip
def test_other_requests_are_refused_in_one_line(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    if words[-1] == "/no/b":
        words = [*words[:-1], str(ASSETS / "arenas" / "pitanks" / "classic.toml" / "b")]
    assert main(["arena", *words]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
