"""Swap page: hand each robot of a running match over to a simulated one, and back."""

import math

import pygame

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import StackOperation
from pigaming_app.scenes.mat.things.moved_page import InterruptedMatch
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import menu_spots, sheet_title
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, MIST, PLAYERS, badge
from pigaming_app.ui.draw.layers import Layer, fit_size, word
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus


class SwapPage(Sheet):
    """The page; the selection takes effect on leaving. `access`: devices that may operate it."""

    idle = math.inf
    closing = (Button.START,)
    hints = ((Button.FIRE, "mat.hint_change"), (Button.BACK, "mat.hint_done"))

    def __init__(self, match: InterruptedMatch, access: Access) -> None:
        self.match, self.access = match, access
        self.seats = [i for i, robot in enumerate(match.match.state.robots) if robot.present]
        self.wanted = {seat: seat in match.real for seat in self.seats}
        super().__init__(match.context, Focus(menu_spots([str(seat) for seat in self.seats])), access)

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE, LEFT and RIGHT toggle the focused robot."""
        if event.button in (Button.LEFT, Button.RIGHT):
            return self.choose(self.focus.name, event)
        return super().press(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        self.wanted[int(name)] = not self.wanted[int(name)]
        self.context.sounds.play("move")
        return None

    def leave(self) -> StackOperation:
        """Apply the selection."""
        for seat, real in self.wanted.items():
            self.match.set_real(seat, real)
        return super().leave()

    def advance(self, seconds: float) -> StackOperation:
        """Keep all robots still."""
        self.match.robots.advance_paused(seconds)
        return None

    @property
    def behind(self) -> pygame.Surface:
        return self.match.runner.picture()

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the state of each robot."""
        self.focus.draw(screen)
        for spot in self.focus.spots:
            label = self.context.words("mat.real" if self.wanted[int(spot.name)] else "mat.simulated")
            color = FOCUS if spot.name == self.focus.name else MIST
            size = fit_size(label, LABEL, spot.rect.w - 150)
            word(label, size, color, "head", 0.3).draw(screen, spot.rect.centerx + 50, spot.rect.centery)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw what lies over every page of the match, too."""
        super().draw_foot(screen)
        self.match.robots.draw_overlay(screen)

    def paint_sheet(self, layer: Layer) -> None:
        sheet_title(layer, None, self.context.words("mat.which"), ICE)
        for spot in self.focus.spots:
            seat = int(spot.name)
            badge(layer.glow, seat, spot.rect.left + 60, spot.rect.centery - (4 if seat == 1 else 0), 26)
            layer.glow.line([(spot.rect.left + 110, spot.rect.centery), (spot.rect.left + 122, spot.rect.centery)],
                          PLAYERS[seat], LINE)  # fmt: skip
