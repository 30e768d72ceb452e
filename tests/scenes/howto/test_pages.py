"""How to play: pages in order, their rule sets, and pictures that move."""

import pygame
import pytest

from pigaming_app.games.registry import games
from pigaming_app.scenes.howto.lessons import LESSONS, PAGE, PAGES
from pigaming_app.scenes.howto.scene import HowTo
from pigaming_app.ui.draw import BODY
from pigaming_app.ui.draw.layers import span
from pigaming_app.ui.draw.text import wrap
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade

ROOM = span(0, 3)[1] - 48  # px for a caption


@pytest.fixture
def arcade(controls: Controls) -> Arcade:
    return Arcade(controls)


def test_right_leads_through_all_pages_and_back_to_the_first(arcade: Arcade) -> None:
    page = HowTo(arcade.context, "pitanks")
    arcade.open(page)
    seen = []
    for _ in range(sum(len(lessons) for lessons in LESSONS.values()) // PAGE):
        seen.append((page.game, page.page))
        arcade.press(Button.RIGHT)
    assert (page.game, page.page) == seen[0] == ("pitanks", 0)
    assert seen[1] == ("pitanks", 1)
    assert len(set(seen)) == len(seen)
    arcade.press(Button.LEFT)
    assert (page.game, page.page) == seen[-1]


@pytest.mark.parametrize("game", LESSONS)
def test_every_page_is_full_and_named_by_a_rule_set(game: str) -> None:
    names = PAGES.get(game, (games()[game].default.name,))
    assert len(LESSONS[game]) == PAGE * len(names)
    assert {*names} <= {*games()[game].variants}


@pytest.mark.parametrize("language", LANGUAGES)
def test_captions_have_at_most_two_lines(language: str) -> None:
    words = Words(language)
    for lessons in LESSONS.values():
        for name in lessons:
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
        LESSONS["pitanks"][lesson](screen, 320, 320, 0.25 * step)
        pictures.add(pygame.image.tobytes(screen.subsurface(box), "RGB"))
    assert len(pictures) >= 10
