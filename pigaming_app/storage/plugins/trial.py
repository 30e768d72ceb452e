"""A first import of a plug-in in a process of its own, so that what ends a process at import ends no job.

Exceptions are none of its business: they are told with file and line where the plug-in is loaded in earnest. A plug-in
that has passed is not tried again until its sources change.
"""

import hashlib
import json
import os
import subprocess
import sys
import traceback
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from pigaming_app import ROOT, __version__
from pigaming_app.storage.parsing import parse_json, read_text
from pigaming_app.storage.plugins.found import Plugin
from pigaming_app.storage.plugins.time_limit import time_limit
from pigaming_app.storage.safe_files import NotSaved, write_atomic
from pigaming_app.storage.settings import NoHome, folders

VARIABLE = "PIGAMING_TRIAL"  # of the environment of such a process, which loads no other plug-ins
FILE = "plugins.json"  # in the cache folder: digests of plug-ins that have passed
KEPT = 50
PASSED, FAULT = "passed", "fault: "  # last lines of the process
SPARE = 5.0  # s for the process to start


def is_trial() -> bool:
    """Whether this process is for a trial alone."""
    return VARIABLE in os.environ


def fault(plugin: Plugin, parts: Sequence[str], seconds: float) -> str:
    """Why a plug-in cannot be imported in a job, or nothing. `seconds`: for one part."""
    digest, passed = _digest(plugin), _passed()
    if digest in passed:
        return ""
    lines, code = _run([plugin.module, str(plugin.folder), str(seconds), *parts], seconds + SPARE)
    if lines[-1:] == [PASSED]:
        with suppress(NotSaved, NoHome):
            write_atomic(folders().cache / FILE, json.dumps([*passed, digest][-KEPT:]).encode())
        return ""
    if lines and lines[-1].startswith(FAULT):
        return lines[-1].removeprefix(FAULT)
    part = next((line for line in reversed(lines) if line in parts), "") or "__init__"
    if code is None:
        return f"{part}.py: its import is not done after {seconds:g} s"
    return f"{part}.py: its import ends the process {f'with exit code {code}' if code >= 0 else f'by signal {-code}'}"


def _run(words: Sequence[str], seconds: float) -> tuple[list[str], int | None]:
    """Run this module. Returns its lines, and its exit code; None: it did not end in time."""
    process = subprocess.Popen(
        [sys.executable, "-m", __name__, *words],
        cwd=ROOT,
        env={**os.environ, VARIABLE: "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    )
    with process:
        try:
            output, _ = process.communicate(timeout=seconds)
            code: int | None = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            (output, _), code = process.communicate(), None
        except BaseException:
            process.kill()
            raise
    return output.decode(errors="replace").splitlines(), code


def _passed() -> list[str]:
    try:
        found = parse_json(read_text(folders().cache / FILE))
    except (OSError, ValueError, NoHome):
        return []
    return [one for one in found if isinstance(one, str)] if isinstance(found, list) else []


def _digest(plugin: Plugin) -> str:
    """Hash of all sources of a plug-in, of where it is, and of what imports it."""
    sha = hashlib.sha256(f"{__version__} {sys.version} {plugin.module} {plugin.folder}".encode())
    for path in sorted(plugin.folder.rglob("*.py")):
        with suppress(OSError):
            sha.update(f"\0{path.relative_to(plugin.folder)}\0".encode() + path.read_bytes())
    return sha.hexdigest()


def _try(module: str, folder: str, seconds: str, *parts: str) -> None:
    """Import a plug-in, naming each part before. Its own prints go nowhere."""
    report, sys.stdout = sys.stdout, open(os.devnull, "w")  # noqa: SIM115
    for part in parts:
        print(f"\n{part}", file=report, flush=True)
        try:
            with time_limit(float(seconds)):
                name = f"{module}.{part}" if part else module
                if not part or find_spec(name):
                    import_module(name)
        except TimeoutError as error:
            frames = traceback.extract_tb(error.__traceback__)
            inside = [frame for frame in frames if Path(folder) in Path(frame.filename).parents]
            place = f"{Path(inside[-1].filename).relative_to(folder)}, line {inside[-1].lineno}: " if inside else ""
            print(f"\n{FAULT}{place}TimeoutError: {error}", file=report, flush=True)
            os._exit(1)
        except BaseException:
            break  # it is told where it happens in earnest
    print(f"\n{PASSED}", file=report, flush=True)
    os._exit(0)


if __name__ == "__main__":
    _try(*sys.argv[1:])
