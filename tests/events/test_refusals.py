"""Refusals: each has its sentence, with the values that it needs, and each sentence its refusal."""

import ast
import re
from collections.abc import Iterator

import pytest

from pigaming_app import ASSETS
from pigaming_app.events.refusals import Refused
from pigaming_app.ui.i18n import fields, texts

PACKAGE = ASSETS.parent / "pigaming_app"
SENTENCES = {key.removeprefix("refused."): text for key, text in texts("en").items() if key.startswith("refused.")}
SOURCES = [*(PACKAGE / "events").rglob("*.py"), *(PACKAGE / "scenes/events/desk").rglob("*.py")]


def refusals() -> Iterator[tuple[str, set[str | None]]]:
    """Key and names of the values of each refusal in the code."""
    for file in SOURCES:
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "Refused":
                key = node.args[0]
                if isinstance(key, ast.Constant):
                    yield str(key.value), {one.arg for one in node.keywords}


def test_every_refusal_has_a_sentence_with_its_values_and_no_sentence_is_left_over() -> None:
    found = dict(refusals())
    for key, names in refusals():
        assert fields(SENTENCES[key]) == names, key
    others = {*SENTENCES} - {*found}
    source = "".join(file.read_text(encoding="utf-8") for file in SOURCES)
    assert others == {"bad_name", "bad_team", "bad_arcade", "bad_score", "bad_seat"}, "their keys are arguments"
    assert all(f'"{key}"' in source for key in others)


def test_as_a_text_it_is_the_english_sentence() -> None:
    reason = Refused("called", name="Ana", match=3)
    assert str(reason) == "Ana is called to match 3"
    with pytest.raises(ValueError, match=re.escape("Ana {match} is entered already")):
        raise Refused("entered", name="Ana {match}")
