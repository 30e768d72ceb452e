"""Text layout: what does not fit is set smaller, then cut off or broken, but never too small to read."""

import os
import sys
import weakref

import pytest

from pigaming_app.ui.draw import BODY, LABEL, font, text_width
from pigaming_app.ui.draw.layers import LINE_PITCH, SMALLEST, fit_lines, fit_paragraphs, fit_text

NAME = "WWWWWWWWWWWW"
PATH = "/dev/serial/by-id/usb-FTDI_FT231X_USB_UART_DN02MQBC-if00-port0"


@pytest.mark.parametrize("width", [60, 120, 240, 480, 960])
def test_a_name_gets_smaller_then_loses_its_end(width: int) -> None:
    shown, size = fit_text(NAME, LABEL, width, "hero")
    assert SMALLEST <= size <= LABEL
    assert text_width(shown, size, "hero") <= width
    assert shown == NAME or (shown.endswith("…") and size == SMALLEST and NAME.startswith(shown[:-1]))
    longer = f"{NAME[: len(shown)]}…"
    assert shown == NAME or text_width(longer, SMALLEST, "hero") > width, "as much as possible is kept"


def test_a_name_that_fits_stays() -> None:
    assert fit_text("AAA", LABEL, 400, "hero") == ("AAA", LABEL)


@pytest.mark.parametrize("room", [200, 400, 800])
def test_a_word_longer_than_the_line_is_broken(room: int) -> None:
    size, lines = fit_lines(f"No permission for {PATH}.", room, 3)
    assert max(text_width(line, size, "body") for line in lines) <= room
    assert "".join(lines).replace(" ", "") == f"Nopermissionfor{PATH}."


def test_sentences_share_one_size_that_fits_or_are_refused() -> None:
    said = [
        "One sentence about a fault of a robot.",
        "And one about the radio at the other end of the cable, which is out of sight.",
    ]
    sizes = range(BODY, SMALLEST - 1, -2)
    roomy, tight = fit_paragraphs(said, 800, 400, 8, sizes), fit_paragraphs(said, 800, 160, 8, sizes)
    assert roomy is not None
    assert tight is not None
    assert roomy[0] == BODY > tight[0] >= SMALLEST
    for (size, found), height in ((roomy, 400), (tight, 160)):
        assert len(found) == 2
        assert LINE_PITCH * size * sum(map(len, found)) + 8 <= height
    assert fit_paragraphs(said, 800, 60, 8, sizes) is None


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts the files of /proc")
def test_fonts_of_many_sizes_keep_no_file_open() -> None:
    before = len(os.listdir("/proc/self/fd"))
    fonts = [font(face, size) for face in ("head", "hero", "body") for size in range(301, 331)]
    assert len({letters.render("Ag", True, "white").get_size() for letters in fonts}) > 30
    assert len(os.listdir("/proc/self/fd")) == before


def test_not_all_fonts_are_kept() -> None:
    fonts = [weakref.ref(font("body", size)) for size in range(10, 210)]
    assert 20 < sum(letters() is not None for letters in fonts) < 60
