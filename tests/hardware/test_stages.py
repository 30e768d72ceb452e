"""The rooms of hardware: arrows between its stages, imports without OpenCV, and docs/hardware.md."""

import re
import shlex
import subprocess
import sys
import tomllib
from graphlib import TopologicalSorter
from importlib import import_module

import pytest

from pigaming_app.hardware.emulator.faults import FAULTS
from pigaming_app.hardware.proof.emergencies import EMERGENCIES
from pigaming_app.jobs.cli import Parser
from pigaming_app.jobs.registry import jobs
from pigaming_app.jobs.terminal.options import declare_job
from tests.test_layers import PACKAGE, imported

HARDWARE = PACKAGE / "hardware"
ROOT = PACKAGE.parent
MODULES = sorted(
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in HARDWARE.rglob("*.py")
    if path.stem != "__init__" and "micropython" not in path.parts  # for another interpreter
)
PAGE = (ROOT / "docs/hardware.md").read_text(encoding="utf-8")
QUOTED = re.findall(r"^    python3 main\.py(.*)$|`python3 main\.py([^`]*)`", PAGE, re.MULTILINE)
COMMANDS = sorted({re.split("#|>", line or inline)[0] for line, inline in QUOTED})
SHARED = {"recordings", "robot_kinds", "run_writer", "signals"}
MAY = {
    "radio": set(),
    "vision": set(),
    "calibration": {"vision"},
    "control": {"radio", "tracking"},
    "tracking": {"calibration", "vision"},
    "ros": {"control", "radio", "tracking"},
    "drivers": {"radio", "ros"},
    "commissioning": {"control", "radio", "tracking"},
    "sysid": {"calibration"},
    "scan": {"calibration", "control", "vision"},
    "emulator": {"calibration", "vision"},
    "session": {"calibration", "control", "drivers", "emulator", "radio", "ros", "scan", "tracking", "vision"},
    "proof": {
        "calibration",
        "commissioning",
        "control",
        "drivers",
        "emulator",
        "radio",
        "scan",
        "session",
        "tracking",
        "vision",
    },
}


def test_no_stage_leads_back_to_itself():
    assert set(TopologicalSorter(MAY).static_order()) == set(MAY)


def test_every_stage_and_every_shared_module_has_its_place():
    assert {path.name for path in HARDWARE.iterdir() if (path / "__init__.py").is_file()} == set(MAY)
    assert {path.stem for path in HARDWARE.glob("*.py")} == SHARED | {"__init__"}


def test_a_stage_imports_only_those_before_it():
    for path in sorted(HARDWARE.rglob("*.py")):
        stage = path.relative_to(HARDWARE).parts[0].removesuffix(".py")
        for module, _ in imported(path):
            if module.startswith("pigaming_app.hardware."):
                other = module.split(".")[2]
                assert other in SHARED | {stage} | MAY.get(stage, set()), f"{path.name} imports {module}"


def test_everything_is_imported_without_opencv_and_pyserial():
    names = "".join(f"import {name}\n" for name in ("pigaming_app.jobs.cli", "pigaming_app.scenes.start", *MODULES))
    code = f"import sys\nsys.modules['cv2'] = sys.modules['serial'] = None\n{names}"
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)


def texts(table):
    """All texts of a language."""
    for value in table.values():
        yield from texts(value) if isinstance(value, dict) else [value]


def is_text(words: str, text: str) -> bool:
    """True if `words` are a text with its gaps filled, or filled by dots."""
    if re.fullmatch(".{1,60}".join(map(re.escape, re.split(r"\{\w+\}", text))), words):
        return True
    parts = [part.strip() for part in re.split(r"…|\d+", words)]
    return any(len(part) > 8 for part in parts) and all(part in text for part in parts if re.search(r"[a-z]", part))


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_is_understood(command: str) -> None:
    words = shlex.split(command)
    name, rest = ("arcade", words) if not words or words[0].startswith("-") else (words[0], words[1:])
    assert name in jobs()
    parser = Parser(allow_abbrev=False)
    declare_job(parser, import_module(f"pigaming_app.jobs.{jobs()[name].module}"))
    parser.parse_args(rest)


def test_messages_are_those_of_the_program() -> None:
    table = PAGE.partition("## Troubleshooting")[2].partition("\n## ")[0]
    english = tomllib.loads((ROOT / "assets/text/en.toml").read_text(encoding="utf-8"))
    known = [text for text in texts(english) if isinstance(text, str) and len(re.sub(r"\{\w+\}", "", text)) > 8]
    cells = [row.split("|")[1] for row in table.splitlines() if row.startswith("| *")]
    named = [words for cell in cells for words in re.findall(r"\*([^*]+)\*", cell)]
    assert len(named) > 50
    assert [words for words in named if not any(is_text(words, text) for text in known)] == []


def test_every_fault_that_is_proven_stands_in_the_table_with_what_to_do() -> None:
    table = PAGE.partition("## Troubleshooting")[2].partition("\n## ")[0]
    rows = [[cell.strip() for cell in row.split("|")[1:-1]] for row in table.splitlines() if row.startswith("| ")][1:]
    english = tomllib.loads((ROOT / "assets/text/en.toml").read_text(encoding="utf-8"))["faults"]
    shown = [words for cell, *_ in rows for words in re.findall(r"\*([^*]+)\*", cell)]
    reports = {name for emergency in EMERGENCIES.values() for name in emergency.reports} | {"disobeys"}
    assert [name for name in sorted(reports) if not any(is_text(words, english[name]) for words in shown)] == []
    assert [row for row in rows if len(row) != 3 or not all(row)] == []


def test_tests_and_faults_exist() -> None:
    assert set(re.findall(r"`(test_\w+\.py)`", PAGE)) <= {path.name for path in (ROOT / "tests/hardware").rglob("*.py")}
    assert re.findall(r"inject (\d+) faults", PAGE) == [str(len(FAULTS))]
