"""A day or a week from outside: supervisors are started, arcades killed, the ledgers compared with what was kept."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

from pigaming_app import ROOT
from pigaming_app.events import event_files, resume
from pigaming_app.storage.pin import PinFile
from tests.bench.open_day import audit
from tests.bench.open_day import ledger as ledgers
from tests.bench.open_day.arcade import PORT
from tests.bench.open_day.clock import TIME_ZONE, DayClock
from tests.bench.open_day.disk import Disk
from tests.bench.open_day.ledger import Ledger
from tests.bench.open_day.plan import FULL_SECONDS, PIN, Day, Group
from tests.bench.open_day.week import days_of

POLL = 0.002  # s
SILENT = 180.0  # s of real time without a frame after which the day is given up
POWER_OFF = 0.5  # s
SUPERVISOR = """
import sys
from pigaming_app.jobs.kiosk.start import supervise
from pigaming_app.scenes.kiosk import safe_start
safe_start.MINUTE = 1.5  # s: about what a minute of the day takes
sys.exit(supervise(sys.argv[1:]))
"""


class Place:
    """A place in the hall with an arcade under its supervisor. `folder`: its clock and ledger; `home`: its files."""

    def __init__(self, folder: Path, home: Path, day: Day, wishes: dict[str, Any]) -> None:
        self.folder, self.home, self.day = folder, home, day
        folder.mkdir(parents=True)
        (folder / "day.json").write_text(json.dumps({**wishes, "times": asdict(day.times)}), encoding="utf-8")
        PinFile(home / "config").set(PIN)
        self.clock, self.kills = DayClock(folder / "clock"), list(day.kills)
        self.environment = {
            **os.environ,
            "PIGAMING_HOME": str(home),
            "PYTHONPATH": str(ROOT),
            "SDL_VIDEODRIVER": "dummy",
            "SDL_AUDIODRIVER": "dummy",
            "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
            "PYGAME_HIDE_SUPPORT_PROMPT": "1",
            PORT: str(free_port()),
        }
        self._frames, self._since = 0, time.monotonic()
        self._supervisor = self._start()

    def _start(self) -> subprocess.Popen[bytes]:
        arcade = [sys.executable, "-m", "tests.bench.open_day.arcade", str(self.folder)]
        command = [sys.executable, "-c", SUPERVISOR, *arcade]
        return subprocess.Popen(command, cwd=ROOT, env=self.environment, start_new_session=True)

    def look(self) -> bool:
        """Kill the arcade if it is due. Returns whether its day is over."""
        if self._supervisor.poll() is not None:
            return True
        if self.clock.frames != self._frames:
            self._frames, self._since = self.clock.frames, time.monotonic()
        kill = self.kills[0] if self.kills and self._frames else None
        if kill and self.clock.seconds >= kill.after and self.clock.place == kill.place:
            self.kills.pop(0)
            self._kill(kill.power)
        return time.monotonic() - self._since > SILENT

    def troubles(self) -> list[str]:
        """How its day ended, if not well."""
        code = self._supervisor.poll()
        found = [f"no frame for {SILENT:.0f} s, at {self.clock.seconds:.0f} s"] if code is None else []
        found += [f"the supervisor ended with {code}"] if code else []
        return found + ([f"{len(self.kills)} kills had no occasion: {self.kills}"] if self.kills else [])

    def _kill(self, power: bool) -> None:
        """Kill the arcade, with its supervisor if the power fails; return when the next one has begun."""
        process = self.clock.process
        if power:
            os.killpg(self._supervisor.pid, signal.SIGKILL)
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
        if power:
            self._supervisor.wait()
            time.sleep(POWER_OFF)
            self._supervisor = self._start()
        end = time.monotonic() + SILENT
        while self.clock.process == process and self._supervisor.poll() is None and time.monotonic() < end:
            time.sleep(POLL)

    def close(self) -> None:
        """End the supervisor and its arcade, if they still run."""
        self._supervisor.terminate()
        with suppress(subprocess.TimeoutExpired):
            self._supervisor.wait(30.0)
        with suppress(ProcessLookupError):
            os.killpg(self._supervisor.pid, signal.SIGKILL)

    def ledger(self) -> Ledger:
        """What was seen."""
        return ledgers.read(self.folder / "ledger")

    def report(self) -> dict[str, Any]:
        """What `main.py report --json` prints about the day."""
        words = ["report", "--json", "--day", f"{self.day.times.wall(0.0):%Y-%m-%d}"]
        report: dict[str, Any] = json.loads(main_py(self.environment, *words))
        return report


def outcome(folder: Path, **wishes: Any) -> dict[str, Any]:
    """Play the days of `days_of` in an empty folder. Returns the figures; `problems` lists what was wrong."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends the supervisors, too
    os.environ["TZ"] = TIME_ZONE
    time.tzset()
    days, began, figures = days_of(**wishes), time.monotonic(), list[dict[str, Any]]()
    first, second, problems = Ledger(), Ledger(), list[str]()
    with Disk(folder / "disk", needed=any(day.full < day.seconds for day in days)) as disk:
        homes = disk.folder / "home", disk.folder / "second"
        problems += disk.troubles
        for i, day in enumerate(days):
            named = {"days": wishes, "day": i}
            if day.second:
                share(day.groups[0], *homes)
            places = [Place(folder / f"day{i + 1}", homes[0], day, {**named, "second": False})]
            if day.second:
                places.append(Place(folder / f"day{i + 1}-second", homes[1], day.second, {**named, "second": True}))
            play(places, disk)
            found = [problem for place in places for problem in problems_of(place)]
            problems += [f"day {i + 1}: {problem}" if len(days) > 1 else problem for problem in found]
            seen = [place.ledger() for place in places]
            figures.append({**figures_of(day, sum(seen[1:], seen[0])), "report": places[0].report(), "problems": found})
            first, second = first + seen[0], sum(seen[1:], second)
        together = first + second
        at_last = [
            *audit.results_of_events(together, homes[0] / "data"),
            *audit.of_files(days, first, homes[0] / "data"),
        ]
        others = [day.second for day in days if day.second]
        at_last += audit.of_files(others, second, homes[1] / "data") if others else []
        absent = sum(day.visitors for day in days) - len(together.seated)
        at_last += [f"{absent} visitors have never played"] if absent else []
    minutes = round((time.monotonic() - began) / 60.0, 1)
    shown = {"days": figures} if len(days) > 1 else figures[0]
    return {**wishes, "minutes_real": minutes, **shown, "problems": [*problems, *at_last]}


