"""Every command of README, CONTRIBUTING and docs/ runs: those of a page in their order, in one folder.

It ends with 0, the files that it names are there afterwards, and `--json` prints one JSON object.
"""

import json
import re
import shlex
from pathlib import Path

import pytest

from pigaming_app.boot.start import extras
from tests.pages.commands import PAGES, ROOT, Command, commands
from tests.pages.sandbox import FILES, Sandbox
from tests.pages.stand_ins import ELSEWHERE, FORMULAS, MAY_MISS, PLACEHOLDERS

TARGET = r"--(?:out|csv|record|screenshot|poster|curve|matches|json|sheet)|>|event new|export \w+ [\w-]+"
WRITTEN = re.compile(rf"(?:{TARGET}) (\w[\w.-]*\.\w+)")  # files that a command makes
PROVEN = {"docs/add-a-game.md": "tests/test_add_a_game.py"}  # pages whose commands have a test of their own
NAMES = {page.relative_to(ROOT).as_posix(): page for page in PAGES}
ALL = {name: commands(page) for name, page in NAMES.items() if name not in PROVEN}
FIRST = {command.text: command for page in reversed(ALL.values()) for command in reversed(page)}


@pytest.fixture
def sandbox(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Sandbox:
    return Sandbox(monkeypatch, tmp_path)


def filled_in(command: Command) -> str:
    """The command with something in every gap."""
    text = command.text
    for row in PLACEHOLDERS:
        text = re.sub(row.part, row.instead, text)
    return text


def is_elsewhere(command: Command) -> bool:
    return any(re.fullmatch(row.command, command.text) for row in ELSEWHERE)


@pytest.mark.parametrize("page", ALL)
def test_every_command_of_a_page_runs(page: str, sandbox: Sandbox, capfd: pytest.CaptureFixture[str]) -> None:
    for command in ALL[page]:
        if command.text.startswith(FORMULAS):
            continue
        text = filled_in(command)
        words, _, redirected = text.partition(" > ")
        if FIRST[command.text] != command and not WRITTEN.search(text):
            continue  # it has run for another page, or further up
        if is_elsewhere(command):
            assert sandbox.parse(shlex.split(words)) == 0, f"{command}\n{capfd.readouterr().err}"
            continue
        sandbox.lend(text, WRITTEN.findall(text))
        capfd.readouterr()
        code = sandbox.run(shlex.split(words))
        printed = capfd.readouterr()
        assert code == 0 or (code == 1 and re.fullmatch(MAY_MISS, command.text)), f"{command}\n{printed.err[-2000:]}"
        assert sandbox.asked <= extras(re.sub(r"^(python3 )?main\.py ?", "", words).split()), (
            f"{command}: main.py does not fetch {sandbox.asked}"
        )
        if redirected:
            Path(redirected).write_text(printed.out, encoding="utf-8")
        assert all(Path(name).stat().st_size for name in WRITTEN.findall(text)), command
        if re.search(r"--json(?! \w)", text):
            assert isinstance(json.loads(printed.out), dict), command


def test_a_line_of_a_block_can_be_typed_as_it_stands() -> None:
    """`main.py` alone is no program of a shell, and many systems have no `python`."""
    for page in NAMES.values():
        assert re.findall(r"^    (?:main\.py|python) .*", page.read_text(encoding="utf-8"), re.MULTILINE) == [], page


def test_each_row_of_the_tables_is_needed() -> None:
    texts = [command.text for page in ALL.values() for command in page]
    gaps = [text for text in texts for row in PLACEHOLDERS if re.search(row.part, text)]
    assert gaps
    for row in ELSEWHERE:
        assert any(re.fullmatch(row.command, text) for text in texts), row
        assert (ROOT / row.proof).exists(), row
    for start in FORMULAS:
        assert any(text.startswith(start) for text in texts), start
    for name in FILES:
        assert any(name in filled_in(command) for page in ALL.values() for command in page), name
    assert all((ROOT / file).exists() for file in PROVEN.values())


def test_every_gap_of_a_command_is_filled() -> None:
    gap = re.compile(r"…|\[|\b(GAME|BRAIN|NAME|FILE|FOLDER|DIR|LEFT|RIGHT|JOB|V|N)\b")
    run = [one for page in ALL.values() for one in page if not is_elsewhere(one) and not one.text.startswith(FORMULAS)]
    assert [str(one) for one in run if gap.search(filled_in(one))] == []
