"""Sheets of paper, A4 at 300 dpi: drawn part by part, then saved as pictures or as one PDF.

A sheet is a picture, and the text on it, which a PDF has once more, invisible: it can be searched and read aloud. PNG
needs nothing else, PDF needs Pillow (the extra `events`).
"""

import logging
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from time import perf_counter

import pygame

from pigaming_app.storage.safe_files import NotSaved, write_all_atomic
from pigaming_app.ui.draw import Color, font
from pigaming_app.ui.draw.layers import fit_text
from pigaming_app.ui.draw.theme import baseline, line_image
from pigaming_app.ui.pdf import PdfFile, WrittenLine
from pigaming_app.ui.png import png_of

PDF = ".pdf"
SIZE = W, H = 2480, 3508  # px
DPI = 300
MARGIN = 160  # px
INK, SOFT, RULE, PAPER = (16, 22, 36), (96, 108, 130), (196, 204, 218), (255, 255, 255)
MEDALS: tuple[Color, ...] = ((214, 158, 0), (128, 140, 158), (176, 104, 48))
SMALLEST = 26  # px, of type: 6 pt
STEP = 0.006  # s of drawing in a frame
AHEAD = 2  # sheets that may wait to be encoded: each takes 26 MB
PATIENCE = 30.0  # s after which a job that nobody works on ends

log = logging.getLogger("pigaming")
FACES = (
    "dejavusans", "notosans", "segoeui", "arial", "helveticaneue", "arialunicodems", "notosanscjkjp", "notosanscjksc",
    "droidsansfallback", "wenquanyizenhei", "microsoftyahei", "hiraginosansgb", "symbola", "freesansbold",
)  # fmt: skip
PROBE = 24  # px, at which letters are compared
NO_LETTER = "\U0010ffff"  # is drawn as a box
RIGHT_TO_LEFT = {"R": "Hebr", "AL": "Arab"}  # script by the class of a letter


class PaperSheet:
    """A white sheet. `lines`: what is written on it."""

    def __init__(self, picture: pygame.Surface | None = None) -> None:
        self.picture = picture.copy() if picture else pygame.Surface(SIZE, depth=24)
        if not picture:
            self.picture.fill(PAPER)
        self.lines: list[WrittenLine] = []

    def write(
        self, line: str, size: int, at: tuple[float, float], color: Color, align: str = "l", room: float = W
    ) -> None:
        """A line with its middle at y, in smaller type or shortened if it needs more than `room` px; see `text`."""
        if letters := system_font(line, size, room):
            image, base = letters.render(line, True, color), letters.get_ascent()
        else:
            line, size = fit_text(line, size, room, "head", min(size, SMALLEST))
            image, base = line_image(line, "head", size, color), baseline(line, "head", size)
        x = at[0] - image.get_width() * {"l": 0.0, "c": 0.5, "r": 1.0}[align]
        self.picture.blit(image, (round(x), round(at[1] + 0.35 * size - base)))
        self.lines.append((line, x, at[1] + 0.35 * size, size))


class PrintJob:
    """Draws sheets in the frame thread, part by part; another one encodes each of them, and saves all. `drawing`: a
    sheet at a step that completes one, else None; `targets`: files, see `encoded`.
    """

    def __init__(self, drawing: Iterator[PaperSheet | None], targets: Sequence[Path]) -> None:
        self.targets = targets
        self.saved = False
        self._drawing, self._drawn = drawing, False
        self._sheets: Queue[PaperSheet | None] = Queue()
        self._thread = Thread(target=self._save, daemon=True)
        self._thread.start()

    @property
    def name(self) -> str:
        """The names of the files."""
        return ", ".join(target.name for target in self.targets)

    def work(self) -> bool:
        """Work for some milliseconds; true when the files are saved, or could not be."""
        if self._drawn:
            return not self._thread.is_alive()
        end = perf_counter() + STEP
        while perf_counter() < end and self._sheets.qsize() < AHEAD:
            try:
                sheet = next(self._drawing)
            except StopIteration:
                self._drawn = True
                self._sheets.put(None)
                break
            if sheet:
                self._sheets.put(sheet)
        return False

    def _save(self) -> None:
        try:
            write_all_atomic(encoded(iter(self._next, None), self.targets))
            self.saved = True
        except Empty:
            log.warning("%s was not finished", self.name)
        except NotSaved as reason:
            log.warning("%s", reason)

    def _next(self) -> PaperSheet | None:
        return self._sheets.get(timeout=PATIENCE)


def can_pdf() -> bool:
    """True if Pillow is installed."""
    return find_spec("PIL") is not None


def encoded(drawing: Iterable[PaperSheet | None], targets: Sequence[Path]) -> dict[Path, bytes]:
    """The files: of a target that ends with .pdf one PDF, of another a picture a sheet: NAME.png, NAME-2.png …"""
    pdf, pictures = PdfFile(DPI), [target for target in targets if target.suffix.lower() != PDF]
    files: dict[Path, bytes] = {}
    for number, sheet in enumerate((sheet for sheet in drawing if sheet), 1):
        if len(pictures) < len(targets):
            pdf.add(_packed(sheet, "JPEG", quality=92), SIZE, sheet.lines)
        for target in pictures:
            files[target if number == 1 else target.with_stem(f"{target.stem}-{number}")] = _png(sheet)
    return files | {target: pdf.packed() for target in targets if target not in pictures}


def _png(sheet: PaperSheet) -> bytes:
    return _packed(sheet, "PNG") if can_pdf() else png_of(sheet.picture)


def _packed(sheet: PaperSheet, form: str, **more: int) -> bytes:
    from PIL import Image

    packed = BytesIO()
    image = Image.frombytes("RGB", SIZE, pygame.image.tobytes(sheet.picture, "RGB"))
    image.save(packed, form, **more)  # Pillow, unlike pygame, lets other threads run meanwhile
    return packed.getvalue()


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
