"""The lessons: their notebooks are those of their pages, run, and print what the pages show, in both languages."""

import json
import re
from pathlib import Path

import pytest

from tests.pages.commands import commands
from tests.pages.lessons import PAGES, cells, notebook, printed, run_apart, without_words

PAIRS = [*zip(PAGES["en"], PAGES["pt"], strict=True)]
NUMBER = re.compile(r"\d[\d.,]*\d|\d")


def test_lessons_print_what_their_pages_show(tmp_path: Path) -> None:
    pytest.importorskip("gymnasium")
    pytest.importorskip("matplotlib")
    assert run_apart(PAGES["en"], tmp_path) == [printed(page) for page in PAGES["en"]]


@pytest.mark.parametrize("page", [*PAGES["en"], *PAGES["pt"]], ids=lambda page: page.stem)
def test_a_notebook_is_that_of_its_page(page: Path) -> None:
    text = page.with_suffix(".ipynb").read_text(encoding="utf-8")
    assert text == notebook(page), "python -m tests.pages.lessons --write"
    book = json.loads(text)
    code = ["".join(cell["source"]) + "\n" for cell in book["cells"] if cell["cell_type"] == "code"]
    assert code == cells(page)
    assert all(cell["cell_type"] == "markdown" or not cell["outputs"] for cell in book["cells"])


@pytest.mark.parametrize(("page", "other"), PAIRS, ids=lambda page: page.stem)
def test_both_languages_run_the_same_code_and_show_the_same_numbers(page: Path, other: Path) -> None:
    assert page.stem[0] == other.stem[0]
    for ours, theirs in zip(cells(page), cells(other), strict=True):
        assert without_words(ours) == without_words(theirs)
    for ours, theirs in zip(printed(page), printed(other), strict=True):
        assert NUMBER.findall(ours) == NUMBER.findall(theirs)


@pytest.mark.parametrize(("page", "other"), PAIRS, ids=lambda page: page.stem)
def test_both_languages_have_the_same_commands(page: Path, other: Path) -> None:
    assert [one.text for one in commands(page)] == [one.text for one in commands(other)]


def test_only_words_may_differ_between_languages() -> None:
    code = 'axes.plot(x, label="wins")\nprint("wins", 1)\nmake("race")  # a race\n'
    said = code.replace("wins", "ganhos").replace("# a race", "# uma corrida")
    assert without_words(said) == without_words(code)
    for other in (code.replace("1)", "2)"), code.replace('"race"', '"corrida"'), code.replace("label", "colour")):
        assert without_words(other) != without_words(code)


def test_there_are_five_lessons_in_each_language() -> None:
    assert [page.stem[0] for page, _ in PAIRS] == [*"12345"]
