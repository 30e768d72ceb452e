"""The first view of the results, and the way to the numbers."""

from dataclasses import replace

import pygame
import pytest

from pigaming_app.games.game import Row
from pigaming_app.scenes.results.awards.ceremony import ICON_X, Ceremony
from pigaming_app.scenes.results.scene import IDLE, Results
from pigaming_app.scenes.results.view import score_cell
from pigaming_app.ui.draw.layers import LEFT
from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.results.awards.test_award import every_award
from tests.scenes.results.awards.test_praise import ended_match
from tests.scenes.screens import ENDINGS, Ending


def opened(arcade: Arcade, ending: Ending) -> Results:
    results = ending.results(arcade)
    results.claims = []
    return arcade.open(results)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", ["alone", "in teams"])
def test_names_and_awards_leave_a_gap(monkeypatch: pytest.MonkeyPatch, arcade: Arcade, name: str) -> None:
    """With the longest names, the longest award of the language, and the longest kind word."""
    words = arcade.context.words
    longest = max((award for _, award in every_award()), key=lambda award: len(words(f"awards.{award.key}")))
    monkeypatch.setattr(
        "pigaming_app.scenes.results.awards.ceremony.awards_of", lambda *_: dict.fromkeys(range(4), longest)
    )
    said = max((text for key, text in texts(words.language).items() if key.startswith("awards.")), key=len)
    monkeypatch.setattr("pigaming_app.scenes.results.awards.ceremony.praises", lambda *_: dict.fromkeys(range(4), said))
    ended = replace(ended_match(name), names=("W" * 12, "M" * 12, "Wolfgang-Maria", "Ångström"))
    page = Ceremony(arcade.context, ended, True, {})
    page.draw(arcade.screen, 9.0)
    gap = arcade.screen.subsurface((LEFT + ICON_X - 72, 226, 20, 580))
    lit = pygame.mask.from_threshold(gap, (255, 255, 255), (150, 150, 150)).count()
    assert lit < 200, "the panels' lines cross it, no text does"
    right = arcade.screen.subsurface((1800, 226, 14, 580))
    assert pygame.mask.from_threshold(right, (255, 255, 255), (150, 150, 150)).count() < 200


def test_left_and_right_change_between_awards_and_numbers(arcade: Arcade) -> None:
    results = opened(arcade, ENDINGS["alone"])
    arcade.frame(draw=True)
    awards = arcade.screen.copy()
    arcade.press(Button.RIGHT)
    assert results.page is results.numbers
    arcade.frame(draw=True)
    assert pygame.image.tobytes(arcade.screen, "RGB") != pygame.image.tobytes(awards, "RGB")
    arcade.press(Button.LEFT)
    assert results.page is results.ceremony
    arcade.until(lambda: arcade.stack.top is arcade.title, IDLE + 1.0)


def test_the_prompt_of_the_other_view_can_be_clicked(arcade: Arcade) -> None:
    results = opened(arcade, ENDINGS["alone"])
    for page, key in ((results.ceremony, "results.numbers"), (results.numbers, "results.awards")):
        assert results.page is page
        assert (Button.RIGHT, key) in results.prompts.items
        arcade.press(Button.RIGHT, device=KEYS[0])


@pytest.mark.parametrize("language", LANGUAGES)
def test_in_party_a_score_below_zero_is_shown_as_hits_taken(language: str) -> None:
    words, row = Words(language), Row(0, 0, 1, -3, {"taken": 7, "hits": 4}, {}, ())
    party, pickups = (setup_of("pitanks", "human human", variant=variant) for variant in ("party", "pickups"))
    assert score_cell(words, party, row)[0] == words("results.hits_taken", count=7)
    assert score_cell(words, pickups, row)[0] == "−3"
    assert score_cell(words, party, replace(row, score=0))[0] == "0"
