"""Sprites that every match will ask for, in the order in which it will need them: made ahead, a few in each frame.

Each job is one small piece of work: it makes one sprite, or finds it made.
"""

from collections.abc import Iterator, Sequence
from functools import partial

from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS


def driving(seats: Sequence[int]) -> Iterator[Job]:
    """The robots themselves: headings, headlights, treads, flames."""
    for turn in range(HEADINGS):
        for seat in seats:
            yield partial(tank.tank, seat, turn)
    for seat in seats:
        for turn in range(effects.BEAM_TURNS):
            yield partial(effects.beam, seat, turn)
        for turn in range(effects.TURNS):
            for level in range(effects.TREAD_LEVELS, 0, -1):
                yield partial(effects.tread, seat, turn, level)
        for turn in range(effects.TURNS):
            for flicker in (0, 1):
                yield partial(effects.flame, seat, turn, flicker)
