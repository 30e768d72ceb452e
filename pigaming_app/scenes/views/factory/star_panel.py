"""HUD of `together`: the pallets of all robots in one panel, the stars that can still be won in the other.

The clock counts up; a star is lost when the clock passes the time below it.
"""

from collections.abc import Iterator
from functools import partial

import pygame

from pigaming_app.games.factory.state import DELIVERED, ICE, Factory
from pigaming_app.scenes.views.background import Bit
from pigaming_app.scenes.views.factory import panels
from pigaming_app.scenes.views.factory.order_cards import ORDER
from pigaming_app.scenes.views.factory.panels import MIDDLE, NUMBER, H, Mate, W, X, Y
from pigaming_app.scenes.views.hud.parts import ALARM_SECONDS, CLOCK, EDGE, HudParts, clock_bits, drawn
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, LINE, MIST, STEEL, THIN, Color, GlowCanvas, readable, star_points
from pigaming_app.ui.draw import ICE as WHITE
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.surface_cache import cached

CRATES, CRATE, PITCH, ROW = 306, 38, 54, 6  # px from the left edge; size; pitch; in a row of two rows, else one
SINGLE = (4, 52, 80)  # at most so many pallets are in one row; px: their size and pitch
STARS, STAR_PITCH, STAR_R = 70, 138, 30  # px: first star's centre from the left edge, pitch, radius
STAR_UP, TIME_DOWN, TIME = 15, 33, 34  # px from the middle to a star, and to its time; size of that
ROBOTS = (480.0, 580.0)  # px from the left edge to the columns of robots


def limits(state: Factory) -> tuple[int, int, int]:
    """Ticks within which everything must be delivered for one, two and three stars."""
    rules = state.rules
    return rules.ticks, rules.two_stars, rules.three_stars


def stars_left(state: Factory) -> int:
    """The stars that can still be won."""
    return sum(state.tick <= limit for limit in limits(state))


def progress(state: Factory) -> tuple[int, ...]:
    """The states of all pallets, delivered ones first."""
    return tuple(sorted((pallet.state for pallet in state.pallets if pallet.exists), key=ORDER.__getitem__))


def show_stars(parts: HudParts, state: Factory, mates: tuple[Mate, ...]) -> None:
    """Bake the panel of the stars and the clock, if they have changed."""
    left = stars_left(state)
    content = left, _urgent(state, left), tuple(limit // HZ for limit in limits(state)), mates
    parts.show(1, content, X[1] - 8, W + 16, partial(star_bits, *content))
    now = state.tick // HZ, ALARM if _urgent(state, left) else WHITE
    parts.show("clock", now, CLOCK.x, CLOCK.w, partial(_clock_bits, *now))


def _urgent(state: Factory, left: int) -> bool:
    """True shortly before the next star is lost."""
    return bool(left and 0 <= limits(state)[left - 1] - state.tick <= ALARM_SECONDS * HZ)


def _clock_bits(seconds: int, color: Color) -> list[Bit]:
    return clock_bits(clock(seconds), 82, color)


def clock(seconds: int) -> str:
    """Minutes and seconds."""
    return f"{seconds // 60}:{seconds % 60:02}"


def progress_bits(forms: tuple[int, ...], color: Color) -> Iterator[Bit]:
    """Pieces of the left panel: the number of delivered pallets, and the state of each pallet."""
    x = X[0]
    yield panels.frame(ICE, True), (x - EDGE, Y - EDGE), None
    yield from panels.count_bits(str(forms.count(DELIVERED)), f"/{len(forms)}", x + NUMBER, color)
    most, size, pitch = SINGLE
    if len(forms) > most:
        size, pitch = CRATE, PITCH
    rows = [row for row in (forms[:ROW], forms[ROW:]) if row]
    for j, row in enumerate(rows):
        y = MIDDLE + 46 * (j - (len(rows) - 1) / 2)
        for i, form in enumerate(row):
            yield panels.centred(panels.small_crate(ICE, form, size), x + CRATES + pitch * (i + 0.5), y)


def star_bits(left: int, urgent: bool, seconds: tuple[int, ...], mates: tuple[Mate, ...]) -> Iterator[Bit]:
    """Pieces of the right panel: three stars with their times, and the robots."""
    x = X[1]
    yield panels.plain_frame(ICE), (x - EDGE, Y - EDGE), None
    for i, limit in enumerate(seconds):
        form = "lost" if i >= left else "urgent" if urgent and i == left - 1 else "lit"
        yield panels.centred(star_sign(form, clock(limit)), x + STARS + STAR_PITCH * i, MIDDLE)
    yield from panels.robot_bits(mates, tuple(x + column for column in ROBOTS))


@cached
def star_sign(form: str, text: str) -> pygame.Surface:
    """A star that is lit, urgent or lost, above its time."""
    color = {"lit": FOCUS, "urgent": ALARM, "lost": STEEL}[form]
    ink = GlowCanvas(STAR_PITCH + 20, H + 16, 3).set_transform(STAR_PITCH / 2 + 10, H / 2 + 8)
    shape = star_points(STAR_R, 0, -STAR_UP)
    if form == "lost":
        ink.line(shape, color, THIN, True)
    else:
        ink.fill(shape, color).line(shape, color, LINE, True)
    ink.text(text, readable(TIME), 0, TIME_DOWN, MIST if form == "lost" else WHITE, "hero", "c")
    return ink.lit(0.5)


def jobs(state: Factory) -> Iterator[Job]:
    """Prewarm jobs: samples of both panels, and of the clock."""
    times = tuple(limit // HZ for limit in limits(state))
    yield drawn(progress_bits, tuple(range(DELIVERED + 1)) * 2, WHITE)
    yield from (drawn(star_bits, left, urgent, times, ()) for left in range(4) for urgent in (False, True))
