"""Replay files: setup, arena, engine hash, the actions of every seat on every tick, digest of the final state.

The file is one line of JSON (the head) and the ticks, column by column and compressed. A column is one byte of one
seat; it rarely changes, so a two-minute match takes a few kilobytes. Decoding validates everything: a truncated, edited
or foreign file raises a ReplayError of one line.
"""

import hashlib
import json
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from msgspec import Meta

from pigaming_app.games.arenas import parse
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.game import Setup
from pigaming_app.games.match import Match
from pigaming_app.games.moments import KINDS, Moment, moments
from pigaming_app.games.registry import games
from pigaming_app.games.setup import check_teams
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import STEPS, set_action
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.plant import SimPlant
from pigaming_app.sim.record import digest
from pigaming_app.sim.toml_table import printable, quote
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.storage.parsing import ParseError, parse_json
from pigaming_app.storage.schema import Line, between, to_plain, typed

FORMAT = "pigaming-replay-1"
BYTES_PER_TICK = 3 * ROBOTS
MAX_TICKS = 60 * 60 * HZ
MAX_SCORE = 100_000
MAX_HEAD = 1_000_000  # bytes; an arena file has at most 100,000, before JSON escapes
MAX_BYTES = MAX_HEAD + BYTES_PER_TICK * MAX_TICKS  # upper bound: ticks are compressed
Score = Annotated[int, between(-MAX_SCORE, MAX_SCORE)]
SeatNumber = Annotated[int, between(0, ROBOTS - 1)]


class ReplayError(ValueError):
    """A file is not a valid replay: the reason in one line."""


@dataclass(frozen=True)
class Replay:
    """A validated replay."""

    setup: Setup
    source: str  # text of the arena file
    ticks: bytes  # BYTES_PER_TICK for each tick
    digest: str  # of the state after the last tick
    engine: str  # hash of the engine that recorded it
    scores: tuple[int, ...] = ()  # of each seat after the last tick
    winners: tuple[int, ...] = ()  # seats of the winning team
    moments: tuple[Moment, ...] = ()  # worth showing again

    @property
    def length(self) -> int:
        """Number of ticks."""
        return len(self.ticks) // BYTES_PER_TICK

    @property
    def other_engine(self) -> bool:
        """True if another version of the engine recorded it, so that it may play out differently."""
        return self.engine != engine_hash(self.setup.game)


@dataclass(frozen=True)
class Head:
    """The first line of a file. `check`: see `_check`."""

    format: str
    engine: Line
    setup: Setup
    arena: str
    ticks: Annotated[int, between(0, MAX_TICKS)]
    digest: Line
    scores: Annotated[tuple[Score, ...], Meta(min_length=ROBOTS, max_length=ROBOTS)]
    winners: Annotated[tuple[SeatNumber, ...], Meta(max_length=ROBOTS)]
    moments: Annotated[tuple[Moment, ...], Meta(max_length=len(KINDS))]
    check: str = ""


def replayable(match: Match) -> bool:
    """False for a match of real or measured robots, which the actions alone do not determine."""
    return isinstance(match.plant, SimPlant) and not match.plant.drivetrains


def recorded(match: Match) -> Replay:
    """The replay of a match, up to its current tick."""
    return Replay(
        match.setup,
        match.arena.source,
        bytes(match.log.ticks),
        digest(match.state),
        engine_hash(match.setup.game),
        tuple(robot.score for robot in match.state.robots),
        match.outcome().winners,
        moments(match),
    )


def encode(match: Match) -> bytes:
    """The contents of a replay file of a match, up to its current tick."""
    return pack(recorded(match))


def pack(replay: Replay) -> bytes:
    """The contents of the file of a replay."""
    ticks = replay.ticks
    columns = b"".join(ticks[i::BYTES_PER_TICK] for i in range(BYTES_PER_TICK))
    packed = zlib.compress(columns, 9)
    head = to_plain(
        Head(
            FORMAT,
            replay.engine,
            replay.setup,
            replay.source,
            replay.length,
            replay.digest,
            replay.scores,
            replay.winners,
            replay.moments,
        )
    )
    head["check"] = _check(head, packed)
    return json.dumps(head, separators=(",", ":")).encode() + b"\n" + packed


