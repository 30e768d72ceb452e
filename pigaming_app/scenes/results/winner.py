"""The winner's moment before the results, or another scene: three seconds for the robot, its colour and its name.

The robots that came first drive in, a crown lands on them, confetti flies. A tie shows all of them, without a crown;
allies get their stars. Any player may skip it after a second.
"""

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Protocol

import pygame

from pigaming_app.games.game import Outcome
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, Scene, StackOperation, Swap
from pigaming_app.scenes.results.celebration import SIZES, TUMBLES, Celebration, confetti
from pigaming_app.scenes.results.headline import EndedMatch, headline, winning_color
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.sprites.effects import SPARK_SIZES, SPARK_TURNS, sparks
from pigaming_app.scenes.views.sprites.robot import robot
from pigaming_app.scenes.views.sprites.stars import STARS, star
from pigaming_app.scenes.views.sprites.teams import TEAMS
from pigaming_app.scenes.views.view import ShownEffects
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import PrewarmQueue, Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, backdrop, fit_size
from pigaming_app.ui.draw.sprites import Sprite, trim
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.theme import CAPITALS, line_image
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import blit_sprite

LENGTH, SKIP = 3.0, 1.0  # s, and s after which it may be skipped
ARRIVED, CROWNED = 0.5, 0.8  # s at which the robots and the crown are there
VOLLEYS, BURSTS = (0.5, 1.25), (0.5, 0.8, 1.4, 2.1)  # s, of confetti and of sparks
HOPS, HOP = 1.6, 34.0  # hops in a second, and px of their height
PREWARM_MS = 4.0
MIDDLE = (960, 470)  # px, of the robots
NAME_Y, PROMPT_Y = 838, 984
SCALES = {1: (4.4, 0), 2: (3.5, 520), 3: (2.9, 460), 4: (2.4, 400)}  # scale of so many robots, and px between them
BARREL, RING = 64.0, 54.0  # px, before scaling: from a robot's centre to its muzzle; radius of the ring round it
RAYS, RAY_PARTS, RAY_FLAT = 48, 5, 0.62  # rays, dashes of each, and their height relative to their width
NAME_W, MOST_W = 1640, 1800  # px, of the headline; with its outline and glow, as it appears
OUTLINE = 12  # px, black outline of the headline
POPS, POP = 4, 0.12  # cached sizes of the headline as it appears, and s that it takes
STAR_R, STAR_PITCH = 58, 170  # px
STAR_RISE, STAR_TOP = 96, 112  # px, of the stars above the muzzles, and their least y
UP = -math.pi / 2

Rings = tuple[tuple[int, float, float, float], ...]  # of each robot: player, x, y, radius


