"""Replays of matches with real robots: they come with a recording, since they cannot be simulated again."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

from pigaming_app.games import replay as plain_replays
from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.games.timeline import EVERY, Timeline
from pigaming_app.hardware.control import match_recording
from pigaming_app.hardware.control.match_recording import REPLAY, MatchFileError, MatchRecorder, MatchRecording
from pigaming_app.hardware.control.moving_things import Reroute
from pigaming_app.hardware.control.recorded_plant import RecordedPlant
from pigaming_app.scenes.features.feature import Marks
from pigaming_app.sim.record import copy
from pigaming_app.ui.i18n import Words


@dataclass(frozen=True, kw_only=True)
class RealReplay(Replay):
    """The replay of a match with real robots."""

    recording: MatchRecording


class RealReplays:
    """The kind of these replays; see `ReplayKind`."""

    def replay_of(self, match: Match) -> Replay | None:
        recorder: MatchRecorder | None = getattr(match.plant, "recorder", None)
        if recorder is None:
            return None
        plain = plain_replays.recorded(match)
        return RealReplay(**vars(plain), recording=recorder.recording(plain.length, match.state.robots))

    def pack(self, plain: bytes, replay: Replay) -> bytes | None:
        return match_recording.pack(plain, replay.recording) if isinstance(replay, RealReplay) else None

    def decode(self, raw: bytes, name: str, decode: Callable[[bytes, str], Replay]) -> Replay | None:
        if not raw.startswith(b"PK"):
            return None
        try:
            parts = match_recording.unpack(raw)
            plain = decode(parts[REPLAY], name)
            return RealReplay(**vars(plain), recording=match_recording.recording_of(parts, plain.length))
        except MatchFileError as error:
            raise ReplayError(f"{name}: {error}") from None

    def prepare(self, match: Match, replay: Replay) -> None:
        if isinstance(replay, RealReplay):
            _set_plant(match, replay)

    def timeline(self, replay: Replay) -> Timeline | None:
        return RealTimeline(replay) if isinstance(replay, RealReplay) else None

    def marks(self, replay: Replay, words: Words) -> Marks | None:
        from pigaming_app.scenes.mat.replay_faults import ReplayFaults

        return ReplayFaults(replay.recording.faults, words) if isinstance(replay, RealReplay) else None


class RealTimeline(Timeline):
    """The ticks of a replay of real robots."""

    def __init__(self, replay: RealReplay) -> None:
        super().__init__(replay)
        self.real = replay
        _set_plant(self._scout, replay)

    def match_at(self, tick: int) -> Match:
        tick = max(0, min(tick, self.length))
        match = super().match_at(min(tick, self.explored) // EVERY * EVERY)  # a snapshot, from which nothing is played
        _set_plant(match, self.real)
        while match.state.tick < tick:
            match.tick()
        return match


def _set_plant(match: Match, replay: RealReplay) -> None:
    """Let the robots of the match repeat the recorded ones."""
    recording: Any = replay.recording
    match.plant = RecordedPlant(
        match.state, recording.track, recording.moves, len(match.arena.walls), reroute_of(match)
    )


def reroute_of(match: Match) -> Reroute | None:
    """The planning of a game whose AIs do not plan from the walls alone, for things that move."""
    reroute, arena, rules = match.game.reroute, match.arena, copy(match.state.rules)
    if reroute is None:
        return None
    return cache(lambda things: reroute(arena, rules, things))
