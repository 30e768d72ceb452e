"""Copies of events of other computers: files of events in a folder of their own, each with a note where it is from."""

import contextlib
import hashlib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated
from urllib.parse import urlsplit

from msgspec import Meta

from pigaming_app.events import event_files
from pigaming_app.events.event import Event
from pigaming_app.storage.parsing import read_text
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import Line, between, from_json, to_json

FOLDER = "joined"  # below the data folder
SCHEME = "http://"


@dataclass(frozen=True)
class Host:
    """The computer that has the event. `token`: admits this one, as the PIN does; empty: none yet."""

    address: Annotated[str, Meta(pattern=r"^[0-9A-Za-z.-]{1,253}\Z")]
    port: Annotated[int, between(1, 65535)]
    token: Line = ""

    @property
    def url(self) -> str:
        """The address of its public page."""
        return f"{SCHEME}{self.address}:{self.port}/"


def host_at(url: str, port: int) -> Host:
    """The host of an address, with this port if it names none. Raises ValueError."""
    parts = urlsplit(url)
    return from_json(to_json(Host(parts.hostname or "", parts.port or port)), Host)


def path_of(folder: Path, host: Host, event: Event) -> Path:
    """The copy of this event: by its host and by what never changes of it."""
    made = hashlib.sha256(to_json(event.renamed("x").spec).encode()).hexdigest()[:8]
    return folder / f"{host.address}-{host.port}-{made}.json"


def latest(folder: Path, host: Host) -> Path | None:
    """The copy from this host that was changed last."""
    found = [one for one in folder.glob(f"{host.address}-{host.port}-*.json") if host_of(one)]
    return max(found, key=event_files.version, default=None)


def host_of(path: Path) -> Host | None:
    """Where a copy is from; None for an event of this computer."""
    try:
        return from_json(read_text(_note(path)), Host)
    except (OSError, ValueError):
        return None


def note(path: Path, host: Host) -> None:
    """Note where a copy is from; only its owner may read it. Raises NotSaved."""
    write_atomic(_note(path), to_json(host).encode())
    if os.name != "nt":
        with contextlib.suppress(OSError):
            os.chmod(_note(path), 0o600)


def _note(path: Path) -> Path:
    return path.with_name(f".{path.name}.host")
