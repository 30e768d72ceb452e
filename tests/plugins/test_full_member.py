"""A plug-in at every place, the editor and the Ladder too; one that fails there takes its game from the title alone."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.cases import repeated
from tests.plugins.packages import ROOT, changed, install, write_tag
from tests.processes import python

SEEN = """
from pigaming_app.scenes.views.registry import shown_games
before = shown_games()
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.games.arenas import load
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.scenes.editor.checker import Checker
from pigaming_app.scenes.editor.model.edits import placed
from pigaming_app.scenes.editor.model.symmetry import Symmetry
from pigaming_app.ui.i18n import Words
print(*before, "|", *shown_games(), "|", Words("en")("games.tag"), load("tag", "classic").name)
if "tag" in EDITORS:
    tools = EDITORS["tag"]
    drawing = drawing_of(load("tag", tools.template).source)
    drawing, items = placed(tools, drawing, tools.palette[0], (600, 100), (600, 180), Symmetry.TURN)
    checker = Checker(tools, "new-1")
    checker._asked, checker._planner.give = drawing, checker._plan
    checker._find((drawing, True))
    print(len(items), checker.verdict.arena.walls == load("tag", "classic").walls, len(checker.verdict.routes))
"""


@pytest.fixture
def tag(home: Path) -> Path:
    """The package of Tag, as docs/add-a-game.md makes it."""
    switch("tag", True)
    return write_tag(user_folder() / "tag")


def seen() -> tuple[list[str], str]:
    """The lines that a process prints, and its errors."""
    ended = python(SEEN)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout.splitlines(), ended.stderr


def test_the_arenas_of_tag_are_drawn(tag: Path) -> None:
    lines, errors = seen()
    assert lines == ["pitanks factory race football tag | pitanks factory race football tag | Tag classic", "2 False 4"]
    assert errors == ""


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("TOOLS = TagTools()", "TOOLS = tag_tools", "editor.py, line {n}: NameError: name 'tag_tools' is not defined."),
        ('game = "tag"', 'game = "tick"', "its tools are for tick, not for tag."),
        ("TOOLS = TagTools()", "TOOLS = TagTools", "TOOLS is no Tools."),
    ],
)
def test_one_that_fails_takes_its_game_from_the_title_alone(tag: Path, old: str, new: str, reason: str) -> None:
    reason = reason.format(n=changed(tag / "editor.py", old, new))
    lines, errors = seen()
    assert lines == ["pitanks factory race football tag | pitanks factory race football | Tag classic"]
    assert errors == f"PiGaming: The game tag in {tag} is left out: {reason}\n"


CLIMBED = """
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.events.ladder import climbed_games
print(*shown_games(), "|", *climbed_games())
"""


@pytest.mark.parametrize(
    ("file", "old", "new", "reason"),
    [
        ("rules.py", "", "", ""),
        ("screens.py", "", "", ""),
        ("__init__.py", "LadderMatches()", 'LadderMatches(arenas=("park",))', "arenas/park.toml is missing."),
        ("rules.py", "REACH = 92.0", "REACH = 92.0 +", "rules.py, line {n}: SyntaxError: invalid syntax"),
    ],
)
def test_a_game_that_asks_for_it_is_on_the_ladder(tag: Path, file: str, old: str, new: str, reason: str) -> None:
    """Unless it cannot be used, or has no screens."""
    package = tag / "__init__.py"
    text = package.read_text().replace("import Game", "import Game, LadderMatches")
    package.write_text(text.replace("    judge=judge,", "    judge=judge,\n    ladder=LadderMatches(),"))
    if old:
        reason = reason.format(n=changed(tag / file, old, new))
    if file == "screens.py":
        (tag / file).unlink()
    ended = python(CLIMBED)
    tag_too = " tag" if file == "rules.py" and not reason else ""
    assert ended.stdout == f"pitanks factory race football{tag_too} | pitanks factory race football{tag_too}\n"
    assert (ended.stderr.count("\n"), f"is left out: {reason}" in ended.stderr) == (bool(reason), bool(reason))


@pytest.mark.long
@pytest.mark.parametrize("place", repeated(["installed", "user"]))  # the page of Tag walks through many in the folder
def test_a_plug_in_appears_at_every_place(home: Path, tmp_path: Path, place: str) -> None:
    site = tmp_path / "site"
    if place == "user":
        write_tag(user_folder() / "tag")
        switch("tag", True)
    else:
        write_tag(install(site, "tag", "robot_tag.game"))
        switch("tag@robot_tag.game", True)
    command = [sys.executable, "-X", "pigaming", "-m", "tests.plugins.places", "tag", str(tmp_path)]
    quiet = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PYTHONPATH": str(site)}
    ended = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=os.environ | quiet, timeout=1800)
    assert ended.stdout.splitlines()[-1:] == ["all places"], ended.stderr[-3000:]
