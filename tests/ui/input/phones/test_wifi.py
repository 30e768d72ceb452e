"""The code of the Wi-Fi, read by OpenCV from its picture, and taken apart by a second implementation of the format."""

import random
import re

import pytest

from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.web.code import qr_code, wifi_text

cv2 = pytest.importorskip("cv2", reason="the extra `hardware` is not installed")
NETWORKS = [
    ("School", "secret123"),
    ("guests", ""),
    (r'a\b;c,d:e"f', r'\\;;,,::""'),
    ("  two  spaces ", " in front"),
    ("Café für Ängste", "pässwörter ñ"),
    (";", ":"),
    ("P:x;;WIFI:", "S:y;T:nopass;"),
    ("W" * 32, "m" * 63),
]


def read(text: str) -> dict[str, str]:
    """The fields of a code, by the grammar: a field ends at the first semicolon without a backslash before it."""
    found = re.fullmatch(r"WIFI:((?:[A-Z]:(?:[^\\;]|\\.)*;)+);", text)
    assert found, text
    fields = re.findall(r"([A-Z]):((?:[^\\;]|\\.)*);", found[1])
    assert len(dict(fields)) == len(fields)
    return {key: re.sub(r"\\(.)", r"\1", value) for key, value in fields}


@pytest.mark.parametrize(("name", "password"), NETWORKS)
def test_another_reader_finds_name_and_password_in_the_picture(name: str, password: str) -> None:
    code = qr_code(wifi_text(name, password), 600, (0, 0, 0), (226, 238, 255))
    decoded, _, _ = cv2.QRCodeDetectorAruco().detectAndDecode(pixels_of(code))
    fields = read(decoded)
    assert fields.pop("S") == name
    assert fields.pop("T") == ("WPA" if password else "nopass")
    assert fields.pop("P", "") == password
    assert fields == {}


def test_no_name_and_no_password_break_the_format() -> None:
    rng = random.Random(random.random())
    signs = '\\;,:"aZ9 ä'
    for _ in range(3000):
        name, password = ("".join(rng.choices(signs, k=rng.randint(1, 12))) for _ in range(2))
        assert read(wifi_text(name, password)) == {"T": "WPA", "S": name, "P": password}
