"""What the arcade says: both languages say the same things."""

import re
from string import Formatter

import pytest

from pigaming_app import ASSETS
from pigaming_app.games import GAMES
from pigaming_app.scenes.words import LANGUAGES, Words, texts


def test_both_languages_have_the_same_keys() -> None:
    english, portuguese = texts("en"), texts("pt")
    assert sorted(english) == sorted(portuguese)
    assert all(text.strip() for text in [*english.values(), *portuguese.values()])


@pytest.mark.parametrize("key", sorted(texts("en")))
def test_both_languages_are_told_the_same_values(key: str) -> None:
    assert _holes(texts("en")[key]) == _holes(texts("pt")[key])


def test_values_are_put_in_and_the_language_can_change() -> None:
    words = Words("en")
    assert words("lobby.seat", player=2) == "Player 2"
    words.switch("pt")
    assert words("lobby.seat", player=2) == "Jogador 2"
    assert (words.language, words.other) == ("pt", "en")


def test_a_space_bar_has_a_name_and_a_button_is_called_what_is_printed_on_it() -> None:
    assert Words("pt").printed("SPACE") == "ESPAÇO"
    assert Words("pt").printed("R CTRL") == "R CTRL"


def test_a_text_that_nobody_wrote_is_an_error() -> None:
    with pytest.raises(KeyError):
        Words("en")("lobby.nonsense")


def test_every_text_that_a_scene_asks_for_by_name_is_there() -> None:
    known = set(texts("en"))
    asked = set()
    for file in (ASSETS.parent / "pigaming_app" / "scenes").rglob("*.py"):
        asked |= set(re.findall(r'words\("([a-z]+\.[a-z_]+)"[,)]', file.read_text(encoding="utf-8")))
    assert asked
    assert asked <= known


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_game_and_its_rules_have_names(language: str) -> None:
    words = Words(language)
    for game in GAMES.values():
        assert words(f"games.{game.name}")
        asked = game.variants if len(game.variants) > 1 else ()
        assert all(words(f"setup.{variant}") and words(f"setup.{variant}_line") for variant in asked)


def _holes(text: str) -> set[str | None]:
    return {name for _, name, _, _ in Formatter().parse(text)} - {None}
