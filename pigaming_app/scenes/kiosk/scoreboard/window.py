"""The window of the second screen. It is drawn a few times a second, in what is left of a frame of the arcade."""

import logging
import sys
import warnings
from collections.abc import Hashable, Sequence

import pygame

from pigaming_app.scenes.features.board_page import BoardPage, BoardPart, Box
from pigaming_app.scenes.flow.scene import Scene
from pigaming_app.ui.draw.frame_budget import Unfinished, budget, clock

PERIOD = 0.25  # s between two looks for changes
SLICE_MS = 2.0  # of painting in a frame
ROOM = 0.006  # s that a frame must have left for a slice, or for showing the picture
PATIENCE = 1.0  # s after which it no longer waits for such a frame
WINDOWED = (960, 540)

log = logging.getLogger("pigaming")
SIZE = (1920, 1080)


class ScoreboardWindow:
    """The window on display `number`, from 1; on that of the arcade or its mirror, and if it is not there, a small one.

    If the system supports only one window, this is logged and the arcade runs on. `trouble`: the reason.
    """

    def __init__(self, number: int, arena_display: int, pages: Sequence[BoardPage], headless: bool = False) -> None:
        self.board = Board(pages)
        self.fills = has_display(number, arena_display, headless)  # a display of its own
        self.window: pygame.Window | None = None
        self.trouble = ""
        self._age, self._waited = PERIOD, 0.0
        self._complete = True  # the picture in the window is that of the board
        self._size = (0, 0)
        try:
            self.window = _open(number - 1 if self.fills else None)
            if self.fills and _covers_arcade(self.window):
                self.window.destroy()
                self.fills, self.window = False, _open(None)
            self.window.get_surface()
            _focus_arcade()
        except pygame.error as reason:
            self._lose(f"There is no second screen: {reason}.")

    def update(self, seconds: float, left: float, page: str, scenes: Sequence[Scene]) -> None:
        """Paint a slice of a page, or show the finished picture. `left`: s of this frame that nobody else needs."""
        self._age += seconds
        if self.window is None or (self._complete and self._age < PERIOD):
            return
        self._waited += seconds
        if left < ROOM and self._waited < PATIENCE:
            return
        self._waited = 0.0
        try:
            self._step(self.window, page, scenes)
        except pygame.error as reason:
            self._lose(f"The second screen was lost: {reason}.")

    def _step(self, window: pygame.Window, page: str, scenes: Sequence[Scene]) -> None:
        surface = window.get_surface()
        if surface.get_size() != self._size:
            self._size = surface.get_size()
            self.board.redraw(surface)
            self._complete = False
        if self._age >= PERIOD and not self.board.waiting:
            self._age = 0.0
            if self.board.refresh(page, scenes):
                self._complete = False
                return
        if self._complete:
            return
        if self.board.waiting:
            self.board.paint(SLICE_MS, surface)
        else:
            self._complete = True
            window.flip()

    def close_if_requested(self, event: pygame.Event) -> bool:
        """Close this window if an event requests it; true if so."""
        mine = event.type == pygame.WINDOWCLOSE and self.owns(event)
        if mine:
            self.close()
        return mine

    def owns(self, event: pygame.Event) -> bool:
        """True if an event belongs to this window: its mouse positions are not those of the arcade."""
        return self.window is not None and getattr(event, "window", None) == self.window

    def close(self) -> None:
        window, self.window = self.window, None
        if window is not None:
            window.destroy()

    def _lose(self, trouble: str) -> None:
        self.trouble = trouble
        log.warning("%s", trouble)
        print(f"PiGaming: {trouble}", file=sys.stderr)
        self.close()


def has_display(number: int, arena_display: int, headless: bool) -> bool:
    """True if display `number`, from 1, is connected and free: the arena's is another one, and connected as well.

    Without its own display, the system moves the arena to one of the others.
    """
    count = len(pygame.display.get_desktop_sizes())
    return not headless and arena_display != number - 1 < count and 0 <= arena_display < count


