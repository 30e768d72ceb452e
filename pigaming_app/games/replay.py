"""Replay files: setup, arena, engine hash, the actions of every seat on every tick, digest of the final state.

The file is one line of JSON (the head) and the ticks, column by column and compressed. A column is one byte of one
seat; it rarely changes, so a two-minute match takes a few kilobytes. Decoding validates everything: a truncated, edited
or foreign file raises a ReplayError of one line.
"""

import hashlib
import json
import zlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from pigaming_app.games.arenas import parse
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.game import Seat, Setup
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

FORMAT = "pigaming-replay-1"
BYTES_PER_TICK = 3 * ROBOTS
MAX_TICKS = 60 * 60 * HZ
MAX_SCORE = 100_000
MAX_HEAD = 1_000_000  # bytes; an arena file has at most 100,000, before JSON escapes
MAX_BYTES = MAX_HEAD + BYTES_PER_TICK * MAX_TICKS  # upper bound: ticks are compressed


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
    head: dict[str, Any] = {
        "format": FORMAT,
        "engine": replay.engine,
        "setup": asdict(replay.setup),
        "arena": replay.source,
        "ticks": replay.length,
        "digest": replay.digest,
        "scores": replay.scores,
        "winners": replay.winners,
        "moments": [asdict(moment) for moment in replay.moments],
    }
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
        head = json.loads(line) if newline and len(line) < MAX_HEAD else None
    except (ValueError, RecursionError, MemoryError):
        head = None
    if not isinstance(head, dict) or not str(head.get("format", "")).startswith("pigaming-replay"):
        raise ReplayError("not a PiGaming replay")
    if head["format"] != FORMAT:
        raise ReplayError(f"a replay of another format ({quote(head['format'])}); known is {FORMAT}")
    if head.get("check") != _check(head, packed):
        raise ReplayError("damaged: it has been cut short or edited")
    try:
        setup = _setup(head["setup"])
        count, source, last = int(head["ticks"]), str(head["arena"]), str(head["digest"])
        engine = str(head["engine"])
        scores, winners, found = _result(head, count)
        parse(setup.game, source, setup.arena)
        if not 0 <= count <= MAX_TICKS:
            raise ValueError("ticks")
        columns = zlib.decompressobj().decompress(packed, BYTES_PER_TICK * MAX_TICKS)
    except (KeyError, TypeError, ValueError, OverflowError, ArenaError, zlib.error) as error:
        raise ReplayError(f"not a valid replay ({type(error).__name__}: {printable(str(error))})") from None
    if len(columns) != count * BYTES_PER_TICK:
        raise ReplayError("not a valid replay (the number of ticks)")
    ticks = bytearray(len(columns))
    for i in range(BYTES_PER_TICK):
        ticks[i::BYTES_PER_TICK] = columns[i * count : (i + 1) * count]
    return Replay(setup, source, bytes(ticks), last, engine, scores, winners, found)


def _result(head: Mapping[str, Any], ticks: int) -> tuple[tuple[int, ...], tuple[int, ...], tuple[Moment, ...]]:
    """Scores, winners and moments. Raises KeyError, TypeError or ValueError if they are invalid."""
    scores, winners = (tuple(int(number) for number in head[name]) for name in ("scores", "winners"))
    found = tuple(
        Moment(str(one["kind"]), int(one["tick"]), int(one["seat"]), float(one["lead"])) for one in head["moments"]
    )
    seats = {*winners, *(moment.seat for moment in found)}
    if len(scores) != ROBOTS or any(abs(score) > MAX_SCORE for score in scores):
        raise ValueError("scores")
    if not seats <= {*range(ROBOTS)} or len(winners) > ROBOTS or len(found) > len(KINDS):
        raise ValueError("result")
    if any(moment.kind not in KINDS or not 0 <= moment.tick <= ticks for moment in found):
        raise ValueError("moments")
    return scores, winners, found


def _setup(table: Mapping[str, Any]) -> Setup:
    """Parse a setup. Raises KeyError, TypeError or ValueError if it is invalid."""
    seats = [Seat(str(seat["brain"]), int(seat["team"])) for seat in table["seats"]]
    if len(seats) != ROBOTS or not {seat.team for seat in seats} <= {*range(ROBOTS)}:
        raise ValueError("seats")
    one, two, three, four = seats
    game, minutes, variant, goal = (
        str(table["game"]),
        float(table["minutes"]),
        str(table["variant"]),
        int(table["goal"]),
    )
    rules = games()[game]
    offered = rules.variants[variant]
    if not 0 < minutes <= 60 or goal not in (*offered.goals, offered.default_goal):
        raise ValueError("setup")
    check_teams(rules, offered, [seat.team for seat in seats if seat.brain != "off"])
    arena, seed, sudden = str(table["arena"]), int(table["seed"]), bool(table["sudden_death"])
    return Setup(game, arena, (one, two, three, four), minutes, seed, variant, goal, sudden)
