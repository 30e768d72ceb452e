"""Rematch vote: every player presses FIRE once; absent players delay it only briefly."""

import math
from collections.abc import Collection, Sequence

import pygame

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.flow.used_keys import UsedKeys
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, LINE, MIST, PLAYERS, THIN, badge, cut_box, dim, icon, text_width
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.widgets.caption import RING_STEPS, hold_ring

Y = 884
PITCH = 160
PATIENCE = 10.0  # s from the first vote until the rematch starts without the others


class RematchVote:
    """Votes of the humans among `seats`; `devices` (of all four seats) may be reassigned here."""

    def __init__(
        self, context: Context, seats: Sequence[int], humans: Sequence[int], devices: Sequence[Device | None]
    ) -> None:
        self.context, self.seats, self.humans = context, list(seats), list(humans)
        self.devices = list(devices)
        self.votes: set[int] = set()
        self.waited = 0.0

    def vote(self, device: Device) -> bool:
        """Count a vote; a free device takes over a seat whose device is gone. True if it counted."""
        if device in self.devices:
            seat = self.devices.index(device)
        elif missing := [seat for seat in self.humans if not self.here(seat)]:
            seat = missing[0]
            self._sit(seat, device)
        elif not self.humans:
            seat = self.seats[0]
        else:
            return False
        return self._count(seat)

    @property
    def takeable(self) -> list[int]:
        """Seats of AIs, in the order in which free devices get them."""
        return [seat for seat in reversed(self.seats) if seat not in self.humans]

    def take(self, device: Device) -> bool:
        """Give a free device the seat of an AI, which counts as its vote. True if it has a seat now."""
        if device in self.devices or not self.takeable:
            return False
        seat = self.takeable[0]
        self._sit(seat, device)
        self.humans.append(seat)
        return self._count(seat)

    def _sit(self, seat: int, device: Device) -> None:
        self.devices[seat] = device
        self.context.shared(UsedKeys).forget(device)

    def _count(self, seat: int) -> bool:
        new = seat not in self.votes
        self.votes.add(seat)
        return new

    def here(self, seat: int) -> bool:
        """True if the device of a human's seat is connected."""
        device = self.devices[seat]
        return device is not None and self.context.controls.connected(device)

    def update(self, seconds: float) -> bool:
        """Advance the timeout; True when the rematch starts."""
        if not self.votes:
            return False
        self.waited += seconds
        return self.votes >= set(self.humans) or self.waited >= PATIENCE

    def drivers(self, everyone: bool) -> list[Device | None]:
        """Drivers of the rematch: everyone who voted, or everyone connected."""
        wanted = [seat for seat in self.humans if (everyone and self.here(seat)) or seat in self.votes]
        return [device if seat in wanted else None for seat, device in enumerate(self.devices)]

    def draw(self, screen: pygame.Surface, held: Collection[float] = ()) -> None:
        """Draw the question and the votes. `held`: hold progress of free devices taking seats, 0..1."""
        text = self.context.words("results.rematch")
        width = text_width(text, LABEL)
        x = 960 - (width + 48 + len(self.seats) * PITCH - 44) / 2
        question(text).draw(screen, x)
        x += width + 78
        taken = dict(zip(self.takeable, held, strict=False))
        for seat in self.seats:
            icon_name = "ai" if seat not in self.humans else "check" if seat in self.votes else ""
            answer(seat, icon_name).draw(screen, x)
            if seat in taken:
                hold_ring(seat, math.ceil(taken[seat] * RING_STEPS)).draw(screen, x, Y)
            x += PITCH
        if self.votes and self.waited > 0.5 and self.humans:
            left = 1.0 - self.waited / PATIENCE
            pygame.draw.line(screen, FOCUS, (960 - 300 * left, 928), (960 + 300 * left, 928), 4)


@cached
def question(text: str) -> LitImage:
    """The question; left edge at x = 0."""
    layer = Layer(0, Y - 40, text_width(text, LABEL), 80)
    layer.canvas.text(text, LABEL, 0, Y, FOCUS)
    return layer.render()


@cached
def answer(seat: int, icon_name: str) -> LitImage:
    """Badge centred on x = 0 with the player's vote: an icon name, or "" before it."""
    layer = Layer(-40, Y - 40, 140, 80)
    badge(layer.glow, seat, 0, Y, 28, None if icon_name else dim(PLAYERS[seat], 0.45))
    if icon_name:
        color, weight = (ICE, LINE) if icon_name == "check" else (MIST, THIN)
        icon(layer.glow, icon_name, 66, Y, 20, color, weight)
    else:
        layer.glow.dashes(cut_box(44, Y - 22, 44, 44, 8), MIST, THIN, 10, 8)
    return layer.render()
