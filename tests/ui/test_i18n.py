"""Screen texts: all languages have the same keys and placeholders."""

import ast
import re
from collections.abc import Iterator
from datetime import datetime
from itertools import combinations
from string import Formatter

import pygame
import pytest

from pigaming_app import ASSETS
from pigaming_app.games.registry import games
from pigaming_app.ui.draw import font
from pigaming_app.ui.draw.theme import STARS
from pigaming_app.ui.i18n import LANGUAGES, Words, system_language, texts, with_english


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_languages_have_the_same_keys_in_the_same_order(language: str) -> None:
    assert list(texts(language)) == list(texts("en"))
    assert all(text.strip() for text in texts(language).values())


@pytest.mark.parametrize("language", LANGUAGES)
def test_all_languages_have_the_same_placeholders_and_line_breaks(language: str) -> None:
    english, foreign = texts("en"), texts(language)
    assert [key for key in english if _holes(english[key]) != _holes(foreign[key])] == []
    assert [key for key in english if english[key].count("|") != foreign[key].count("|")] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_fonts_have_every_letter_and_sign(language: str) -> None:
    """A missing letter is drawn as a box: as a character that no font here has."""
    letters = {letter for text in texts(language).values() for letter in text if not letter.isspace()} - set(STARS)
    for face in ("head", "hero", "body"):
        box = pygame.image.tobytes(font(face, 40).render("\u4e00", True, "white"), "RGBA")
        drawn = {letter: font(face, 40).render(letter, True, "white") for letter in letters}
        assert [letter for letter, image in drawn.items() if pygame.image.tobytes(image, "RGBA") == box] == []


def test_french_signs_stay_with_their_word() -> None:
    assert [key for key, text in texts("fr").items() if re.search(" [!?:;]", text)] == []


def test_every_language_has_its_own_texts() -> None:
    """Nobody forgot to translate: few texts are the same in two languages, as names and units are."""
    for one, other in combinations(LANGUAGES, 2):
        ours = {key: text for key, text in texts(one).items() if " " in text and not key.startswith("keys.")}
        same = [key for key, text in ours.items() if text == texts(other)[key]]
        assert len(same) < 40, (one, other)


@pytest.mark.parametrize(
    ("system", "language"),
    [
        ("fr_CA.UTF-8", "fr"),
        ("de_AT.UTF-8", "de"),
        ("es_MX.UTF-8", "es"),
        ("pt_BR.UTF-8", "pt"),
        ("C", "en"),
        ("ja", "en"),
    ],
)
def test_the_first_language_is_that_of_the_system(monkeypatch: pytest.MonkeyPatch, system: str, language: str) -> None:
    monkeypatch.setenv("LANG", system)
    monkeypatch.delenv("LANGUAGE", raising=False)
    assert system_language() == language


def test_what_is_printed_is_in_english_too() -> None:
    assert with_english("de", "keys.SPACE", "options.off") == ["LEERTASTE", "Aus", "SPACE", "Off"]
    assert with_english("en", "keys.SPACE") == ["SPACE"]


def test_values_are_put_in_and_the_language_can_change() -> None:
    words = Words("en")
    assert words("lobby.seat", player=2) == "Player 2"
    words.switch("pt")
    assert words("lobby.seat", player=2) == "Jogador 2"
    assert (words.language, words.following) == ("pt", "es")
    words.switch("de")
    assert words.following == "en"


@pytest.mark.parametrize("language", LANGUAGES)
def test_one_is_singular(language: str) -> None:
    """Each text for the number 1 differs from the one for several, whose only value is that number."""
    words = Words(language)
    ones = [key.removesuffix("_one") for key in texts(language) if key.endswith("_one")]
    several = [key for key in ones if key in words and _holes(texts(language)[key])]
    assert {"games.race_line", "results.best_race", "brain.because_tried"} <= set(several)
    for key in several:
        (name,) = _holes(texts(language)[key])
        assert words.counted(key, 2, **{str(name): 2}) == words(key, **{str(name): 2})
        assert words.counted(key, 1, **{str(name): 1}) == words(f"{key}_one") != words(key, **{str(name): 1})


