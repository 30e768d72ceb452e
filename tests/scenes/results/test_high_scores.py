"""The high-score page: initial table and navigation."""

from dataclasses import replace

import pygame
import pytest

from pigaming_app.scenes.results.high_scores import HighScores, conditions, contests
from pigaming_app.storage.scores import ScoreTable
from pigaming_app.ui.draw import text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade

ALONE = ScoreTable("pitanks", "classic", "points", rules="pickups", length=2, people=1)
PAIR = replace(ALONE, people=2)
ISLANDS = replace(ALONE, arena="islands")
LAP = ScoreTable("race", "classic", "lap", True, "standard", 3, 1)
THREE = replace(PAIR, people=3)


def opened(arcade: Arcade, at: ScoreTable, *filled: ScoreTable) -> HighScores:
    for table in filled:
        arcade.context.scores.add(table, "ABC", 9_000)
    best = HighScores(arcade.context, replace(at, achievement="", timed=False))
    arcade.open(best)
    arcade.wait(HighScores.lockout + 0.1, draw=True)
    return best


def shown(best: HighScores, *tables: ScoreTable) -> bool:
    return best.contest in {replace(table, achievement="", timed=False) for table in tables}


def test_it_opens_at_the_table_of_the_match_that_was_played(arcade: Arcade) -> None:
    assert shown(opened(arcade, PAIR, ALONE, PAIR), PAIR)


@pytest.mark.parametrize(
    ("filled", "found"),
    [((), PAIR), ((LAP,), LAP), ((LAP, ISLANDS), ISLANDS), ((LAP, ISLANDS, ALONE), ALONE), ((LAP, THREE), THREE)],
)
def test_an_empty_table_gives_way_to_the_nearest_one_with_rows(
    arcade: Arcade, filled: tuple[ScoreTable], found: ScoreTable
) -> None:
    assert shown(opened(arcade, PAIR, *filled), found)


def test_left_and_right_lead_round_the_tables_of_an_arena_and_up_and_down_round_the_arenas(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR, THREE, ISLANDS, LAP)
    for button, table in (
        (Button.RIGHT, PAIR),
        (Button.RIGHT, THREE),
        (Button.RIGHT, ALONE),
        (Button.LEFT, THREE),
        (Button.DOWN, ISLANDS),
        (Button.DOWN, LAP),
        (Button.LEFT, LAP),
        (Button.DOWN, ALONE),
        (Button.UP, LAP),
    ):
        arcade.press(button)
        arcade.frame(draw=True)
        assert shown(best, table), button
    assert arcade.stack.top is best


def test_every_table_with_rows_can_be_reached(arcade: Arcade) -> None:
    tables = [replace(ALONE, length=minutes, people=people) for minutes in (1, 2, 5) for people in (1, 2, 3, 4)]
    best = opened(arcade, ALONE, *tables, ISLANDS, LAP)
    seen = set()
    for _ in range(3):
        for _ in tables:
            seen.add(best.contest)
            arcade.press(Button.RIGHT)
        arcade.press(Button.DOWN)
    assert seen == set(contests(arcade.context.scores))


def test_a_click_on_an_arrow_goes_its_way_and_a_click_elsewhere_leads_on(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR, ISLANDS)
    assert set(best.arrows) == {Button.LEFT, Button.RIGHT, Button.UP, Button.DOWN}
    arcade.click(*best.arrows[Button.RIGHT])
    assert shown(best, PAIR)
    arcade.click(*best.arrows[Button.DOWN])
    assert shown(best, ISLANDS)
    arcade.click(960, 600)
    assert arcade.stack.top is not best


def test_it_leaves_when_nobody_presses_any_more(arcade: Arcade) -> None:
    best = opened(arcade, ALONE, ALONE, PAIR)
    arcade.wait(HighScores.idle - 2.0)
    arcade.press(Button.RIGHT)
    arcade.wait(HighScores.idle - 1.0)
    assert arcade.stack.top is best
    arcade.wait(2.0)
    assert arcade.stack.top is not best


def test_an_arena_that_has_gone_is_not_shown(arcade: Arcade) -> None:
    gone = replace(ALONE, arena="../../etc\n")
    assert shown(opened(arcade, ALONE, gone, PAIR), PAIR)
    assert shown(opened(arcade, gone), PAIR)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_heading_fits_and_nothing_runs_over_the_edge(controls: Controls, language: str) -> None:
    words = Words(language)
    tables = [
        replace(table, rules=rules, length=length, people=people, side=side)
        for table, length, variants in ((ALONE, 5, ("pickups", "plain", "classic")), (LAP, 9, ("standard",)))
        for rules in variants
        for people in range(1, 5)
        for side in range(people + 1)
    ]
    for table in [*tables, THREE, ScoreTable("race", "classic", "race", True, "standard", 9)]:
        assert text_width(conditions(words, table), 52, "head") < 1500, "between the arrows"
    arcade = Arcade(controls, language)
    best = opened(arcade, tables[0], *tables)
    for _ in tables[:8]:
        arcade.press(Button.RIGHT)
        arcade.wait(1.0, fps=10, draw=True)
        lit = pygame.mask.from_threshold(arcade.screen, (0, 0, 0), (40, 40, 40, 255))
        lit.invert()
        assert not [box for box in lit.get_bounding_rects() if box.left < 20 or box.right > 1900]
    assert arcade.stack.top is best
