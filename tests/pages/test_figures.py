"""Blocks that a program writes: derived ones are those of the code, and measured ones have its rows and columns."""

import re
from dataclasses import replace
from itertools import pairwise

import pytest

from pigaming_app import links
from pigaming_app.games import setup
from pigaming_app.games.registry import games
from pigaming_app.hardware.proof.figures import DRIVERS
from pigaming_app.hardware.proof.showings import SHOWINGS
from pigaming_app.jobs.bench import figures
from pigaming_app.jobs.bench.robots import BY_DRIVER, SHOWING, TARGETS
from pigaming_app.scenes.bench import frame_times
from tests.bench.detection import Sample
from tests.bench.figures import as_markdown, on_page, pattern, robots, write
from tests.bench.figures.derived import bundles, where_to_get_it
from tests.bench.figures.duels import LEAST
from tests.bench.figures.registry import DERIVED, MEASURED
from tests.bench.figures.seeds import READINGS, compared, counted
from tests.bench.reproduce_table import BINS, Result, Row
from tests.pages.commands import PAGES, ROOT

SMALL = 0.01  # share of the work
TRAINING = ("seeds", "verdict")  # their rows are those of robots that train for seconds
LEANT = tuple(name for name in MEASURED if name.endswith("sensitivity"))
COMPILED = ("people", "auto", "seats", "exploits", *LEANT)  # take minutes


