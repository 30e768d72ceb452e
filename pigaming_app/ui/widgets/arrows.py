"""Arrows that show where a page goes on, and clicks on them."""

from collections.abc import Mapping

import pygame

from pigaming_app.ui.draw import FOCUS, LINE
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import sign

SIZE = 20  # px from the centre of an arrow to its tip
ASIDE, ABOVE = 48, 24  # px from the centre within which a click counts

Arrows = Mapping[Button, tuple[float, float]]  # centre of each, by direction


def draw_arrows(screen: pygame.Surface, arrows: Arrows) -> None:
    """Draw each arrow at its place."""
    for button, (x, y) in arrows.items():
        sign(button.name.lower(), SIZE, FOCUS, LINE).draw(screen, x, y)


def as_direction(event: InputEvent, arrows: Arrows) -> InputEvent:
    """A click on an arrow as that direction; anything else as it is."""
    if event.button is Button.CLICK and event.at:
        for button, (x, y) in arrows.items():
            if abs(event.at[0] - x) <= ASIDE and abs(event.at[1] - y) <= ABOVE:
                return InputEvent(button, event.device)
    return event
