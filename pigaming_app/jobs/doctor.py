"""Check of the installation: packages, folders, assets, devices and engine, with advice. It changes no file."""

import contextlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from importlib import metadata
from pathlib import Path

from pigaming_app import ASSETS, FROZEN, INSTALLED, ROOT, __version__
from pigaming_app.boot.interpreter import ARCADE, StartError, has_both_pygames, is_missing, packages
from pigaming_app.boot.interpreter import requirements as listed
from pigaming_app.boot.version import commit
from pigaming_app.jobs.terminal.options import JsonOption
from pigaming_app.jobs.terminal.refusal import remedy
from pigaming_app.links import DOWNLOAD
from pigaming_app.storage.optional import optional
from pigaming_app.storage.parsing import one_line, parse_json
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.restarts import restarts
from pigaming_app.storage.settings import PHONE, Folders, NoHome, Settings, folders

MIN_FREE = 200_000_000  # bytes of free disk space, below which the report has a note
TIMEOUT = 15.0  # s for the drivers to answer
WHOLE = f"get the whole folder of the program again {DOWNLOAD}".rstrip()
REINSTALL = "install the package again" if INSTALLED else WHOLE
RESTART = REINSTALL if INSTALLED or FROZEN else "start main.py again"
PROGRAM = "pigaming" if INSTALLED or FROZEN else "main.py"
EXTRAS = {
    "train": "bench, duel, league and train are slow without it; the arcade does not need it",
    "hardware": "only real robots need it",
    "keyring": "without it the Wi-Fi's password of robots and phones is a setting, as plain text",
    "ray": "only training on several machines needs it",
    "phones": "only phones as pads or as the camera need it",
    "onnx": "only ONNX models as players need it",
}
DEVICES = {  # state and advice where it is missing
    "pygame": ("problem", REINSTALL if INSTALLED or FROZEN else "delete the folder .venv and start main.py again"),
    "displays": ("note", "connect one to play; play --headless, duel and bench go without"),
    "sound": ("note", "the arcade is silent, and works"),
    "pads": ("note", "it works as a plain joystick; a mapping in SDL_GAMECONTROLLERCONFIG names its buttons"),
    "fonts": ("problem", REINSTALL),
}
UNTOLD = {  # about cameras by OpenCV, by system
    "linux": "other sizes and rates are not told",
    "win32": "names and other sizes are not told; exposures are in powers of two",
    "darwin": "names, other sizes and exposures are not told, and no exposure can be set",
}


@dataclass(frozen=True)
class Line:
    """One finding. `state`: ok, note (playing is possible all the same) or problem."""

    what: str
    state: str
    found: str
    advice: str = ""


def run(options: JsonOption) -> int:
    """Print the report; 1 if something prevents playing."""
    lines = report()
    ok = all(line.state != "problem" for line in lines)
    if options.json:
        print(json.dumps({"ok": ok, "lines": [asdict(line) for line in lines]}))
        return int(not ok)
    for line in lines:
        advice = f"  ->  {line.advice}" if line.advice else ""
        print(one_line(f"{line.state:8} {line.what:24} {line.found}{advice}"))
    print("All is well." if ok else "Something prevents playing: see the lines that begin with problem.")
    return int(not ok)


def report() -> list[Line]:
    """All findings. It never raises: a failed check becomes a line."""
    return [*_system(), *_packages(), *_files(), *_assets(), *_devices(), *_cameras(), _engine()]


def _system() -> Iterator[Line]:
    yield Line("PiGaming", "ok", f"{__version__}, commit {commit()}")
    yield Line("Python", "ok", f"{platform.python_version()}, {sys.executable}")
    yield Line(
        "system", "ok", f"{platform.system()} {platform.release()}, {platform.machine()}, {os.cpu_count()} cores"
    )


def _packages() -> Iterator[Line]:
    installed = packages([ROOT] if FROZEN else [Path(folder) for folder in sys.path if folder.endswith("-packages")])
    for group in (ARCADE, *EXTRAS):
        try:
            wanted = requirements(group)
        except StartError as trouble:
            yield Line("packages", "problem", str(trouble), REINSTALL)
            return
        for requirement in wanted:
            name = re.split("[<>]", requirement)[0]
            if not is_missing(installed, requirement):
                yield Line(name, "ok", installed[name])
            elif group == ARCADE:
                yield Line(name, "problem", f"{installed.get(name, 'missing')}, but {requirement} is needed", RESTART)
            else:
                yield Line(name, "note", installed.get(name, "not installed"), _advice(group))
    if has_both_pygames(installed):
        yield Line(
            "pygame", "problem", "it is installed beside pygame-ce and they overwrite each other", "uninstall both"
        )


