"""How to play Robot Factory, together: one team, stars by time, the tasks of team mates, outputs that are cleared."""

import math

import pygame

from pigaming_app.games.factory.state import DELIVERED, DONE, ICE, RAW, B
from pigaming_app.scenes.views.lessons.animation import Loop, add
from pigaming_app.scenes.views.lessons.factory_party import DOWN, FORK, SLOT, UP, ease, machine, robot, slot
from pigaming_app.scenes.views.sprites import factory as crates
from pigaming_app.scenes.views.sprites import factory_signs as signs
from pigaming_app.scenes.views.sprites.stars import star
from pigaming_app.ui.draw import ICE as WHITE
from pigaming_app.ui.draw import MIST, PLAYERS, TITLE
from pigaming_app.ui.draw.sprites import HEADINGS, step
from pigaming_app.ui.draw.text import glyph, number_width, text
from pigaming_app.ui.widgets.labels import blit_sprite

ROUND, SPEED = Loop(250.0, 330.0, 90.0), 120.0  # px, px/s: the way of all four
SECONDS, RATE, REST = (90, 60, 30), 18.0, 1.5  # s on the clock at which a star is lost; their pace; s of pause
STAR_R, STAR_PITCH, TIME = 44, 112, 38  # px: stars, and the size of their times
FETCH, BRING = 2.2, 2.2  # s of the two ways of a mate
COUNT, CARRY = 5.0, 2.4  # s until the output is cleared; s of the worker's way


def allies(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """Robots of all four players carry pallets of the same team."""
    for seat in range(4):
        px, py, heading, _ = ROUND.at(seconds * SPEED + seat * ROUND.length / 4)
        turn = step(heading, HEADINGS)
        robot(screen, seat, ICE, x + px, y + py, turn)
        c, s = math.cos(heading), math.sin(heading)
        blit_sprite(screen, crates.crate(ICE, DONE), x + px + FORK * c, y + py + FORK * s)
    blit_sprite(screen, crates.crate(ICE, DELIVERED), x, y)
    return None


def stars(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """The clock runs, and a star is lost at each of its times."""
    now = min(SECONDS[0], int(RATE * (seconds % (SECONDS[0] / RATE + REST))))
    digits = f"{now // 60}:{now % 60:02}"
    px = x - number_width(digits, TITLE) / 2
    for char in digits:
        sprite, advance = glyph(char, TITLE, WHITE)
        add(screen, sprite, px, y - 90)
        px += advance
    for i, limit in enumerate(SECONDS):
        star(now < limit, STAR_R).draw(screen, round(x + STAR_PITCH * (i - 1)), round(y + 40))
        text(f"{limit // 60}:{limit % 60:02}", TIME, MIST, "hero").draw(screen, x + STAR_PITCH * (i - 1), y + 128)
    return None


def tasks(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """A mate is on its way to a pallet, then to the place for it; the sign and the dots show which."""
    seat, now = 2, seconds % (FETCH + BRING)
    high, low = y - 160, y + 180
    for sy in (high, low):
        slot().draw(screen, round(x), round(sy))
    lifts = now < FETCH
    py = low - FORK - 60 - (low - high - 2 * FORK - 60) * ease(now / FETCH) if lifts else 0.0
    if not lifts:
        py = high + FORK + (low - high - 2 * FORK) * ease((now - FETCH) / BRING)
    way = -1 if lifts else 1
    fork_y, goal = py + way * FORK, high if lifts else low
    for i in range(1, int(abs(goal - fork_y) - 40) // 24 + 1):
        add(screen, signs.dot(PLAYERS[seat]), x, fork_y + way * 24 * i)
    robot(screen, seat, ICE, x, py, UP if lifts else DOWN)
    if lifts:
        blit_sprite(screen, crates.crate(ICE, RAW), x, high)
    else:
        blit_sprite(screen, crates.crate(ICE, RAW), x, fork_y)
    add(screen, crates.target(PLAYERS[seat], True), x, goal)
    blit_sprite(screen, signs.task(seat, lifts), x + 72, goal)
    return None


def clear(screen: pygame.Surface, x: float, y: float, seconds: float) -> str | None:
    """The time to collect a pallet runs out; a worker carries it away."""
    now = seconds % (COUNT + CARRY)
    machine_y, out = y - 110, y - 110 + SLOT
    machine(B).draw(screen, round(x), round(machine_y))
    gone = ease((now - COUNT) / CARRY) * 260 if now >= COUNT else 0.0
    heading = 3 * crates.PERSON_TURNS // 4 if gone == 0.0 else crates.PERSON_TURNS // 4
    stride = int(seconds * 7) % crates.STRIDE if gone else 0
    if now < COUNT:
        blit_sprite(screen, crates.crate(ICE, DONE), x, out)
        add(screen, signs.time_left(math.ceil(crates.COUNTS * (COUNT - now) / COUNT), True), x, out)
        blit_sprite(screen, signs.seconds_left(math.ceil(COUNT - now)), x + 96, out)
        blit_sprite(screen, crates.person(heading, stride, False), x, out + 150 - 60 * ease((now - 3.0) / 2.0))
    else:
        blit_sprite(screen, crates.person(heading, stride, False), x, out + 90 + gone)
        blit_sprite(screen, crates.crate(ICE, DONE), x, out + 130 + gone)
    return None
