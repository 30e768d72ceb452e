"""A day from outside: the supervisor is started, the arcade killed, and the ledger compared with what was kept."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

from pigaming_app import ROOT
from pigaming_app.storage.pin import PinFile
from tests.bench.open_day import ledger as ledgers
from tests.bench.open_day.arcade import PORT
from tests.bench.open_day.audit import memory_of_runs, problems
from tests.bench.open_day.clock import OPENING, DayClock
from tests.bench.open_day.plan import PIN, Day, plan

KILLS = 5
POLL = 0.002  # s
SILENT = 180.0  # s of real time without a frame after which the day is given up
SUPERVISOR = """
import sys
from pigaming_app.jobs.kiosk.start import supervise
sys.exit(supervise(sys.argv[1:]))
"""


def outcome_of_day(
    folder: Path, hours: float, visitors: int, seed: int, kills: int = KILLS, only: str = ""
) -> dict[str, Any]:
    """Play a day in an empty folder. Returns its figures; `problems` lists what was wrong."""
    day, began = plan(hours, visitors, seed, kills, only), time.monotonic()
    home = folder / "home"
    wishes = {"hours": hours, "visitors": visitors, "seed": seed, "kills": kills, "only": only}
    (folder / "day.json").write_text(json.dumps(wishes), encoding="utf-8")
    PinFile(home / "config").set(PIN)
    environment = {
        **os.environ,
        "PIGAMING_HOME": str(home),
        "PYTHONPATH": str(ROOT),
        "SDL_VIDEODRIVER": "dummy",
        "SDL_AUDIODRIVER": "dummy",
        "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
        PORT: str(free_port()),
    }
    code, troubles = play(day, folder, environment)
    ledger, data = ledgers.read(folder / "ledger"), home / "data"
    report = report_of(environment)
    found = [*troubles, *([f"the supervisor ended with {code}"] if code else []), *problems(day, ledger, data, report)]
    return {
        "hours": hours,
        "minutes_real": round((time.monotonic() - began) / 60.0, 1),
        "visitors": len(ledger.seated),
        "groups": len(ledger.done),
        "matches": len(ledger.matches),
        "games": dict(Counter(match.game for match in ledger.matches)),
        "left": ledger.left,
        "at_a_kill": len(ledger.open) + ledger.playing,
        "high_scores": len(ledger.rows),
        "events": len(ledger.events),
        "matches_of_events": sum(bool(match.event) for match in ledger.matches),
        "kills": len(day.kills),
        "counts": dict(sorted(ledger.counts.items())),
        "memory": memory_of_runs(ledger),
        "report": report,
        "problems": found,
    }


def play(day: Day, folder: Path, environment: dict[str, str]) -> tuple[int, list[str]]:
    """Run the supervisor to the end of the day, and kill the arcade as planned. Returns its code and troubles."""
    clock = DayClock(folder / "clock")
    arcade = [sys.executable, "-m", "tests.bench.open_day.arcade", str(folder)]
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends the supervisor, too
    supervisor = subprocess.Popen([sys.executable, "-c", SUPERVISOR, *arcade], cwd=ROOT, env=environment)
    kills, frames, since = list(day.kills), 0, time.monotonic()
    try:
        while (code := supervisor.poll()) is None:
            if clock.frames != frames:
                frames, since = clock.frames, time.monotonic()
            if time.monotonic() - since > SILENT:
                return 0, [f"no frame for {SILENT:.0f} s, at {clock.seconds:.0f} s"]
            if kills and frames and clock.seconds >= kills[0].after and clock.place == kills[0].place:
                kill(clock)
                kills.pop(0)
            time.sleep(POLL)
        return code, [f"{len(kills)} kills had no occasion: {kills}"] if kills else []
    finally:
        supervisor.terminate()
        supervisor.wait(30.0)


def kill(clock: DayClock) -> None:
    """Kill the arcade, and wait until the next one has begun."""
    process = clock.process
    os.kill(process, signal.SIGKILL)
    end = time.monotonic() + 120.0
    while clock.process == process and time.monotonic() < end:
        time.sleep(POLL)


def report_of(environment: dict[str, str]) -> dict[str, Any]:
    """What `main.py report --json` prints about the day."""
    command = [
        sys.executable,
        "-X",
        "pigaming",
        str(ROOT / "main.py"),
        "report",
        "--json",
        "--day",
        f"{OPENING:%Y-%m-%d}",
    ]
    done = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    report: dict[str, Any] = json.loads(done.stdout)
    return report


def free_port() -> int:
    """A port of the loopback address that nobody listens on."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return int(taken.getsockname()[1])
