"""Swap page: hand each robot of a running match over to a simulated one, and back."""

import pygame

from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.stack import Pop, StackOperation
from pigaming_app.scenes.mat.robots.interrupted import InterruptedMatch
from pigaming_app.scenes.play.pause import menu_spots, sheet_title
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, MIST, PLAYERS, badge
from pigaming_app.ui.draw.layers import Layer
from pigaming_app.ui.draw.text import fit_size, word
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.dialog import PROMPTS, W, overlay
from pigaming_app.ui.widgets.focus import Focus


class SwapPage:
    """The page; the selection takes effect on leaving. `access`: devices that may operate it."""

    def __init__(self, match: InterruptedMatch, access: Access) -> None:
        self.match, self.context, self.access = match, match.context, access
        self.seats = [i for i, robot in enumerate(match.match.state.robots) if robot.present]
        self.wanted = {seat: seat in match.real for seat in self.seats}
        self.focus = Focus(menu_spots([str(seat) for seat in self.seats]))
        self.picture: pygame.Surface | None = None
        hints = [(Button.FIRE, "mat.hint_change"), (Button.BACK, "mat.hint_done")]
        self.prompts = self.context.prompts(hints, PROMPTS, W - 80, device=lambda: access.hint_device)

    def on_enter(self) -> None:
        """Nothing to do."""

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE, LEFT and RIGHT toggle the focused robot; BACK and START apply."""
        admitted = self.access.admit(self.prompts.as_button(event))
        if admitted is None:
            return None
        event = admitted
        if event.button in (Button.BACK, Button.START):
            for seat, real in self.wanted.items():
                self.match.set_real(seat, real)
            self.context.sounds.play("back")
            return Pop()
        if self.focus.handle(event):
            self.context.sounds.play("move")
        chosen = self.focus.name if event.button in (Button.LEFT, Button.RIGHT) else self.focus.activated(event)
        if chosen:
            self.wanted[int(chosen)] = not self.wanted[int(chosen)]
            self.context.sounds.play("move")
        return None

    def update(self, seconds: float) -> StackOperation:
        """Keep all robots still."""
        self.match.advance_paused(seconds)
        self.access.update(seconds)
        self.focus.update(seconds)
        return None

    def draw(self, screen: pygame.Surface) -> None:
        if self.picture is None:
            self.picture = overlay(self.match.picture(), ICE, self._paint)
        screen.blit(self.picture, (0, 0))
        self.focus.draw(screen)
        for spot in self.focus.spots:
            label = self.context.words("mat.real" if self.wanted[int(spot.name)] else "mat.simulated")
            color = FOCUS if spot.name == self.focus.name else MIST
            size = fit_size(label, LABEL, spot.rect.w - 150)
            word(label, size, color, "head", 0.3).draw(screen, spot.rect.centerx + 50, spot.rect.centery)
        self.prompts.draw(screen)
        self.match.draw_overlay(screen)

    def _paint(self, layer: Layer) -> None:
        sheet_title(layer, None, self.context.words("mat.which"), ICE)
        for spot in self.focus.spots:
            seat = int(spot.name)
            badge(layer.glow, seat, spot.rect.left + 60, spot.rect.centery - (4 if seat == 1 else 0), 26)
            layer.glow.line([(spot.rect.left + 110, spot.rect.centery), (spot.rect.left + 122, spot.rect.centery)],
                          PLAYERS[seat], LINE)  # fmt: skip
