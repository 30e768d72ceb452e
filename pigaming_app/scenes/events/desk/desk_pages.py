"""The operator's pages: the event at a glance, and a page for each match, entrant and late entry."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from pigaming_app.events.changes.live import LiveMatch
from pigaming_app.events.event import Event
from pigaming_app.events.spec import MAX_NAME, Fixture
from pigaming_app.scenes.events.desk.document import document, languages
from pigaming_app.scenes.events.desk.public_page import head, now, result_line, tables, versus
from pigaming_app.scenes.events.running import accepts_late, round_name
from pigaming_app.ui.i18n import Words, numeral
from pigaming_app.ui.web.markup import Markup, tag

EVERY = 1.0  # s between two looks for news
NOTES = ("note_referee", "note_robot", "note_agreed", "note_seats")


@dataclass(frozen=True)
class DeskView:
    """What every page of the desk needs. `key`: of the forms; `message`: why the last form was refused."""

    words: Words
    event: Event
    live: Sequence[LiveMatch]
    key: str
    message: str = ""

    def page(self, title: str, *main: object, every: float = 0) -> Markup:
        """A page of the desk with the way back."""
        words = self.words
        top = tag(
            "nav",
            tag("a", words("desk.title"), href="/desk"),
            tag("a", words("desk.public"), href="/", target="_blank"),
            self.form("/desk/logout", tag("button", words("desk.logout"))),
        )
        message = tag("p", self.message, class_="banner wrong", role="alert") if self.message else ""
        foot = [languages(words, "/desk?language={language}")]
        return document(words, f"{title} · {self.event.spec.title}", [top, message, *main], foot, every, "/")

    def form(self, address: str, *fields: object, **more: object) -> Markup:
        """A form that only this session can send, and that counts once."""
        key = tag("input", type="hidden", name="key", value=self.key)
        seen = tag("input", type="hidden", name="seen", value=len(self.event.journal))
        return tag("form", key, seen, *fields, method="post", action=address, autocomplete="off", **more)


def login_page(words: Words, title: str, message: str = "") -> Markup:
    """The form for the PIN."""
    form = tag(
        "form",
        tag(
            "label",
            words("access.title"),
            tag(
                "input",
                type="password",
                name="pin",
                inputmode="numeric",
                autocomplete="current-password",
                required=True,
                autofocus=True,
            ),
        ),
        tag("input", type="hidden", name="language", value=words.language),
        tag("button", words("desk.login")),
        method="post",
        action="/desk/login",
        class_="box",
    )
    told = tag("p", message, class_="banner wrong", role="alert") if message else ""
    foot = [tag("a", words("desk.public"), href="/"), languages(words, "/desk?language={language}")]
    return document(words, title, [tag("h1", title), told, form], foot, 0, "/")


def overview_page(view: DeskView, buttons: Sequence[Markup]) -> Markup:
    """Break, open matches, late entries and entrants, then what everybody sees; `buttons`: of the format."""
    words, event = view.words, view.event
    open_rows = [_open_row(view, one) for one in event.open]
    played = [one for one in reversed(event.fixtures) if one.number in event.played]
    late = tag("a", words("events.hint_late"), href="/desk/enter", class_="button") if accepts_late(event) else ""
    results = [
        tag("h2", words("events.correct")),
        tag("ol", *(_played_row(view, one) for one in played), class_="rows"),
    ]
    return view.page(
        words("desk.title"),
        *head(words, event),
        *now(words, event, view.live),
        tag("section", tag("h2", words("desk.coming")), tag("ol", *open_rows, class_="rows"), *buttons, _pause(view)),
        tag("section", tag("h2", words("desk.entrants")), tag("ol", *_entrants(view), class_="names"), late),
        tag("section", *results) if played else "",
        *tables(words, event),
        every=EVERY,
    )


def match_page(view: DeskView, fixture: Fixture) -> Markup:
    """Result, call, seats and order of an open match; correction of one that has been played."""
    words, event, number = view.words, view.event, fixture.number
    title = words("desk.match", number=number)
    top = [tag("h1", title, " ", tag("small", round_name(words, event, fixture))), tag("p", versus(fixture.entrants))]
    address = f"/desk/match/{number}"
    if number in event.outcomes:
        if number not in event.played:
            return view.page(title, *top)
        return view.page(title, *top, _correction(view, fixture, address))
    if fixture.extra:
        top.append(tag("p", words("events.sudden_death")))
    places = sorted({one.arcade for one in view.live} | {*event.calls.values()} - {""})
    names = tag("datalist", *(tag("option", value=place) for place in places), id="arcades")
    call = view.form(
        address,
        tag("h2", words("desk.call")),
        tag(
            "label",
            words("desk.arcade"),
            tag("input", name="arcade", list="arcades", maxlength=MAX_NAME, value=event.calls.get(number)),
            names,
        ),
        tag("button", words("desk.call"), name="do", value="call"),
        tag("button", words("desk.call_off"), name="do", value="call_off") if number in event.calls else "",
    )
    return view.page(
        title,
        *top,
        view.form(
            address,
            tag("h2", words("desk.result")),
            tag("input", type="hidden", name="extra", value=fixture.extra),
            *_scores(words, fixture, {}),
            tag("button", words("events.hint_save"), name="do", value="result"),
        ),
        call,
        "" if fixture.extra else _seats(view, fixture, address),
        view.form(address, tag("button", words("desk.postpone"), name="do", value="postpone")),
    )


def entrant_page(view: DeskView, number: int) -> Markup:
    """What can happen to an entrant: absent, back, another place, gone."""
    words, event = view.words, view.event
    entrant = event.entrants[number]
    address = f"/desk/entrant/{number}"
    others = [one.name for one in event.entrants if one.name not in event.withdrawn and one != entrant]
    team = tag("p", entrant.team) if entrant.team else ""
    if entrant.name in event.withdrawn:
        gone = tag("p", words("events.withdrew", name=entrant.name))
        return view.page(entrant.name, tag("h1", entrant.name), team, gone)
    back = [tag("button", words("desk.back"), name="do", value="back")] if entrant.brain else []
    return view.page(
        entrant.name,
        tag("h1", entrant.name),
        team,
        tag("p", entrant.brain) if entrant.brain else "",
        view.form(address, *(back or [tag("button", words("desk.absent"), name="do", value="absent")])),
        view.form(
            address,
            tag("label", words("desk.swap"), tag("select", *(tag("option", name) for name in others), name="other")),
            tag("button", words("events.change"), name="do", value="swap"),
        ),
        view.form(address, tag("button", words("events.withdraw"), name="do", value="withdraw", class_="grave")),
    )


def enter_page(view: DeskView, given: Mapping[str, str]) -> Markup:
    """The form for a late entrant; `given`: what was refused."""
    words = view.words
    fields = (
        tag(
            "label",
            words(f"desk.{name}"),
            tag("input", name=name, maxlength=MAX_NAME, value=given.get(name), required=name == "name"),
        )
        for name in ("name", "team", "brain")
    )
    form = view.form("/desk/enter", *fields, tag("button", words("events.hint_enter")))
    return view.page(words("events.hint_late"), tag("h1", words("events.hint_late")), form)


def _pause(view: DeskView) -> Markup:
    words = view.words
    if view.event.pause is not None:
        return view.form("/desk/break", tag("button", words("desk.resume"), name="do", value="end"))
    return tag("a", words("desk.pause"), href="/desk/break", class_="button")


def pause_page(view: DeskView) -> Markup:
    """The form for a break."""
    words = view.words
    form = view.form(
        "/desk/break",
        tag("label", words("desk.pause_note"), tag("input", name="note", maxlength=100, autofocus=True)),
        tag("button", words("desk.pause_begin"), name="do", value="begin"),
    )
    return view.page(words("desk.pause"), tag("h1", words("desk.pause")), form)


def _open_row(view: DeskView, fixture: Fixture) -> Markup:
    """An open match: who plays, where it is called, and the way to its page."""
    called = view.event.calls.get(fixture.number)
    where = None if called is None else called or view.words("desk.called")
    link = tag("a", tag("b", f"{fixture.number}"), " ", versus(fixture.entrants), href=f"/desk/match/{fixture.number}")
    return tag("li", link, tag("span", where, class_="small"), class_="called" if where else None)


def _played_row(view: DeskView, fixture: Fixture) -> Markup:
    outcome = view.event.outcomes.get(fixture.number) or view.event.played[fixture.number][0]
    line = result_line(view.words, outcome)
    link = tag("a", tag("b", f"{fixture.number}"), " ", line, href=f"/desk/match/{fixture.number}")
    return tag("li", link, tag("span", outcome.note, class_="small"))


def _entrants(view: DeskView) -> Iterator[Markup]:
    for i, entrant in enumerate(view.event.entrants):
        gone = entrant.name in view.event.withdrawn
        link = tag("a", entrant.name, href=f"/desk/entrant/{i}")
        yield tag("li", link, tag("span", entrant.brain or None, class_="small"), class_="gone" if gone else None)


def _scores(words: Words, fixture: Fixture, before: Mapping[str, float]) -> Iterator[Markup]:
    """A field for the score of each entrant, named by the place in the match."""
    for i, name in enumerate(fixture.entrants):
        value = before.get(name)
        yield tag(
            "label",
            name,
            tag(
                "input",
                name=f"score{i}",
                inputmode="decimal",
                required=True,
                maxlength=12,
                value=None if value is None else words.decimal(numeral(value, 2).removesuffix(".00")),
                aria_label=f"{words('desk.score')}: {name}",
            ),
        )


def _correction(view: DeskView, fixture: Fixture, address: str) -> Markup:
    words, outcome = view.words, view.event.outcomes[fixture.number]
    notes = (tag("option", value=words(f"events.{note}")) for note in NOTES)
    return view.form(
        address,
        tag("p", result_line(words, outcome)),
        tag("h2", words("events.correct")),
        *_scores(words, fixture, outcome.scores),
        tag(
            "label",
            words("events.note"),
            tag("input", name="reason", list="notes", required=True, maxlength=100),
            tag("datalist", *notes, id="notes"),
        ),
        tag("button", words("events.hint_save"), name="do", value="correct"),
    )


def _seats(view: DeskView, fixture: Fixture, address: str) -> Markup:
    """A choice of the entrant for each seat."""
    words = view.words
    rows = (
        tag(
            "label",
            words("events.pad", number=seat + 1),
            tag(
                "select",
                *(tag("option", other, selected=other == name) for other in fixture.entrants),
                name=f"seat{seat}",
            ),
        )
        for seat, name in enumerate(fixture.entrants)
    )
    button = tag("button", words("events.change"), name="do", value="seats")
    return view.form(address, tag("h2", words("desk.seats")), *rows, button)
