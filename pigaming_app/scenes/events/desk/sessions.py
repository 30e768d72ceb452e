"""Who is logged in at the desk: the operator, by the PIN."""

import hashlib
import hmac
import secrets
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from pigaming_app.storage.pin import PinFile

COOKIE = "pigaming_desk"
LASTS = 12 * 3600.0  # s
MOST = 16  # sessions; with one more the oldest ends


@dataclass
class Session:
    """One browser. `key`: stands in its forms, so that no other site can send one."""

    ends: float
    key: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    language: str = ""


class Sessions:
    """The sessions of a desk, which end with it. `clock`: s."""

    def __init__(self, pin: PinFile, clock: Callable[[], float] = time.monotonic) -> None:
        self.pin, self._clock = pin, clock
        self._sessions: dict[str, Session] = {}  # by hash of the token, oldest first

    def begin(self, pin: str, source: str) -> str:
        """The token of a new session; empty if the PIN is wrong, or has to wait."""
        if not self.pin.check(pin, source):
            return ""
        token = secrets.token_urlsafe(32)
        self._sessions[_hash(token)] = Session(self._clock() + LASTS)
        for oldest in list(self._sessions)[:-MOST]:
            self._sessions.pop(oldest, None)
        return token

    def find(self, token: str) -> Session | None:
        """The session of a token, unless it has ended."""
        session = self._sessions.get(_hash(token))
        return session if session and self._clock() < session.ends else None

    def end(self, token: str) -> None:
        """Log out."""
        self._sessions.pop(_hash(token), None)


def is_key(session: Session, given: str) -> bool:
    """True for the key of a session's forms."""
    return hmac.compare_digest(session.key.encode(), given.encode(errors="replace"))


def cookie(token: str) -> str:
    """The header that gives a browser its token; an empty one takes it back."""
    age = int(LASTS) if token else 0
    return f"{COOKIE}={token}; Path=/; Max-Age={age}; HttpOnly; SameSite=Strict"


def _hash(token: str) -> str:
    return hashlib.sha256(token.encode(errors="replace")).hexdigest()