class AfterMatch(Scene, Protocol):
    """A scene that follows a match."""

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the scene for at most this many milliseconds; True when complete."""


class WinnersMoment:
    """The moment after the match `ended`, before the scene `then`."""

    def __init__(self, context: Context, ended: EndedMatch, then: AfterMatch) -> None:
        self.context, self.ended, self.then = context, ended, then
        self.outcome, self.setup = ended.outcome, ended.setup
        stars = self.outcome.rows[0].stats.get("stars")
        self.stars = None if stars is None else round(stars)  # of allies
        self.seats = celebrated(self.outcome)
        self.scale, pitch = SCALES[len(self.seats)]
        half = (len(self.seats) - 1) / 2
        self.places = [(MIDDLE[0] + pitch * (i - half), MIDDLE[1]) for i in range(len(self.seats))]
        self.color = winning_color(self.outcome, self.setup)
        self.name = headline(context.words, ended)
        self.size = fit_size(self.name, kit.HERO * 3 // 4, NAME_W, "hero")
        self.celebration = Celebration(self.setup.game, self.seats, self._colors())
        cheerful = self.stars != 0
        self.volleys = [*VOLLEYS] if cheerful else []
        self.bursts = [*BURSTS] if cheerful and ShownEffects(context.settings).flashes != "off" else []
        self.age = 0.0
        self.queue = PrewarmQueue(self._jobs())
        self.access = Access(context, lambda: ended.devices)
        hints = [(Button.FIRE, "results.hint_skip")]
        self.prompts = context.prompts(hints, PROMPT_Y, device=lambda: self.access.hint_device)

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the pictures for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        self.context.sounds.play(self._sound())

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE, START, BACK or a click skips it after a second."""
        admitted = self.access.admit(self.prompts.as_button(event))
        skips = admitted and admitted.button in (Button.FIRE, Button.START, Button.BACK, Button.CLICK)
        return Swap(self.then) if skips and self.age >= SKIP else None

    def update(self, seconds: float) -> StackOperation:
        """Animate; then the next scene, as soon as it is rendered."""
        self.age += seconds
        self.celebration.update(seconds)
        while self.bursts and self.bursts[0] <= self.age:
            self.bursts.pop(0)
            for seat, (x, y) in zip(self.seats, self.places, strict=True):
                self.celebration.burst(x, y - (BARREL + 10) * self.scale, kit.PLAYERS[seat])
        while self.volleys and self.volleys[0] <= self.age:
            self.volleys.pop(0)
            self.celebration.volley()
        ready = self.then.prewarm(PREWARM_MS)
        return Swap(self.then) if ready and self.age >= LENGTH else None

    def draw(self, screen: pygame.Surface) -> None:
        since = self.age - ARRIVED
        screen.blit(backdrop(), (0, 0))
        if since >= 0.0:
            rays(self.color, self._rings()).draw(screen)
        self.celebration.draw(screen)
        happy = since >= 0.0 and self.stars != 0 and self.outcome.winners
        hop = HOP * abs(math.sin(math.pi * HOPS * since)) if happy else 0.0
        for seat, (x, y) in zip(self.seats, self.places, strict=True):
            below = (1080.0 + BARREL * self.scale - y) * (1.0 - eased(self.age / ARRIVED))
            blit_sprite(screen, big_robot(seat, self.scale), x, y + below - hop)
        if since >= 0.0:
            self._award(screen, since)
            pop = min(POPS - 1, int(since / POP * POPS))
            blit_sprite(screen, popped(self.name, self.size, self.color, pop), MIDDLE[0], NAME_Y)
        if self.age >= SKIP:
            self.prompts.draw(screen)

    # ---- inside

    def _award(self, screen: pygame.Surface, since: float) -> None:
        """Draw the falling crown, or the stars of allies, `since` s after the arrival."""
        y = MIDDLE[1] - (BARREL + 14) * self.scale
        if self.stars is not None:
            y = max(STAR_TOP, y - STAR_RISE)
            for i in range(STARS):
                left = 1.0 - (since - 0.3 * i) / 0.25
                lit = i < self.stars and left < 1.0
                x = MIDDLE[0] + STAR_PITCH * (i - (STARS - 1) / 2)
                star(lit, STAR_R).draw(screen, x, y - (140 * max(0.0, left) ** 2 if lit else 0.0))
        elif self.outcome.winners:
            left = max(0.0, 1.0 - since / (CROWNED - ARRIVED))
            crown().draw(screen, MIDDLE[0], y - 200 * left**2)

    def _rings(self) -> Rings:
        return tuple((seat, x, y, RING * self.scale) for seat, (x, y) in zip(self.seats, self.places, strict=True))

    def _colors(self) -> list[kit.Color]:
        """Colours of the confetti."""
        if SCREENS[self.setup.game].team_colors:
            return [TEAMS[self.setup.seats[seat].team % len(TEAMS)] for seat in self.seats]
        return [kit.PLAYERS[seat] for seat in self.seats]

    def _sound(self) -> str:
        """The sound of a victory, of a tie, or of people who have lost to AIs or to the clock."""
        people, winners = set(self.ended.humans), set(self.outcome.winners)
        if self.stars is None and not winners:
            return "tie"
        return "lose" if self.stars == 0 or (people and not people & winners) else "fanfare"

    def _jobs(self) -> Iterator[Callable[[], object]]:
        """Jobs that build the pictures, in order of appearance."""
        yield backdrop
        for seat in self.seats:
            yield partial(big_robot, seat, self.scale)
        yield partial(rays, self.color, self._rings())
        for pop in reversed(range(POPS)):
            yield partial(popped, self.name, self.size, self.color, pop)
        yield crown
        if self.stars is not None:
            yield partial(star, False, STAR_R)
            yield partial(star, True, STAR_R)
        for seat in self.seats if self.bursts else ():
            for size in SPARK_SIZES:
                for turn in range(SPARK_TURNS):
                    yield partial(sparks, kit.PLAYERS[seat], size, turn)
        for shape in self.seats:
            for color in dict.fromkeys(self.celebration.colors):
                for size in SIZES:
                    for tumble in range(TUMBLES):
                        yield partial(confetti, self.setup.game, shape, color, size, tumble)