def requirements(group: str) -> list[str]:
    """The packages of an extra, or of ARCADE, with their versions: `numba>=0.61,<1`. Raises StartError."""
    if not INSTALLED:
        return listed([group])
    try:
        lines = [line.partition(";") for line in metadata.requires("pigaming-app") or ()]
    except metadata.PackageNotFoundError:
        raise StartError("the list of packages is missing") from None
    extra = "" if group == ARCADE else group
    return [requirement.strip() for requirement, _, marker in lines if marker.partition("==")[2].strip(" '\"") == extra]


def _advice(extra: str) -> str:
    return EXTRAS[extra] + (
        f": {remedy(extra)}" if INSTALLED or FROZEN else "; main.py fetches it for the jobs that use it"
    )


def _files() -> Iterator[Line]:
    """The user's folders, and findings in the data folder."""
    try:
        where = folders()
    except NoHome as trouble:
        yield Line("folders", "problem", str(trouble))
        return
    yield from _folders(where)
    yield from _restarts(where.data)
    yield _kiosk(where.config)


def _folders(where: Folders) -> Iterator[Line]:
    for what, folder in (("settings", where.config), ("scores", where.data), ("cache", where.cache)):
        existing = _nearest(folder)
        try:
            tempfile.TemporaryFile(dir=existing).close()
        except OSError as error:
            yield Line(what, "note", f"{folder} ({error.strerror})", "it cannot be written, so nothing will be kept")
            continue
        yield Line(what, "ok", str(folder))
    yield from _free_space(where)


def _free_space(where: Folders) -> Iterator[Line]:
    """The free space of each disk that holds one of the folders."""
    disks = {os.stat(place).st_dev: place for place in map(_nearest, (where.cache, where.data, where.config))}
    for place in disks.values():
        try:
            free = shutil.disk_usage(place).free
        except OSError as error:
            yield Line(
                "free space", "note", f"{place} ({error.strerror})", "it cannot be read; make sure there is some"
            )
            continue
        full = "" if free >= MIN_FREE else f"make room: below {MIN_FREE // 1_000_000} MB files may not be kept"
        yield Line("free space", "note" if full else "ok", f"{free // 1_000_000:,} MB for {place}", full)


def _restarts(data: Path) -> Iterator[Line]:
    """Restarts of a kiosk after a crash or a hang."""
    if found := restarts(data):
        last = found[-1]
        text = (
            f"{len(found)}, the last one at {one_line(last.time, 40)} ({one_line(f'{last.reason}: {last.detail}', 80)})"
        )
        yield Line("kiosk restarts", "note", text, f"the reports in {data / 'crashes'} give the reasons")


def _kiosk(config: Path) -> Line:
    """How visitors could leave a kiosk here."""
    ways = [] if PinFile(config).exists else ["its operator has no PIN"]
    advice = [] if PinFile(config).exists else [f"{PROGRAM} kiosk pin"]
    if sys.platform == "win32":
        ways.append("Ctrl+Alt+Del leads out")
        advice.append("a user with assigned access (docs/open-day.md)")
    elif sys.platform == "darwin":
        ways.append("Command+Option+Escape leads out")
        advice.append("Guided Access (docs/open-day.md)")
    elif desktop := next(filter(None, map(os.environ.get, ("XDG_CURRENT_DESKTOP", "DESKTOP_SESSION"))), ""):
        ways.append(f"Ctrl+Alt+F2 leads out, and there is a desktop ({one_line(desktop, 40)})")
        advice.append("a session of its own (docs/open-day.md)")
    if not ways:
        return Line("kiosk", "ok", "it needs the PIN to be left, and no desktop is below it")
    return Line("kiosk", "note", f"visitors can leave it: {'; '.join(ways)}", "; ".join(advice))


def _nearest(folder: Path) -> Path:
    """The folder, or its nearest parent that exists."""
    for place in (folder, *folder.parents):
        with contextlib.suppress(OSError):  # a name that is too long
            if place.exists():
                return place
    return Path()


def _assets() -> Iterator[Line]:
    from pigaming_app.games.arenas import arenas, load
    from pigaming_app.games.registry import games
    from pigaming_app.sim.arena import ArenaError
    from pigaming_app.storage.plugins.parts import failures

    every = games()
    for failure in failures():
        yield Line("added game", "note", failure, "mend it, or switch it off: main.py games off NAME")
    for game in every:
        names = arenas(game)
        for name in names:
            try:
                load(game, name)
            except ArenaError as error:
                yield Line("arena", "note", str(error), "mend the file, or take it away")
        yield Line(
            "arenas", "ok" if names else "problem", f"{game}: {', '.join(names) or 'none'}", "" if names else REINSTALL
        )
    for what, files, state in (("texts", "text/*.toml", "problem"), ("sounds", "sounds/*.ogg", "note")):
        count = len(list(ASSETS.glob(files)))
        yield Line(what, "ok" if count else state, f"{count} files", "" if count else REINSTALL)


