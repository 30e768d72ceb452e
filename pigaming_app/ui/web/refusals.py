"""What the server refuses: counted by kind, and logged in at most one line per kind every few seconds."""

import logging
import time
from collections import Counter, deque
from collections.abc import Callable

LOG_SECONDS = 10.0  # s between two lines of a kind

log = logging.getLogger("pigaming")


class Refusals:
    """The refusals since the server was started, by kind."""

    def __init__(self, clock: Callable[[], float] = time.monotonic, server: str = "phones") -> None:
        self.server = server  # that the lines name
        self.counts: Counter[str] = Counter()
        self._clock = clock
        self._logged: dict[str, tuple[float, int]] = {}  # time of the last line of each kind, and the count then

    def note(self, kind: str, peer: str = "") -> None:
        """Count a refusal of a peer at the address `peer`, and log it unless one of its kind was logged lately."""
        self.counts[kind] += 1
        now = self._clock()
        at, count = self._logged.get(kind, (-LOG_SECONDS, 0))
        if now - at >= LOG_SECONDS:
            self._logged[kind] = now, self.counts[kind]
            more = self.counts[kind] - count - 1
            log.warning(
                "%s: %s%s%s.", self.server, kind, f", {peer}" if peer else "", f", and {more} more" if more else ""
            )


class ErrorsOfLibrary(logging.Handler):
    """Notes what the HTTP library reports, such as a malformed request, as a refusal, without its traceback."""

    def __init__(self, refusals: Refusals) -> None:
        super().__init__(logging.WARNING)
        self.refusals = refusals

    def emit(self, record: logging.LogRecord) -> None:
        self.refusals.note("malformed request refused")


class RateMeter:
    """A limit of `most` events in any `seconds`."""

    def __init__(self, most: int, seconds: float = 1.0) -> None:
        self.most, self.seconds = most, seconds
        self._times: deque[float] = deque(maxlen=most)

    def exceeded(self, now: float) -> bool:
        """Count an event at the time `now`, s; true if it is one too many."""
        over = self.spent(now)
        self._times.append(now)
        return over

    def spent(self, now: float) -> bool:
        """True if one more event at the time `now` would be one too many."""
        return len(self._times) == self.most and now - self._times[0] < self.seconds
