"""The cards over a race, in running order, and its clock; baked into the ground whenever what they say changes.

The clock counts up; once somebody has finished it counts down what the others have left.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import pygame

from pigaming_app.ai import BRAINS
from pigaming_app.games.race.state import LINES, Race
from pigaming_app.scenes.frame_budget import Job
from pigaming_app.scenes.ink import ALARM, BODY, FOCUS, ICE, MIST, SUB, TITLE, WHITE, Color, Ink
from pigaming_app.scenes.surface_cache import cached
from pigaming_app.scenes.things import glyph, number_width
from pigaming_app.scenes.views import race_cards
from pigaming_app.scenes.views.ground import Ground
from pigaming_app.scenes.views.hud import number_bits
from pigaming_app.scenes.views.picture import Words
from pigaming_app.scenes.views.race_cards import FOOT, GAIN, LOSS, Card, H, W, Y, card_bits
from pigaming_app.scenes.views.race_happenings import SHOWN_FROM
from pigaming_app.sim.world import DT, HZ

PLACES = {1: (520,), 2: (520, 1048), 3: (160, 520, 1048), 4: (160, 520, 1048, 1408)}
HIGH = 138  # px of the canvas that the cards may use
TELLS = int(2.5 * HZ)  # ticks for which a difference is shown
MOVED = int(1.2 * HZ)  # ticks for which an arrow says that the order has changed
Delta = tuple[float, int]  # ticks, and the tick at which it came


class Cards:
    """Keeps the ground saying what the race says. `players`: who sits where; names in BRAINS are marked as AI."""

    def __init__(self, ground: Ground, state: Race, players: list[str], words: Words | None) -> None:
        self.ground, self.players = ground, players
        seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.xs = PLACES[len(seats)]
        self.endings = [words(f"race.place_{i + 1}") if words else "" for i in range(LINES)]
        self.said: dict[object, object] = {}
        self.moves: dict[int, tuple[int, int]] = {}  # seat: which way it went, at which tick

    def moved(self, seat: int, ahead: bool, tick: int) -> None:
        """A robot has gone ahead or fallen back."""
        self.moves[seat] = (1 if ahead else -1), tick

    def show(self, state: Race, order: Sequence[int], golden: Mapping[int, Delta]) -> None:
        """Bake what has changed. `golden`: for each seat the difference to the best lap ever."""
        for i, (seat, x) in enumerate(zip(order, self.xs, strict=True)):
            card = self._card(state, seat, i + 1, golden.get(seat))
            if self.said.get(x) != card:
                self.ground.bake(pygame.Rect(x - 8, 0, W + 16, HIGH), card_bits(card, x))
                self.said[x] = card
        left = _left(state)
        clock = ("left", left) if left is not None else ("time", state.tick // HZ)
        if self.said.get("clock") != clock:
            self._bake_clock(*clock)
            self.said["clock"] = clock

    def jobs(self, state: Race) -> Iterator[Job]:
        """The pieces of the cards, each made by one small job."""
        for seat in (i for i, robot in enumerate(state.robots) if robot.present):
            yield partial(race_cards.pulse, seat)
            for alarm, done in ((False, False), (True, False), (False, True)):
                yield partial(race_cards.frame, seat, self._ai(seat), alarm, done)
            for full in (True, False):
                yield partial(race_cards.turbo, seat, full)
                yield partial(race_cards.foot, seat, state.rules.laps, full)
        for char in "0123456789:":
            yield from (partial(glyph, char, SUB, color) for color in (ICE, ALARM))
        for char in "1234":
            yield from (partial(glyph, char, TITLE, color) for color in (WHITE, FOCUS, ICE))
        for char in "0123456789.+−–/":
            yield from (partial(glyph, char, BODY, color) for color in (ICE, MIST, FOCUS, GAIN, LOSS))
        for line in range(LINES):
            yield partial(race_cards.missed_mark, line)
            yield from (partial(race_cards.word, self.endings[line], color) for color in (WHITE, FOCUS))
        for flag in (True, False):
            yield partial(race_cards.signs, flag)
            yield partial(race_cards.mover, flag)
        yield from (race_cards.wrong_mark, small_flag)

    def _ai(self, seat: int) -> bool:
        return self.players[seat] in BRAINS.get("race", {})

    def _card(self, state: Race, seat: int, place: int, golden: Delta | None) -> Card:
        racer, robot, laps = state.racers[seat], state.robots[seat], state.rules.laps
        went, when = self.moves.get(seat, (0, -MOVED))
        done = bool(racer.finished)
        share = racer.progress / (laps * state.course.length)
        return Card(
            seat=seat,
            ai=self._ai(seat),
            place=place,
            ending=self.endings[place - 1],
            lap=f"{min(laps, robot.score + 1)}/{laps}",
            first=_first(state, seat, golden),
            last=_time(racer.last_lap),
            best=_time(racer.best_lap),
            turbo=round(64 * robot.turbo),
            way=FOOT if done else round(FOOT * max(0.0, min(1.0, share))),
            laps=laps,
            sign="" if done else "missed" if racer.missed else "wrong" if racer.wrong > SHOWN_FROM else "",
            missed=racer.missed - 1,
            moved=went if state.tick - when < MOVED else 0,
            done=done,
        )

    def _bake_clock(self, kind: str, seconds: int) -> None:
        text = f"{seconds // 60}:{seconds % 60:02}" if kind == "time" else str(seconds)
        lead = 0 if kind == "time" else 58
        x = 960 - (number_width(text, SUB) + lead) / 2
        bits = number_bits(text, SUB, x + lead, Y + H / 2, ICE if kind == "time" else ALARM)
        if lead:
            bits.append((small_flag(), (round(x) - 28, Y + H // 2 - 52), None))
        self.ground.bake(pygame.Rect(872, 0, 176, HIGH), bits)


def _left(state: Race) -> int | None:
    """The seconds that those have left who have not finished, once somebody has."""
    racing = any(robot.present and not one.finished for robot, one in zip(state.robots, state.racers, strict=True))
    if not state.first or not racing:
        return None
    return max(0, -(-(state.first + state.rules.patience - state.tick) // HZ))


def _first(state: Race, seat: int, golden: Delta | None) -> tuple[str, Color]:
    """The time of this lap; for a moment after a line, how much it is better or worse; in the end, that of the race."""
    racer = state.racers[seat]
    if racer.finished:
        return f"{racer.finish * DT:.2f}", ICE
    if racer.delta_at and state.tick - racer.delta_at < TELLS:
        return signed(racer.delta), GAIN if racer.delta <= 0.0 else LOSS
    if golden and state.tick - golden[1] < TELLS:
        return signed(golden[0]), FOCUS
    return f"{(state.tick - racer.lap_began) * DT if racer.passed else 0.0:.1f}", ICE


def signed(ticks: float) -> str:
    """A difference of so many ticks, in seconds."""
    hundredths = round(100 * ticks * DT)
    return f"{'−' if hundredths < 0 else '+'}{abs(hundredths) / 100:.2f}"


def _time(ticks: float) -> str:
    return f"{ticks * DT:.2f}" if ticks > 0.0 else "–"


@cached
def small_flag() -> pygame.Surface:
    """The flag beside the clock once somebody has finished."""
    ink = Ink(104, 104)
    race_cards.flag(ink, 50, 52, 20, WHITE)
    return ink.lit(0.7)
