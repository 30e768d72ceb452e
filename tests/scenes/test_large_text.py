"""Larger text: it is larger, and still nothing overlaps."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import BODY, read_large, readable
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.button_prompts import type_size
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.cache import empty_cache
from tests.scenes.measuring import faults, measuring
from tests.scenes.screens import SCREENS

WITH_LARGE = [name for name in SCREENS if name.startswith(("options", "operator", "lobby", "robots menu", "ladder"))]


@pytest.fixture
def _large() -> Iterator[None]:
    with empty_cache():
        read_large(True)
        yield
        read_large(False)


@pytest.mark.usefixtures("_large")
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", WITH_LARGE)
def test_nothing_overlaps(
    controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, language: str
) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    arcade = Arcade(controls, language)
    arcade.context.canvas = Canvas.open(Settings(fullscreen=False), headless=True)
    with measuring(monkeypatch) as screen:
        scene = SCREENS[name](arcade)
        for _ in range(12 if name.startswith(("options", "operator", "robots menu")) else 1):
            scene.update(0.4)
            screen.marks.clear()
            scene.draw(screen)
            assert faults(screen) == []
            scene.handle(InputEvent(Button.DOWN, KEYS[0]))


@pytest.mark.usefixtures("_large")
def test_texts_are_larger_where_they_fit() -> None:
    assert readable(BODY) > BODY
    assert type_size((("A", "Ready"),), 800) == readable(BODY)
    assert type_size((("A", "Ready for the next match"),), 500) == BODY


def test_by_default_they_are_as_usual() -> None:
    assert readable(BODY) == BODY
