"""Stops when the whole arcade fails, with a match in its window and the robots in another process: this one."""

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from select import select
from tempfile import TemporaryDirectory

from pigaming_app.games.arenas import load
from pigaming_app.games.registry import games
from pigaming_app.hardware.calibration.ground_plane import to_toml
from pigaming_app.hardware.proof.outside import OutsideArena
from pigaming_app.hardware.radio.wifi import PORT
from pigaming_app.jobs.bench.sabotage import PLAYING, ROOT, Sabotage
from pigaming_app.storage.log import FILE
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import english

START = 120.0  # s until the robots have taken their places
KEY = bytes(range(100, 116))  # of the Wi-Fi robots
GAME = "pitanks"
IN_ORDER = "3"  # a seed that deals the starts in the order of the seats
PLAY = ("play", GAME, "--seats", "level5,level5,level5,level5", "--real", "all", "--minutes", "30", "--seed", IN_ORDER)


class Arcade:
    """A running arcade; a context manager."""

    def __init__(self, home: Path, feed: Path, radio: tuple[str, ...]) -> None:
        sabotaged = [sys.executable, "-X", "pigaming", "-m", "pigaming_app.jobs.bench.sabotage", str(feed)]
        self.log = home / "data" / FILE
        with (home / "arcade.log").open("ab") as log:
            self.process = subprocess.Popen(
                [*sabotaged, *PLAY, "--camera", "0", *radio],
                cwd=ROOT,
                env=environment(home),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
            )

    def __enter__(self) -> "Arcade":
        return self

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.wait()
        with suppress(OSError):
            assert self.process.stdin
            assert self.process.stdout
            self.process.stdout.close()
            self.process.stdin.close()

    @property
    def alive(self) -> bool:
        return self.process.poll() is None

    def await_match(self) -> None:
        """Wait until its match has begun. Raises RuntimeError after START s, or if it ends."""
        assert self.process.stdout
        ready = select([self.process.stdout], [], [], START)[0]
        if not ready or self.process.stdout.readline().decode().strip() != PLAYING:
            last = self.log.read_text(encoding="utf-8").splitlines()[-1:] if self.log.exists() else []
            raise RuntimeError(f"the match in the arcade did not begin; its log ends: {''.join(last) or 'nowhere'}")

    def order(self, word: str) -> None:
        """Hand it a word of `sabotage`."""
        assert self.process.stdin
        self.process.stdin.write(f"{word}\n".encode())
        self.process.stdin.flush()

    def signal(self, number: int) -> None:
        self.process.send_signal(number)


class Trials:
    """Faults of arcades that play a match on an arena outside. `radio`: arguments that choose its radio.

    `stops` are the stopping times by fault, s.
    """

    def __init__(
        self, outside: OutsideArena, folder: Path, radio: tuple[str, ...], note: Callable[[str], None]
    ) -> None:
        self.outside, self.stops = outside, dict[str, float]()
        self._home, self._radio, self._note = folder, radio, note
        _set_up(outside, folder)

    def run(self, *trials: Callable[[Arcade], None]) -> None:
        """Play a match, with robots where it starts, and try these faults. Raises RuntimeError if they do not drive."""
        for seat, start in enumerate(load(GAME, games()[GAME].arena).starts):
            self.outside.arena.place(seat, (start.x, start.y, start.heading))
        with Arcade(self._home, self.outside.feed, self._radio) as arcade:
            arcade.await_match()
            for trial in trials:
                trial(arcade)

    def fault(
        self,
        name: str,
        begin: Callable[[Arcade], None],
        end: Callable[[Arcade], None] = lambda _: None,
        report: str = "",
        raised: bool = False,
    ) -> Callable[[Arcade], None]:
        """A trial. `report`: the fault that the arcade must show and log. `raised`: it must log an error."""

        def trial(arcade: Arcade) -> None:
            self.outside.settle(lambda: arcade.alive)
            before = Counter(self._logged())
            self.stops[name] = self.outside.stopping(lambda: begin(arcade))
            self._note(f"arcade, {name}: motors stood after {1e3 * self.stops[name]:.0f} ms")
            news = "\n".join(Counter(self._logged()) - before)
            if report and english()(f"faults.{report}") not in news:
                raise RuntimeError(f"{name}: the fault was not reported")
            if raised and Sabotage.__name__ not in news:
                raise RuntimeError(f"{name}: the exception was not logged")
            end(arcade)

        return trial

    def _logged(self) -> list[str]:
        """Lines of the arcade's log and of its standard error."""
        files = (self._home / "data" / FILE, self._home / "arcade.log")
        return [line for file in files for line in file.read_text(encoding="utf-8").splitlines()]


