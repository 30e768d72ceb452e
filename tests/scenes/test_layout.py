"""Layout: no text overlaps another, crosses a frame or leaves the picture; both languages, longest values."""

import pytest

from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.window import Canvas
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import Mark, faults, measuring
from tests.scenes.screens import SCREENS

# Capitals of 25 px, type of 36 px: legible at three metres.
LARGE = ("event", "widest event", "next match", "widest next", "entrants", "correction", "sudden death")
# Each row of these is checked.
LISTS = ("options", "operator", "robots menu", "setup", "added games", "arena and radio")


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.context.canvas = Canvas.open(Settings(fullscreen=False), headless=True)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", SCREENS)
def test_texts_keep_off_each_other_and_off_frames(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, name: str, language: str
) -> None:
    arcade.context.words.switch(language)
    with measuring(monkeypatch) as screen:
        scene = SCREENS[name](arcade)
        for _ in range(12 if name.startswith(LISTS) else 1):
            scene.update(0.4)
            screen.marks.clear()
            scene.draw(screen)
            assert len(screen.texts) >= 3, "it is measured"
            assert relevant(name, faults(screen)) == []
            if name.startswith(LARGE) and name != "correction in own words":
                assert [mark.text for mark in screen.texts if mark.text[1:] and height(mark) < 25] == []
            scene.handle(InputEvent(Button.DOWN, KEYS[0]))


def height(mark: Mark) -> float:
    return mark.box[3] - mark.box[1]


def relevant(name: str, found: list[str]) -> list[str]:
    """Without the lesson numbers, which lie in discs on the frames."""
    numbers = {f"'{number}' crosses its frame" for number in range(1, 5)} if name.startswith("how to") else set()
    return [fault for fault in found if fault not in numbers]
