"""The first view of the results, and the way to the numbers."""

from dataclasses import replace

import pygame
import pytest

from pigaming_app.games.game import Row
from pigaming_app.scenes.results.awards.ceremony import AWARD_X, ICON_X, Ceremony, award_text
from pigaming_app.scenes.results.scene import IDLE, Results
from pigaming_app.scenes.results.view import score_cell
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.ui.draw import BODY, LABEL, SUB
from pigaming_app.ui.draw.layers import LEFT, RIGHT, fit_size
from pigaming_app.ui.i18n import LANGUAGES, Words, texts
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.button_prompts import places, type_size
from tests.matches import setup_of
from tests.scenes.arcade import Arcade
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


@pytest.mark.parametrize("language", LANGUAGES)
def test_awards_and_kind_words_are_read_from_three_metres(language: str) -> None:
    words, room = Words(language), RIGHT - LEFT - AWARD_X - 40
    awards = {award_text(words, game, award) for game, award in every_award()}
    assert {text for text in awards if fit_size(text, SUB, room) < LABEL} == set()
    said = [key for key in texts(language) if key.startswith("awards.") and key.endswith(("_praise", "praise", "led"))]
    said = [words(key) for key in said] + [
        words("awards.close", count=3),
        words("awards.driven", meters=99),
        words("awards.close_time", seconds="4.9"),
    ]
    assert {text for text in said if fit_size(text, BODY, room, "body") < BODY} == set()


@pytest.mark.parametrize("language", LANGUAGES)
def test_prompts_of_both_views_are_of_full_size(arcade: Arcade) -> None:
    results = opened(arcade, ENDINGS["alone"])
    for page in (results.ceremony, results.numbers):
        results.page = page
        assert type_size(results.prompts.labels, results.prompts.room) >= 36


def test_a_plug_in_may_name_an_icon_that_is_none(monkeypatch: pytest.MonkeyPatch, arcade: Arcade) -> None:
    named = replace(SCREENS["pitanks"], awards={"hits": "no such icon"})
    monkeypatch.setitem(SCREENS, "pitanks", named)
    results = opened(arcade, ENDINGS["alone"])
    assert "no such icon" in {award.icon for award in results.ceremony.awards.values()}
    results.ceremony.draw(arcade.screen, 9.0)


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
        prompts = results.prompts
        assert (Button.RIGHT, key) in prompts.items
        left, right = places(prompts.labels, prompts.room)[prompts.buttons.index(Button.RIGHT)]
        arcade.click((left + right) / 2, prompts.y)
    assert results.page is results.ceremony


@pytest.mark.parametrize("language", LANGUAGES)
def test_in_party_a_score_below_zero_is_shown_as_hits_taken(language: str) -> None:
    words, row = Words(language), Row(0, 0, 1, -3, {"taken": 7, "hits": 4}, {}, ())
    party, pickups = (setup_of("pitanks", "human human", variant=variant) for variant in ("party", "pickups"))
    assert score_cell(words, party, row)[0] == words("results.hits_taken", count=7)
    assert score_cell(words, pickups, row)[0] == "−3"
    assert score_cell(words, party, replace(row, score=0))[0] == "0"
