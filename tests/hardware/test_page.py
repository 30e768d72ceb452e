"""docs/hardware.md agrees with the program: its commands, messages, tests, and the number of faults."""

import re
import shlex
import tomllib
from importlib import import_module
from pathlib import Path

import pytest

from pigaming_app.hardware.emulator.faults import FAULTS
from pigaming_app.jobs.cli import Parser
from pigaming_app.jobs.registry import jobs
from pigaming_app.jobs.terminal.options import declare_job

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/hardware.md").read_text(encoding="utf-8")
QUOTED = re.findall(r"^    python3 main\.py(.*)$|`python3 main\.py([^`]*)`", PAGE, re.MULTILINE)
COMMANDS = sorted({re.split("#|>", line or inline)[0] for line, inline in QUOTED})


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


def test_tests_and_faults_exist() -> None:
    assert set(re.findall(r"`(test_\w+\.py)`", PAGE)) <= {path.name for path in (ROOT / "tests/hardware").rglob("*.py")}
    assert re.findall(r"inject (\d+) faults", PAGE) == [str(len(FAULTS))]
