"""The QR code of an address as a picture."""

from functools import lru_cache

import pygame

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
