"""The scripted open day: its ledger and audit find what is lost or doubled; a miniature day is played with a kill."""

import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from pigaming_app import ROOT
from pigaming_app.events.spec import Format, Result
from pigaming_app.scenes.kiosk.day_report import report_of
from pigaming_app.storage.day_log import DayLog, PlayedMatch, ProgramEvent
from pigaming_app.storage.scores import LENGTH, LETTERS, Scores, ScoreTable
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.letter_picker import LetterPicker
from tests.bench.open_day import audit, ledger
from tests.bench.open_day.clock import TIME_ZONE, DayClock, Times
from tests.bench.open_day.plan import MISHAPS, PADS, plan
from tests.bench.open_day.run import outcome
from tests.bench.open_day.visit import next_letter
from tests.scenes.events.drawn import an_event, result_of

TABLE = ScoreTable("pitanks", "classic", "points", rules="plain", length=2, people=1)
KEY = audit.table_key(asdict(TABLE))
TIMES = Times()


@pytest.fixture(autouse=True)
def _time_zone(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The local time is that of the days."""
    follow = getattr(time, "tzset", lambda: None)  # not on Windows
    monkeypatch.setenv("TZ", TIME_ZONE)
    follow()
    yield
    monkeypatch.undo()
    follow()


def over(name: str, at: float, **more: Any) -> dict[str, Any]:
    """A line of a match that was seen at its end."""
    seen = {"game": "pitanks", "began": TIMES.wall(at).isoformat(), "seconds": 60.0, "people": 2, "ais": 1}
    event = {"event": "", "fixture": 0, "extra": 0, "scores": {}}
    return {"what": "over", "match": name, "group": 0, "visitors": [1, 2], **seen, **event, **more}


def settled(name: str, at: float, **more: Any) -> Iterator[dict[str, Any]]:
    """The lines of a match whose next page was seen."""
    yield {"what": "playing", "match": name}
    yield over(name, at, **more)
    yield {"what": "settled", "match": name}


def logged(at: float, complete: bool = True) -> PlayedMatch:
    return PlayedMatch(TIMES.wall(at), "pitanks", 60.0, 2, 1, complete=complete)


def counted(seen: ledger.Ledger, log: list[PlayedMatch]) -> list[str]:
    return list(audit.matches_counted_once(seen, log))


def test_a_match_counted_once_is_no_problem_and_any_other_number_is_one() -> None:
    seen = ledger.digest(iter([*settled("1.1", 10), *settled("1.2", 500)]))
    assert seen.seated == {1, 2}
    assert seen.playing == 0
    assert counted(seen, [logged(10), logged(500)]) == []
    assert "not in the day log" in counted(seen, [logged(10)])[0]
    assert "twice" in counted(seen, [logged(10), logged(10), logged(500)])[0]
    assert "never seen" in counted(seen, [logged(10), logged(500), logged(900)])[0]
    assert len(counted(seen, [logged(10), logged(500, complete=False)])) == 1


def test_a_match_at_a_kill_may_be_counted_once_but_not_twice() -> None:
    seen = ledger.digest(iter([*settled("1.1", 10), {"what": "playing", "match": "1.2"}, over("1.2", 500)]))
    assert counted(seen, [logged(10)]) == []
    assert counted(seen, [logged(10), logged(500)]) == []
    assert counted(seen, [logged(10), logged(500), logged(500)])


def test_an_incomplete_last_line_does_not_count_and_an_unknown_one_is_refused(tmp_path: Path) -> None:
    file = ledger.LedgerFile(tmp_path / "ledger")
    file.note("count", name="phones")
    file.close()
    with (tmp_path / "ledger").open("a", encoding="utf-8") as torn:
        torn.write('{"what": "count", "na')
    assert ledger.read(tmp_path / "ledger").counts == {"phones": 1}
    with pytest.raises(ValueError, match="no line"):
        ledger.digest(iter([{"what": "nothing"}]))


def test_a_round_of_several_is_neither_a_match_nor_left() -> None:
    rounds = [{"what": "playing", "match": "1.1"}, {"what": "round", "match": "1.1"}]
    seen = ledger.digest(iter([*rounds, *settled("1.2", 70), {"what": "playing", "match": "1.3"}]))
    assert (len(seen.settled), seen.left, seen.playing) == (1, 0, 1)
    seen = ledger.digest(iter([{"what": "playing", "match": "1.1"}, {"what": "left", "match": "1.1"}]))
    assert (seen.left, seen.playing) == (1, 0)


def test_the_report_of_the_arcade_is_compared_line_by_line(tmp_path: Path) -> None:
    killed, log = DayLog(tmp_path), DayLog(tmp_path)
    killed.add(ProgramEvent(TIMES.wall(0.0), "start"))
    for what, at in (("start", 300.0), ("end", 7200.0)):
        log.add(ProgramEvent(TIMES.wall(at), what))
    matches = [logged(10), logged(4000), logged(5000), logged(6000, complete=False)]
    for match in matches:
        log.add(match)
    lines = [line for i, at in enumerate((10, 4000, 5000)) for line in settled(f"1.{i}", at)]
    left = [{"what": "playing", "match": "1.9"}, {"what": "left", "match": "1.9"}]
    seen, report = ledger.digest(iter([*lines, *left])), report_of(tmp_path, TIMES.wall(0.0).date()).as_json()
    assert report["busiest_hour"] == 11
    assert list(audit.report_agrees(seen, matches, report, 1)) == []
    for name in ("matches", "left", "busiest_hour", "people", "starts", "crashes", "failures", "skipped_lines"):
        wrong = {**report, name: report[name] + 1}
        assert list(audit.report_agrees(seen, matches, wrong, 1)), name
    assert list(audit.report_agrees(seen, matches, {**report, "hours": {"10": {"pitanks": 3}}}, 1))
    assert list(audit.report_agrees(seen, matches, report, 2)), "a kill that is no crash of the report"


def seen_of(event_path: str, numbers: list[int], last_settled: bool = True) -> ledger.Ledger:
    """The matches of an event with these numbers, as on the screen."""
    event, lines = an_event(), []
    fixtures = {fixture.number: fixture for fixture in event.fixtures}
    for i, number in enumerate(numbers):
        scores = dict(result_of(fixtures[number]).scores)
        found = list(settled(f"1.{i}", 100 * i, event=event_path, fixture=number, scores=scores))
        lines += found if last_settled or i < len(numbers) - 1 else found[:-1]
    return ledger.digest(iter(lines))


def test_each_match_of_an_event_has_the_one_result_that_was_seen() -> None:
    event = an_event()
    one, two = event.open[:2]
    event = event.record(result_of(one)).record(result_of(two))
    assert list(audit.journal_agrees(event, seen_of("e", [1, 2]).matches)) == []
    assert "nobody has seen" in next(audit.journal_agrees(event, seen_of("e", [1]).matches))
    assert "2 times" in next(audit.journal_agrees(event, seen_of("e", [1, 2, 2]).matches))
    begun = an_event().record(result_of(one))
    assert "lost" in next(audit.journal_agrees(begun, seen_of("e", [1, 2]).matches))
    assert list(audit.journal_agrees(begun, seen_of("e", [1, 2], last_settled=False).matches)) == []
    assert list(audit.journal_agrees(event, seen_of("e", [1, 2], last_settled=False).matches)) == []
    other = ledger.digest(settled("1.1", 0, event="e", fixture=1, scores={one.entrants[0]: 3.0}))
    assert "is not what was seen" in next(audit.journal_agrees(begun, other.matches))


def test_a_tie_and_the_extra_match_after_it_are_two_results() -> None:
    event = an_event(form=Format.KNOCKOUT, count=4)
    one, lines = event.open[0], list[dict[str, Any]]()
    first, second = one.entrants
    for extra, scores in enumerate(({first: 1.0, second: 1.0}, {first: 2.0, second: 0.0})):
        places = ((first, second),) if not extra else ((first,), (second,))
        event = event.record(Result(one.number, places, scores, extra=extra))
        lines += settled(f"1.{extra}", 100 * extra, event="e", fixture=one.number, extra=extra, scores=scores)
    assert list(audit.journal_agrees(event, ledger.digest(iter(lines)).matches)) == []
    assert list(audit.journal_agrees(event, ledger.digest(iter(lines[:3])).matches)) != []


def test_matches_of_ais_may_be_played_in_the_background() -> None:
    event = an_event(brains="level3")
    assert list(audit.journal_agrees(event.record(result_of(event.open[0])), [])) == []


def scores_of(data: Path, values: list[int]) -> None:
    data.mkdir(exist_ok=True)
    book = Scores()
    for value in values:
        book.add(TABLE, "ABC", value, TIMES.wall(0.0))
    book.save(data)


@pytest.mark.parametrize(
    ("kept", "entered", "asked", "wrong"),
    [
        ([5, 7], [5, 7], [], 0),
        ([5], [5, 7], [], 1),
        ([5, 7, 7], [5, 7], [], 1),
        ([5, 7], [5], [7], 0),
        ([5, 7, 7], [5], [7], 1),
        ([5], [5], [7], 0),
        (list(range(2, 2 + LENGTH)), [1, *range(2, 2 + LENGTH)], [], 0),  # the eleventh
        (list(range(2, 1 + LENGTH)), [1, *range(2, 1 + LENGTH)], [], 1),
    ],
)
def test_each_high_score_is_kept_once(
    tmp_path: Path, kept: list[int], entered: list[int], asked: list[int], wrong: int
) -> None:
    scores_of(tmp_path, kept)
    lines = [{"what": "asked", "entry": str(value), "rows": [[KEY, value]]} for value in (*asked, *entered)]
    lines += [{"what": "entered", "entry": str(value), "rows": [[KEY, value, "ABC"]]} for value in entered]
    assert len(list(audit.scores_counted_once(ledger.digest(iter(lines)), tmp_path))) == wrong


def readings(mb: list[float], life: int = 1) -> list[dict[str, Any]]:
    """One reading of the memory each ten minutes."""
    return [{"what": "memory", "life": life, "at": 600 * i, "mb": one} for i, one in enumerate(mb)]


def test_memory_is_compared_from_the_first_match_of_the_last_game_on() -> None:
    rows = readings([190.0] * 12 + [240.0] * 12)
    late = [{**row, "games": 3 + (i >= 12)} for i, row in enumerate(rows)]
    assert [*audit.flat(ledger.digest(iter(late)), 8 * 3600.0)] == []
    assert [*audit.flat(ledger.digest(iter(rows)), 8 * 3600.0)] != []


def test_memory_that_grows_after_the_warm_up_is_a_problem() -> None:
    flat = ledger.digest(iter(readings([100.0, 250.0, 250.0, *[300.0] * 12])))
    assert audit.memory_of_runs(flat)[0]["end_mb"] == 300.0
    assert list(audit.flat(flat, 8 * 3600.0)) == []
    grown = ledger.digest(iter(readings([100.0, 250.0, *[300.0 + 3 * i for i in range(14)]])))
    assert "memory from" in next(audit.flat(grown, 8 * 3600.0))
    short = ledger.digest(iter(readings([100.0] * 4)))
    assert list(audit.flat(short, 600.0)) == []
    assert "no run" in next(audit.flat(short, 8 * 3600.0))


def test_a_line_in_a_log_and_a_restart_that_is_no_kill_are_problems(tmp_path: Path) -> None:
    assert list(audit.clean(tmp_path, 0)) == []
    assert len(list(audit.clean(tmp_path, 1))) == 2
    (tmp_path / "pigaming.log").write_text("2026-06-20 12:00:00 ERROR a scene failed\n", encoding="utf-8")
    (tmp_path / "crash.log").write_text("Fatal Python error", encoding="utf-8")
    assert len(list(audit.clean(tmp_path, 0))) == 2


def test_the_plan_of_a_day_has_all_that_it_has_to_prove() -> None:
    day = plan(8.0, 200, 1)
    assert day == plan(8.0, 200, 1)
    assert day != plan(8.0, 200, 2)
    people = [visitor for group in day.groups for visitor in group.visitors]
    assert len({visitor.number for visitor in people}) == len({visitor.initials for visitor in people}) == 200
    assert {group.mishap for group in day.groups} == {"", *MISHAPS}
    assert sum(group.event is not None for group in day.groups) == 2
    assert len(day.kills) == 5
    assert len({group.language for group in day.groups}) == 6
    assert all(0.0 <= group.at < day.seconds for group in day.groups)
    plain = [group for group in day.groups if not group.event]
    assert all(sum(not one.phone for one in group.visitors) <= PADS for group in plain)
    pulled = [group for group in day.groups if group.mishap == "pull" and any(not one.phone for one in group.visitors)]
    locked = [group for group in day.groups if group.mishap == "lock" and any(one.phone for one in group.visitors)]
    assert pulled
    assert locked
    assert day.quiet(TIMES.wall(3 * 3600.0))
    assert not day.quiet(TIMES.wall(0.0))


def test_initials_are_spelled_with_few_presses() -> None:
    picker, presses = LetterPicker(LETTERS, "AAA"), 0
    while (button := next_letter(picker, "DZB")) is not Button.FIRE:
        presses += 1
        if button in (Button.LEFT, Button.RIGHT):
            picker.move(1 if button is Button.RIGHT else -1)
        else:
            picker.turn(1 if button is Button.DOWN else -1)
    assert picker.spelled == "DZB"
    assert presses == 3 + 1 + 1 + 1 + 1


def test_an_arcade_in_simulated_time_notes_it_everywhere(tmp_path: Path) -> None:
    """In another process, since the classes of the standard library are replaced."""
    DayClock(tmp_path / "clock").write(5400.0, 0, "other", 0)
    script = """
import sys
from pathlib import Path
from tests.bench.open_day import clock
day = clock.DayClock(Path(sys.argv[1]) / "clock")
clock.install(day, clock.Times())
from pigaming_app.storage.day_log import now
from pigaming_app.storage.scores import Scores, ScoreTable
book = Scores()
table = ScoreTable("race", "oval", "points", people=1)
book.add(table, "ABC", 5)
book.save(Path(sys.argv[1]))
day.write(9000.0, 0, "other", 0)
again, problems = Scores.load(Path(sys.argv[1]))
print(now(), again.best(table, 1)[0].when.replace(tzinfo=None), problems)
"""
    done = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path)], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
    )
    assert done.stdout.strip() == "2026-06-20 12:30:00 2026-06-20 11:30:00 []"


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="signals of POSIX, virtual pads")
def test_a_miniature_day_with_a_kill(tmp_path: Path) -> None:
    pytest.importorskip("aiohttp", reason="the extra `phones` is not installed")
    figures = outcome(tmp_path, hours=0.06, visitors=3, seed=8)  # one group, in PiTanks
    assert figures["problems"] == []
    assert figures["visitors"] == 3
    assert figures["report"]["crashes"] == figures["kills"] == 1
    assert figures["matches"] == figures["report"]["matches"] > 0
