"""A bundle, built and run in an empty root: without Python, without network, with the C library and zlib only.

PIGAMING_BUNDLE names a bundle that is already built.
"""

import json
import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from pigaming_app import ROOT, __version__
from pigaming_app.boot.version import commit
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.registry import games
from pigaming_app.jobs.bundle.build import is_bundle

MAX_BYTES = 450_000_000
C_LIBRARIES = ("c.so.6", "m.so.6", "dl.so.2", "pthread.so.0", "rt.so.1", "util.so.1", "resolv.so.2",
               "z.so.1")  # which PyInstaller's program needs before it reads its own  # fmt: skip
ENVIRONMENT = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": "/home"}
TITLE = 2.0  # s until the first picture of the title is drawn, as time of a core: other tests run beside
AS_FAST = 1.25  # times the clone's own
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="an empty root is made of Linux's tools"),
]


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if ready := os.environ.get("PIGAMING_BUNDLE"):
        assert is_bundle(Path(ROOT, ready)), f"no bundle in {ready}"
        return Path(ROOT, ready).resolve()
    if not find_spec("PyInstaller"):
        pytest.skip("PyInstaller is not installed; `main.py bundle` fetches it")
    out = tmp_path_factory.mktemp("bundle")
    command = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "bundle", "--out", str(out), "--json"]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    assert json.loads(built.stdout)["program"] == str(out / "pigaming" / "pigaming")
    return out / "pigaming"


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that is /home in the empty root."""
    return tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def inside(bundle: Path, home: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[str]]:
    """The command that runs the bundle in an empty root; its user's files are kept from run to run.

    Bubblewrap makes the root, also without network; where it may not, or is not there, root takes chroot.
    """
    words = by_bubblewrap(bundle, home)
    if shutil.which("bwrap") and subprocess.run([*words, "--help"], capture_output=True, check=False).returncode == 0:
        yield words
    elif os.geteuid() == 0:
        yield by_chroot(bundle, home, tmp_path_factory.mktemp("root"))
    else:
        pytest.skip("an empty root needs bubblewrap, with user namespaces, or a test run as root")


def by_bubblewrap(bundle: Path, home: Path) -> list[str]:
    words = ["bwrap", "--unshare-all", "--die-with-parent", "--clearenv", "--dev", "/dev", "--proc", "/proc"]
    words += ["--tmpfs", "/tmp", "--bind", str(home), "/home", "--ro-bind", str(bundle), "/opt/pigaming"]
    for library in c_libraries(bundle / "pigaming"):
        words += ["--ro-bind", os.path.realpath(library), library]
    for name, value in ENVIRONMENT.items():
        words += ["--setenv", name, value]
    return [*words, "--chdir", "/home", "/opt/pigaming/pigaming"]


def by_chroot(bundle: Path, home: Path, root: Path) -> list[str]:
    """Without /proc and devices. The bundle is hard-linked or copied into the root, /home is moved there."""
    (root / "opt").mkdir()
    (root / "tmp").mkdir()
    (root / "dev").mkdir()
    (root / "dev/null").touch()
    linked = subprocess.run(["cp", "-al", bundle, root / "opt/pigaming"], capture_output=True, check=False)
    if linked.returncode:  # on another file system
        subprocess.run(["cp", "-a", bundle, root / "opt/"], check=True)
    for library in c_libraries(bundle / "pigaming"):
        copy = root / library.lstrip("/")
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(library, copy)
    home.rmdir()
    (root / "home").mkdir()
    home.symlink_to(root / "home")
    variables = [f"{name}={value}" for name, value in ENVIRONMENT.items()]
    return ["env", "-i", *variables, str(shutil.which("chroot")), str(root), "/opt/pigaming/pigaming"]


def c_libraries(program: Path) -> list[str]:
    """The paths of C_LIBRARIES and their loader, as every program of this system names them."""
    told = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    folder = next(Path(line.split()[2]).parent for line in told.splitlines() if "libc.so.6 =>" in line)
    loader = next(line.split()[0] for line in told.splitlines() if "ld-linux" in line)
    files = (folder / f"lib{name}" for name in C_LIBRARIES)
    return [loader, *(str(file) for file in files if file.exists())]


def run(inside: list[str], *words: str) -> "subprocess.CompletedProcess[str]":
    ended = subprocess.run([*inside, *words], capture_output=True, text=True, timeout=500, check=False)
    assert "Traceback" not in ended.stderr
    return ended


def test_it_is_a_folder_of_limited_size_with_icon_and_desktop_entry(bundle: Path) -> None:
    assert is_bundle(bundle)
    assert (
        sum(path.stat().st_size for path in bundle.rglob("*") if path.is_file() and not path.is_symlink()) <= MAX_BYTES
    )
    assert (bundle / "pigaming.png").is_file()
    assert subprocess.run(["grep", "-c", "Exec=", bundle / "pigaming.desktop"], capture_output=True, check=True)


def test_a_match_is_played_and_its_replay_verified_with_the_same_engine(inside: list[str], home: Path) -> None:
    seats = ("--seats", "level3,level5", "--minutes", "0.2", "--record", "/home/a.replay")
    played = run(inside, "play", "pitanks", "--headless", "--speed", "max", *seats)
    assert (played.returncode, played.stderr) == (0, "")
    assert run(inside, "replay", "--verify", "/home/a.replay").returncode == 0
    assert engine_hash().encode() in (home / "a.replay").read_bytes()


def test_the_doctor_finds_every_library(inside: list[str]) -> None:
    ended = run(inside, "doctor", "--json")
    report = json.loads(ended.stdout)
    assert (ended.returncode, report["ok"]) == (0, True)
    lines = {line["what"]: line for line in report["lines"]}
    for what in (
        "pygame-ce",
        "numpy",
        "numba",
        "opencv-python-headless",
        "pyserial",
        "aiohttp",
        "segno",
        "ifaddr",
        "cryptography",
        "pygame",
        "fonts",
        "sounds",
        "engine",
    ):
        assert lines[what]["state"] == "ok", lines[what]


@pytest.mark.again
def test_learning_is_compiled_in_it_and_kept_compiled_in_the_users_folder(inside: list[str], home: Path) -> None:
    ended = run(inside, "train", "qlearning", "--matches", "4", "--minutes", "0.05", "--out", "/home/q.npz")
    assert ended.returncode == 0, ended.stderr
    assert "compiling the training" in ended.stderr
    assert "numba" not in ended.stderr
    compiled = set((home / "cache").rglob("*.nbc"))
    assert compiled
    again = run(inside, "train", "qlearning", "--matches", "4", "--minutes", "0.05", "--out", "/home/r.npz")
    assert (again.returncode, set((home / "cache").rglob("*.nbc"))) == (0, compiled)
    with np.load(home / "q.npz") as first, np.load(home / "r.npz") as second:
        learned = [name for name in first.files if name != "head"]  # which has the day and the file's name
        assert learned
        assert all(np.array_equal(first[name], second[name]) for name in learned)
    assert duel(inside, "pitanks", "/home/q.npz", "level1")


@pytest.mark.parametrize("brain", sorted(path.stem for path in (ROOT / "assets" / "brains").glob("*.npz")))
def test_every_shipped_network_and_table_plays_in_it(inside: list[str], brain: str) -> None:
    game = brain if brain in games() else "pitanks"
    file = f"/opt/pigaming/_internal/assets/brains/{brain}.npz"
    assert duel(inside, game, file, "level1")


def duel(inside: list[str], game: str, *players: str) -> dict[str, object]:
    ended = run(inside, "duel", game, *players, "--matches", "2", "--minutes", "0.05", "--json")
    assert ended.returncode == 0, ended.stderr
    found: dict[str, object] = json.loads(ended.stdout)
    return found


@pytest.mark.again
def test_emulated_robots_drive_under_the_emulated_camera(inside: list[str]) -> None:
    seats = ("--seats", "level3,level3", "--real", "1,2", "--minutes", "0.05")
    ended = run(inside, "play", "pitanks", "--emulate", "--headless", *seats)
    assert ended.returncode == 0, ended.stderr
    assert len(ended.stdout.splitlines()) == 2


def test_the_title_is_there_as_soon_as_from_a_clone(inside: list[str], home: Path) -> None:
    assert run(inside, "--frames", "1").returncode == 0  # from a warm disk, as the clone
    clone = [sys.executable, "-X", "pigaming", str(ROOT / "main.py"), "--frames", "1"]
    bundled, cloned = [], []
    for _ in range(8):  # by turns, until both have had a core to themselves
        bundled.append(core_time([*inside, "--frames", "1"]))
        cloned.append(core_time(clone))
        if min(bundled) <= min(TITLE, AS_FAST * min(cloned)):
            break
    assert min(bundled) <= TITLE
    assert min(bundled) <= AS_FAST * min(cloned)


def core_time(command: list[str]) -> float:
    """Seconds of a core that a command takes with all its processes."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_it_names_its_version_and_the_commit_that_it_was_made_from(inside: list[str]) -> None:
    ended = run(inside, "--version")
    assert ended.stdout == f"PiGaming {__version__}, commit {commit()}\n"


def test_it_opens_in_a_kiosk(inside: list[str]) -> None:
    assert run(inside, "--kiosk", "--frames", "5").returncode == 0


def test_as_root_it_plays_in_a_bare_chroot_too(bundle: Path, tmp_path: Path) -> None:
    if os.geteuid():
        pytest.skip("chroot is for root")
    (tmp_path / "root").mkdir()
    (tmp_path / "user").mkdir()
    words = by_chroot(bundle, tmp_path / "user", tmp_path / "root")
    seats = ("--seats", "level3,level5", "--minutes", "0.05")
    played = run(words, "play", "pitanks", "--headless", "--speed", "max", *seats)
    assert (played.returncode, played.stderr) == (0, "")


@pytest.mark.parametrize(
    "words", [["test"], ["bundle"], ["train", "qlearning", "--out", "/home/a.npz", "--curve", "/home/a.png"]]
)
def test_what_it_lacks_is_one_line(inside: list[str], words: list[str]) -> None:
    ended = run(inside, *words)
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
