"""Who wants a rematch: everyone who played presses FIRE once; somebody missing does not hold the others up for long."""

import math
from collections.abc import Collection, Sequence

import pygame

from pigaming_app.scenes.flow.context import Context
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, MIST, PLAYERS, THIN, badge, cut_box, dim, icon, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.widgets.caption import RING_STEPS, hold_ring

Y = 884
PITCH = 160
PATIENCE = 10.0  # seconds from the first vote until it begins without the others


class RematchVote:
    """The votes of the humans among `seats`; `devices` (of all four seats) may change hands here."""

    def __init__(
        self, context: Context, seats: Sequence[int], humans: Sequence[int], devices: Sequence[Device | None]
    ) -> None:
        self.context, self.seats, self.humans = context, list(seats), list(humans)
        self.devices = list(devices)
        self.votes: set[int] = set()
        self.waited = 0.0

    def vote(self, device: Device) -> bool:
        """Count a press; a free device takes the seat of somebody whose device is gone. True: it counted."""
        if device in self.devices:
            seat = self.devices.index(device)
        elif missing := [seat for seat in self.humans if not self.here(seat)]:
            seat = missing[0]
            self.devices[seat] = device
        elif not self.humans:
            seat = self.seats[0]
        else:
            return False
        return self._count(seat)

    @property
    def takeable(self) -> list[int]:
        """The seats of AIs, in the order in which free devices get them."""
        return [seat for seat in reversed(self.seats) if seat not in self.humans]

    def take(self, device: Device) -> bool:
        """Give a free device the seat of an AI; that counts as its vote. True: it has one now."""
        if device in self.devices or not self.takeable:
            return False
        seat = self.takeable[0]
        self.devices[seat] = device
        self.humans.append(seat)
        return self._count(seat)

    def _count(self, seat: int) -> bool:
        new = seat not in self.votes
        self.votes.add(seat)
        return new

    def here(self, seat: int) -> bool:
        """The device of a human's seat is there."""
        device = self.devices[seat]
        return device is not None and self.context.controls.connected(device)

    def update(self, seconds: float) -> bool:
        """Let time pass; true when the rematch begins."""
        if not self.votes:
            return False
        self.waited += seconds
        return self.votes >= set(self.humans) or self.waited >= PATIENCE

    def drivers(self, everyone: bool) -> list[Device | None]:
        """Who drives each seat of the rematch: those who voted, or everyone whose device is there."""
        wanted = [seat for seat in self.humans if (everyone and self.here(seat)) or seat in self.votes]
        return [device if seat in wanted else None for seat, device in enumerate(self.devices)]

    def draw(self, screen: pygame.Surface, held: Collection[float] = ()) -> None:
        """Add the question and the votes to the screen; `held`: how far free devices are with taking seats, 0..1."""
        text = self.context.words("results.rematch")
        width = text_width(text, LABEL)
        x = 960 - (width + 48 + len(self.seats) * PITCH - 44) / 2
        question(text).draw(screen, x)
        x += width + 78
        taken = dict(zip(self.takeable, held, strict=False))
        for seat in self.seats:
            said = "ai" if seat not in self.humans else "check" if seat in self.votes else ""
            answer(seat, said).draw(screen, x)
            if seat in taken:
                hold_ring(seat, math.ceil(taken[seat] * RING_STEPS)).draw(screen, x, Y)
            x += PITCH
        if self.votes and self.waited > 0.5 and self.humans:
            left = 1.0 - self.waited / PATIENCE
            pygame.draw.line(screen, FOCUS, (960 - 300 * left, 928), (960 + 300 * left, 928), 4)


@cached
def question(text: str) -> LitImage:
    """The question, its left edge at x = 0."""
    layer = Layer(0, Y - 40, text_width(text, LABEL), 80)
    layer.canvas.text(text, LABEL, 0, Y, FOCUS)
    return layer.done()


@cached
def answer(seat: int, said: str) -> LitImage:
    """A badge round x = 0 and what that player said: an icon's name, or nothing yet."""
    layer = Layer(-40, Y - 40, 140, 80)
    badge(layer.glow, seat, 0, Y, 28, None if said else dim(PLAYERS[seat], 0.45))
    if said:
        color, weight = (ICE, LINE) if said == "check" else (MIST, THIN)
        icon(layer.glow, said, 66, Y, 20, color, weight)
    else:
        layer.glow.dashes(cut_box(44, Y - 22, 44, 44, 8), MIST, THIN, 10, 8)
    return layer.done()
