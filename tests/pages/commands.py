"""The commands of README.md, CONTRIBUTING.md and docs/: blocks, and code in sentences that begins like a command."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from pigaming_app.jobs.registry import jobs

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
PAGES += [ROOT / "docs/lessons/README.md", *sorted((ROOT / "docs/lessons/en").glob("*.md"))]
PROGRAMS = (
    *("python3", "python", ".venv/bin/python", "main.py", "pigaming", "pip", "pipx", "uv", "uvx", "sudo", "cd", "make"),
    *("roscore", "ray", "mpremote", "tests.bench"),
)
FENCE = re.compile(r"^ *```(\w*)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(?<!`)`([^`]+)`(?!`)")
REMARK = re.compile(r" {2,}(?![-\[])| +# ")  # what follows is for people
SHELL = {"", "sh", "bash", "console"}  # languages of fenced blocks of commands


@dataclass(frozen=True)
class Command:
    """A command as printed, without the words beside it; `line` counts from 1."""

    page: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}: {self.text}"


def commands(page: Path) -> list[Command]:
    """Every command of a page, in its order."""
    text = page.read_text(encoding="utf-8")
    blocks = FENCE.sub(lambda fence: _indented(fence[2]) if fence[1] in SHELL else _blank(fence[0]), text)
    found = chain(_in_blocks(blocks), _in_sentences(blocks))
    name = page.relative_to(ROOT).as_posix()
    return [Command(name, line, words) for line, words in sorted(found)]


def _blank(text: str) -> str:
    return "\n" * text.count("\n")


def _indented(code: str) -> str:
    return "\n" + "".join(f"    {line}\n" for line in code.splitlines())


def _in_blocks(text: str) -> Iterator[tuple[int, str]]:
    """Lines that are indented by four spaces; one that is indented further goes on with the line before."""
    paragraph, last = "", (0, "")
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("    ") and not re.match(r"\d+\. |- ", paragraph):
            if line.startswith("     "):
                last = last[0], f"{last[1]} {line.strip()}"
                continue
            if last[1]:
                yield last
            last = number, REMARK.split(line.strip())[0]
        else:
            if last[1]:
                yield last
            last = 0, ""
            paragraph = line if line.strip() and not line.startswith("  ") else paragraph if line.strip() else ""
    if last[1]:
        yield last


def _in_sentences(text: str) -> Iterator[tuple[int, str]]:
    prose = re.sub(r"^    (?! ).*$", "", text, flags=re.MULTILINE)
    for code in CODE.finditer(prose):
        words = " ".join(code[1].split())
        first, *others = words.split(" ")
        if (first in PROGRAMS and others) or (
            first in jobs() and any(_is_option(word) or first == "bench" for word in others)
        ):
            yield prose.count("\n", 0, code.start()) + 1, words


def _is_option(word: str) -> bool:
    return word.startswith(("-", "[-"))


if __name__ == "__main__":
    for page in PAGES:
        for command in commands(page):
            print(command)