def celebrated(outcome: Outcome) -> list[int]:
    """The seats of the winning team, or of all who share the first place."""
    return sorted(outcome.winners or [row.seat for row in outcome.rows if row.place == 1])


def eased(share: float) -> float:
    """Share of the way after a share of the time: ends slowly, after a little overshoot."""
    left = min(1.0, share) - 1.0
    return 1.0 + 2.2 * left**3 + 1.2 * left**2


@cached
@resumable
def rays(color: kit.Color, rings: Rings) -> Steps[LitImage]:
    """Rays of light in `color`, and a ring round each robot."""
    layer = Layer(60, 60, 1800, 960)
    x, y = MIDDLE
    for i in range(RAYS):
        a = (i + 0.5) * math.tau / RAYS
        near, far = (420, 560) if i % 2 else (380, 900)
        for k in range(RAY_PARTS):
            reach = [near + (far - near) * share / RAY_PARTS for share in (k, k + 0.7)]
            ends = [(x + r * math.cos(a), y + RAY_FLAT * r * math.sin(a)) for r in reach]
            layer.glow.line(ends, kit.dim(color, 0.42 * (1 - k / RAY_PARTS)), kit.THIN)
    for player, ring_x, ring_y, r in rings:
        for i in range(3):
            start = UP + 0.3 + i * math.tau / 3
            layer.glow.arc(
                ring_x, ring_y, r, start, start + math.tau / 3 - 0.6, kit.dim(kit.PLAYERS[player], 0.75), kit.LINE
            )
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def big_robot(player: int, scale: float) -> Steps[Sprite]:
    """A robot that heads up the screen."""
    half = round(84 * scale)
    ink = robot(kit.GlowCanvas(2 * half, 2 * half), player, half, half, UP, scale)
    yield
    image = yield from ink.sprite_steps(0.9)
    yield
    return trim(image, half, half)


@cached
@resumable
def title(text: str, size: int, color: kit.Color) -> Steps[Sprite]:
    """The headline centred on (0, 0), with a black outline against the confetti behind it."""
    edge = line_image(text, "hero", size, kit.BLACK)
    w, h = edge.get_width() + 96, round(1.5 * size) + 64
    out = pygame.Surface((w, h), pygame.SRCALPHA)
    top = h / 2 - kit.font("hero", size).get_ascent() + CAPITALS * size / 2
    for i in range(16):
        angle = i * math.tau / 16
        out.blit(edge, (48 + OUTLINE * math.cos(angle), top + OUTLINE * math.sin(angle)))
    yield
    light = yield from kit.GlowCanvas(w, h).text(text, size, w / 2, h / 2, color, "hero", "c").lit_steps(0.5)
    out.blit(light, (0, 0), special_flags=kit.ADD)
    yield
    return trim(out, w / 2, h / 2)


@cached
def popped(text: str, size: int, color: kit.Color, pop: int) -> Sprite:
    """The headline, larger for a smaller `pop`, 0..POPS - 1."""
    whole = title(text, size, color)
    if pop == POPS - 1:
        return whole
    room = MOST_W / whole.image.get_width() - 1.0
    scale = 1.0 + max(0.0, min(0.25, room)) * (1.0 - (pop + 1) / POPS)
    image = pygame.transform.smoothscale_by(whole.image, scale)
    return Sprite(image, round(whole.dx * scale), round(whole.dy * scale))


@cached
def crown() -> LitImage:
    """The crown centred on (0, 0)."""
    ink = kit.GlowCanvas(200, 160).set_transform(100, 80)
    return LitImage(kit.icon(ink, "crown", 0, 0, 52, kit.FOCUS, kit.LINE).lit(), (-100, -80))
