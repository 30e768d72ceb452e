"""Replays of matches of any robots. Those of real ones come with a recording, since they cannot be simulated again."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from pigaming_app.games import replay as replays
from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.games.setup import ChoiceError, require_game
from pigaming_app.games.timeline import EVERY, Timeline
from pigaming_app.sim.record import copy, digest
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.storage.parsing import parse_json
from pigaming_app.storage.plugins.found import NAME

if TYPE_CHECKING:
    from pigaming_app.hardware.control.match_recording import MatchRecorder, MatchRecording
    from pigaming_app.hardware.control.moving_things import Reroute

MAX_BYTES = 200_000_000  # of a file; an hour of real robots has about 60 million


@dataclass(frozen=True, kw_only=True)
class RealReplay(Replay):
    """The replay of a match with real robots."""

    recording: "MatchRecording"


def replay_of(match: Match) -> Replay | None:
    """The replay of a match, up to its current tick; None if it cannot be played again."""
    if replays.replayable(match):
        return replays.recorded(match)
    recorder: MatchRecorder | None = getattr(match.plant, "recorder", None)
    if recorder is None:
        return None
    plain = replays.recorded(match)
    return RealReplay(**vars(plain), recording=recorder.recording(plain.length, match.state.robots))


def reroute_of(match: Match) -> "Reroute | None":
    """The planning of a game whose AIs do not plan from the walls alone, for things that move."""
    reroute, arena, rules = match.game.reroute, match.arena, copy(match.state.rules)
    if reroute is None:
        return None
    return cache(lambda things: reroute(arena, rules, things))


def shown_things(match: Match) -> "Sequence[ThingSpec] | None":
    """The things in play now, if they may move during the match."""
    things: Sequence[ThingSpec] | None = getattr(match.plant, "shown_things", None)
    return things


def pack(replay: Replay) -> bytes:
    """The contents of the file of a replay."""
    plain = replays.pack(replay)
    if not isinstance(replay, RealReplay):
        return plain
    from pigaming_app.hardware.control import match_recording

    return match_recording.pack(plain, replay.recording)


def decode(raw: bytes, name: str) -> Replay:
    """Validate and unpack the contents of the file `name`. Raises ReplayError, prefixed with the name."""
    if not raw.startswith(b"PK"):
        return _decode(raw, name)
    from pigaming_app.hardware.control import match_recording
    from pigaming_app.hardware.control.match_recording import REPLAY, MatchFileError

    try:
        parts = match_recording.unpack(raw)
        plain = _decode(parts[REPLAY], name)
        return RealReplay(**vars(plain), recording=match_recording.recording_of(parts, plain.length))
    except MatchFileError as error:
        raise ReplayError(f"{name}: {error}") from None


def _decode(raw: bytes, name: str) -> Replay:
    """Validate and unpack a replay. Raises ReplayError; it names a game that is not here."""
    try:
        return replays.decode(raw, name)
    except ReplayError:
        if reason := _game_fault(raw):
            raise ReplayError(f"{name}: {reason}") from None
        raise


def _game_fault(raw: bytes) -> str:
    """The reason why the game of a replay cannot be played here, or nothing."""
    try:
        game = str(parse_json(raw.partition(b"\n")[0])["setup"]["game"])
        if NAME.fullmatch(game):
            require_game(game)
    except ChoiceError as reason:
        return str(reason)
    except (ValueError, KeyError, TypeError):
        pass
    return ""


def to_match(replay: Replay) -> Match:
    """The match of a replay, before its first tick."""
    match = replays.to_match(replay)
    _set_plant(match, replay)
    return match


def verify(replay: Replay) -> bool:
    """True if the rules, applied again to the recorded actions and poses, end in exactly the recorded state."""
    match = to_match(replay)
    for _ in range(replay.length):
        match.tick()
    return digest(match.state) == replay.digest


def timeline_of(replay: Replay) -> Timeline:
    """Random access to a replay."""
    return RealTimeline(replay) if isinstance(replay, RealReplay) else Timeline(replay)


class RealTimeline(Timeline):
    """The ticks of a replay of real robots."""

    def __init__(self, replay: Replay) -> None:
        super().__init__(replay)
        _set_plant(self._scout, replay)

    def match_at(self, tick: int) -> Match:
        tick = max(0, min(tick, self.length))
        match = super().match_at(min(tick, self.explored) // EVERY * EVERY)  # a snapshot, from which nothing is played
        _set_plant(match, self.replay)
        while match.state.tick < tick:
            match.tick()
        return match


def _set_plant(match: Match, replay: Any) -> None:
    """Let the robots of the match repeat the recorded ones, if they were real."""
    if isinstance(replay, RealReplay):
        from pigaming_app.hardware.control.recorded_plant import RecordedPlant

        recording = replay.recording
        match.plant = RecordedPlant(
            match.state, recording.track, recording.moves, len(match.arena.walls), reroute_of(match)
        )
