"""A week of open days: its plan, clocks, waiting phones and disk; a miniature week is played with every fault."""

import json
import shutil
import subprocess
import sys
from datetime import datetime, timedelta
from itertools import pairwise
from math import isfinite
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

import pytest

from pigaming_app import ROOT
from pigaming_app.ui.i18n import LANGUAGES
from tests.bench.open_day import audit, ledger
from tests.bench.open_day.clock import TIME_ZONE
from tests.bench.open_day.page import page
from tests.bench.open_day.plan import Day
from tests.bench.open_day.week import CLASS, NIGHT, days_of
from tests.processes import python

WEEK = days_of(4.0, 1000, 1, week=True)
LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="mounts, signals and virtual pads of Linux")


def test_the_plan_of_a_week_has_all_that_it_has_to_prove() -> None:
    assert days_of(4.0, 1000, 1, week=True) == WEEK != days_of(4.0, 1000, 2, week=True)
    people = [visitor for day in WEEK for group in day.groups for visitor in group.visitors]
    assert len(WEEK) == 5
    assert len({one.number for one in people}) == len({one.initials for one in people}) == len(people) == 1000
    assert sum(group.event is not None for day in WEEK for group in day.groups) == 3
    assert all(len(kills_with_power(day)) == 1 and len(day.kills) == 3 for day in WEEK)
    classes = [group for day in WEEK for group in day.groups if group.is_class]
    assert all(len(group.visitors) == CLASS and all(one.phone for one in group.visitors) for group in classes)
    assert {group.language for group in classes} == {*LANGUAGES}
    for fault in ([day for day in WEEK if isfinite(day.full)], [day for day in WEEK if isfinite(day.times.set_back)]):
        assert len(fault) == 1
    (second,) = [day.second for day in WEEK if day.second]
    assert second.groups == tuple(group for group in WEEK[-1].groups if group.event)


def kills_with_power(day: Day) -> list[float]:
    return [kill.after for kill in day.kills if kill.power]


@LINUX
def test_the_night_has_the_clock_of_berlin_and_one_day_a_clock_set_back(monkeypatch: pytest.MonkeyPatch) -> None:
    """Against the time zone database. In a process of its own, whose time zone is that of the days."""
    try:
        berlin = ZoneInfo("Europe/Berlin")
    except ZoneInfoNotFoundError:
        pytest.skip("no time zone database here")
    code = (
        "import json, time\ntime.tzset()\nfrom tests.bench.open_day.week import days_of\n"
        "days = days_of(4.0, 1000, 1, week=True)\n"
        "print(json.dumps([[f'{day.times.wall(60.0 * m):%d %H:%M}' for m in range(241)] for day in days]))"
    )
    monkeypatch.setenv("TZ", TIME_ZONE)
    shown = json.loads(python(code).stdout)
    for number, day in enumerate(WEEK):
        if isfinite(day.times.set_back):
            minutes = [datetime.strptime(one, "%d %H:%M") for one in shown[number]]
            steps = [after - before for before, after in pairwise(minutes)]
            assert sorted({*steps}) == [timedelta(minutes=-59), timedelta(minutes=1)]
            assert steps.count(timedelta(minutes=-59)) == 1
        else:
            real = [datetime.fromtimestamp(day.times.opening + 60.0 * m, berlin) for m in range(241)]
            assert shown[number] == [f"{one:%d %H:%M}" for one in real]
    night = shown[NIGHT]
    assert len({*night}) == len(night) - 60, "an hour is there twice"


@pytest.mark.parametrize(("matches", "problems"), [(1, 0), (6, 0), (7, 1)])
def test_twice_the_fair_share_is_the_most_that_a_phone_waits(matches: int, problems: int) -> None:
    seen = ledger.digest(iter([{"what": "wait", "visitor": 7, "seconds": 400.0, "matches": matches, "fair": 3}]))
    assert len(list(audit.fair(seen))) == problems


def test_two_days_are_added_up_and_their_groups_stay_apart() -> None:
    lines = [{"what": "life", "life": 1}, {"what": "event", "group": 0, "path": "a"}, {"what": "done", "group": 0}]
    one, other = ledger.digest(iter(lines)), ledger.digest(iter([*lines[:1], {**lines[1], "path": "b"}, lines[2]]))
    both = one + other
    assert both.lives == 2
    assert sorted(both.events.values()) == ["a", "b"]
    assert len(both.done) == 2


def test_the_page_for_the_owner_says_what_was_lost() -> None:
    day = {
        "opening": "2026-10-22 10:00", "visitors": 200, "matches": 90, "matches_of_events": 12, "left": 3,
        "high_scores": 40, "kills": 3, "power_cuts": 1, "problems": [], "games": {"race": 90}, "memory": [],
        "waits": {"turns": 31, "longest_minutes": 20.5, "most_of_share": 1.5}, "counts": {"matches in pt": 9},
    }  # fmt: skip
    figures = {"days": [day] * 5, "visitors": 1000, "hours": 4.0, "seed": 1, "problems": []}
    text = page(figures)
    assert "5 open days, 1000 visitors" in text
    assert "Nothing was lost" in text
    assert "at most 20.5 minutes" in text
    assert "matches in pt: 45" in text
    text = page({**figures, "problems": ["day 2: not in the day log: <race>"]})
    assert "Nothing was lost" not in text
    assert "&lt;race&gt;" in text


@LINUX
def test_a_full_disk_takes_no_byte_until_it_has_room_again(tmp_path: Path) -> None:
    if not shutil.which("unshare") or subprocess.run(["unshare", "-rm", "true"], check=False).returncode:
        pytest.skip("no mount namespaces here")
    code = (
        "import sys\nfrom pathlib import Path\nfrom tests.bench.open_day.disk import Disk\n"
        "with Disk(Path(sys.argv[1]) / 'disk', needed=True) as disk:\n"
        "    assert not disk.troubles, disk.troubles\n"
        "    (disk.folder / 'kept').write_text('before')\n"
        "    disk.fill(True)\n"
        "    try: print((disk.folder / 'new').write_text('more'))\n"
        "    except OSError as error: print(error.strerror)\n"
        "    disk.fill(False)\n"
        "    print((disk.folder / 'new').write_text('more'))\n"
    )
    done = subprocess.run(
        ["unshare", "-rm", sys.executable, "-c", code, str(tmp_path)], cwd=ROOT, check=True, stdout=subprocess.PIPE
    )
    assert done.stdout.decode().split("\n")[:2] == [audit.FULL[0], "4"]
    assert (tmp_path / "disk" / "kept").read_text() == "before"


@pytest.mark.long
@pytest.mark.again  # a whole week takes minutes
@LINUX
def test_a_miniature_week(tmp_path: Path) -> None:
    pytest.importorskip("aiohttp", reason="the extra `phones` is not installed")
    if not shutil.which("unshare") or subprocess.run(["unshare", "-rm", "true"], check=False).returncode:
        pytest.skip("no mount namespaces here")
    command = [sys.executable, "-m", "tests.bench.open_day", "--week", "--hours", "0.15", "--visitors", "100", "--json"]
    done = subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.PIPE, text=True)
    figures = json.loads(done.stdout)
    assert figures["problems"] == []
    assert [len(day["report"]["hours"]) > 0 for day in figures["days"]] == [True] * 5
