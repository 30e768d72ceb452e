"""Race HUD: cards in running order and a clock, baked into the background when their content changes.

The clock counts up; once a robot has finished it counts down the time left for the others.
"""

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import pygame

from pigaming_app.games.race.state import LINES, Race
from pigaming_app.scenes.views.background import Background, Bit
from pigaming_app.scenes.views.hud.ai_sign import ai_of, name_of
from pigaming_app.scenes.views.hud.parts import CLOCK, XS, H, HudParts, Y, drawn, pulse, word_bits
from pigaming_app.scenes.views.hud.parts import clock_bits as digits
from pigaming_app.scenes.views.race.events import drives_wrong
from pigaming_app.scenes.views.race.hud_cards import FLASH, RaceCard, W, card_bits
from pigaming_app.scenes.views.race.lines import flag, line_signs
from pigaming_app.scenes.views.view import decimal
from pigaming_app.sim.world import DT, HZ
from pigaming_app.ui.draw import ALARM, ICE, LABEL, PLAYERS, WHITE, GlowCanvas, readable
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.layers import wrap, wrap_balanced
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words, signed

MOVED = int(1.2 * HZ)  # ticks for which an arrow marks a change of place
ANNOUNCED = int(2.5 * HZ)  # ticks for which words stand in place of the clock
ICONS = ("", "speed", "shield", "oil")  # of `Racer.item`
EVERY = 25  # ticks between two readings, so that the tenths are readable


