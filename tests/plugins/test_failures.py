"""A plug-in that fails in the arcade: the title returns without its game, with one sentence; all others play."""

from pathlib import Path

import pytest

from pigaming_app.jobs.new_game import write
from pigaming_app.storage.plugins.consent import switch
from pigaming_app.storage.plugins.found import user_folder
from tests.plugins.packages import changed
from tests.processes import python

MATCH = """
from pigaming_app.games.game import Seat, Setup
from pigaming_app.scenes.app import App
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened
from pigaming_app.scenes.views.registry import shown_games

seats = tuple(Seat("level5", seat) for seat in range(4))
match = lambda context: MatchScene(context, Setup("tag", "classic", seats, 1.0, 3, "standard"), [None] * 4)
print(*shown_games())
with opened(Options(first_scene=match, headless=True, step=1 / 30, frames=240)) as app:
    said = []
    app.notices.add = said.append
    assert app.loop() == 0
    print(*shown_games())
    print(*[type(scene).__name__ for scene in app.stack.scenes], *app.stack.top.tiles.names)
    print(*said)
"""
FAULTS = {
    "rules.py": ("    match.tick += 1\n", "    match.tick += 1\n    match.tick //= int(match.tick < 9)\n"),
    "ai.py": ("    if match.tick % PERIOD", "    match.nothing.x = 1\n    if match.tick % PERIOD"),
    "screens.py": ("        put(under, coin()", "        self.nothing.draw()\n        put(under, coin()"),
}
ENDLESS = (*FAULTS["rules.py"][:1], "    match.tick += 1\n    while match.tick > 9:\n        pass\n")


@pytest.mark.parametrize(
    ("file", "before", "after"), [*((file, *fault) for file, fault in FAULTS.items()), ("rules.py", *ENDLESS)]
)
def test_the_title_returns_without_a_game_that_fails_or_hangs_in_a_match(
    home: Path, file: str, before: str, after: str
) -> None:
    folder = user_folder() / "tag"
    write(folder, "tag")
    switch("tag", True)
    changed(folder / file, before, after)
    ended = python(MATCH, timeout=600.0)
    assert ended.returncode == 0, ended.stderr[-2000:]
    *_, at_first, later, stack, notice = ended.stdout.splitlines()
    assert at_first.split() == [*later.split(), "tag"]
    assert stack.split() == ["Title", *later.split()]
    assert notice == "Tag failed. It is left out until the next start."
    (line,) = [line for line in ended.stderr.splitlines() if "left out" in line]
    assert line.startswith(f"PiGaming: The game tag in {folder} is left out: {file}, line ")
