"""The pictures of README and docs/ show the present screens, and the files are those that were written."""

import re
from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest

from tests.pages import pictures
from tests.pages.commands import PAGES
from tests.pages.pictures import FOLDER, GRID, SCENES, manifest, saved, signature

MOST = 6  # levels of a cell's mean: fonts and lines differ a little between systems, a changed screen by more
ENCODED = 12  # levels for an animation, whose encoding loses something
pytestmark = pytest.mark.usefixtures("_glow")
RENEW = "the picture is out of date: .venv/bin/python -m tests.pages.pictures"


@pytest.fixture(autouse=True, scope="module")
def _clips() -> Iterator[None]:
    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    yield
    pictures.clip.cache_clear()


def difference(one: bytes, other: bytes) -> int:
    """The largest difference of two signatures."""
    assert len(one) == len(other) == 3 * GRID[0] * GRID[1]
    return max(abs(a - b) for a, b in zip(one, other, strict=True))


LABORIOUS = pytest.param("lab.png", marks=pytest.mark.long)  # a robot learns for it


@pytest.mark.parametrize("name", [LABORIOUS, *(name for name in SCENES if name != "lab.png")])
def test_a_picture_shows_the_present_screen(name: str, home: Path) -> None:
    noted = manifest()[name]
    assert difference(signature(SCENES[name]()), noted) <= MOST, RENEW
    assert difference(signature(saved(name)), noted) <= (ENCODED if name.endswith(".webp") else MOST), RENEW


def test_a_changed_screen_is_noticed() -> None:
    picture = saved("lab.png")
    before = signature(picture)
    pygame.draw.rect(picture, (0, 0, 0), (640, 640, 70, 40))  # one prompt of five
    assert difference(signature(picture), before) > MOST


def test_every_picture_of_a_page_comes_from_the_program() -> None:
    shown = {
        name
        for page in PAGES
        for name in re.findall(r"\]\([^)]*assets/pictures/(.*?)\)", page.read_text(encoding="utf-8"))
    }
    assert shown == {*SCENES} == {*manifest()}
    assert {file.name for file in FOLDER.iterdir()} == {*SCENES, "manifest.json"}
