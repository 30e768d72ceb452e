"""QR codes as pictures: of an address, and of a Wi-Fi network, which phones that scan it offer to join."""

from functools import lru_cache

import pygame

SPECIAL = '\\;,:"'  # characters that a backslash precedes
QUIET = 4  # modules of light margin that readers need (ISO/IEC 18004)


@lru_cache(4)
def qr_code(text: str, size: int, dark: tuple[int, int, int], light: tuple[int, int, int]) -> pygame.Surface:
    """A QR code with its margin, at most `size` px wide, each module a whole number of px. Needs the extra `phones`."""
    import segno

    rows = [bytes(row) for row in segno.make(text, error="m", micro=False).matrix]
    count = len(rows) + 2 * QUIET
    small = pygame.Surface((count, count))
    small.fill(light)
    for y, row in enumerate(rows):
        for x, module in enumerate(row):
            if module:
                small.set_at((x + QUIET, y + QUIET), dark)
    scale = max(1, size // count)
    return pygame.transform.scale(small, (count * scale, count * scale))


def wifi_text(name: str, password: str) -> str:
    """The text of the code for a network with WPA, or without a password for an open one.

    Source: "Barcode Contents", wiki of ZXing, section "Wi-Fi Network config"; WPA3 specification, section 7.
    """
    kind = "WPA" if password else "nopass"
    key = f"P:{escaped(password)};" if password else ""
    return f"WIFI:T:{kind};S:{escaped(name)};{key};"


def escaped(text: str) -> str:
    """A text within the code."""
    return "".join(f"\\{sign}" if sign in SPECIAL else sign for sign in text)
