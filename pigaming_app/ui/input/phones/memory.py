"""What is kept of the phones over a restart of the arcade: the address of the page, the order of the queue, the names.

Tokens are kept as hashes. The file is deleted when phones are switched off; half an hour after it was written, only the
address counts.
"""

import logging
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from msgspec import Meta

from pigaming_app.storage.parsing import ParseError, read_text
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import PRINTABLE, Count, between, from_json, to_json

FILE = "phones.json"
MAX_BYTES = 64_000
FORGET_SECONDS = 1800.0  # after which a phone that is away is forgotten, with its name
MAX_ENTRIES = 256
Hash = Annotated[str, Meta(pattern=r"^[0-9a-f]{32}\Z")]

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class KnownPhone:
    """A phone by its device number. `token`: the hash of the token by which it returns."""

    number: Annotated[int, between(0, 2**31)]
    token: Hash
    name: Annotated[str, PRINTABLE, Meta(max_length=40)] = ""
    colour: Annotated[int, between(0, 255)] = 0
    played: Count = 0


@dataclass(frozen=True)
class Hall:
    """The phones in their order, the hashes of what is banned, and `page`, the token in the address."""

    page: Annotated[str, Meta(pattern=r"^([a-z2-9]{10})?\Z")] = ""
    phones: Annotated[tuple[KnownPhone, ...], Meta(max_length=MAX_ENTRIES)] = ()
    banned: Annotated[tuple[Hash, ...], Meta(max_length=4 * MAX_ENTRIES)] = ()


def load(data: Path) -> Hall:
    """What the last run kept in the data folder; empty if there is nothing that can be read."""
    path = data / FILE
    try:
        hall = from_json(read_text(path, MAX_BYTES), Hall)
        old = not 0.0 <= time.time() - path.stat().st_mtime <= FORGET_SECONDS
        return replace(hall, phones=()) if old else hall
    except FileNotFoundError:
        return Hall()
    except (OSError, ParseError) as trouble:
        log.warning("phones start anew: %s: %s", FILE, trouble)
        return Hall()


def save(data: Path, hall: Hall) -> None:
    """Keep this. A failure is logged: phones then only do not survive a restart."""
    try:
        data.mkdir(parents=True, exist_ok=True)
        write_atomic(data / FILE, to_json(hall).encode())
    except OSError as trouble:
        log.warning("phones are not kept for a restart: %s", trouble)


def forget(data: Path) -> None:
    """Delete what was kept."""
    (data / FILE).unlink(missing_ok=True)