@pytest.fixture
def _small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Short matches without overtime; and given results in place of proofs and pictures that take minutes."""
    for game in games().values():
        for name, variant in game.variants.items():
            monkeypatch.setitem(game.variants, name, replace(variant, overtime=0.0))
    monkeypatch.setattr(setup, "MIN_MINUTES", LEAST)
    monkeypatch.setattr(figures, "PLAIN_TICKS", 100)
    monkeypatch.setattr(frame_times, "FIRST", 1)
    groups = {SHOWING: dict.fromkeys(SHOWINGS, TARGETS), BY_DRIVER: dict.fromkeys(DRIVERS, TARGETS)}
    monkeypatch.setattr(robots, "measured", lambda: TARGETS | groups)
    monkeypatch.setattr(robots, "found", lambda *look: [Sample(16, 23.0, 1.4, 1 / 60, True)])


@pytest.mark.parametrize("name", DERIVED)
def test_a_derived_block_is_that_of_the_code(name: str) -> None:
    block = DERIVED[name]
    renew = f"python -m tests.bench.figures --only {name} --write"
    assert on_page(block.page, name) == block.text(), renew


@pytest.mark.parametrize("name", MEASURED)
def test_a_measured_block_names_a_version_and_its_command(name: str) -> None:
    block = MEASURED[name]
    first = on_page(block.page, name).partition("\n")[0]
    assert re.fullmatch(rf"Version \d+\.\d+\.\d+( to \d+\.\d+\.\d+)?, `{re.escape(block.command)}`:", first)


@pytest.mark.usefixtures("_small")
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.long, pytest.mark.again] if name in COMPILED else [])
        for name in MEASURED
        if name not in TRAINING
    ],
)
def test_a_measured_block_has_the_rows_and_columns_of_its_program(name: str) -> None:
    block = MEASURED[name]
    assert outline(on_page(block.page, name)) == outline(as_markdown(block.table(SMALL)))


def test_the_histogram_counts_every_seed_once() -> None:
    wins = zip([0, 0, 1, 20, 100], [21, 55, 99, 80, 41], strict=True)
    found = [Row(0, Result(one, 100 - one, 0), Result(two, 100 - two, 0), Result(0, 100, 0)) for one, two in wins]
    head, *body = counted(found)
    assert [int(row[1]) for row in body] == [2, 2, 0, 0, 0, 0, 1]
    assert [int(row[3]) for row in body] == [0, 0, 1, 2, 1, 1, 0]
    assert [len(row[2]) for row in body] == [20, 20, 0, 0, 0, 0, 10]
    assert sorted(wins for low, high in BINS for wins in range(low, high + 1)) == [*range(101)]
    assert outline(on_page(MEASURED["seeds"].page, "seeds")) == outline(as_markdown([head, *body]))


def test_the_verdict_counts_seeds_of_either_reward() -> None:
    """Of four seeds of reward 1 one has fewer wins than published, and one as many."""
    wins = ((0, 94), (32, 0), (40, 100), (50, 50))
    found = [Row(0, Result(one, 100 - one, 0), Result(two, 100 - two, 0), Result(60, 0, 40)) for one, two in wins]
    table = compared(dict.fromkeys(READINGS, found))
    cells = {row[0]: row[1:] for row in table}
    assert cells["win fewer matches than published"][:2] == ["37.5 %", "62.5 %"]
    assert cells["never win a match"][0].startswith("25.0 %")
    assert cells["tie all matches"][:2] == ["25.0 %", "25.0 %"]
    assert cells["lie inside every published interval"][:2] == ["50.0 %", "25.0 %"]
    assert cells["win more against `classic` than the other reward"][:2] == ["25.0 %", "50.0 %"]
    assert cells["beat the other reward head to head"][:2] == ["100.0 %", "0.0 %"]
    assert outline(on_page(MEASURED["verdict"].page, "verdict")) == outline(as_markdown(table))


def outline(text: str) -> tuple[list[str], list[str], set[int]]:
    """Head, first column, and number of cells a row, of the table in a text."""
    head, _, *body = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in re.findall(r"^\|.*$", text, re.M)
    ]
    return head, [row[0] for row in body if not row[0][:1].isdigit()], {len(row) for row in (head, *body)}


def test_every_block_of_a_page_is_registered() -> None:
    known = {(one.page, name) for name, one in DERIVED.items()} | {(one.page, name) for name, one in MEASURED.items()}
    found = set()
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        marks = re.findall(r"^<!-- (.*?) -->$", text, re.M)
        assert marks[1::2] == ["end"] * (len(marks) // 2), page
        found |= {(page.relative_to(ROOT).as_posix(), name) for name in marks[::2]}
    assert found == known


def test_a_table_below_a_command_that_measures_is_a_block() -> None:
    measures = re.compile(r"tests\.bench\.|main\.py (duel|league|bench)\b|figures of version", re.I)
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for name in re.findall(r"^<!-- (?!end)(.*?) -->$", text, re.M):
            text = pattern(name).sub("", text, count=1)
        for before, table in pairwise(text.split("\n\n")):
            if table.startswith("|") and not before.startswith("    "):
                assert not measures.search(before), f"{page.name}: {table.splitlines()[0]}"


def test_no_place_is_mentioned_that_does_not_exist(monkeypatch: pytest.MonkeyPatch) -> None:
    assert (where_to_get_it(), bundles()) == ("", "") or links.DOWNLOAD or links.CLONE
    if not links.DOWNLOAD:
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            assert not re.search(r"\[[^\]]*download[^\]]*\]\(http|releases/", text, re.I), page
            assert "git clone" not in text or links.CLONE, page
    monkeypatch.setattr(links, "DOWNLOAD", "https://example.org/pigaming")
    monkeypatch.setattr(links, "CLONE", "https://example.org/pigaming.git")
    assert "[download](https://example.org/pigaming)" in where_to_get_it()
    assert "    git clone https://example.org/pigaming.git" in where_to_get_it()
    assert "https://example.org/pigaming" in bundles()


def test_a_place_is_written_in_one_file_only() -> None:
    addresses = re.compile(r"https?://[\w./-]*pigaming", re.I)
    ours = [
        *PAGES,
        *(ROOT / "pigaming_app").rglob("*.py"),
        *(ROOT / "assets/text").glob("*.toml"),
        ROOT / "pyproject.toml",
    ]
    assert [
        str(file) for file in ours if file.name != "links.py" and addresses.search(file.read_text(encoding="utf-8"))
    ] == []


def test_a_block_is_written_into_its_page_and_nothing_else(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.bench.figures.ROOT", tmp_path)
    file = tmp_path / "a.md"
    file.write_text("before\n<!-- one -->\nold\n<!-- end -->\nafter\n<!-- two -->\n<!-- end -->\n", encoding="utf-8")
    write("a.md", "one", "new\nlines")
    write("a.md", "two", "")
    text = file.read_text(encoding="utf-8")
    assert text == "before\n<!-- one -->\nnew\nlines\n<!-- end -->\nafter\n<!-- two -->\n<!-- end -->\n"
    assert (on_page("a.md", "one"), on_page("a.md", "two")) == ("new\nlines", "")


def test_readme_is_short_and_begins_with_two_commands() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 110
    assert re.findall(r"^    (\S.*?)(?:  .*)?$", text, re.M) == ["python3 main.py", "python3 main.py test"]
    assert not re.search(r"hand[0-9*]|39th|44th", text)
    assert not re.search(r"\b(cost|about) \d+ (each|a )", text), "prices have a currency"
