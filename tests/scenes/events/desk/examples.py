"""A desk on an event, and a browser at it."""

import re
from pathlib import Path

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import load, save
from pigaming_app.events.spec import Entrant, EventSpec, Format
from pigaming_app.scenes.events.desk.desk import COOKIE, Desk
from pigaming_app.storage.pin import PinFile
from pigaming_app.ui.web.server import WebReply, WebRequest

PIN = "274918"
NAMES = ("Ana", "Bia", "Caio", "Duda")


def new_event(folder: Path, *names: str, form: Format = Format.SWISS, title: str = "Cup") -> Path:
    """The file of an event."""
    path = folder / "cup.json"
    save(path, Event(EventSpec(title, form, ("pitanks",), tuple(map(Entrant, names or NAMES)))))
    return path


def cup(path: Path) -> Event:
    event, problems = load(path)
    assert event is not None
    assert not problems
    return event


class Operator:
    """A browser without a server: it sends requests to the desk and keeps the cookie."""

    def __init__(self, desk: Desk, peer: str = "192.0.2.7") -> None:
        self.desk, self.peer, self.token = desk, peer, ""

    def get(self, path: str, **headers: str) -> WebReply:
        address, _, query = path.partition("?")
        fields = dict(part.partition("=")[::2] for part in query.split("&") if part)
        return self.desk(WebRequest("GET", address, fields, cookies=self._cookies(), headers=headers, peer=self.peer))

    def post(self, path: str, **form: str) -> WebReply:
        """Send a form of the desk."""
        return self.send(path, form | {"key": self.key})

    def send(self, path: str, form: dict[str, str], own: bool = True) -> WebReply:
        """Send any form; `own`: from a page of the desk."""
        return self.desk(WebRequest("POST", path, form=form, cookies=self._cookies(), peer=self.peer, own=own))

    def log_in(self, pin: str = PIN) -> WebReply:
        form = {"pin": pin}
        reply = self.desk(WebRequest("POST", "/desk/login", form=form, peer=self.peer, own=True))
        if found := re.match(rf"{COOKIE}=([\w-]+);", reply.headers.get("Set-Cookie", "")):
            self.token = found[1]
        return reply

    @property
    def key(self) -> str:
        found = re.search(r'name="key" value="([\w-]+)"', self.get("/desk").body.decode())
        return found[1] if found else ""

    def _cookies(self) -> dict[str, str]:
        return {COOKIE: self.token} if self.token else {}


def desk_on(path: Path, language: str = "en") -> Desk:
    """A desk whose PIN is PIN."""
    pin = PinFile(path.parent)
    pin.set(PIN)
    return Desk(path, pin, language)