def _open(display: int | None) -> pygame.Window:
    """A window that fills a display; None: a small one. Raises pygame.error."""
    title = "PiGaming: scores"
    if display is None:
        return pygame.Window(title, WINDOWED, position=(24, 24), resizable=True)
    middle = pygame.WINDOWPOS_CENTERED | display  # of this display, in either direction
    size = pygame.display.get_desktop_sizes()[display]
    return pygame.Window(title, size, (middle, middle), borderless=True, fullscreen_desktop=True)


def _covers_arcade(window: pygame.Window) -> bool:
    """True if a window that fills a display lies over the arcade: the two displays are mirrored."""
    arcade = pygame.Rect(pygame.display.get_window_position(), pygame.display.get_window_size())
    return arcade.collidepoint(pygame.Rect(window.position, window.size).center)


def _focus_arcade() -> None:
    """Give the keys to the arcade's window."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # there is no other way to access the first window
        pygame.Window.from_display_module().focus()


class Board:
    """A canvas of 1920 x 1080 px that follows its pages, copied to a surface of any size."""

    def __init__(self, pages: Sequence[BoardPage]) -> None:
        self.pages = pages
        self.picture = pygame.Surface(SIZE, depth=32)
        self.shown: dict[Box, Hashable] = {}  # contents by box
        self.page = ""
        self.waiting: list[BoardPart] = []  # to be painted
        self._to_clear = False  # everything, before that

    def refresh(self, name: str, scenes: Sequence[Scene]) -> bool:
        """Note what has to be painted for a page; without contents of its own, for the first one that has any.

        Returns true if there is anything to paint.
        """
        chosen = [page for page in self.pages if page.name == name]
        for page in [*chosen, *(page for page in self.pages if page.name != name)]:
            parts = page.parts(scenes)
            if parts is not None:
                self._take(page.name, parts)
                break
        return bool(self.waiting)

    def paint(self, milliseconds: float, target: pygame.Surface) -> bool:
        """Paint for up to `milliseconds`, and at least one step; true when the picture is complete."""
        end = clock() + milliseconds / 1000.0
        if self._to_clear:
            self._to_clear = False
            self.picture.fill("black")
            target.fill("black")
        with budget.until(end):
            while self.waiting:
                part = self.waiting[0]
                surface = self.picture.subsurface(part.box)
                surface.fill("black")
                try:
                    part.paint(surface)
                except Unfinished:
                    return False
                self.shown[part.box] = part.content
                self.waiting.pop(0)
                _copy(self.picture, part.box, target)
                if self.waiting and clock() >= end:
                    return False
        return True

    def redraw(self, target: pygame.Surface) -> None:
        """Draw the whole picture on a surface that is new."""
        target.fill("black")
        _copy(self.picture, (0, 0, *SIZE), target)

    def _take(self, page: str, parts: Sequence[BoardPart]) -> None:
        boxes = {part.box for part in parts}
        if page != self.page or not self.shown.keys() <= boxes:
            self.page, self.shown, self._to_clear = page, {}, True
        self.waiting = [part for part in parts if part.content != self.shown.get(part.box, _NOTHING)]


class _Nothing:
    """The content of a box that shows nothing."""


_NOTHING = _Nothing()


def _copy(picture: pygame.Surface, box: Box, target: pygame.Surface) -> None:
    """Copy a part of the picture to its place on a surface of another size."""
    area = fit(target.get_size())
    if area.size == SIZE:
        target.blit(picture, (area.x + box[0], area.y + box[1]), box)
        return
    k = area.w / SIZE[0]
    left, top = int(box[0] * k), int(box[1] * k)
    w, h = int((box[0] + box[2]) * k) - left, int((box[1] + box[3]) * k) - top
    if w > 0 and h > 0:
        target.blit(pygame.transform.smoothscale(picture.subsurface(box), (w, h)), (area.x + left, area.y + top))


def fit(size: tuple[int, int]) -> pygame.Rect:
    """The largest rectangle of the canvas's shape, centred in a window of `size`."""
    k = min(size[0] / SIZE[0], size[1] / SIZE[1])
    w, h = round(SIZE[0] * k), round(SIZE[1] * k)
    return pygame.Rect((size[0] - w) // 2, (size[1] - h) // 2, w, h)
