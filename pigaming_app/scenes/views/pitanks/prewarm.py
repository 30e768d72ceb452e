"""Prewarm jobs for the sprites specific to PiTanks."""

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from pigaming_app.games.pitanks.state import POWERS
from pigaming_app.scenes.views.sprites import effects, party
from pigaming_app.scenes.views.sprites import pickups as things
from pigaming_app.scenes.views.sprites import robot as tank
from pigaming_app.scenes.views.walled_background import wall_sprite
from pigaming_app.ui.draw import ALARM, FOCUS, LINE, PLAYERS, THIN, WALL
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.sprites import HEADINGS
from pigaming_app.ui.i18n import signed


def jobs(state: Any, walls: int, seats: Sequence[int]) -> Iterator[Job]:
    """One small job per sprite; a cached sprite costs nothing. `walls`: number of walls of the arena itself."""
    yield from (partial(tank.ghost, seat) for seat in seats)
    yield from _shooting(seats, state.rules.magazine)
    yield from _points(seats, ("+1", "−1") if state.rules.penalty else ("+1",))
    yield from _walls(state, walls)
    yield from _hits(seats)
    if state.rules.pickups:
        yield from _powers(seats)
    if state.rules.knockout:
        yield from _party(seats)


def _shooting(seats: Sequence[int], magazine: int) -> Iterator[Job]:
    for seat in seats:
        if magazine:
            r = effects.MAGAZINE_R
            yield from (partial(effects.magazine, seat, left, magazine, r) for left in range(magazine + 1))
        for turn in range(HEADINGS):
            yield partial(effects.bullet, seat, turn)
        for turn in range(effects.TURNS):
            yield partial(effects.flash, seat, turn)


def _party(seats: Sequence[int]) -> Iterator[Job]:
    for turn in range(party.STAR_TURNS):
        yield partial(party.stars, turn)
    yield party.spotlight
    yield party.stage
    for points in (2, 4):
        yield partial(party.bounty, points)
        yield from (partial(things.popup, signed(points), seat) for seat in seats)  # fading it takes 0.1 ms


def _points(seats: Sequence[int], popups: Sequence[str]) -> Iterator[Job]:
    for seat in seats:
        for text in popups:
            for level in range(things.POPUP_LEVELS, 0, -1):
                yield partial(things.popup, text, seat, level)


def _walls(state: Any, count: int) -> Iterator[Job]:
    for i in range(count):
        wall = state.walls[i]
        for health in range(wall.initial_health - 1, -1, -1):
            yield partial(wall_sprite, wall, health)


def _hits(seats: Sequence[int]) -> Iterator[Job]:
    for color in (*(PLAYERS[seat] for seat in seats), WALL, FOCUS, ALARM):
        for size in effects.SPARK_SIZES:
            for turn in range(effects.SPARK_TURNS):
                yield partial(effects.sparks, color, size, turn)
    for shape in range(effects.SHARDS):
        for turn in range(effects.SPARK_TURNS):
            yield partial(effects.shards, shape, turn)
    for seat in seats:
        for stage in range(effects.WAVE_STEPS):
            yield partial(effects.wave, PLAYERS[seat], stage)
        for level in range(effects.LIGHT_LEVELS, 0, -1):
            yield partial(effects.light, PLAYERS[seat], level)


def _powers(seats: Sequence[int]) -> Iterator[Job]:
    for name in POWERS:
        yield partial(things.pickup, name)
        yield partial(things.small_icon, name, FOCUS, 15)
    for left in range(49):
        for r, width in ((56, LINE), (52, THIN), (26, THIN)):
            yield partial(effects.timer_ring, FOCUS, left, r, width)
    for seat in seats:
        yield partial(things.mine, seat, True)
        yield partial(things.mine, seat, False)
        for turn in range(24):
            yield partial(effects.shield, seat, turn)
