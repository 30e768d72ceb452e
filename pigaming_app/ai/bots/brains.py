"""Bots as brains: `bot:NAME` wherever an AI is named. A seat whose bot is silent stands still, then an AI takes it."""

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from pigaming_app.ai.bots import view
from pigaming_app.ai.bots.book import PREFIX, BotBook
from pigaming_app.ai.bots.line import FRESH, BotLine, SeatOfMatch, next_match
from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer
from pigaming_app.ai.game_ai import STAND_IN, GameAI
from pigaming_app.sim.action import set_action
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, World
from pigaming_app.storage.settings import folders

HELD = 2000  # seats of matches that are played at the same time, at most
PATIENCE = 3 * HZ  # ticks of silence in a row after which an AI takes the seat, until the match is over

log = logging.getLogger("pigaming")


@record
class BotMind:
    """A match by its number."""

    random: int
    match: int


@dataclass
class BotSeat:
    """One seat of one match."""

    connection: int = 0  # by which the bot was told of the match
    standing: tuple[int, ...] = ()  # the layout that it knows
    silent: int = 0  # ticks
    stand_in: BrainPlayer | None = None


def book() -> BotBook:
    """The bots of this computer."""
    return _book(folders().config)


@cache
def _book(folder: Path) -> BotBook:
    return BotBook(folder)


@cache
def line_of(name: str) -> BotLine:
    """The line to a bot."""
    return BotLine()


def bots(game: str, ai: GameAI) -> Mapping[str, BrainKind]:
    """The bots as players of a game, by name; connected or not."""
    return {PREFIX + name: _kind(game, name, ai.kinds[STAND_IN]) for name in book().keys}


def connected() -> list[str]:
    """The names of the bots that are connected, in alphabetical order."""
    return [PREFIX + name for name in sorted(book().keys) if line_of(name).connected]


@cache
def _kind(game: str, name: str, stand_in: BrainKind) -> BrainKind:
    line, seats = line_of(name), dict[SeatOfMatch, BotSeat]()

    def reset(mind: BotMind, seed: int) -> None:
        mind.match = next_match()

    def think(state: Any, seat: int, mind: BotMind, weights: Any) -> None:
        place = SeatOfMatch(mind.match, seat)
        own = seats.get(place)
        if own is None:
            own = seats[place] = BotSeat()
            if len(seats) > HELD:
                del seats[next(iter(seats))]
        if own.stand_in:
            own.stand_in.think(state, seat)
            return
        _tell(line, game, own, state, place)
        command = line.decide(place, state)
        if command:
            own.silent = 0
            fire, turbo = int(command.fire), int(command.turbo)
            set_action(state.actions[seat], command.linear, command.angular, fire, turbo)
            return
        set_action(state.actions[seat], 0.0, 0.0, 0, 0)
        own.silent += FRESH if line.patient else 1
        if own.silent >= PATIENCE:
            log.warning("bot %s is silent: %s takes its seat", name, STAND_IN)
            own.stand_in = BrainPlayer(stand_in, mind.random)

    return BrainKind(PREFIX + name, BotMind, think, reset, plain=True)


def _tell(line: BotLine, game: str, own: BotSeat, state: World, place: SeatOfMatch) -> None:
    """Tell the bot of the match, or of walls that have changed, if it does not know."""
    standing = view.standing(state)
    if line.connection != own.connection:
        line.begin(place, game, state)
    elif standing != own.standing:
        line.changed(place, state)
    own.connection, own.standing = line.connection, standing
