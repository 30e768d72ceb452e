"""The desk of the event that this arcade runs, on while the operator has switched it on."""

import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders
from pigaming_app.ui.web import PORT

if TYPE_CHECKING:
    from pigaming_app.ui.web.server import PageServer

CHECK_SECONDS = 3.0  # s between two attempts to start
NEEDED = ("pigaming_app.ui.web.server", "ifaddr", "segno")  # of the extra `phones`


class DeskHost:
    """The server. `trouble`: key of the sentence why there is none, and its values; empty: it runs, or is off."""

    def __init__(self, port: int = PORT, clock: Callable[[], float] = time.monotonic) -> None:
        self.port, self._clock = port, clock
        self.server: PageServer | None = None
        self.trouble: tuple[str, dict[str, object]] = ("", {})
        self._wanted: tuple[Path, str] | None = None  # event and network
        self._tried_at = 0.0

    @property
    def url(self) -> str:
        """The address of the public page; empty while there is no server."""
        return self.server.url if self.server else ""

    def follow(self, path: Path | None, network: str, language: str) -> None:
        """Serve this event on a network, or nothing. Does nothing if that is so."""
        wanted = (path, network) if path else None
        if wanted != self._wanted:
            self.close()
            self._wanted = wanted
        elif self.server or self._clock() - self._tried_at < CHECK_SECONDS:
            return
        if self._wanted:
            self._tried_at = self._clock()
            self._start(*self._wanted, language)

    def close(self) -> None:
        """Stop the server."""
        if self.server:
            self.server.stop()
        self.server, self.trouble, self._wanted = None, ("", {}), None

    def _start(self, path: Path, network: str, language: str) -> None:
        if not can_serve():
            self.trouble = ("phones.missing", {})
            return
        from pigaming_app.scenes.events.desk.desk import Desk
        from pigaming_app.ui.web.network import ServerUnavailable, chosen, networks
        from pigaming_app.ui.web.server import PageServer

        pin = PinFile(folders().config)
        if not pin.is_set:
            self.trouble = ("desk.no_pin", {})
            return
        try:
            server = PageServer(Desk(path, pin, language), chosen(network, networks()).address, self.port)
            server.start()
        except ServerUnavailable as trouble:
            self.trouble = (f"phones.{trouble.key}", trouble.values)
        except ValueError:
            self.trouble = ("events.damaged", {"name": path.name})
        else:
            self.server, self.trouble = server, ("", {})


def desk_host(context: Context) -> DeskHost:
    """Made at first use: `context.shared(desk_host)`."""
    return DeskHost()


def can_serve() -> bool:
    """True if this installation has what the pages need."""
    try:
        return all(import_module(name) for name in NEEDED)
    except ImportError:
        return False
