"""The results of Robot Factory: one to three stars for allies, without opponents; points and thefts in party."""

import itertools

import pygame
import pytest

from pigaming_app.scenes.results.awards.ceremony import BADGE_X, HEIGHT, STAR_PITCH, TOP
from pigaming_app.scenes.results.headline import headline, is_allied, stars
from pigaming_app.scenes.results.high_scores import conditions, contest, counts
from pigaming_app.scenes.results.scene import Results
from pigaming_app.ui.draw.layers import LEFT
from pigaming_app.ui.i18n import LANGUAGES, Words
from tests.scenes.screens import FACTS, Ending

ALLIES = (0, 0, 0, 0)
BRAINS = "human human level5 level3"


def ended(monkeypatch, number, variant="together", teams=ALLIES, winners=(0, 1, 2, 3)):
    monkeypatch.setitem(FACTS, "factory", {**FACTS["factory"], "stars": number})
    return Ending("factory", BRAINS, teams, (2, 3, 2, 1), winners if number or teams != ALLIES else (), variant)


def opened(arcade, ending: Ending, finished=True) -> Results:
    results = ending.results(arcade, finished)
    results.age = 0.0
    arcade.open(results)
    return results


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_headline_of_allies_names_their_stars_and_no_team(monkeypatch, arcade, language):
    titles = []
    for number in range(4):
        ending = ended(monkeypatch, number)
        match = opened(arcade, ending).ended
        assert is_allied(match.setup)
        assert stars(ending.outcome()) == number
        titles.append(headline(Words(language), match))
    assert len(set(titles)) == 4
    words = Words(language)
    assert not any(words(f"lobby.side_{side}") in title for side in (1, 2) for title in titles)


def starlight(screen: pygame.Surface) -> int:
    """Pixels of lit stars."""
    box = pygame.Rect(LEFT, TOP, BADGE_X - STAR_PITCH // 2, HEIGHT)
    return pygame.mask.from_threshold(screen.subsurface(box), (255, 236, 64), (40, 40, 60)).count()


def test_more_stars_are_more_light(monkeypatch, arcade):
    shining = []
    for number in (0, 1, 2, 3):
        opened(arcade, ended(monkeypatch, number))
        arcade.wait(3.0, fps=5, draw=True)
        shining.append(starlight(arcade.screen))
    assert shining == sorted(shining)
    assert shining[0] < 100
    assert min(after - before for before, after in itertools.pairwise(shining)) > 1000


def test_a_match_of_allies_that_was_left_shows_no_stars(monkeypatch, arcade):
    results = opened(arcade, ended(monkeypatch, 3), finished=False)
    arcade.wait(3.0, fps=20, draw=True)
    assert results.ceremony.head.stars == 0
    assert starlight(arcade.screen) < 100


def test_times_of_allies_count_without_opponents(monkeypatch, arcade):
    setup = opened(arcade, ended(monkeypatch, 3)).setup
    assert counts(setup, 0)
    table = contest(setup, 0)
    assert (table.people, table.side) == (2, 2)


def test_party_shows_points_deliveries_and_thefts(monkeypatch, arcade):
    ending = Ending("factory", BRAINS, (0, 1, 0, 1), (2, 3, 2, 1), (), "party")
    results = opened(arcade, ending)
    assert results.numbers.columns == ("score", "delivered", "stolen")  # type: ignore[attr-defined]


@pytest.mark.parametrize(("variant", "length"), [("party", "5 min"), ("standard", "Pallets: 8"), ("together", "12")])
def test_a_table_names_the_length_of_its_matches(monkeypatch, arcade, variant, length):
    teams = ALLIES if variant == "together" else (0, 1, 0, 1)
    setup = opened(arcade, Ending("factory", BRAINS, teams, (2, 3, 2, 1), (0, 1, 2, 3), variant)).setup
    words = {"setup.count_pallets": "Pallets: {count}", "setup.min": "{minutes} min"}
    monkeypatch.setattr(Words, "__call__", lambda self, key, **values: words.get(key, "").format(**values))
    assert length in conditions(Words("en"), contest(setup, 0))