def _devices() -> Iterator[Line]:
    answers = _probed()
    for what, (state, advice) in DEVICES.items():
        if what not in answers:
            yield Line(what, state, "its driver did not answer", advice)
        else:
            found, wrong = answers[what]
            none = "none; the keyboard will do" if what == "pads" else "none"
            text = "; ".join(part for part in (found, wrong) if part) or none
            yield Line(what, state if wrong else "ok", text.rstrip("."), advice if wrong else "")


def _cameras() -> Iterator[Line]:
    """Cameras for real robots, their formats, and what OpenCV does not tell about them on this system."""
    try:
        discovery = optional("hardware.vision.discovery")
    except ImportError as error:
        yield Line("cameras", "note", f"not looked for: {error}")
        return
    if discovery is None:
        yield Line("cameras", "note", "not looked for: the feature mat is not installed")
        return
    names = {str(camera.number): camera.name for camera in discovery.cameras()}
    chosen = _chosen_camera()
    if not names:
        yield Line("cameras", "ok", "none" if isinstance(chosen, str) else "none; only real robots need one")
    else:
        yield from _connected(names, f"{discovery.__package__}.formats")
    if chosen == PHONE:
        yield Line("camera of settings", "ok", "a phone, which connects while the arcade runs")
    elif isinstance(chosen, str):
        yield _stream(chosen, f"{discovery.__package__}.formats")


def _connected(names: Mapping[str, str], prober: str) -> Iterator[Line]:
    """Cameras of this computer, by number and name."""
    linux = sys.platform.startswith("linux")
    untold = UNTOLD.get("linux" if linux else sys.platform, "names and other sizes are not told")
    found = ", ".join(f"{number} ({name})" for number, name in names.items())
    advice = "set 1/60 s and a fixed focus in the camera's own program" if sys.platform == "darwin" else ""
    yield Line(
        "cameras", "note" if advice else "ok", f"{found if linux else 'numbers 0 to 2 were tried'}; {untold}", advice
    )
    answers = {str(number): str(told) for number, told in _answers(prober, *names)}
    for number in names:
        if told := answers.get(number):
            yield Line(f"camera {number}", "ok", told)
        elif linux or number not in answers:
            silent = "it does not open" if number in answers else "OpenCV did not answer"
            yield Line(f"camera {number}", "note", silent, "close other programs that use it; main.py robots says more")


def _chosen_camera() -> int | str:
    try:
        return Settings.load(folders().config)[0].camera
    except NoHome:
        return Settings().camera


def _stream(address: str, prober: str) -> Line:
    """The camera at an address, by its host: that has no password."""
    told = next(((str(host), str(told)) for host, told in _answers(prober, given=address)), None)
    if told and told[1]:
        return Line("camera of settings", "ok", f"{told[0]}: {told[1]}")
    found = f"{told[0]}: it does not open" if told else "OpenCV did not answer"
    return Line("camera of settings", "note", found, "start it, and check address, password and Wi-Fi")


def _probed() -> dict[str, tuple[str, str]]:
    """Answers of the probe: (found, wrong) by name."""
    return {str(name): (str(found), str(wrong)) for name, found, wrong in _answers("pigaming_app.ui.probe")}


def _answers(module: str, *arguments: str, given: str = "") -> Iterator[list[object]]:
    """The lines of JSON that a module prints in a process of its own, up to its end, crash or timeout.

    `given`: its standard input.
    """
    command = [sys.executable, "-m", module, *arguments]
    environment = {**os.environ, "PYGAME_HIDE_SUPPORT_PROMPT": "1", "PYTHONIOENCODING": "utf-8"}
    try:
        output = subprocess.run(
            command, cwd=ROOT, env=environment, input=given.encode(), capture_output=True, timeout=TIMEOUT, check=False
        ).stdout
    except subprocess.TimeoutExpired as stopped:
        output = stopped.stdout or b""
    for line in output.decode(errors="replace").splitlines():
        with contextlib.suppress(ValueError):  # other output of a driver
            answer = parse_json(line)
            if isinstance(answer, list):
                yield answer


def _engine() -> Line:
    try:
        from pigaming_app.ai.registry import new_match
        from pigaming_app.games.setup import make_setup

        match = new_match(
            make_setup("pitanks", ["level1", "level5"], "classic", 1, 1, None, None, ["level1", "level5"])
        )
        for _ in range(50):
            match.tick()
    except Exception as error:  # a broken engine must not prevent the report
        return Line("engine", "problem", f"{type(error).__name__}: {error}", REINSTALL)
    return Line("engine", "ok", "a second of a match was played")
