"""Prewarm jobs for the sprites of every match, in order of first use; a few are run per frame.

Each job is small: it renders one sprite, or finds it cached.
"""

from collections.abc import Iterator, Sequence
from functools import partial

from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS


def driving(seats: Sequence[int]) -> Iterator[Job]:
    """Jobs for driving robots: headings, headlights, treads, flames."""
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
