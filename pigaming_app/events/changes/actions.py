"""What an operator asks for, in words or from a form, as an entry of the journal.

Each function reads the event and returns one entry, which `Event.after` checks, or raises Refused.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import groupby
from math import isfinite

from pigaming_app.events.entrant_lists import entrants_of_words
from pigaming_app.events.event import Event
from pigaming_app.events.journal import Added, Corrected, Recorded, Reseated
from pigaming_app.events.refusals import Refused
from pigaming_app.events.spec import Entrant, Fixture, Result
from pigaming_app.storage.parsing import quote

MAX_SCORE = 1e9
MAX_NOTE = 200  # characters

Places = tuple[tuple[str, ...], ...]


def recorded(event: Event, number: int, words: Sequence[str]) -> Recorded:
    """The result of an open match, see `_read`; after a tie in a knock-out that of its extra match."""
    fixture = next((one for one in event.open if one.number == number), None) or _fixture(event, number)
    places, scores = _read(fixture, words)
    return Recorded(Result(number, places, scores, extra=fixture.extra))


def corrected(event: Event, number: int, words: Sequence[str], reason: str) -> Corrected:
    """Another result of a match that has been played; it also replaces extra matches."""
    places, scores = _read(_fixture(event, number), words)
    return Corrected(Result(number, places, scores, note=reason.strip()[:MAX_NOTE]))


def scored(event: Event, number: int, extra: int, scores: Mapping[str, float]) -> Recorded:
    """The result by scores of the match, or extra match, that somebody saw. Raises Refused if it has counted."""
    fixture = next((one for one in event.open if one.number == number), None) or _fixture(event, number)
    if number in event.outcomes or fixture.extra != extra:
        raise Refused("counted", match=number)
    return Recorded(Result(number, by_score(fixture, scores), scores, extra=extra))


def entered(event: Event, word: str, complete: Callable[[Entrant, Sequence[str]], Entrant]) -> Added:
    """A late entrant: NAME, NAME/TEAM, NAME=AI. `complete(entrant, games)` checks that the AI plays all games."""
    (entrant,) = entrants_of_words([word])
    return Added(complete(entrant, event.spec.games))


def seats(event: Event, number: int, words: Sequence[str]) -> Reseated:
    """The seats of a match: A=2 B=1; those who are not named keep the order of the others."""
    fixture = _fixture(event, number)
    wanted = {name: figure(text, "bad_seat") for name, text in map(_pair, words)}
    places = range(1, len(fixture.entrants) + 1)
    if not wanted or not {*wanted.values()} <= {*places} or len({*wanted.values()}) < len(words):
        raise Refused("seats", match=number, most=len(places))
    _require_entrants(fixture, wanted)
    rest = iter(name for name in fixture.entrants if name not in wanted)
    by_seat = {int(seat): name for name, seat in wanted.items()}
    return Reseated(number, tuple(by_seat.get(seat) or next(rest) for seat in places))


def by_score(fixture: Fixture, scores: Mapping[str, float]) -> Places:
    """The places of everybody in a match, who has a score each: more is better, equal ones share a place."""
    _require_entrants(fixture, scores)
    if missing := [name for name in fixture.entrants if name not in scores]:
        raise Refused("no_score", match=fixture.number, name=missing[0])
    if any(not isfinite(score) or abs(score) > MAX_SCORE for score in scores.values()):
        raise Refused("score_range", match=fixture.number, most=f"{MAX_SCORE:.0f}")
    ranked = sorted(scores, key=lambda name: (-scores[name], name))
    return tuple(tuple(names) for _, names in groupby(ranked, key=scores.__getitem__))


def _read(fixture: Fixture, words: Sequence[str]) -> tuple[Places, dict[str, float]]:
    """Places and scores: `A=3 B=1` are scores, more is better; `A B` are places, best first; `A+B` share one."""
    if any("=" in word and word not in fixture.entrants for word in words):
        pairs = [*map(_pair, words)]
        scores = {name: figure(text) for name, text in pairs}
        if len(scores) < len(pairs):
            raise Refused("one_score", match=fixture.number)
        return by_score(fixture, scores), scores
    places = tuple((word,) if word in fixture.entrants else tuple(word.split("+")) for word in words)
    _require_entrants(fixture, [name for place in places for name in place])
    return places, {}


def _pair(word: str) -> tuple[str, str]:
    name, sign, text = word.rpartition("=")
    if not sign:
        raise Refused("no_pair", word=quote(word))
    return name, text


def figure(text: str, refusal: str = "bad_score") -> float:
    """A number with a decimal point or comma. Raises Refused."""
    try:
        return float(text.strip().replace(",", ".").replace("−", "-"))
    except ValueError:
        raise Refused(refusal, text=quote(text)) from None


def _fixture(event: Event, number: int) -> Fixture:
    fixture = next((one for one in event.fixtures if one.number == number), None)
    if fixture is None:
        raise Refused("no_match", match=number)
    return fixture


def _require_entrants(fixture: Fixture, names: Sequence[str] | Mapping[str, float]) -> None:
    if strangers := [name for name in names if name not in fixture.entrants]:
        who = ", ".join(fixture.entrants)
        raise Refused("stranger", name=quote(strangers[0]), match=fixture.number, names=who)
