"""Pallets in a team's panel; in party they are its orders, and a rush order shows its worth and the time left."""

from collections.abc import Iterator
from typing import NamedTuple

import pygame

from pigaming_app.games.factory.state import DELIVERED, Factory
from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.factory.panels import MIDDLE, centred, small_crate
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, THIN, GlowCanvas, cut_box, dim, readable
from pigaming_app.ui.draw.surface_cache import cached

CARD_W, CARD_H = 60, 92  # px of the card of a rush order
RUSH_CRATE, CRATE_UP, WORTH_DOWN, BAR_DOWN = 38, 24, 14, 35  # px: size of its crate; distances from the card's centre
BAR_W, BAR_H, STEPS = 48, 8, 24  # px of the bar of its remaining time, and the steps in which it shrinks
URGENT = 8 * HZ  # ticks left from which it is urgent
ORDER = (3, 2, 1, 4, 0)  # by state: delivered first, then by remaining steps, damaged last
SIZES = ((52, 66), (52, 58), (44, 48), (40, 42), (36, 38))  # px: size and pitch of ordinary ones, by falling preference
CARD_PITCH = 68  # px


class Order(NamedTuple):
    """A pallet in a panel. `left`: steps of STEPS to the deadline of a rush order; 0: an ordinary order."""

    state: int
    left: int = 0
    urgent: bool = False


def orders(state: Factory, team: int) -> tuple[Order, ...]:
    """The pallets of a team: rush orders first, the most urgent before the others."""
    own = [pallet for pallet in state.pallets if pallet.exists and pallet.team == team]
    own.sort(key=lambda pallet: (pallet.rush or 10**9, ORDER[pallet.state]))
    return tuple(
        Order(pallet.state, -(-STEPS * pallet.rush // state.rules.rush), pallet.rush <= URGENT)
        if pallet.rush and pallet.state != DELIVERED
        else Order(pallet.state)
        for pallet in own
    )


def bits(team: int, shown: tuple[Order, ...], left: float, right: float, mirrored: bool) -> Iterator[Bit]:
    """Pieces of a row of orders between two x, px; a mirrored row begins at the right."""
    cards = sum(bool(order.left) for order in shown)
    room = right - left - cards * CARD_PITCH
    size, pitch = next((fit for fit in SIZES if (len(shown) - cards) * fit[1] <= room), SIZES[-1])
    at = 0.0
    for order in shown:
        wide = CARD_PITCH if order.left else pitch
        x = right - at - wide / 2 if mirrored else left + at + wide / 2
        at += wide
        if not order.left:
            yield centred(small_crate(team, order.state, size), x, MIDDLE)
            continue
        yield centred(card(order.urgent), x, MIDDLE)
        yield centred(small_crate(team, order.state, RUSH_CRATE), x, MIDDLE - CRATE_UP)
        image = bar(order.urgent)
        cut = (image.get_width() - BAR_W) // 2 + BAR_W * order.left // STEPS
        corner = round(x) - image.get_width() // 2, round(MIDDLE) + BAR_DOWN - image.get_height() // 2
        yield image, corner, (0, 0, cut, image.get_height())


@cached
def card(urgent: bool) -> pygame.Surface:
    """Card of a rush order without its crate: outline, worth, and the empty bar."""
    color = ALARM if urgent else FOCUS
    ink = GlowCanvas(CARD_W + 40, CARD_H + 40, 3).set_transform(20 + CARD_W / 2, 20 + CARD_H / 2)
    outline = cut_box(-CARD_W / 2, -CARD_H / 2, CARD_W, CARD_H, 10)
    ink.fill(outline, dim(color, 0.12)).line(outline, color, THIN, True)
    ink.text("×2", readable(30), 0, WORTH_DOWN, color, "hero", "c")
    ink.line([(-BAR_W / 2, BAR_DOWN), (BAR_W / 2, BAR_DOWN)], dim(color, 0.25), BAR_H)
    return ink.lit(0.5)


@cached
def bar(urgent: bool) -> pygame.Surface:
    """The remaining time of a rush order, in full."""
    ink = GlowCanvas(BAR_W + 20, BAR_H + 20, 3).set_transform(10, 10 + BAR_H / 2)
    return ink.line([(0, 0), (BAR_W, 0)], ALARM if urgent else FOCUS, BAR_H).lit(0.5)
