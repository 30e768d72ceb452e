"""Prewarm jobs for the sprites of `party`."""

from collections.abc import Iterator, Sequence
from functools import partial

from pigaming_app.games.race.state import Race
from pigaming_app.scenes.views.race.lines import LineFrame
from pigaming_app.scenes.views.race.party import sprites as things
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS, step


def party_jobs(state: Race, seats: Sequence[int], finish: LineFrame) -> Iterator[Job]:
    """One small job per sprite; a cached sprite costs nothing. `finish`: the common finish line."""
    for turn in sorted({step(pad.heading, HEADINGS) for pad in state.pads}):
        yield from (partial(things.pad, turn, phase) for phase in range(things.PAD_PHASES))
    yield from (partial(things.item_box, turn) for turn in range(things.BOX_TURNS))
    yield things.box_gone
    for shape in range(things.OIL_SHAPES):
        yield from (partial(things.oil, shape, level) for level in range(things.OIL_LEVELS, 0, -1))
    for turn in range(things.AIR_TURNS):
        yield from (partial(things.air, turn, level) for level in range(things.AIR_LEVELS, 0, -1))
    yield from (partial(things.swirl, turn, 52) for turn in range(things.SWIRL_TURNS))
    yield from (partial(things.finish_pulse, finish, level) for level in range(things.PULSE_LEVELS, 0, -1))
    for seat in seats:
        for place in range(len(seats)):
            yield from (partial(things.place_change, seat, up, str(place + 1)) for up in (True, False))
        yield from (partial(effects.shield, seat, turn, 72) for turn in range(things.SHIELD_SWAY + 1))
    for size in effects.SPARK_SIZES:
        yield from (partial(effects.sparks, things.OIL, size, turn) for turn in range(effects.SPARK_TURNS))
