"""The HUD is complete however little time a frame has for its pieces."""

import pygame
import pytest

from pigaming_app.scenes.bench.busy_pitanks import BusyPiTanks
from pigaming_app.scenes.views.background import Background
from pigaming_app.scenes.views.hud.score import ScoreHud
from pigaming_app.ui.draw.frame_budget import Unfinished, budget
from tests.scenes.cache import empty_cache

PLAYERS = ["human", "level3", "level3", "human"]


def picture(make, state, hurried):
    """A HUD drawn in one go, or a piece a frame."""
    background = Background(lambda: pygame.Surface((1920, 1080), depth=32))
    hud, frames = make(background, state), 0
    with empty_cache():
        while hurried:
            assert (frames := frames + 1) < 200
            try:
                with budget.frame(behind=False), budget.until(0.0):
                    hud.show(state)
                break
            except Unfinished:
                continue
        hud.show(state)
    assert frames > 3 or not hurried, "it was interrupted"
    return pygame.image.tobytes(background.surface, "RGB")


@pytest.mark.parametrize("teams", [(0, 1, 2, 3), (0, 1, 0, 1)])
def test_every_panel_is_there_though_its_pieces_come_one_by_one(teams):
    pygame.font.init()
    state = BusyPiTanks(teams).state

    def hud(background, state):
        return ScoreHud(background, state, PLAYERS)

    assert picture(hud, state, True) == picture(hud, state, False)