def by_serial_line(note: Callable[[str], None], seed: int = 1) -> dict[str, float]:
    """Stopping times by fault, s. Raises OSError without pseudo-terminals, RuntimeError if the robots do not drive."""
    with TemporaryDirectory(dir=_memory()) as folder, OutsideArena(seed, Path(folder, "camera")) as outside:

        def freeze(on: bool) -> None:
            outside.arena.faults.switch("camera_frozen", on, 0)

        trials = Trials(outside, Path(folder), ("--radio", "api2", "--port", outside.port), note)
        run, fault = trials.run, trials.fault
        run(
            fault("SIGSTOP", lambda one: one.signal(signal.SIGSTOP), lambda one: one.signal(signal.SIGCONT)),
            fault("lock held", lambda one: one.order("lock"), lambda one: time.sleep(1.5)),
            fault("camera frozen", lambda one: freeze(True), lambda one: freeze(False), "camera"),
            fault(
                "exception in the tracker",
                lambda one: one.order("tracker"),
                lambda one: one.order("mend"),
                "camera",
                raised=True,
            ),
            fault("kill -9", lambda one: one.signal(signal.SIGKILL)),
        )
        run(fault("exception in the link", lambda one: one.order("link"), report="radio", raised=True))
        run(fault("exception in a scene", lambda one: one.order("scene"), raised=True))
        run(fault("port pulled", lambda one: outside.pull(), report="radio"))
        return trials.stops


def by_wifi(note: Callable[[str], None], seed: int = 1) -> dict[str, float]:
    """The same with four Wi-Fi robots that run their own program, over a network that loses 5 %.

    Raises NoMicroPython, or RuntimeError if the robots do not drive.
    """
    with TemporaryDirectory(dir=_memory()) as folder, OutsideArena(seed, Path(folder, "camera"), KEY, PORT) as outside:
        trials = Trials(outside, Path(folder), ("--radio", "udp"), note)
        fault = trials.fault
        trials.run(
            fault("Wi-Fi, SIGSTOP", lambda one: one.signal(signal.SIGSTOP), lambda one: one.signal(signal.SIGCONT)),
            fault("Wi-Fi, kill -9", lambda one: one.signal(signal.SIGKILL)),
        )
        return trials.stops


def environment(home: Path) -> dict[str, str]:
    """Environment of the arcade: a window that nobody sees, no sound, files of its own."""
    dummies = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": str(home)}
    dummies["PYGAME_HIDE_SUPPORT_PROMPT"] = "1"  # standard output belongs to `sabotage`
    return {**os.environ, **dummies}


def _set_up(outside: OutsideArena, home: Path) -> None:
    """Save number and key of the arena, and the calibration for the projection of the arcade's window."""
    (home / "config").mkdir(parents=True, exist_ok=True)
    Settings(arena_id=outside.arena.arena_id, wifi_key=outside.key.hex()).save(home / "config")
    code = (
        "from pigaming_app.storage.settings import Settings\nfrom pigaming_app.ui.window import Canvas\n"
        "print(Canvas.open(Settings(), None, None, False).projection)"
    )
    found = subprocess.run(
        [sys.executable, "-X", "pigaming", "-c", code], cwd=ROOT, env=environment(home), capture_output=True
    )
    if found.returncode:
        raise RuntimeError("a window could not be opened")
    display = found.stdout.decode().splitlines()[-1]
    ground = replace(outside.ground, display=display)
    write_atomic(home / "config" / "calibration.toml", to_toml(ground).encode())


def _memory() -> str | None:
    """A folder in memory, if there is one."""
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
