"""Names: what is shown of them, and what is refused however it is spelled."""

import re

import pygame
import pytest

from pigaming_app import ASSETS
from pigaming_app.ui.input.phones.names import MAX_NAME, kind_name

GOOD = """Ana, Zoë, José, Björn, François, Max-Uwe, O'Neil, Dr. No, Player 1, Dickens, Hancock, Cassandra, Constance,
Connor, Essex, Sussex, Titus, Assunta, Analia, Cummings, Shitara, Peniston, Scunthorpe, Saul, Bernazi, Rapella, Sextus,
Pedro, Consuelo, Marica, Isis, Preto, Culver, Concha, Ficus, Nigel, Puteri, Arsène, Émilie, Ñusta, Luís, Øystein"""
UNKIND = """fuck, FUCK, fück, f.u.c.k, F u c k, fuuuck, f-u-c-k, 5h1t, sh1t, $hit, a$$, @ss, b1tch, bitchy, xXfuckXx,
Arschloch, ARSCHL0CH, Hurensohn, Fotze, scheiße, Schlampe1, merde, connard, s4lope, puta, hijo de puta, gilipollas,
c4brón, caralho, filhodaputa, f0der, merda, 88, n1gg3r, Hitler, p3n1s"""


@pytest.mark.parametrize("name", re.split(r",\s+", GOOD))
def test_a_name_that_people_have_is_shown(name: str) -> None:
    assert kind_name(name) == name


@pytest.mark.parametrize("name", re.split(r",\s+", UNKIND))
def test_an_unkind_name_is_refused_however_it_is_spelled(name: str) -> None:
    assert kind_name(name) == ""


@pytest.mark.parametrize(
    ("raw", "shown"),
    [
        ("  Ana   Maria ", "Ana Maria"),
        ("A" * 5000, "A" * MAX_NAME),
        ("\u202eanA", "anA"),  # right to left
        ("A\u200bna\u2066\u2069\ufeff", "Ana"),
        ("A\x00n\x1ba\n\t", "Ana"),
        ("Z\u0336o\u0336e\u0336", "Zoe"),
        ("Ze\u0301", "Zé"),  # composed
        ("\uff21\uff4e\uff41", "Ana"),  # wide letters
        ("<b>Ana</b>", "bAnab"),
        ("Max 🎮", "Max"),
        ("アナ", ""),
        ("...", ""),
        ("'--'", ""),
        ("", ""),
    ],
)
def test_only_letters_that_the_screen_has_are_left(raw: str, shown: str) -> None:
    assert kind_name(raw) == shown


@pytest.mark.parametrize("file", ["lexend-latin-500-normal.woff2", "oxanium-latin-700-normal.woff2"])
def test_every_letter_that_may_be_shown_is_in_the_fonts(file: str) -> None:
    pygame.font.init()
    font = pygame.font.Font(ASSETS / "fonts" / file, 40)
    letters = {letter for code in range(0x20, 0x2200) for letter in kind_name(f"o{chr(code)}")}
    assert {"z", "é", "ã", "ç", "Ñ", "ß", "œ"} <= letters
    box, *drawn = (font.render(letter, True, "white") for letter in ("\u4e00", *sorted(letters - {" "})))
    boxes = [pygame.image.tobytes(image, "RGBA") == pygame.image.tobytes(box, "RGBA") for image in drawn]
    assert len(boxes) > 100
    assert not any(boxes), "a missing letter is drawn as a box"
