"""Particles, sounds, and rising words and times for the events of a race."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from pigaming_app.games.race.state import Race
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.particles import MAX_PARTICLES, Frame, Particle, Particles, fading, reel
from pigaming_app.scenes.views.race import sprites as race_signs
from pigaming_app.scenes.views.race.events import RaceEvent
from pigaming_app.scenes.views.race.ghost import Delta
from pigaming_app.scenes.views.race.hud_cards import GAIN, LOSS
from pigaming_app.scenes.views.race.lines import CHECKPOINT, sign_color
from pigaming_app.scenes.views.race.party.sprites import OIL, place_change
from pigaming_app.scenes.views.race.recovery import BEAM_LASTS, beam
from pigaming_app.scenes.views.view import Pose, SoundCue, ViewOptions, decimal
from pigaming_app.sim.world import DT, WIDTH
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, PLAYERS, SUB, WHITE, Color
from pigaming_app.ui.draw.layers import glyph, number_width
from pigaming_app.ui.draw.sprites import Batch, Sprite, put
from pigaming_app.ui.i18n import Words, signed

SOUNDS = {  # by event, the most important first
    "close": "photo_finish",
    "finish": "finish",
    "last_lap": "last_lap",
    "best": "best_lap",
    "lap": "lap",
    "void": "missed",
    "missed": "missed",
    "wrong": "wrong_way",
    "spin": "oil",
    "back": "back_on_track",
    "asked": "back_on_track",
    "resisted": "shield",
    "boost": "boost",
    "item": "pickup",
    "used": "drop",
    "up": "overtake",
    "slip": "slipstream",
    "mud": "mud",
}
BY_WEIGHT = list(SOUNDS)
LASTS, RISE = 1.7, 46.0  # s and px of an announcement
ABOVE = 70.0  # px from a robot to its announcement
HIGHEST = 170.0  # px from the upper edge of the arena to a robot, below which its announcements go below it
STACK_PITCH = 76.0  # px between stacked announcements


class RaceAnnouncement(NamedTuple):
    """Rises over a seat's robot: a sprite, or a number, with a star if it is a best time."""

    born: float
    seat: int
    sprite: Sprite | None
    text: str
    color: Color


class RaceAnnouncements:
    """Current announcements; overlapping ones are stacked."""

    def __init__(self) -> None:
        self.notes: list[RaceAnnouncement] = []

    def add(self, now: float, seat: int, text: str, color: Color, sprite: Sprite | None = None) -> None:
        """Start an announcement over a robot; a sprite replaces an earlier one of the same robot and text."""
        if sprite:
            self.notes = [note for note in self.notes if not (note.sprite and (note.seat, note.text) == (seat, text))]
        self.notes.append(RaceAnnouncement(now, seat, sprite, text, color))

    def draw(self, light: Batch, top: Batch, poses: Sequence[Pose], now: float, busy: set[int]) -> None:
        """Draw the live announcements, except over robots in `busy`, which show a sign."""
        self.notes = [note for note in self.notes if now - note.born < LASTS and note.seat not in busy]
        placed: list[tuple[float, float, float]] = []
        for note in self.notes:
            width = note.sprite.image.get_width() if note.sprite else number_width(note.text, SUB) + 70
            t = (now - note.born) / LASTS
            x = min(max(poses[note.seat][0], LEFT + width / 2), LEFT + WIDTH - width / 2)
            away = 1.0 if poses[note.seat][1] - TOP < HIGHEST else -1.0  # below a robot near the upper edge
            y = poses[note.seat][1] + away * (ABOVE + RISE * (1.0 - (1.0 - t) ** 2))
            while any(abs(x - px) < (width + w) / 2 and abs(y - py) < STACK_PITCH for px, py, w in placed):
                y += away * STACK_PITCH
            y = max(y, TOP + 60)
            placed.append((x, y, width))
            if note.sprite:
                put(top, note.sprite, x, y)
            else:
                _number(light, note, x, y)


def _number(light: Batch, note: RaceAnnouncement, x: float, y: float) -> None:
    width = number_width(note.text, SUB)
    if note.color == FOCUS:
        put(light, race_signs.gold_star(), x - width / 2 - 12, y)
        x += 26
    x -= width / 2
    for char in note.text:
        sprite, advance = glyph(char, SUB, note.color)
        put(light, sprite, x, y)
        x += advance


def sound_cues(events: Sequence[RaceEvent], state: Race) -> list[SoundCue]:
    """Sounds of the events: for each robot only the most important one; overtaking is heard in party only."""
    loudest: dict[int, str] = {}
    for event in events:
        if event.kind in SOUNDS and (event.kind != "up" or state.rules.party):
            loudest[event.seat] = min(loudest.get(event.seat, event.kind), event.kind, key=BY_WEIGHT.index)
    return [(SOUNDS[kind], seat, state.robots[seat].x) for seat, kind in loudest.items()]


