"""Names in the editor: of the tool with the focus or under the mouse, and of a drawing that has none."""

from pathlib import Path

import pygame
import pytest

from pigaming_app.games.arenas import load, shipped_arenas
from pigaming_app.games.drawing.values import drawing_of
from pigaming_app.scenes.editor import store
from pigaming_app.scenes.editor.naming import ArenaNamePage
from pigaming_app.scenes.editor.registry import EDITORS
from pigaming_app.scenes.editor.scene import Editor
from pigaming_app.scenes.editor.toolbar import NAMES, RIGHT_COLUMN, W, box
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.ui.i18n import LANGUAGES, texts
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, Device, InputEvent
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import SAFE, measuring

OWN = ("pitanks", "race", "factory")


@pytest.mark.parametrize("game", OWN)
def test_every_tile_is_named_with_the_focus_and_under_the_mouse(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, game: str
) -> None:
    arcade = Arcade(controls)
    drawing = drawing_of(load(game, shipped_arenas(game)[0]).source)
    scene = Editor(arcade.context, game, "new-1", drawing)
    scene.bench.close()
    seen: dict[str, str] = {}
    with measuring(monkeypatch) as screen:

        def beside(tile: pygame.Rect) -> list[str]:
            """The texts at the height of a tile, right of the bar."""
            screen.marks.clear()
            scene.draw(screen)
            marks = [mark for mark in screen.texts if mark.box[0] > RIGHT_COLUMN + W and SAFE.right > mark.box[2]]
            return [mark.text for mark in marks if abs(mark.box[1] + mark.box[3] - 2 * tile.centery) < 6]

        for item in scene.tools.items(drawing):
            scene.bench.selected = item
            for name, tile in scene.tiles.items():
                if tile.icon in seen:
                    continue
                at = box(NAMES.index(name))
                assert beside(at) == []
                scene.handle(InputEvent(Button.POINT, Device("mouse"), at=at.center))
                (seen[tile.icon],) = beside(at)
                scene.handle(InputEvent(Button.FOUND, KEYS[0]))
                assert beside(at) == []
                scene.bar.open = True
                scene.bar.focus.move_to(name)
                assert beside(at) == [seen[tile.icon]]
                scene.bar.open = False
    assert len(seen) > 10
    assert len({*seen.values()}) == len(seen)
    assert all({f"editor.tool_{icon}" for icon in seen} <= texts(language).keys() for language in LANGUAGES)


@pytest.mark.parametrize("language", ["fr", "de"])
@pytest.mark.parametrize("game", list(EDITORS))
def test_an_empty_name_proposes_a_free_one(
    controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, game: str, language: str
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    arcade, entered = Arcade(controls, language), list[str]()
    drawing = drawing_of(load(game, shipped_arenas(game)[0]).source)
    for number in (1, 2):
        page = ArenaNamePage(arcade.context, game, f"new-{number}", "", entered.append)
        arcade.open(page)
        arcade.wait(0.5)
        proposed = page.name
        assert proposed.endswith(f" {number}")
        assert page.is_possible(proposed)
        page.spell("")
        arcade.press(Button.START)
        assert (page.name, entered, page.unusable) == (proposed, entered[: number - 1], False)
        arcade.press(Button.START)
        assert entered[number - 1] == proposed
        write_atomic(store.draft_file(game, store.file_name(proposed)), drawing.text().encode())
    assert len({*entered}) == 2


def test_a_title_that_letters_cannot_spell_gets_a_proposal(controls: Controls) -> None:
    context = Arcade(controls).context
    assert ArenaNamePage(context, "race", "x", "Circuit", lambda name: None).name == "CIRCUIT"
    assert ArenaNamePage(context, "race", "x", "Überhang", lambda name: None).name == "TRACK 1"
