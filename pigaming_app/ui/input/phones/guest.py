"""A phone that was let in, and where it stands."""

import hashlib
from dataclasses import dataclass, field
from enum import Enum

from pigaming_app.ui.input.phone_messages import Touches

CHEER_SECONDS = 1.5  # between two cheers of a phone


class Stage(Enum):
    """A phone's way: in the queue; may act; has a seat; left the queue because nobody touched it."""

    WAITING = "waiting"
    TURN = "turn"
    PLAYING = "playing"
    IDLE = "idle"


@dataclass
class Guest:
    """A phone that was let in. `token`: the hash of the token by which it returns; times in s of the clock.

    `since`: it waits since then; `turn`: s of its turn in which a seat was free and others waited; `missed`: turns in
    a row that it let pass; `left_at`: it is away since then.
    """

    number: int
    token: str
    address: str
    since: float
    touched_at: float
    left_at: float
    name: str = ""
    colour: int = 0
    played: int = 0
    missed: int = 0
    turn: float = 0.0
    stage: Stage = Stage.WAITING
    connected: bool = False
    touches: Touches = field(default_factory=Touches)
    cheered_at: float = -CHEER_SECONDS

    @property
    def placed(self) -> bool:
        """True if one of the places is this phone's."""
        return self.stage in (Stage.TURN, Stage.PLAYING)

    @property
    def rank(self) -> tuple[float, int, int]:
        """Its order in the queue: the smallest comes first."""
        return self.since, self.played, self.number


def hash_of(secret: str) -> str:
    """A secret as it is kept."""
    return hashlib.sha256(secret.encode(errors="replace")).hexdigest()[:32]
