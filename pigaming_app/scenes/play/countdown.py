"""Countdown: large signs over the arena, before a match and after every interruption."""

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import cycle

import pygame

from pigaming_app.ui.draw import ALARM, BLACK, BOLD, FOCUS, ICE, Color, GlowCanvas, baseline, font
from pigaming_app.ui.draw.frame_budget import Job, Steps, resumable
from pigaming_app.ui.draw.sprites import Sprite, faded, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.theme import CAPITALS

CENTRE = (960, 590)  # of the arena, on the canvas
GO = 0.7  # seconds for which GO! is shown
POP = 0.16  # seconds in which a sign shrinks to its final size
POPS = 5  # cached sizes of each sign
HUGE = 300
LEVELS = 8  # brightnesses of a fading sign
OUTLINE = 14  # px of black outline
CLEAR_X, CLEAR_Y = 390, 290  # px of clearance between a number and a robot with its caption
SHIFTS = sorted(((x, y) for x in range(-480, 481, 60) for y in range(-180, 181, 60)), key=lambda at: math.hypot(*at))


class Countdown:
    """Blocks motion while it runs. `step`: seconds per number; `lead`: seconds before the first."""

    def __init__(self, step: float = 1.0, lead: float = 0.0) -> None:
        self.restart(step, lead)

    def restart(self, step: float, lead: float = 0.0) -> None:
        """Begin anew."""
        self.step, self.seconds_left, self.since = step, 3 * step + lead, 0.0
        self.number = 4

    def skip_lead(self) -> None:
        """Begin with the first number now."""
        self.seconds_left = min(self.seconds_left, 3 * self.step)

    @property
    def locked(self) -> bool:
        """True while robots may not move."""
        return self.seconds_left > 0.0

    @property
    def shown(self) -> bool:
        """True while there is a sign to draw."""
        return self.locked or self.since < GO

    def update(self, seconds: float) -> str | None:
        """Advance by `seconds`; returns the name of the sound to play, if any."""
        if not self.locked:
            self.since += seconds
            return None
        self.seconds_left -= seconds
        if not self.locked:
            self.since = 0.0
            return "go"
        number = math.ceil(self.seconds_left / self.step)
        self.since += seconds
        if number < self.number:
            self.number, self.since = number, 0.0
            return "count" if number <= 3 else None
        return None

    def draw(self, screen: pygame.Surface, go: str, at: tuple[int, int] = CENTRE) -> None:
        """Draw the number, or the text `go`, centred on a canvas position."""
        pop = min(POPS - 1, int(self.since / POP * POPS))
        if not self.locked:
            if self.since < GO:
                level = LEVELS if self.since < GO / 2 else math.ceil(2 * LEVELS * (1 - self.since / GO))
                show(screen, popped(go, FOCUS, pop, level), at)
        elif self.number <= 3:
            show(screen, popped(str(self.number), ICE, pop), at)
            show(screen, arcs(self.number), at)


def signs(go: str, *ends: str) -> Iterator[Job]:
    """Jobs that build the signs of a match, in order of appearance.

    The ending signs are requested in a loop, which keeps them cached until needed.
    """
    for number in (3, 2, 1):
        yield partial(arcs, number)
        yield partial(_word, str(number), ICE)
    yield partial(_word, go, FOCUS)
    yield from (partial(_word, end, ALARM) for end in cycle(ends))


def popped(text: str, color: Color, pop: int, level: int = LEVELS) -> Sprite:
    """A huge word centred on (0, 0) with a black outline; larger for a smaller `pop`, 0..POPS - 1."""
    sign = _word(text, color)
    if pop < POPS - 1:
        scale = 1.0 + 0.7 * (1 - (pop + 1) / POPS) ** 2
        image = pygame.transform.smoothscale_by(sign.image, scale)  # 0.5 ms
        sign = Sprite(image, round(sign.dx * scale), round(sign.dy * scale))
    return sign if level == LEVELS else faded(sign, level / LEVELS)


@cached
@resumable
def _word(text: str, color: Color) -> Steps[Sprite]:
    edge = font("hero", HUGE).render(text, True, BLACK)
    w, h = edge.get_width() + 128, HUGE + 128
    out = pygame.Surface((w, h), pygame.SRCALPHA)
    top = h / 2 - baseline(text, "hero", HUGE) + CAPITALS * HUGE / 2
    for i in range(24):
        angle = i * math.tau / 24
        out.blit(edge, (64 + OUTLINE * math.cos(angle), top + OUTLINE * math.sin(angle)))
    yield
    light = yield from GlowCanvas(w, h).text(text, HUGE, w / 2, h / 2, color, "hero", "c").lit_steps(0.8)
    out.blit(light, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    yield
    return trim(out, w / 2, h / 2)


def clear_of(robots: Sequence[tuple[float, float]]) -> tuple[int, int]:
    """The position nearest to the arena's centre where a number covers no robot; the centre if there is none."""
    for dx, dy in SHIFTS:
        x, y = CENTRE[0] + dx, CENTRE[1] + dy
        if all(abs(x - robot[0]) > CLEAR_X or abs(y - robot[1]) > CLEAR_Y for robot in robots):
            return x, y
    return CENTRE


def show(screen: pygame.Surface, sign: Sprite, at: tuple[int, int] = CENTRE) -> None:
    """Draw a sign centred on a canvas position."""
    screen.blit(sign.image, (at[0] + sign.dx, at[1] + sign.dy), special_flags=pygame.BLEND_PREMULTIPLIED)


@cached
@resumable
def arcs(count: int) -> Steps[Sprite]:
    """Three arcs round a number, `count` of them lit."""
    half = 270
    ink = GlowCanvas(2 * half, 2 * half).set_transform(half, half)
    for i in range(3):
        start = -math.pi / 2 + i * math.tau / 3 + 0.14
        lit = i < count
        ink.arc(0, 0, 215, start, start + math.tau / 3 - 0.28, FOCUS if lit else (58, 54, 16), BOLD if lit else 4)
    yield
    image = yield from ink.sprite_steps(1.0)
    yield
    return trim(image, half, half)
