"""What counts of an arcade's news: each entry once, whatever answers are lost, and nothing that others did first."""

from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from pigaming_app.events.event import Event
from pigaming_app.events.event_files import beyond, latest, merged, save, without
from pigaming_app.events.journal import Added, Entry, Postponed, Recorded, Summoned, Swapped
from pigaming_app.events.network.news import BYTES, News, Outdated, first_of, mark_of, news_of, with_news
from pigaming_app.events.spec import Entrant, Format, Result
from pigaming_app.storage.schema import to_json
from tests.events.examples import best_seed_wins, new_event

EVENT = new_event(Format.ROUND_ROBIN, 6)


def after(event: Event, *entries: Entry) -> Event:
    for entry in entries:
        event = event.after(entry)
    return event


def told(event: Event, *entries: Entry) -> News:
    """The news of an arcade that has this event and these entries of its own."""
    return News("right", len(event.journal), mark_of(event.journal), entries)


def result(event: Event, number: int) -> Recorded:
    return Recorded(best_seed_wins(event.fixtures[number - 1]))


def test_what_is_sent_again_counts_once() -> None:
    """An exchange of places that counts twice is undone, a match that is postponed twice comes a round later."""
    swiss = new_event(Format.SWISS, 4)
    news = told(swiss, Swapped("P1", "P2"), Postponed(1), Postponed(1))
    once = with_news(swiss, news)
    assert once.journal == news.entries, "equal ones of one arcade are two"
    others = after(once, Recorded(best_seed_wins(once.open[0])))
    assert with_news(others, news) == others
    assert with_news(after(swiss, news.entries[0]), news) == once, "the rest"


def test_of_two_results_of_one_match_the_first_counts() -> None:
    fixture = EVENT.fixtures[0]
    here, there = (Result(1, tuple((name,) for name in order)) for order in (fixture.entrants, fixture.entrants[::-1]))
    event = after(EVENT, Recorded(here))
    assert with_news(event, told(EVENT, Recorded(there))) is event


def test_a_claim_takes_no_match_that_is_called_elsewhere_and_its_end_no_call_of_others() -> None:
    event = after(EVENT, Summoned(1, "left"))
    news = told(EVENT, Summoned(1, "right"), Summoned(1, None), Summoned(2, "right"))
    assert with_news(event, news).calls == {1: "left", 2: "right"}
    free = with_news(EVENT, told(EVENT, Summoned(1, "right"), Summoned(1, None), Summoned(1, "right")))
    assert free.calls == {1: "right"}
    assert len(free.journal) == 3


def test_a_copy_with_another_beginning_is_outdated() -> None:
    event = after(EVENT, Postponed(1), Postponed(2))
    for wrong in (News("right", 3, mark_of(event.journal)), News("right", 2, mark_of(event.journal[:1]))):
        with pytest.raises(Outdated):
            with_news(event, wrong)


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"[]",
        b"{}",
        b'{"arcade": ""}',
        b'{"arcade": 3}',
        b'{"arcade": "right", "after": -1}',
        b'{"arcade": "right", "after": 1e400}',
        b'{"arcade": "right", "entries": [{"entry": "rm"}]}',
        b'{"arcade": "right", "entries": [{"entry": "call", "fixture": "x", "arcade": "y"}]}',
        b'{"arcade": "right", "live": {"arcade": "left"}}',
        b'{"arcade": "ri\\u0000ght"}',
        b'{"arcade": ' + b"[" * 5000,
        b"\xff\xfe",
    ],
)
def test_anything_else_is_no_news(body: bytes) -> None:
    with pytest.raises(ValueError):  # noqa: PT011
        news_of(body)


def test_much_news_is_sent_in_parts_of_limited_size() -> None:
    entries = [result(EVENT, number) for number in range(1, 16)] * 60
    parts: list[Sequence[Entry]] = []
    while entries:
        parts.append(first_of(entries))
        entries = entries[len(parts[-1]) :]
    assert len(parts) > 2
    assert all(len(to_json(list(part)).encode()) < 1.2 * BYTES for part in parts)
    assert sum(map(len, parts)) == 900


def test_news_comes_out_as_it_went_in() -> None:
    news = told(after(EVENT, Postponed(1)), result(EVENT, 2), Summoned(3, None), Added(Entrant("Éva", "", "Red")))
    assert news_of(to_json(news).encode()) == news


@pytest.mark.parametrize("seed", range(5))
def test_copies_that_exchange_at_random_times_become_equal(seed: int) -> None:
    """Three copies change and exchange as they like; answers are lost. At the end every match counts once, by the first
    of its results that was sent."""
    random = Random(seed)
    host, copies, known = EVENT, [EVENT] * 3, [EVENT] * 3
    first: dict[int, Result] = {}
    for step in range(700):
        i = random.randrange(3)
        copy = copies[i]
        if step < 400 and random.random() < 0.6 and copy.open:
            fixture = random.choice(copy.open)
            places = random.sample(fixture.entrants, 2)
            entries: Sequence[Entry] = (
                Recorded(Result(fixture.number, tuple((name,) for name in places), note=f"{step}")),
                Summoned(fixture.number, f"arcade {i}"),
                Postponed(fixture.number),
            )
            try:
                copies[i] = copy.after(random.choice(entries))
            except ValueError:
                continue
            continue
        common, own = beyond(copy.journal, known[i].journal)
        assert common == len(known[i].journal)
        sent = first_of(own)[: random.randint(1, 5)]
        host = with_news(host, told(known[i], *sent))
        for entry in sent:
            if isinstance(entry, Recorded):
                first.setdefault(entry.outcome.fixture, entry.outcome)
        if random.random() < 0.6 or step > 550:  # else the answer is lost
            common, own = beyond(copies[i].journal, host.journal)
            copies[i], known[i] = merged(host, common, without(own, sent)), host
    assert all(not beyond(copy.journal, host.journal)[1] for copy in copies)
    counted = [entry.outcome for entry in host.journal if isinstance(entry, Recorded)]
    assert {one.fixture: one for one in counted} == host.outcomes == first
    assert len({one.fixture for one in counted}) == len(counted) > 10


def test_an_arcade_with_a_full_disk_does_not_steal_a_call_either(tmp_path: Path) -> None:
    save(tmp_path / "cup.json", after(EVENT, Summoned(1, "left")))
    assert latest(tmp_path / "cup.json", after(EVENT, Summoned(1, "right"))).calls == {1: "left"}
