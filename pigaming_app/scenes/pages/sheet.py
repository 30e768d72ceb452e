"""A page that is a sheet over a darkened picture: a question, a message, a small menu."""

from collections.abc import Hashable

import pygame

from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui.draw import ICE, Color
from pigaming_app.ui.draw.layers import Layer, backdrop
from pigaming_app.ui.widgets.dialog import PROMPTS, W, overlay


class Sheet(Page):
    """Its still part is drawn once for each `look`."""

    prompts_y, prompts_room = PROMPTS, W - 80
    _shown: tuple[Hashable, pygame.Surface] | None = None

    @property
    def color(self) -> Color:
        """The colour of the outline."""
        return ICE

    @property
    def look(self) -> Hashable:
        """What the still part depends on, besides the page itself."""
        return None

    @property
    def behind(self) -> pygame.Surface:
        """The picture under the sheet."""
        return backdrop()

    def paint_sheet(self, layer: Layer) -> None:
        """Draw the still part."""
        raise NotImplementedError

    def draw(self, screen: pygame.Surface) -> None:
        look = self.look
        if self._shown is None or self._shown[0] != look:
            self._shown = look, overlay(self.behind, self.color, self.paint_sheet, (id(self), look))
        screen.blit(self._shown[1], (0, 0))
        self.paint(screen)
        self.draw_foot(screen)
