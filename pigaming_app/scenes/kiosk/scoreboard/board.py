"""The picture of the second screen: the page chosen by the operator, painted in slices, only where it has changed."""

from collections.abc import Hashable, Sequence

import pygame

from pigaming_app.scenes.features.board_page import BoardPage, BoardPart, Box
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.ui.draw.frame_budget import Unfinished, budget, clock

SIZE = (1920, 1080)


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
