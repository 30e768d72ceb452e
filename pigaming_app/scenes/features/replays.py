"""Replays of matches. Features add kinds of their own, such as those of real robots."""

from collections.abc import Iterator

from pigaming_app.games import replay as plain_replays
from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay, ReplayError
from pigaming_app.games.setup import ChoiceError, require_game
from pigaming_app.games.timeline import Timeline
from pigaming_app.scenes.features.feature import Marks, ReplayKind
from pigaming_app.scenes.features.registry import features
from pigaming_app.sim.record import digest
from pigaming_app.storage.parsing import parse_json
from pigaming_app.storage.plugins.found import NAME
from pigaming_app.ui.i18n import Words

MAX_BYTES = 200_000_000  # of a file; an hour of real robots has about 60 million


def _kinds() -> Iterator[ReplayKind]:
    return (feature.replays() for feature in features() if feature.replays)


def replay_of(match: Match) -> Replay | None:
    """The replay of a match, up to its current tick; None if it cannot be played again."""
    if plain_replays.replayable(match):
        return plain_replays.recorded(match)
    return next((replay for kind in _kinds() if (replay := kind.replay_of(match))), None)


def pack(replay: Replay) -> bytes:
    """The contents of the file of a replay."""
    plain = plain_replays.pack(replay)
    return next((packed for kind in _kinds() if (packed := kind.pack(plain, replay))), plain)


def decode(raw: bytes, name: str) -> Replay:
    """Validate and unpack the contents of the file `name`. Raises ReplayError, prefixed with the name."""
    return next((found for kind in _kinds() if (found := kind.decode(raw, name, _decode))), None) or _decode(raw, name)


def _decode(raw: bytes, name: str) -> Replay:
    """Validate and unpack a replay. Raises ReplayError; it names a game that is not here."""
    try:
        return plain_replays.decode(raw, name)
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
    match = plain_replays.to_match(replay)
    for kind in _kinds():
        kind.prepare(match, replay)
    return match


def verify(replay: Replay) -> bool:
    """True if the rules, applied again to the recorded actions and poses, end in exactly the recorded state."""
    match = to_match(replay)
    for _ in range(replay.length):
        match.tick()
    return digest(match.state) == replay.digest


def timeline_of(replay: Replay) -> Timeline:
    """Random access to a replay."""
    return next((line for kind in _kinds() if (line := kind.timeline(replay))), None) or Timeline(replay)


def marks_of(replay: Replay, words: Words) -> tuple[Marks, ...]:
    """What a replay shows besides the match."""
    return tuple(marks for kind in _kinds() if (marks := kind.marks(replay, words)))
