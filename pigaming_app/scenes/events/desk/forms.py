"""What each form of the desk does: from the texts that a browser sends to an entry of the journal."""

from collections.abc import Callable, Mapping

from pigaming_app.ai.brain_files import is_path
from pigaming_app.ai.registry import is_brain
from pigaming_app.events.changes import actions
from pigaming_app.events.event import Event
from pigaming_app.events.journal import (
    Added,
    Arranged,
    Closed,
    Entry,
    Paused,
    Postponed,
    Reseated,
    Resumed,
    Substituted,
    Summoned,
    Swapped,
    Withdrawn,
)
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import DEFAULT_AI, SEATS, Entrant, Fixture
from pigaming_app.storage.schema import is_line

Action = Callable[[Event], Entry]


def action_of(path: str, form: Mapping[str, str]) -> Action | None:
    """What a form does; None if there is no such form. The action raises Refused.

    `seen` is how many entries the journal had when the page was made: what has been done since is not done twice.
    """
    action = _asked(path, form)
    return None if action is None else lambda event: _once(event, action(event), index(form.get("seen", "")))


def _once(event: Event, entry: Entry, seen: int) -> Entry:
    if entry in event.journal[seen:]:
        raise Refused("done")
    return entry


def _asked(path: str, form: Mapping[str, str]) -> Action | None:
    match [*path.strip("/").split("/"), form.get("do", "")]:
        case ["desk", "enter", _]:
            return lambda event: _entered(event, form)
        case ["desk", "break", "begin"]:
            return lambda _: Paused(plain(form.get("note", ""))[: actions.MAX_NOTE])
        case ["desk", "break", "end"]:
            return lambda _: Resumed()
        case ["desk", "arrange", _]:
            names = (form.get(f"name{i}", "") for i in range(max(SEATS)))
            arranged = Arranged(tuple(name for name in names if name))
            return lambda _: arranged
        case ["desk", "close", _]:
            return lambda _: Closed()
        case ["desk", "entrant", number, do] if do in ENTRANT_ACTIONS:
            return lambda event: ENTRANT_ACTIONS[do](_name(event, number), form)
        case ["desk", "match", number, do] if do in MATCH_ACTIONS:
            return lambda event: MATCH_ACTIONS[do](event, _fixture(event, number), form)
    return None


def _result(event: Event, fixture: Fixture, form: Mapping[str, str]) -> Entry:
    extra = index(form.get("extra", "0"))
    return actions.scored(event, fixture.number, extra, _scores(fixture, form))


def _correction(event: Event, fixture: Fixture, form: Mapping[str, str]) -> Entry:
    words = [f"{name}={score!r}" for name, score in _scores(fixture, form).items()]
    return actions.corrected(event, fixture.number, words, plain(form.get("reason", "")))


def _reseated(event: Event, fixture: Fixture, form: Mapping[str, str]) -> Entry:
    return Reseated(fixture.number, tuple(form.get(f"seat{i}", "") for i in range(len(fixture.entrants))))


MATCH_ACTIONS: Mapping[str, Callable[[Event, Fixture, Mapping[str, str]], Entry]] = {
    "result": _result,
    "correct": _correction,
    "seats": _reseated,
    "call": lambda event, fixture, form: Summoned(fixture.number, form.get("arcade", "").strip()),
    "call_off": lambda event, fixture, form: Summoned(fixture.number, None),
    "postpone": lambda event, fixture, form: Postponed(fixture.number),
}
ENTRANT_ACTIONS: Mapping[str, Callable[[str, Mapping[str, str]], Entry]] = {
    "withdraw": lambda name, form: Withdrawn(name),
    "absent": lambda name, form: Substituted(name, DEFAULT_AI),
    "back": lambda name, form: Substituted(name, ""),
    "swap": lambda name, form: Swapped(name, form.get("other", "")),
}


def fixture_of(event: Event, number: str) -> Fixture | None:
    """The match of a number, its extra match if that is open."""
    wanted = index(number)
    return next((one for one in (*event.open, *event.fixtures) if one.number == wanted), None)


def index(text: str) -> int:
    """A small whole number; a huge one for anything else."""
    return int(text) if text.isascii() and text.isdigit() and len(text) < 6 else 10**6


def plain(text: str) -> str:
    """A text on one line, without spaces around it."""
    return "".join(char for char in " ".join(text.split()) if is_line(char))


def _scores(fixture: Fixture, form: Mapping[str, str]) -> dict[str, float]:
    return {name: actions.figure(form.get(f"score{i}", "")) for i, name in enumerate(fixture.entrants)}


def _fixture(event: Event, number: str) -> Fixture:
    fixture = fixture_of(event, number)
    if fixture is None:
        raise Refused("no_match", match=number[:6])
    return fixture


def _name(event: Event, number: str) -> str:
    if (i := index(number)) >= len(event.entrants):
        raise Refused("no_entrant")
    return event.entrants[i].name


def _entered(event: Event, form: Mapping[str, str]) -> Added:
    name, team, brain = (plain(form.get(field, "")) for field in ("name", "team", "brain"))
    if brain and is_path(brain):
        raise Refused("ai_path")
    for game in event.spec.games if brain else ():
        if not is_brain(game, brain):
            raise Refused("no_ai", name=brain, game=game)
    return Added(Entrant(name, brain, team))
