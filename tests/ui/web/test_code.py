"""The QR code is read by an independent decoder, also small, far away and in capitals."""

import pygame
import pytest

from pigaming_app.ui.web.code import qr_code

URL = "HTTP://192.168.100.200:8787/ABCDEFGHJK"
DARK, LIGHT = (0, 0, 0), (226, 238, 255)


@pytest.mark.parametrize("size", [330, 726])
def test_it_is_read_back(size: int) -> None:
    cv2 = pytest.importorskip("cv2", reason="the extra `hardware` is not installed")
    from pigaming_app.ui.draw.pixels import pixels_of

    code = qr_code(URL, size, DARK, LIGHT)
    assert size - 33 < code.get_width() <= size
    far = pygame.transform.smoothscale(code, (132, 132))  # four px a module
    for picture in (code, far):
        text, _, _ = cv2.QRCodeDetectorAruco().detectAndDecode(pixels_of(picture))
        assert text == URL


def test_it_has_the_margin_that_readers_need() -> None:
    code = qr_code(URL, 330, DARK, LIGHT)
    scale = code.get_width() // 33
    for i in range(4 * scale):
        assert {code.get_at((x, i))[:3] for x in range(code.get_width())} == {LIGHT}
    assert code.get_at((4 * scale, 4 * scale))[:3] == DARK
