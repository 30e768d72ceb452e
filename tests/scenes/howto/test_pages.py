"""How to play: pages in order, their rule sets, and short captions."""

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