def decode(raw: bytes, name: str) -> Replay:
    """Validate and unpack the contents of the file `name`. Raises ReplayError, prefixed with the name."""
    try:
        return _decode(raw)
    except ReplayError as error:
        raise ReplayError(f"{name}: {error}") from None


def to_match(replay: Replay) -> Match:
    """The match of a replay, before its first tick, with a ReplayPlayer on every seat."""
    match = Match(replay.setup, arena=parse(replay.setup.game, replay.source, replay.setup.arena))
    for seat in range(ROBOTS):
        match.sit(seat, ReplayPlayer(replay.ticks))
    return match


def verify(replay: Replay) -> bool:
    """True if re-simulation ends in exactly the recorded state."""
    match = to_match(replay)
    for _ in range(replay.length):
        match.tick()
    return digest(match.state) == replay.digest


class ReplayPlayer:
    """A brain that repeats the recorded actions, and idles after the last."""

    def __init__(self, ticks: bytes) -> None:
        self.ticks = ticks

    def think(self, state: MatchState, seat: int) -> None:
        offset = state.tick * BYTES_PER_TICK + 3 * seat
        linear, angular, buttons = self.ticks[offset : offset + 3] or (int(STEPS), int(STEPS), 0)
        action = state.actions[seat]
        set_action(action, linear / STEPS - 1.0, angular / STEPS - 1.0, buttons & 1, buttons & 2)
        action.aim = buttons >> 2


def _check(head: Mapping[str, Any], packed: bytes) -> str:
    """A hash over the file except the hash itself. It detects edits but does not prevent forgery."""
    rest = {key: value for key, value in head.items() if key != "check"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True).encode() + packed).hexdigest()


def _decode(raw: bytes) -> Replay:
    line, newline, packed = raw.partition(b"\n")
    try:
        plain = parse_json(line) if newline and len(line) < MAX_HEAD else None
    except ParseError:
        plain = None
    if not isinstance(plain, dict) or not str(plain.get("format", "")).startswith("pigaming-replay"):
        raise ReplayError("not a PiGaming replay")
    if plain["format"] != FORMAT:
        raise ReplayError(f"a replay of another format ({quote(plain['format'])}); known is {FORMAT}")
    if plain.get("check") != _check(plain, packed):
        raise ReplayError("damaged: it has been cut short or edited")
    try:
        head = typed(plain, Head)
        _check_setup(head.setup)
        parse(head.setup.game, head.arena, head.setup.arena)
        columns = zlib.decompressobj().decompress(packed, BYTES_PER_TICK * MAX_TICKS)
    except (ValueError, ArenaError, zlib.error) as error:
        raise ReplayError(f"not a valid replay ({printable(str(error))})") from None
    count = head.ticks
    if len(columns) != count * BYTES_PER_TICK or any(moment.tick > count for moment in head.moments):
        raise ReplayError("not a valid replay (the number of ticks)")
    ticks = bytearray(len(columns))
    for i in range(BYTES_PER_TICK):
        ticks[i::BYTES_PER_TICK] = columns[i * count : (i + 1) * count]
    return Replay(
        head.setup, head.arena, bytes(ticks), head.digest, head.engine, head.scores, head.winners, head.moments
    )


def _check_setup(setup: Setup) -> None:
    """Raises ValueError for a setup that the game does not have."""
    rules = games().get(setup.game)
    offered = rules.variants.get(setup.variant) if rules else None
    if rules is None or offered is None or setup.goal not in (*offered.goals, offered.default_goal):
        raise ValueError("setup: the game, its variant or goal")
    check_teams(rules, offered, [seat.team for seat in setup.seats if seat.brain != "off"])
