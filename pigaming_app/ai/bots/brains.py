"""Bots as brains: `bot:NAME` wherever an AI is named. A seat whose bot is silent stands still, then an AI takes it."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from pigaming_app.ai.bots.book import PREFIX, BotBook
from pigaming_app.ai.bots.line import HELD, BotLine, SeatOfMatch, Serving, next_match
from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer
from pigaming_app.ai.game_ai import STAND_IN, GameAI
from pigaming_app.games.setup import ChoiceError
from pigaming_app.sim.action import set_action
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, World
from pigaming_app.storage.settings import NoHome, folders

PATIENCE = 3 * HZ  # ticks without a command that holds, after which an AI takes the seat, until the match is over
MISSES = 10  # decisions in a row, after which it does so where matches wait for them
RETURNS = 10.0  # s in which a bot may connect again there

log = logging.getLogger("pigaming")


@record
class BotMind:
    """A match by its number."""

    random: int
    match: int


@dataclass
class BotSeat:
    """One seat of one match."""

    silent: int = 0  # ticks, or decisions where matches wait for them
    stand_in: BrainPlayer | None = None


_service = Serving.CLOSED  # of lines to come


def book() -> BotBook:
    """The bots of this computer."""
    return _book(folders().config)


def known() -> Mapping[str, str]:
    """The keys of the bots by name; none for a user without a folder of their own."""
    try:
        return book().keys
    except NoHome:
        return {}


@cache
def _book(folder: Path) -> BotBook:
    return BotBook(folder)


@cache
def line_of(name: str) -> BotLine:
    """The line to a bot."""
    return BotLine(_service)


def serve(service: Serving) -> None:
    """Matches of this process treat all bots so from now on."""
    global _service
    _service = service
    for name in known():
        line_of(name).service = service


def bots(game: str, ai: GameAI) -> Mapping[str, BrainKind]:
    """The bots as players of a game, by name; connected or not."""
    return {PREFIX + name: _kind(game, name, ai.kinds[STAND_IN]) for name in known()}


def connected() -> list[str]:
    """The names of the bots that are connected, in alphabetical order."""
    return [PREFIX + name for name in sorted(known()) if line_of(name).connected]


@cache
def _kind(game: str, name: str, stand_in: BrainKind) -> BrainKind:
    line, seats = line_of(name), dict[SeatOfMatch, BotSeat]()

    def reset(mind: BotMind, seed: int) -> None:
        mind.match = next_match()

    def think(state: World, seat: int, mind: BotMind, weights: Any) -> None:
        place = SeatOfMatch(mind.match, seat)
        own = seats.get(place)
        if own is None:
            own = seats[place] = BotSeat()
            if len(seats) > HELD:
                del seats[next(iter(seats))]
        if own.stand_in:
            own.stand_in.think(state, seat)  # type: ignore[arg-type]
            return
        if line.service is Serving.CLOSED:
            raise ChoiceError(f"{PREFIX}{name} plays in the arcade, in play, duel, league and event run only")
        waits = line.service is Serving.PATIENT
        gone = waits and not line.wait(RETURNS)
        if command := line.decide(place, game, state):
            own.silent = 0
            fire, turbo = int(command.fire), int(command.turbo)
            set_action(state.actions[seat], command.linear, command.angular, fire, turbo)
            return
        set_action(state.actions[seat], 0.0, 0.0, 0, 0)
        own.silent += 1
        if gone or own.silent >= (MISSES if waits else PATIENCE):
            log.warning("bot %s is %s: %s takes its seat", name, "gone" if gone else "silent", STAND_IN)
            own.stand_in = BrainPlayer(stand_in, mind.random)

    return BrainKind(PREFIX + name, BotMind, think, reset, plain=True)
