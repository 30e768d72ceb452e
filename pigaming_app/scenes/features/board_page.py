"""The contract of a page on the second screen: parts with plain contents, of which only changed ones are painted."""

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Protocol

import pygame

from pigaming_app.scenes.flow.scene import Scene

Box = tuple[int, int, int, int]  # x, y, width, height, px on a canvas of 1920 x 1080


@dataclass(frozen=True)
class BoardPart:
    """A part of a page. It is painted again when its content differs from that shown in the same box.

    `paint` draws on a black surface of the box's size. It may raise `Unfinished` and is then called again later.
    """

    box: Box
    content: Hashable
    paint: Callable[[pygame.Surface], None]


class BoardPage(Protocol):
    """A page of the second screen. Its name is a text: `scoreboard.NAME`."""

    name: str

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart] | None:
        """Its parts now, with these scenes on the stack; boxes must not overlap. None: it has nothing to show.

        Called a few times a second: it must take less than a millisecond.
        """
