"""Prewarm jobs for the sprites of a race and of `party`, except driving robots and cards."""

from collections.abc import Iterator, Sequence
from functools import partial

from pigaming_app.games.race.state import Race
from pigaming_app.scenes.views.race import sprites as race_signs
from pigaming_app.scenes.views.race.hud_cards import GAIN, LOSS
from pigaming_app.scenes.views.race.lines import START, LineFrame
from pigaming_app.scenes.views.race.party import sprites as things
from pigaming_app.scenes.views.race.recovery import beam, way_dot
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import ghost as blank
from pigaming_app.scenes.views.view import decimal
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, PLAYERS, STEEL, SUB, THIN, WHITE
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.layers import glyph
from pigaming_app.ui.draw.sprites import HEADINGS, step
from pigaming_app.ui.i18n import Words


def jobs(seats: Sequence[int], words: Words | None, signs: Sequence[int]) -> Iterator[Job]:
    """One small job per sprite; a cached sprite costs nothing. `signs`: the sign of each line."""
    yield from _mud()
    yield from _rising(seats, words)
    yield from _signs(seats, words, signs)
    yield from _light(seats, START in signs)
    if START not in signs:  # party has no ghost
        yield from (partial(race_signs.ghost, turn) for turn in range(race_signs.GHOST_TURNS))


def void_words(words: Words | None) -> tuple[str, ...]:
    """Text of an invalid lap, in lines."""
    return tuple(words("race.void").split("|")) if words else ()


def _mud() -> Iterator[Job]:
    yield from (partial(race_signs.clods, size) for size in race_signs.CLODS)
    yield from (partial(race_signs.splash, which) for which in range(3))
    yield from (partial(effects.timer_ring, FOCUS, left, 52, THIN) for left in range(49))


def _rising(seats: Sequence[int], words: Words | None) -> Iterator[Job]:
    for char in "0123456789+−" + decimal(words, "."):
        for color in (GAIN, LOSS, FOCUS, ICE):
            yield partial(glyph, char, SUB, color)
    yield race_signs.gold_star
    if words:
        for seat in seats:
            yield partial(race_signs.notice, words("race.last_lap"), PLAYERS[seat], "flag")


def _signs(seats: Sequence[int], words: Words | None, signs: Sequence[int]) -> Iterator[Job]:
    for below in (False, True):
        yield partial(race_signs.wrong_way, below)
        for sign in signs:
            yield partial(race_signs.missed, sign, below)
            yield partial(race_signs.missed, sign, below, void_words(words))
        for seat in seats:
            for number in range(len(seats)):
                ending = words(f"race.place_{number + 1}") if words else ""
                yield partial(race_signs.place, seat, number + 1, ending, below)
    for seat in seats:
        yield from (partial(beam, seat), partial(blank, seat), partial(way_dot, seat))
        for turn in range(HEADINGS):
            yield partial(race_signs.dash, seat, turn)
            yield partial(race_signs.tip, seat, turn)


def _light(seats: Sequence[int], party: bool) -> Iterator[Job]:
    for color in {*(PLAYERS[seat] for seat in seats), WHITE}:
        yield from (partial(race_signs.confetti, color, turn) for turn in range(4))
    for color in (*PLAYERS, FOCUS, ALARM):
        for size in effects.SPARK_SIZES:
            for turn in range(effects.SPARK_TURNS):
                yield partial(effects.sparks, color, size, turn)
    for stage in range(0 if party else effects.WAVE_STEPS):
        yield partial(effects.wave, FOCUS, stage)
    for color in (PLAYERS[seat] for seat in seats):
        for stage in range(effects.WAVE_STEPS):
            yield partial(effects.wave, color, stage)
        for level in range(effects.LIGHT_LEVELS, 0, -1):
            yield partial(effects.light, color, level)


def party_jobs(state: Race, seats: Sequence[int], finish: LineFrame | None) -> Iterator[Job]:
    """One small job per sprite; a cached sprite costs nothing. `finish`: the common finish line; None: in draft."""
    colors = [FOCUS] if finish else [PLAYERS[seat] for seat in seats] if len(seats) > 1 else [STEEL]
    for turn in sorted({step(pad.heading, HEADINGS) for pad in state.pads}):
        for color in colors:
            yield from (partial(things.pad, turn, phase, color) for phase in range(things.PAD_PHASES))
    for turn in range(things.AIR_TURNS):
        yield from (partial(things.air, turn, level) for level in range(things.AIR_LEVELS, 0, -1))
    if finish:
        yield from _party(seats, finish)


def _party(seats: Sequence[int], finish: LineFrame) -> Iterator[Job]:
    yield from (partial(things.item_box, turn) for turn in range(things.BOX_TURNS))
    yield things.box_gone
    for shape in range(things.OIL_SHAPES):
        yield from (partial(things.oil, shape, level) for level in range(things.OIL_LEVELS, 0, -1))
    yield from (partial(things.swirl, turn, 52) for turn in range(things.SWIRL_TURNS))
    yield from (partial(things.finish_pulse, finish, level) for level in range(things.PULSE_LEVELS, 0, -1))
    for seat in seats:
        for place in range(len(seats)):
            yield from (partial(things.place_change, seat, up, str(place + 1)) for up in (True, False))
        yield from (partial(effects.shield, seat, turn, 72) for turn in range(things.SHIELD_SWAY + 1))
    for size in effects.SPARK_SIZES:
        yield from (partial(effects.sparks, things.OIL, size, turn) for turn in range(effects.SPARK_TURNS))