def test_numbers_have_the_decimal_sign_of_the_language() -> None:
    english, portuguese = Words("en"), Words("pt")
    assert english.decimal("1:02.34") == "1:02.34"
    assert portuguese.decimal("1:02.34") == "1:02,34"
    assert portuguese("fleet.volts", volts="4.4") == "4,4 V"
    assert portuguese("calibrate.mm", mm=2.5) == "2,5 mm"
    assert portuguese("setup.min", minutes="0.5") == "0,5 min"
    assert portuguese("robots.written", path="1.5/2.pdf") == "Criada: 1.5/2.pdf", "only numbers"


FORMATTERS = {
    "format_score": "high_score_tables",
    "clock": "high_score_tables",
    "figure": "race.gaps",
    "signed": "race.hud",
    "cell": "results.view",
    "rule_numbers": "flow.match_words",
}


def test_every_decimal_number_on_a_screen_is_written_in_its_language() -> None:
    """Decimals are formatted in a call of the words or of `decimal`, or in a formatter whose calls are."""
    scenes, found = ASSETS.parent / "pigaming_app" / "scenes", []
    for file in scenes.rglob("*.py"):
        source = file.read_text(encoding="utf-8")
        if not re.search(rf"\.[1-9]f|g['\"}}]|{'|'.join(FORMATTERS)}", source):
            continue  # to parse it takes longer
        module = ast.parse(source)
        found += [f"{file.name}:{line}" for line in bare_decimals(module, known(module))]
    assert found == []


def known(module: ast.AST) -> set[str]:
    """The formatters imported by a module."""
    imports = [node for node in ast.walk(module) if isinstance(node, ast.ImportFrom) and node.module]
    names = [(alias.name, node.module) for node in imports for alias in node.names]
    return {name for name, source in names if name in FORMATTERS and str(source).endswith(FORMATTERS[name])}


def bare_decimals(module: ast.AST, formatters: set[str], localised: bool = False) -> Iterator[int]:
    """Lines on which decimals are formatted without localisation."""
    for node in ast.iter_child_nodes(module):
        name = getattr(node, "name", "")
        if name in ("FrameMeter", "projection") or isinstance(node, ast.Raise):
            continue  # F3, calibration projections and log reasons: not shown to players
        if isinstance(node, ast.FormattedValue) and not localised and decimals(node):
            yield node.lineno
        if isinstance(node, ast.Call) and called(node) in formatters and not localised:
            yield node.lineno
        inside = called(node) in ("counted", "decimal", "words") or name in FORMATTERS
        yield from bare_decimals(node, formatters, localised or inside)


def called(node: ast.AST) -> str:
    """The name of the called function."""
    if not isinstance(node, ast.Call):
        return ""
    return node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")


def decimals(node: ast.FormattedValue) -> bool:
    """True if a format may produce decimals."""
    text = ast.unparse(node.format_spec) if node.format_spec else ""
    return bool(re.search(r"\.[1-9]f|g['\"]$", text))


def test_a_space_bar_has_a_name_and_a_button_is_called_what_is_printed_on_it() -> None:
    assert Words("pt").key_name("SPACE") == "ESPAÇO"
    assert Words("pt").key_name("START") == "START"


def test_an_unknown_key_is_an_error() -> None:
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
    for game in games().values():
        assert words(f"games.{game.name}")
        assert words(f"highlights.last_{game.name}")
        for variant in game.variants:
            assert words(f"setup.{game.name}_{variant}")
            assert words(f"rules.{game.name}_{variant}")


def _holes(text: str) -> set[str | None]:
    return {name for _, name, _, _ in Formatter().parse(text)} - {None}


def test_days_and_times_are_written_as_in_the_language() -> None:
    at = datetime(2026, 3, 1, 9, 5)
    days = {language: Words(language).day(at.date()) for language in LANGUAGES}
    assert days == dict.fromkeys(("en", "pt", "es", "fr"), "01/03/2026") | {"de": "01.03.2026"}
    assert Words("de").moment(at) == "01.03. 09:05"
    assert Words("pt").moment(at) == "01/03 09:05"
