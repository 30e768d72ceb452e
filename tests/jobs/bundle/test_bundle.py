"""A bundle, built and run in an empty root: without Python, without network, with the C library and zlib only.

PIGAMING_BUNDLE names a bundle that is already built.
"""

import json
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from pigaming_app import ROOT
from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.jobs.bundle.build import is_bundle

MAX_BYTES = 450_000_000
C_LIBRARIES = ("c.so.6", "m.so.6", "dl.so.2", "pthread.so.0", "rt.so.1", "util.so.1", "resolv.so.2")
C_LIBRARIES += ("z.so.1",)  # which PyInstaller's program needs before it reads its own
pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="an empty root is made of Linux's tools"),
]


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if ready := os.environ.get("PIGAMING_BUNDLE"):
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
def inside(bundle: Path, home: Path) -> list[str]:
    """The command that runs the bundle in an empty root; its user's files are kept from run to run."""
    if not shutil.which("bwrap"):
        pytest.skip("bubblewrap is not installed")
    words = ["bwrap", "--unshare-all", "--die-with-parent", "--clearenv", "--dev", "/dev", "--proc", "/proc"]
    words += ["--tmpfs", "/tmp", "--bind", str(home), "/home", "--ro-bind", str(bundle), "/opt/pigaming"]
    for library in c_libraries(bundle / "pigaming"):
        words += ["--ro-bind", os.path.realpath(library), library]
    for name, value in {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", "PIGAMING_HOME": "/home"}.items():
        words += ["--setenv", name, value]
    words += ["--chdir", "/home"]
    if subprocess.run([*words, "/opt/pigaming/pigaming", "--help"], capture_output=True, check=False).returncode:
        tried = subprocess.run([*words, "/nothing"], capture_output=True, text=True, check=False)
        if "execvp" not in tried.stderr:
            pytest.skip(f"bubblewrap may not make an empty root here: {tried.stderr.strip()}")
    return [*words, "/opt/pigaming/pigaming"]


def c_libraries(program: Path) -> list[str]:
    """The paths of C_LIBRARIES and their loader, as every program of this system names them."""
    told = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    folder = next(Path(line.split()[2]).parent for line in told.splitlines() if "libc.so.6 =>" in line)
    loader = next(line.split()[0] for line in told.splitlines() if "ld-linux" in line)
    files = (folder / f"lib{name}" for name in C_LIBRARIES)
    return [loader, *(str(file) for file in files if file.exists())]


def run(inside: list[str], *words: str) -> "subprocess.CompletedProcess[str]":
    ended = subprocess.run([*inside, *words], capture_output=True, text=True, timeout=100, check=False)
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
        "pygame",
        "fonts",
        "sounds",
        "engine",
    ):
        assert lines[what]["state"] == "ok", lines[what]


def test_learning_is_compiled_in_it(inside: list[str]) -> None:
    if "CI" not in os.environ or find_spec("numba") is None:
        pytest.skip("compiling takes a minute: the release workflow, which sets CI, does it")
    ended = run(inside, "train", "qlearning", "--matches", "4", "--minutes", "0.05", "--out", "/home/q.npz")
    assert ended.returncode == 0, ended.stderr
    assert "numba" not in ended.stderr


def test_emulated_robots_drive_under_the_emulated_camera(inside: list[str]) -> None:
    seats = ("--seats", "level3,level3", "--real", "1,2", "--minutes", "0.05")
    ended = run(inside, "play", "pitanks", "--emulate", "--headless", *seats)
    assert ended.returncode == 0, ended.stderr
    assert len(ended.stdout.splitlines()) == 2


def test_the_title_opens_also_in_a_kiosk(inside: list[str]) -> None:
    assert run(inside, "--frames", "1").returncode == 0
    assert run(inside, "--kiosk", "--frames", "5").returncode == 0


@pytest.mark.parametrize("words", [["test"], ["bundle"], ["train", "qlearning", "--out", "a.npz", "--curve", "a.png"]])
def test_what_it_lacks_is_one_line(inside: list[str], words: list[str]) -> None:
    ended = run(inside, *words)
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
