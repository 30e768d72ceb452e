"""Letters that the arcade's own fonts lack, which have those of its five languages: Ž, ş, Ł, Greek, Arabic and so on.

A name with one of them is drawn in a font of the system that has all of it, if there is one; the last is pygame's own.
"""

import unicodedata
from functools import cache

import pygame

from pigaming_app.ui.draw import font

FACES = (
    "dejavusans", "notosans", "segoeui", "arial", "helveticaneue", "arialunicodems", "notosanscjkjp", "notosanscjksc",
    "droidsansfallback", "wenquanyizenhei", "microsoftyahei", "hiraginosansgb", "symbola", "freesansbold",
)  # fmt: skip
PROBE = 24  # px, at which letters are compared
NO_LETTER = "\U0010ffff"  # is drawn as a box
RIGHT_TO_LEFT = {"R": "Hebr", "AL": "Arab"}  # script by the class of a letter


def system_font(line: str, size: int, room: float) -> pygame.font.Font | None:
    """The font in which a line is at most `room` px wide; None if the arcade's own has its letters, or none has."""
    if line.isascii() or _has(font("head", PROBE), line):
        return None
    for face in FACES:
        path = _path(face)
        if path and _has(pygame.font.Font(path, PROBE), line):
            width = pygame.font.Font(path, size).size(line)[0]
            found = pygame.font.Font(path, size if width <= room else int(size * room / width))
            script = next(filter(None, (RIGHT_TO_LEFT.get(unicodedata.bidirectional(letter)) for letter in line)), "")
            if script:
                found.set_direction(pygame.DIRECTION_RTL)
                found.set_script(script)
            return found
    return None


@cache
def _path(face: str) -> str | None:
    return pygame.font.match_font(face, bold=True) or pygame.font.match_font(face)


def _has(letters: pygame.font.Font, line: str) -> bool:
    """True if a font draws none of these letters as a box. Marks that join a letter are left out."""
    box = _drawn(letters, NO_LETTER)
    return all(_drawn(letters, one) != box for one in {*line} if one not in " ★☆" and not unicodedata.combining(one))


def _drawn(letters: pygame.font.Font, letter: str) -> bytes:
    return pygame.image.tobytes(letters.render(letter, True, (0, 0, 0)), "RGBA")
