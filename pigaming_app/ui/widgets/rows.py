"""A page of rows, one in focus, with a panel beside them: the form of the operator's pages."""

from collections.abc import Sequence

import pygame

from pigaming_app.scenes.flow.context import House
from pigaming_app.scenes.options.page import Value
from pigaming_app.ui.draw.layers import span
from pigaming_app.ui.input.events import Act, Press
from pigaming_app.ui.widgets import setting_row as dials
from pigaming_app.ui.widgets.focus import Focus, Spot
from pigaming_app.ui.widgets.labels import glow_bar

TOP, PITCH, HIGH = 246, 88, 64


def spots(names: Sequence[str]) -> list[Spot]:
    """Where rows with these names are."""
    x, w = span(0, 8)
    return [Spot(name, pygame.Rect(x, TOP - HIGH // 2 + PITCH * i, w, HIGH)) for i, name in enumerate(names)]


def draw(screen: pygame.Surface, house: House, focus: Focus, table: str, values: dict[str, Value]) -> None:
    """Paint the rows of a page whose texts are in `table`."""
    glow_bar(screen, focus.box)
    for i, spot in enumerate(focus.spots):
        box, value, hot = spot.rect, values[spot.name], spot.name == focus.name
        dials.label(house.words(f"{table}.{spot.name}"), hot).draw(screen, box.x + 40, box.centery)
        dials.value(value.kind, value.options, value.chosen, hot).draw(screen, box.x, box.centery)
        if i:
            dials.rule(box.w).draw(screen, box.x, box.centery - PITCH // 2)
    focus.draw(screen)


def pushed(press: Press, focus: Focus, value: Value) -> int:
    """By how much a press changes the row in focus: 1, -1, or 0; a click does what it hits."""
    if press.act in (Act.LEFT, Act.RIGHT):
        return 1 if press.act is Act.RIGHT else -1
    if press.act is Act.CLICK and press.at and focus.under(press) == focus.name and value.kind != "deed":
        across = press.at[0] - focus.spot.rect.x
        if value.kind == "toggle":
            hit = dials.hit(value.kind, value.options, value.chosen, across)
            return 0 if hit is None else hit - value.chosen
        return 0 if across < dials.AT else -1 if across < dials.AT + dials.ROOM / 2 else 1
    return 0