class RaceHud:
    """Keeps the HUD up to date. `players`: driver of each seat; AIs are marked."""

    def __init__(self, background: Background, state: Race, players: list[str], words: Words | None) -> None:
        self.background, self.players, self.words = background, players, words
        self.gaps, self.signs = Gaps(state), line_signs(state)
        seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.seats, self.xs = seats, XS[len(seats)]
        self.parts = HudParts(background)
        self.moves: dict[int, tuple[int, int]] = {}  # seat: (direction, tick) of its last change of place
        self.names: Sequence[str] = ()  # by seat; of entrants, or of phones
        self.notice = "", 0  # words in place of the clock, and their first tick

    def moved(self, seat: int, ahead: bool, tick: int) -> None:
        """Record a change of place."""
        self.moves[seat] = (1 if ahead else -1), tick

    def announce(self, text: str, tick: int) -> None:
        """Show words in place of the clock for a while."""
        self.notice = announced(text), tick

    def follow(self, state: Race) -> None:
        """Record the positions after this tick."""
        self.gaps.follow(state)

    def show(self, state: Race, order: Sequence[int]) -> None:
        """Bake changed parts."""
        for i, (seat, x) in enumerate(zip(order, self.xs, strict=True)):
            card = self._card(state, seat, i + 1)
            self.parts.show(x, card, x - 8, W + 16, partial(card_bits, card, x))
        lines, begin = self.notice
        if lines and begin <= state.tick < begin + ANNOUNCED:
            self.parts.show("clock", lines, CLOCK.x, CLOCK.w, partial(word_bits, lines))
            return
        left = _left(state)
        clock = ("left", left) if left is not None else ("time", state.tick // HZ)
        self.parts.show("clock", clock, CLOCK.x, CLOCK.w, partial(clock_bits, *clock))

    def jobs(self, state: Race) -> Iterator[Job]:
        """Prewarm jobs: samples of cards and clock."""
        party = bool(state.rules.party)
        for i in range(10):
            yield from (drawn(clock_bits, kind, 60 * i + i) for kind in ("time", "left"))
        for seat in self.seats:
            yield partial(pulse, PLAYERS[seat], W, H, FLASH)
            card = replace(self._card(state, seat, 1), turbo=32)
            changes: list[dict[str, Any]] = [{"sign": "wrong"}, {"done": True}, {"moved": 1}, {"moved": -1}]
            changes += [{"sign": "missed", "missed": sign} for sign in self.signs]
            changes += [{"item": icon, "slip": True} for icon in ICONS if party]
            changes += [{"lap": i, "gap": decimal(self.words, figure(1.1 * i))} for i in range(10)]
            changes += [{"place": i + 1} for i in range(LINES)]
            yield from (drawn(card_bits, replace(card, **change), 0) for change in changes)
        if party and self.words:
            yield drawn(word_bits, announced(self.words("race.last_lap")))

    def _card(self, state: Race, seat: int, place: int) -> RaceCard:
        racer, robot, laps = state.racers[seat], state.robots[seat], state.rules.laps
        direction, changed_at = self.moves.get(seat, (0, -MOVED))
        done = bool(racer.finished)
        sign = "" if done else "missed" if racer.missed else "wrong" if drives_wrong(racer) else ""
        return RaceCard(
            seat=seat,
            brain=ai_of(self.players[seat]),
            place=place,
            lap=min(laps, robot.score + 1),
            gap="" if place == 1 else decimal(self.words, figure(self._gap(state, seat))),
            turbo=round(64 * robot.turbo),
            laps=laps,
            sign=sign,
            missed=self.signs[racer.missed - 1],
            moved=direction if state.tick - changed_at < MOVED else 0,
            done=done,
            item=ICONS[racer.item] if state.rules.party and not done and not sign else "none",
            slip=bool(racer.slip) and not done,
            name=name_of(self.names, seat),
        )

    def _gap(self, state: Race, seat: int) -> float:
        return self.gaps.gap(state, seat) if state.racers[seat].finished else self.gaps.shown[seat]


def announced(text: str) -> str:
    """An announcement in place of the clock; | parts lines."""
    size = readable(LABEL)
    return "|".join(wrap_balanced(text, min(2, len(wrap(text, size, CLOCK.w - 16, "head"))), size, "head"))


def clock_bits(kind: str, seconds: int) -> list[Bit]:
    """Race time or, beside a flag, the time left for the others."""
    text = f"{seconds // 60}:{seconds % 60:02}" if kind == "time" else str(seconds)
    lead = 0 if kind == "time" else 76
    bits = digits(text, Y + H / 2, ICE if kind == "time" else ALARM, lead)
    if lead:
        bits.append((small_flag(), (bits[0][1][0] - lead - 4, Y + H // 2 - 60), None))
    return bits


def _left(state: Race) -> int | None:
    """Seconds left for the unfinished robots, once one has finished."""
    racing = any(robot.present and not racer.finished for robot, racer in zip(state.robots, state.racers, strict=True))
    if not state.first or not racing:
        return None
    return max(0, -(-(state.first + state.rules.patience - state.tick) // HZ))


@cached
def small_flag() -> pygame.Surface:
    """Flag beside the clock once a robot has finished."""
    ink = GlowCanvas(120, 120)
    flag(ink, 58, 60, 28, WHITE)
    return ink.lit(0.7)


class Gaps:
    """Keeps the leading distance of every tick of a race."""

    def __init__(self, state: Race) -> None:
        self.began = state.tick
        self.reached: list[float] = []  # px, leading distance at each tick
        self.shown = [0.0] * len(state.robots)
        self.follow(state)

    def follow(self, state: Race) -> None:
        """Record this tick; refresh the gaps every EVERY ticks."""
        farthest = max(racer.progress for racer, robot in zip(state.racers, state.robots, strict=True) if robot.present)
        while len(self.reached) <= state.tick - self.began:
            self.reached.append(max(farthest, self.reached[-1] if self.reached else farthest))
        if state.tick % EVERY == 0:
            self.shown = [self.gap(state, seat) for seat in range(len(state.robots))]

    def gap(self, state: Race, seat: int) -> float:
        """Gap to the leader in s; after the finish, to the winner."""
        racer = state.racers[seat]
        if racer.finished:
            first = min(other.finish for other in state.racers if other.finished)
            return (racer.finish - first) * DT
        return (len(self.reached) - 1 - bisect_left(self.reached, racer.progress)) * DT


def figure(seconds: float) -> str:
    """A gap in at most four characters: tenths below ten seconds, whole seconds above."""
    tenths = round(10 * max(0.0, seconds))
    return signed(tenths / 10, 1) if tenths < 100 else signed(seconds)
