"""Building of a bundle by PyInstaller, in a temporary folder that finally replaces the previous bundle."""

import contextlib
import errno
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from pigaming_app import ROOT, __version__
from pigaming_app.storage.parsing import describe_error, one_line

ICO = (16, 24, 32, 48, 64, 128, 256)  # px
ICNS = {b"icp4": 16, b"icp5": 32, b"ic07": 128, b"ic08": 256, b"ic09": 512, b"ic10": 1024}  # px by type

SPEC = Path(__file__).with_name("pigaming.spec")
NAME = "pigaming"
# The libraries of NumPy and OpenCV do not survive it.
STRIPPED = (
    "libpython3*.so*",
    "python3*/lib-dynload/*.so",
    "llvmlite/binding/*.so",
    "numba/**/*.so",
    "PIL/*.so",
    "aiohttp/**/*.so",
    "_cffi_backend*.so",
    "cryptography/**/*.so",
    "frozenlist/*.so",
    "multidict/*.so",
    "propcache/*.so",
    "pygame/**/*.so",
    "yarl/*.so",
)
APP = "PiGaming.app"  # on macOS, beside the folder
# %k is the path of the file itself, so that the folder can lie anywhere.
DESKTOP = f"""[Desktop Entry]
Type=Application
Version=1.5
Name=PiGaming
Comment=Robot arcade
Comment[pt]=Arcada de robôs
Exec=sh -c "exec \\\\"\\\\$(dirname \\\\"\\\\$1\\\\")/{NAME}\\\\"" sh %k
Icon={NAME}
Terminal=false
Categories=Game;Education;
X-PiGaming-Version={__version__}
"""


@cache
def png(size: int) -> bytes:
    """The icon of `size` x `size` px as a PNG file."""
    from pigaming_app.scenes.title.logo import icon
    from pigaming_app.ui.png import png_of

    return png_of(icon(size))


def ico() -> bytes:
    """The icon of Windows: a header, 16 bytes for each picture, the pictures."""
    directory, pictures = b"", b""
    begin = 6 + 16 * len(ICO)
    for size in ICO:
        picture = png(size)
        edge = size % 256  # 0 means 256
        directory += struct.pack("<BBBBHHII", edge, edge, 0, 0, 1, 32, len(picture), begin + len(pictures))
        pictures += picture
    return struct.pack("<HHH", 0, 1, len(ICO)) + directory + pictures


def icns() -> bytes:
    """The icon of macOS: a header, then each picture with its type and length."""
    pictures = b"".join(kind + struct.pack(">I", 8 + len(png(size))) + png(size) for kind, size in ICNS.items())
    return b"icns" + struct.pack(">I", 8 + len(pictures)) + pictures


class BuildFailed(Exception):
    """The bundle could not be built; the text is one line."""


@dataclass(frozen=True)
class Built:
    """A bundle: its program, and the bytes in its folder."""

    program: Path
    size: int


def build(out: Path) -> Built:
    """Build `out`/pigaming, replacing an older bundle. Raises BuildFailed."""
    target = out / NAME
    if target.exists() and not is_bundle(target):
        raise BuildFailed(f"{target} is something else than a bundle: choose another folder by --out.")
    with _scratch(out) as scratch:
        _run_pyinstaller(scratch)
        made = scratch / "dist"
        folder = made / NAME
        (folder / "pigaming.png").write_bytes(png(256))
        if sys.platform.startswith("linux"):
            entry = folder / "pigaming.desktop"
            entry.write_text(DESKTOP, encoding="utf-8")
            entry.chmod(0o755)  # file managers ask less
            _strip(folder / "_internal")
        size = sum(path.lstat().st_size for path in folder.rglob("*") if not path.is_dir())
        for name in (NAME, APP):
            if (made / name).exists():
                _replace(made / name, out / name, scratch / f"old {name}")
    return Built(target / program_name(), size)


def program_name() -> str:
    """File name of the program in the folder of a bundle."""
    return f"{NAME}.exe" if sys.platform == "win32" else NAME


def is_bundle(folder: Path) -> bool:
    """True if the folder holds a bundle."""
    return (folder / program_name()).is_file() and (folder / "_internal").is_dir()


@contextlib.contextmanager
def _scratch(out: Path) -> Iterator[Path]:
    """A temporary folder beside the bundle, deleted in the end. Raises BuildFailed for errors of the file system."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".pigaming-", dir=out, ignore_cleanup_errors=True) as name:
            yield Path(name)
    except OSError as error:
        raise BuildFailed(one_line(f"{error.filename or out}: {describe_error(error)}")) from None


def _run_pyinstaller(scratch: Path) -> None:
    """Run PyInstaller; the bundle is in `scratch`/dist. Raises OSError, as for a full disk, or BuildFailed."""
    environment = dict(os.environ)
    if picture := {"win32": ico, "darwin": icns}.get(sys.platform):
        environment["PIGAMING_ICON"] = str(scratch / f"pigaming.{picture.__name__}")
        Path(environment["PIGAMING_ICON"]).write_bytes(picture())
    command = [sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN"]
    command += ["--distpath", str(scratch / "dist"), "--workpath", str(scratch / "work"), str(SPEC)]
    done = subprocess.run(
        command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace"
    )
    if done.returncode:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["no reason given"]
        if os.strerror(errno.ENOSPC) in done.stderr:
            raise OSError(errno.ENOSPC, lines[-1])
        raise BuildFailed(one_line(f"PyInstaller failed: {lines[-1]}"))


def _strip(libraries: Path) -> None:
    """Remove the symbols that only linkers and debuggers read, where that saves megabytes and the tool is there."""
    if tool := shutil.which("strip"):
        for path in (found for pattern in STRIPPED for found in libraries.glob(pattern)):
            subprocess.run([tool, "--strip-unneeded", path], capture_output=True, check=False)


def _replace(made: Path, target: Path, aside: Path) -> None:
    """Put a finished folder in the place of an older one, which goes `aside`. Raises OSError."""
    if target.exists():
        target.rename(aside)
    try:
        made.rename(target)
    except OSError:
        if aside.exists():
            aside.rename(target)
        raise
