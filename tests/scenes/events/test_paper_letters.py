"""Names with letters that the arcade's fonts lack are no boxes on paper."""

import pygame
import pytest

from pigaming_app.scenes.events.paper import sheet
from pigaming_app.scenes.events.paper.sheet import PaperSheet, W


@pytest.fixture(autouse=True)
def font_of_pygame(monkeypatch):
    """The one that is on every machine."""
    pygame.font.init()
    monkeypatch.setattr(sheet, "FACES", ("freesansbold",))


def written(name: str) -> bytes:
    """The name as a sheet has it."""
    sheet = PaperSheet()
    sheet.write(name, 200, (W / 2, 500), (0, 0, 0), "c", 1500)
    return pygame.image.tobytes(sheet.picture.subsurface((0, 300, W, 400)), "RGB")


def test_each_letter_is_a_letter():
    """Boxes would all look the same."""
    assert len({written(letter) for letter in "ŽĎšŁşĞΕΩЖ"}) == 9
    assert len({written(name) for name in ("Žofie", "Ďofie", "Łofie", "Ελένη", "Ελέην")}) == 5


@pytest.mark.parametrize("name", ["Ana", "José Muñoz", "Zoë Ærø ß", "Œuvre – “x”", "★☆"])
def test_letters_of_the_five_languages_keep_the_fonts_of_the_arcade(name):
    assert sheet.system_font(name, 100, 1000) is None


def test_a_long_name_fits():
    found = sheet.system_font("Ž" * 24, 200, 1500)
    assert found is not None
    assert found.size("Ž" * 24)[0] <= 1500


def test_a_name_that_no_font_has_is_written_all_the_same():
    assert sheet.system_font("\U00012000", 100, 1000) is None
    assert written("\U00012000")