def play(places: list[Place], disk: Disk) -> None:
    """Look after the arcades until the day of each is over; the disk is full as the day of the first one says."""
    clock, full = places[0].clock, places[0].day.full
    try:
        open_places = list(places)
        while open_places:
            open_places = [place for place in open_places if not place.look()]
            disk.fill(full <= clock.seconds < full + FULL_SECONDS)
            time.sleep(POLL)
        disk.fill(False)
    except BaseException:
        for place in places:
            place.close()
        raise


def problems_of(place: Place) -> list[str]:
    """What was wrong at a place on its day."""
    troubles = place.troubles()
    place.close()
    return [*troubles, *audit.of_day(place.day, place.ledger(), place.home / "data", place.report())]


def figures_of(day: Day, ledger: Ledger) -> dict[str, Any]:
    """The figures of a day."""
    return {
        "opening": f"{day.times.wall(0.0):%Y-%m-%d %H:%M}",
        "visitors": len(ledger.seated),
        "groups": len(ledger.done),
        "matches": len(ledger.matches),
        "games": dict(Counter(match.game for match in ledger.matches)),
        "left": ledger.left,
        "at_a_kill": len(ledger.open) + ledger.playing,
        "high_scores": len(ledger.rows),
        "events": len({*ledger.events.values()}),
        "matches_of_events": sum(bool(match.event) for match in ledger.matches),
        "kills": len(day.kills) + (len(day.second.kills) if day.second else 0),
        "power_cuts": sum(kill.power for kill in day.kills),
        "waits": waits_of(ledger),
        "counts": dict(sorted(ledger.counts.items())),
        "memory": audit.memory_of_runs(ledger),
    }


def waits_of(ledger: Ledger) -> dict[str, float]:
    """The ways of phones to a seat: how many, the longest in minutes, and the most of a fair share."""
    if not ledger.waits:
        return {}
    most, share = max(wait.seconds for wait in ledger.waits), max(wait.matches / wait.fair for wait in ledger.waits)
    return {"turns": len(ledger.waits), "longest_minutes": round(most / 60.0, 1), "most_of_share": round(share, 2)}


def share(group: Group, first: Path, second: Path) -> None:
    """An event of a group that two arcades open by themselves."""
    assert group.event is not None
    path = first / "data" / event_files.FOLDER / "shared.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    names = ",".join(visitor.initials for visitor in group.visitors)
    words = ["event", "new", str(path), "--game", group.game, "--format", str(group.event.format.value)]
    main_py({**os.environ, "PIGAMING_HOME": str(first)}, *words, "--minutes", "1", "--entrants", names)
    for home, name in ((first, "left"), (second, "right")):
        (home / "data").mkdir(parents=True, exist_ok=True)
        resume.mark(home / "data", path, name)


def main_py(environment: dict[str, str], *words: str) -> str:
    """What a command of `main.py` prints."""
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), *words]
    return subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True).stdout


def free_port() -> int:
    """A port of the loopback address that nobody listens on."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])
