"""The page that checks the calibration: no sentence of it runs into the spot for a robot, in either language."""

from types import SimpleNamespace
from typing import Any

import pygame
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.camera_task import SPOT
from pigaming_app.hardware.emulator.site import EmulatedSite
from pigaming_app.scenes.calibration.drift_page import DriftPage
from pigaming_app.scenes.calibration.height_page import DISC
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.controls import Controls
from tests.scenes.measuring import faults, measuring
from tests.scenes.operated import Operated

SPOT_BOX = pygame.Rect(LEFT + SPOT[0] - DISC, TOP + SPOT[1] - DISC, 2 * DISC, 2 * DISC)
LONGEST = {language: max((text for key, text in texts(language).items() if key.startswith("vision.")), key=len)
           for language in LANGUAGES}  # fmt: skip
OFF = SimpleNamespace(ground=SimpleNamespace(marker=45.0))
STATES: dict[str, dict[str, Any]] = {
    "looking": {"mm": None, "trouble": None},
    "still": {"mm": 0.1, "trouble": None},
    "moved a little": {"mm": 9.9, "trouble": None, "marker_mm": 45.1, "drift": OFF},
    "moved": {"mm": 123.4, "trouble": None, "marker_mm": 149.9, "drift": OFF},
    "trouble": {"trouble": "longest"},
}


@pytest.mark.usefixtures("_home")
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("state", STATES)
def test_no_sentence_runs_into_the_spot(
    controls: Controls, monkeypatch: pytest.MonkeyPatch, language: str, state: str
) -> None:
    arcade = Operated(controls, EmulatedSite(2))
    arcade.context.words = Words(language)
    with measuring(monkeypatch) as screen:
        page = DriftPage(arcade.context, arcade.site)
        for name, value in STATES[state].items():
            setattr(page.work, name, LONGEST[language] if value == "longest" else value)
        page.draw(screen)
        assert len(screen.texts) >= 4
        assert faults(screen) == []
        for mark in screen.texts:
            left, top, right, bottom = mark.box
            assert not SPOT_BOX.colliderect((left, top, right - left, bottom - top)), mark.text
