"""The operator's PIN: its scrypt hash in the folder of the settings, and delays after wrong ones.

Whoever may write there owns the arcade: a file RESET in that folder takes the PIN away.
"""

import hashlib
import hmac
import itertools
import os
import secrets
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from pigaming_app.storage.file_lock import locked
from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from pigaming_app.storage.schema import Count, Finite, from_json, to_json

FILE, RESET = "pin.json", "reset-pin"
SHORTEST, LONGEST = 4, 12  # digits
COST = {"n": 2**14, "r": 8, "p": 1, "maxmem": 64 * 2**20}  # of scrypt (RFC 7914): 16 MB and some 40 ms
FREE = 3  # wrong attempts without a delay
FIRST_DELAY, LONGEST_DELAY = 5.0, 300.0  # s, after one more; each further one doubles it
FORGOTTEN = 86_400.0  # s after which wrong attempts no longer count
MAX_SOURCES = 64  # whose attempts are counted apart; those of all others count together


Hexadecimal = Annotated[str, Meta(pattern=r"^([0-9a-f]{2}){16,64}\Z")]


@dataclass(frozen=True)
class Failures:
    """Wrong attempts in a row, and the time of the last one, s since the epoch."""

    count: Count
    at: Finite

    def wait(self, now: float) -> float:
        """Seconds until the next attempt counts; none after a clock was set back, until the next wrong one."""
        passed = now - self.at
        if self.count < FREE or not 0.0 <= passed < FORGOTTEN:
            return 0.0
        return max(0.0, min(FIRST_DELAY * 2.0 ** min(self.count - FREE, 16), LONGEST_DELAY) - passed)


@dataclass(frozen=True)
class PinRecord:
    """The file: salt and hash in hexadecimal digits; `failures` by source."""

    salt: Hexadecimal
    hash: Hexadecimal
    failures: dict[str, Failures] = field(default_factory=dict)


class PinFile:
    """The PIN in a folder. Several arcades may use it. `clock`: s since the epoch."""

    def __init__(self, folder: Path, clock: Callable[[], float] = time.time) -> None:
        self.folder, self.path, self._clock = folder, folder / FILE, clock
        self._unsaved: dict[str, Failures] = {}  # wrong attempts that the disk does not take

    @property
    def is_set(self) -> bool:
        """True if a PIN is needed; also if the file cannot be read, which only its owner may mend."""
        if os.path.exists(self.folder / RESET):
            self._reset()
        return self.exists

    @property
    def exists(self) -> bool:
        """True if there is a file, usable or not."""
        return os.path.exists(self.path)  # unlike a method of Path, also false for a name that is too long

    def set(self, pin: str) -> None:
        """Replace the PIN. Raises ValueError unless it has SHORTEST to LONGEST digits, or NotSaved."""
        if not (pin.isascii() and pin.isdigit() and SHORTEST <= len(pin) <= LONGEST):
            raise ValueError(f"a PIN has {SHORTEST} to {LONGEST} digits")
        salt = secrets.token_bytes(16)
        self._write(PinRecord(salt.hex(), _hash(pin, salt)))

    def remove(self) -> None:
        """Take the PIN away. Raises NotSaved."""
        try:
            self.path.unlink(missing_ok=True)
        except OSError as error:
            raise NotSaved(f"{self.path} was not deleted: {error.strerror}.") from error
        self._unsaved.clear()

    def wait(self, source: str = "") -> float:
        """Seconds until an attempt of a source counts: an address, or the arcade itself."""
        record = self._read()
        return self._failures(record, source).wait(self._clock()) if record else 0.0

    def check(self, pin: str, source: str = "") -> bool:
        """One attempt; false while `wait` lasts, too, and it is not counted then. Takes some 40 ms."""
        try:
            with locked(self.path):
                return self._check(pin, source)
        except NotSaved:
            return False

    def signature(self, text: str) -> str:
        """A text signed with the PIN, which holds until that is set anew; empty without a PIN."""
        record = self._read()
        return hmac.digest(bytes.fromhex(record.salt + record.hash), text.encode(), "sha256").hex() if record else ""

    # ---- internals

    def _check(self, pin: str, source: str) -> bool:
        record, now = self._read(), self._clock()
        if record is None or self._failures(record, source).wait(now) > 0.0:
            return False
        name = self._name(record, source)
        right = hmac.compare_digest(_hash(pin, bytes.fromhex(record.salt)), record.hash)
        failures = {**record.failures, **self._unsaved}
        before = failures.pop(name, None)
        if not right:
            fresh = before is None or now - before.at >= FORGOTTEN
            failures[name] = Failures(1 if fresh or before is None else before.count + 1, now)
        if right and before is None:
            return True
        try:
            self._write(replace(record, failures=failures))
            self._unsaved = {}
        except NotSaved:
            self._unsaved = failures
        return right

    def _failures(self, record: PinRecord, source: str) -> Failures:
        return {**record.failures, **self._unsaved}.get(self._name(record, source), Failures(0, 0.0))

    def _name(self, record: PinRecord, source: str) -> str:
        known = {**record.failures, **self._unsaved}
        return source if source in known or len(known) < MAX_SOURCES else "others"

    def _read(self) -> PinRecord | None:
        """The record; None without a usable one."""
        try:
            return from_json(read_text(self.path), PinRecord)
        except (OSError, ValueError):
            return None

    def _write(self, record: PinRecord) -> None:
        write_atomic(self.path, to_json(record).encode())
        if os.name != "nt":
            os.chmod(self.path, 0o600)

    def _reset(self) -> None:
        try:
            self.remove()
            (self.folder / RESET).unlink(missing_ok=True)
        except OSError:
            pass  # a folder that cannot be changed: the PIN stays


def is_easy(pin: str) -> bool:
    """True for one that is guessed first: equal digits, or digits in order."""
    return {(int(b) - int(a)) % 10 for a, b in itertools.pairwise(pin)} in ({0}, {1}, {9})


def _hash(pin: str, salt: bytes) -> str:
    return hashlib.scrypt(pin.encode(), salt=salt, dklen=32, **COST).hex()
