"""How to play: pages in order, their rule sets, and pictures that move."""

import pygame
import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.howto.scene import taught
from pigaming_app.scenes.views.game_screens import LESSONS_PER_PAGE
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import span
from pigaming_app.ui.draw.text import wrap
from pigaming_app.ui.i18n import LANGUAGES, Words

ROOM = span(0, 3)[1] - 48  # px for a caption


@pytest.mark.parametrize("game", taught())
def test_every_page_is_full_and_named_by_a_rule_set(game: str) -> None:
    names = SCREENS[game].lesson_pages
    assert len(SCREENS[game].lessons) == LESSONS_PER_PAGE * max(1, len(names))
    assert {*names} <= {*games()[game].variants}


@pytest.mark.parametrize("language", LANGUAGES)
def test_captions_have_at_most_two_lines(language: str) -> None:
    words = Words(language)
    for game in taught():
        for name in SCREENS[game].lessons:
            assert len(wrap(words(f"howto.{name}"), BODY, ROOM)) <= 2, name


@pytest.mark.parametrize("lesson", ["knockout", "light", "bounty", "finale"])
def test_the_pictures_of_party_move_within_their_boxes(lesson: str) -> None:
    pygame.display.init()
    pygame.font.init()
    screen = pygame.display.set_mode((640, 720))
    box = pygame.Rect(113, 60, 414, 470)
    pictures = set()
    for step in range(24):
        screen.fill("black")
        SCREENS["pitanks"].lessons[lesson](screen, 320, 320, 0.25 * step)
        pictures.add(pygame.image.tobytes(screen.subsurface(box), "RGB"))
    assert len(pictures) >= 10
