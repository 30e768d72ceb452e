"""Renewal of constraints.txt, the versions that `main.py` installs: `python -m tests.constraints`, with uv in PATH.

One version of each package serves every Python and system, wherever there is one: a system is resolved with the
versions of the one before as its preferences. Where an extra has no wheels for a Python and system, nothing is
constrained there.
"""

import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from itertools import groupby, product
from subprocess import DEVNULL
from tempfile import TemporaryDirectory

from pigaming_app.boot.environment import CONSTRAINTS
from pigaming_app.boot.interpreter import PROJECT

PYTHONS = ("3.11", "3.12", "3.13", "3.14")
SYSTEMS = {  # uv's name: values of sys_platform and platform_machine
    "x86_64-manylinux_2_28": ("linux", "x86_64"),
    "aarch64-manylinux_2_28": ("linux", "aarch64"),
    "x86_64-pc-windows-msvc": ("win32", "AMD64"),
    "aarch64-apple-darwin": ("darwin", "arm64"),
    "x86_64-apple-darwin": ("darwin", "x86_64"),
}
UV = ("uv", "pip", "compile", "--quiet", "--only-binary=:all:", "--prerelease=disallow", "--no-python-downloads",
      "--no-header", "--no-annotate", str(PROJECT))  # fmt: skip
MACOS = "14.0"  # the oldest
HEADER = "# The versions that main.py installs; renewed by `python -m tests.constraints`.\n"

Pins = dict[str, str]  # version by package
Target = tuple[str, str]  # system, Python


def resolved(target: Target, extras: list[str], preferred: Pins) -> Pins | None:
    """The versions for one target, the preferred ones if possible; None if a package has none."""
    system, python = target
    with TemporaryDirectory() as folder:
        file = f"{folder}/pins.txt"  # uv keeps the versions that it finds there
        with open(file, "w", encoding="utf-8") as draft:
            draft.writelines(f"{name}=={version}\n" for name, version in preferred.items())
        command = [*UV, *(f"--extra={extra}" for extra in extras), "--output-file", file]
        command += ["--python-platform", system, "--python-version", python]
        surroundings = {**os.environ, "MACOSX_DEPLOYMENT_TARGET": MACOS}
        if subprocess.run(command, env=surroundings, stdout=DEVNULL, stderr=DEVNULL).returncode:
            return None
        with open(file, encoding="utf-8") as done:
            return dict(re.findall(r"(?m)^([\w.-]+)==(\S+)", done.read()))


def every_target() -> dict[Target, Pins]:
    """The versions for each Python and system, without the extras that have no wheels there."""
    extras = list(tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]["optional-dependencies"])
    found: dict[Target, Pins] = {}
    preferred: Pins = {}
    for target in product(SYSTEMS, PYTHONS):
        pins = resolved(target, extras, preferred)
        if pins is None:
            fit = [extra for extra in extras if resolved(target, [extra], preferred) is not None]
            print(*target, "without", *sorted({*extras} - {*fit}), file=sys.stderr)
            pins = resolved(target, fit, preferred) or {}
        found[target] = pins
        preferred = {**pins, **preferred}
    return found


def lines(found: dict[Target, Pins]) -> Iterator[str]:
    """The lines of a constraints file, with markers where a package has several versions."""
    for name in sorted({name for pins in found.values() for name in pins}):
        versions = {pins[name] for pins in found.values() if name in pins}
        if len(versions) == 1:
            yield f"{name}=={versions.pop()}"
            continue
        for system, (platform, machine) in SYSTEMS.items():
            here = [(python, found[system, python].get(name)) for python in PYTHONS if name in found[system, python]]
            for version, run in groupby(here, key=lambda pair: pair[1]):
                pythons = [python for python, _ in run]
                marker = f"sys_platform == '{platform}' and platform_machine == '{machine}'"
                if len(pythons) < len(PYTHONS):
                    marker += f" and python_version >= '{pythons[0]}' and python_version <= '{pythons[-1]}'"
                yield f"{name}=={version} ; {marker}"


if __name__ == "__main__":
    CONSTRAINTS.write_text(HEADER + "".join(f"{line}\n" for line in lines(every_target())), encoding="utf-8")