class RaceEffects:
    """Adds the particles and announcements of events. `signs`: the sign of each line."""

    def __init__(
        self,
        particles: Particles,
        notes: RaceAnnouncements,
        options: ViewOptions,
        words: Words | None,
        signs: Sequence[int],
    ) -> None:
        self.particles, self.notes, self.options, self.words, self.signs = particles, notes, options, words, signs
        self.real: frozenset[int] = frozenset()  # seats of real robots
        self.back_at = [-1.0] * len(signs)  # time at which each robot was put back

    def show(self, event: RaceEvent, state: Race, ghost_delta: Delta | None) -> None:
        """Show one event; `ghost_delta`: the racer's time relative to the best lap ever."""
        particles, robot, racer = self.particles, state.robots[event.seat], state.racers[event.seat]
        x, y, color = LEFT + robot.x, TOP + robot.y, PLAYERS[event.seat]
        match event.kind:
            case "line":
                if (sign := self.signs[int(event.number)]) < CHECKPOINT:
                    particles.burst(x, y, sign_color(sign), 10, 40, 50)
                if int(event.number) != racer.line and not state.rules.party:
                    self._difference(event.seat, racer.delta if racer.delta_at == state.tick - 1 else None, ghost_delta)
            case "lap" if not racer.finished:
                self._say(event.seat, decimal(self.words, f"{event.number:.2f}"), ICE)
            case "best":
                if not racer.finished:
                    self._say(event.seat, decimal(self.words, f"{event.number:.2f}"), FOCUS)
                particles.burst(x, y, FOCUS, 16, 44, 80)
            case "last_lap" if self.words:
                self._say(event.seat, "lap", color, race_signs.notice(self.words("race.last_lap"), color, "flag"))
            case "missed" | "void":
                particles.burst(x, y, ALARM, 12, 44, 60)
            case "mud":
                spray(particles, x, y, 0.0, 9, 3.2)
            case "finish":
                self.celebrate(x, y, color)
            case "up" | "down" if state.rules.party and not racer.finished:
                self._say(
                    event.seat, "place", color, place_change(event.seat, event.kind == "up", f"{event.number:.0f}")
                )
            case "boost":
                back = robot.heading + math.pi
                particles.burst(x, y, FOCUS, 14, 40, 90, (back, 0.6))
            case "spin" | "resisted":
                particles.burst(x, y, OIL, 18, 40, 90)
            case "back" if event.seat not in self.real:
                self._appear(event.seat, x, y)
            case "item":
                particles.burst(x, y, FOCUS, 12, 44, 60)
            case "close":
                self.particles.burst(x, y, FOCUS, 30, 46, 150)  # of a close finish

    def celebrate(self, x: float, y: float, color: Color) -> None:
        """A cloud of chequered confetti."""
        particles = self.particles
        for tone in (color, WHITE):
            for _ in range(min(22, MAX_PARTICLES - len(particles.particles))):
                _fly(particles, x, y, 210.0, fading(race_signs.confetti, tone, particles.random.randrange(4)), 1.3)
        particles.burst(x, y, FOCUS, 14, 46, 130)
        if self.options.flashes != "off":
            particles.shock(x, y, color)
        if self.options.flashes == "full":
            particles.glow(x, y, color)

    def _appear(self, seat: int, x: float, y: float) -> None:
        """Beam of light on a robot that was put back on the track."""
        self.back_at[seat] = self.particles.clock
        if self.options.flashes != "off":
            self.particles.bloom(x, y, BEAM_LASTS, reel(beam, seat))

    def record(self, x: float, y: float) -> None:
        """Effects of a new best lap ever on this track."""
        self.particles.burst(x, y, FOCUS, 40, 46, 150)
        if self.options.flashes != "off":
            self.particles.shock(x, y, FOCUS)

    def _difference(self, seat: int, delta: float | None, ghost_delta: Delta | None) -> None:
        if delta is not None:
            self._say(seat, decimal(self.words, signed(delta * DT, 2)), GAIN if delta <= 0.0 else LOSS)
        elif ghost_delta:
            self._say(seat, decimal(self.words, signed(ghost_delta[0] * DT, 2)), FOCUS)

    def _say(self, seat: int, text: str, color: Color, sprite: Sprite | None = None) -> None:
        self.notes.add(self.particles.clock, seat, text, color, sprite)


def spray(particles: Particles, x: float, y: float, heading: float, count: int, spread: float) -> None:
    """Clods thrown up behind the wheels."""
    for _ in range(min(count, MAX_PARTICLES - len(particles.particles))):
        frame = fading(race_signs.clods, particles.random.choice(race_signs.CLODS))
        _fly(particles, x, y, 70.0, frame, 0.6, heading, spread)


def _fly(
    particles: Particles,
    x: float,
    y: float,
    reach: float,
    frame: Frame,
    life: float,
    heading: float = 0.0,
    spread: float = 3.2,
) -> None:
    a = heading + particles.random.uniform(-spread, spread)
    c, s, far = math.cos(a), math.sin(a), reach * particles.random.uniform(0.3, 1.0)
    life *= particles.random.uniform(0.6, 1.0)
    particles.particles.append(Particle(particles.clock, life, x + 34 * c, y + 34 * s, far * c, far * s, frame))
