"""The pages of an event by their addresses, and the changes by their forms.

Everything a browser sends is text that may be wrong. A form needs the session of the operator, its key, and an Origin
that is this server; it becomes one entry of the journal, as on the command line.
"""

import contextlib
import hashlib
import hmac
import logging
import secrets
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path

from pigaming_app.events import event_files
from pigaming_app.events.changes import calendar
from pigaming_app.events.changes.live import LiveMatch, LiveMatches
from pigaming_app.events.event import Event
from pigaming_app.events.refusals import Refused
from pigaming_app.scenes.events.desk import desk_pages, on_call_pages
from pigaming_app.scenes.events.desk.desk_pages import DeskView
from pigaming_app.scenes.events.desk.document import FILES, contents, languages
from pigaming_app.scenes.events.desk.forms import Action, action_of, fixture_of, index
from pigaming_app.scenes.events.desk.joining import Joining
from pigaming_app.scenes.events.desk.public_page import public_page
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.web.markup import Markup, tag
from pigaming_app.ui.web.server import WebReply, WebRequest, tagged

LOOKS = 1.5  # s between two looks of the public page
MAX_LENGTH = 400  # characters of a field; longer ones are cut

log = logging.getLogger("pigaming")
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


class Desk:
    """Answers requests about the event in a file; each method may run in any thread. `language`: of the arcade."""

    def __init__(self, path: Path, pin: PinFile, language: str) -> None:
        """Raises ValueError if there is no event in the file."""
        self.path, self.language = path, language
        self.sessions, self._live = Sessions(pin), LiveMatches(path)
        self._files = contents()
        self._lock = threading.Lock()  # of the event and of the live matches
        self._version: tuple[int, ...] = ()
        self._pages: dict[str, tuple[Event, tuple[LiveMatch, ...], bytes]] = {}  # latest public page by language
        self._event = event_files.latest(path)
        self._joining = Joining(path, pin, self.event)

    def __call__(self, request: WebRequest) -> WebReply:
        """The answer to any request."""
        name = request.path[1:]
        if name in FILES and request.method != "POST":
            return WebReply(self._files[name], kind=FILES[name][1], headers={"Cache-Control": "max-age=3600"})
        if request.path == "/" and request.method != "POST":
            return self._public(request)
        if name.partition("/")[0] == "desk":
            return self._desk(request)
        if name.partition("/")[0] == "join":
            return self._joining(request)
        return WebReply(status=404)

    def event(self) -> Event:
        """The event in the file, whose past weeks are closed; the last one while it cannot be read."""
        with self._lock:
            if (version := event_files.version(self.path)) != self._version:
                found, _ = event_files.load(self.path)
                if found is not None:
                    self._event, self._version = found, version
            if calendar.due(self._event, date.today()):
                with contextlib.suppress(ValueError, NotSaved):
                    self._event = event_files.update(self.path, lambda event: calendar.up_to(event, date.today()))
            return self._event

    # ---- pages

    def _public(self, request: WebRequest) -> WebReply:
        words = self._words(request, request.query.get("language", ""))
        event, live = self.event(), self._now()
        known = self._pages.get(words.language)
        if known is None or known[0] is not event or known[1] != live:
            foot = [languages(words, "?language={language}")]
            page = public_page(words, event, live, foot, LOOKS).encode()
            known = self._pages[words.language] = event, live, page
        return tagged(request, WebReply(known[2]))

    def _desk(self, request: WebRequest) -> WebReply:
        token = request.cookies.get(COOKIE, "")
        session = self.sessions.find(token)
        post = request.method == "POST"
        if post and request.path == "/desk/login":
            return self._log_in(request)
        if session is None:
            words = self._words(request, request.query.get("language", ""))
            return _page(
                desk_pages.login_page(words, self.event().spec.title), 403 if request.method == "POST" else 200
            )
        if (chosen := request.query.get("language", "")) in LANGUAGES:
            session.language = chosen
        if not post:
            return self._shown(request, session)
        if not request.own or not is_key(session, request.form.get("key", "")):
            return self._shown(request, session, "desk.old", status=403)
        if request.path == "/desk/logout":
            self.sessions.end(token)
            return _see("/desk", cookie(""))
        return self._changed(request, session)

    def _log_in(self, request: WebRequest) -> WebReply:
        words = self._words(request, request.form.get("language", ""))
        token = self.sessions.begin(request.form.get("pin", ""), request.peer) if request.own else ""
        if session := self.sessions.find(token):
            session.language = words.language
            return _see("/desk", cookie(token))
        wait = self.sessions.pin.wait(request.peer)
        told = words("access.wait", seconds=round(wait + 0.5)) if wait else words("access.wrong")
        return _page(desk_pages.login_page(words, self.event().spec.title, told), 403)

    def _shown(self, request: WebRequest, session: Session, key: str = "", status: int = 200) -> WebReply:
        """The page of an address."""
        view = self._view(request, session, key)
        match request.path.strip("/").split("/"):
            case ["desk"]:
                reply = _page(desk_pages.overview_page(view, on_call_pages.buttons(view.words, view.event)), status)
                return reply if key else tagged(request, reply)
            case ["desk", "enter"]:
                return _page(desk_pages.enter_page(view, request.form), status)
            case ["desk", "break"]:
                return _page(desk_pages.pause_page(view), status)
            case ["desk", "arrange"] if view.event.progress.running:
                return _page(on_call_pages.arrange_page(view, {}), status)
            case ["desk", "close"] if view.event.progress.running:
                return _page(on_call_pages.close_page(view), status)
            case ["desk", "match", number]:
                if fixture := fixture_of(view.event, number):
                    return _page(desk_pages.match_page(view, fixture), status)
            case ["desk", "entrant", number]:
                if (i := index(number)) < len(view.event.entrants):
                    return _page(desk_pages.entrant_page(view, i), status)
        return WebReply(status=404)

    def _view(self, request: WebRequest, session: Session, key: str = "", **values: str) -> DeskView:
        words = self._words(request, session.language)
        message = words(key, **values) if key else ""
        return DeskView(words, self.event(), self._now(), session.key, message)

    # ---- forms

    def _changed(self, request: WebRequest, session: Session) -> WebReply:
        """The page after a form: that of the event, or the same with the reason why it was refused."""
        form = {name: text[:MAX_LENGTH] for name, text in request.form.items()}
        action = action_of(request.path, form)
        if action is None:
            return WebReply(status=404)
        try:
            with self._lock:
                self._event = event_files.update(self.path, lambda event: _changed(event, action))
                self._version = event_files.version(self.path)
        except (ValueError, NotSaved) as reason:
            view = self._view(request, session, "desk.refused", reason=self._why(request, session, reason))
            return _page(_again(request, view, form), 409)
        return _see("/desk")

    def _why(self, request: WebRequest, session: Session, reason: Exception) -> str:
        """The sentence of a refusal in the language of the operator."""
        words = self._words(request, session.language)
        if isinstance(reason, Refused):
            return words(f"refused.{reason.key}", **reason.values)
        log.warning("%s", reason)
        return words("app.unsaved") if isinstance(reason, NotSaved) else words("events.damaged", name=self.path.name)

    def _now(self) -> tuple[LiveMatch, ...]:
        with self._lock:
            return self._live.now()

    def _words(self, request: WebRequest, chosen: str) -> Words:
        """The language that is chosen, else the browser's first one that has texts, else that of the arcade."""
        asked = (part.strip()[:2].lower() for part in request.headers.get("accept-language", "").split(",")[:10])
        found = chosen if chosen in LANGUAGES else next((one for one in asked if one in LANGUAGES), self.language)
        return Words(found)


def _changed(event: Event, action: Action) -> Event:
    """With what a form does, after the weeks that have passed are closed."""
    event = calendar.up_to(event, date.today())
    return event.after(action(event))


def _again(request: WebRequest, view: DeskView, form: Mapping[str, str]) -> Markup:
    """The page that a refused form came from."""
    match request.path.strip("/").split("/"):
        case ["desk", "enter"]:
            return desk_pages.enter_page(view, form)
        case ["desk", "arrange"] if view.event.progress.running:
            return on_call_pages.arrange_page(view, form)
        case ["desk", "match", number]:
            if fixture := fixture_of(view.event, number):
                return desk_pages.match_page(view, fixture)
        case ["desk", "entrant", number]:
            if (i := index(number)) < len(view.event.entrants):
                return desk_pages.entrant_page(view, i)
    return view.page(view.words("desk.title"), tag("a", view.words("desk.title"), href="/desk"))


def _page(page: Markup, status: int = 200) -> WebReply:
    return WebReply(page.encode(), status)


def _see(address: str, set_cookie: str = "") -> WebReply:
    """Go on at another address."""
    more = {"Set-Cookie": set_cookie} if set_cookie else {}
    return WebReply(status=303, headers={"Location": address, **more})
