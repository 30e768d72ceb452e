"""Replays of play tests: a line of JSON with the people of the match, without anything that names them, and the replay.

{"format": "pigaming-playtest-1", "participants": [{"seat": 0, "device": "pad", "age": "7-9", "driving": "turn"}]}
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated

from msgspec import Meta

from pigaming_app.games.match import Match
from pigaming_app.games.replay import Replay, ReplayError, SeatNumber
from pigaming_app.games.timeline import Timeline
from pigaming_app.scenes.features.feature import Marks
from pigaming_app.sim.toml_table import printable
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.schema import from_json, one_of, to_plain
from pigaming_app.ui.i18n import Words

FORMAT = "pigaming-playtest-1"
START = f'{{"format": "{FORMAT}"'.encode()
MAX_LINE = 4000  # bytes
AGES = ("under7", "7-9", "10-12", "13-17", "adult")  # bands, years
DEVICES = ("keys", "pad", "phone")
STYLES = ("turn", "point")  # of driving without help


@dataclass(frozen=True)
class Participant:
    """A person of a play test."""

    seat: SeatNumber
    device: Annotated[str, one_of(*DEVICES)]
    age: Annotated[str, one_of(*AGES)]
    driving: Annotated[str, one_of(*STYLES)]


Participants = Annotated[tuple[Participant, ...], Meta(min_length=1, max_length=ROBOTS)]


@dataclass(frozen=True)
class PlayTestHead:
    """The first line of a file."""

    format: Annotated[str, one_of(FORMAT)]
    participants: Participants


@dataclass(frozen=True, kw_only=True)
class PlayTestReplay(Replay):
    """The replay of a play test, with all its people."""

    participants: tuple[Participant, ...]


class PlayTestReplays:
    """The kind of these replays; see `ReplayKind`. They play like any other."""

    def replay_of(self, match: Match) -> Replay | None:
        return None

    def pack(self, plain: bytes, replay: Replay) -> bytes | None:
        if not isinstance(replay, PlayTestReplay):
            return None
        return json.dumps(to_plain(PlayTestHead(FORMAT, replay.participants))).encode() + b"\n" + plain

    def decode(self, raw: bytes, name: str, decode: Callable[[bytes, str], Replay]) -> Replay | None:
        if not raw.startswith(START):
            return None
        line, _, plain = raw.partition(b"\n")
        try:
            head = from_json(line[:MAX_LINE], PlayTestHead)
        except ValueError as error:
            raise ReplayError(f"{name}: not a valid play test ({printable(str(error))})") from None
        return PlayTestReplay(**vars(decode(plain, name)), participants=head.participants)

    def prepare(self, match: Match, replay: Replay) -> None:
        """Nothing to do."""

    def timeline(self, replay: Replay) -> Timeline | None:
        return None

    def marks(self, replay: Replay, words: Words) -> Marks | None:
        return None
