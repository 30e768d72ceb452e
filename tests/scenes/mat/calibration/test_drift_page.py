"""The drift page: no text overlaps the spot for a robot, in either language."""

import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pygame
import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.calibration.camera_task import SPOT
from pigaming_app.hardware.emulator.site import EmulatedCalibrationSite
from pigaming_app.scenes.mat.calibration.drift_page import DriftPage
from pigaming_app.scenes.mat.calibration.height_page import DISC
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.controls import Controls
from tests.scenes.mat.calibration.drawn import PICTURES
from tests.scenes.measuring import faults, measuring
from tests.scenes.operated import Operated

SPOT_BOX = pygame.Rect(LEFT + SPOT[0] - DISC, TOP + SPOT[1] - DISC, 2 * DISC, 2 * DISC)


def longest(language: str) -> OperatorMessage:
    """The message with the longest sentence, with every value as long as its placeholder."""
    sentences = {key: text for key, text in texts(language).items() if key.startswith("hardware.")}
    key = max(sentences, key=lambda key: len(sentences[key]))
    holes = re.findall(r"{(\w+)}", sentences[key])
    return OperatorMessage(key.removeprefix("hardware."), **{name: f"{{{name}}}" for name in holes})


OFF = SimpleNamespace(ground=SimpleNamespace(marker=45.0, printed=False))
STATES: dict[str, dict[str, Any]] = {
    "looking": {"mm": None},
    "still": {"mm": 0.1},
    "moved a little": {"mm": 9.9, "marker_mm": 45.1, "drift": OFF},
    "moved": {"mm": 123.4, "marker_mm": 149.9, "drift": OFF},
    "trouble": {"fault": "longest"},
    **{
        f"{name} picture": {"mm": 9.9, "quality": PICTURES[name][0]} for name in ("blurred", "smeared", "tiny", "small")
    },
    "used anyway": {"mm": 9.9, "quality": replace(PICTURES["sharp"][0], anyway=True)},
}


@pytest.fixture(scope="module")
def site() -> EmulatedCalibrationSite:
    """A site that only answers queries."""
    return EmulatedCalibrationSite(2)


@pytest.mark.usefixtures("_home")
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("state", STATES)
def test_no_sentence_runs_into_the_spot(
    controls: Controls, site: EmulatedCalibrationSite, monkeypatch: pytest.MonkeyPatch, language: str, state: str
) -> None:
    arcade = Operated(controls, site)
    arcade.context.words = Words(language)
    with measuring(monkeypatch) as screen:
        page = DriftPage(arcade.context, arcade.site)
        for name, value in STATES[state].items():
            setattr(page.work, name, longest(language) if value == "longest" else value)
        page.draw(screen)
        assert len(screen.texts) >= 4
        assert faults(screen) == []
        for mark in screen.texts:
            left, top, right, bottom = mark.box
            assert not SPOT_BOX.colliderect((left, top, right - left, bottom - top)), mark.text
