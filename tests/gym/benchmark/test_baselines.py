"""The baselines of docs/benchmark.md: its table is that of their results, whose agents lie beside them.

python -m tests.gym.benchmark.test_baselines --write
"""

import hashlib
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import mean

import pytest

from pigaming_app.ai.ppo.registry import TASKS as TRAININGS
from pigaming_app.ai.ppo.task_file import read_task
from pigaming_app.gym.benchmark import results as room
from pigaming_app.gym.benchmark.results import BenchmarkResults, by_budget, verify
from pigaming_app.gym.benchmark.tasks import FORMAT, PARTNERS, SHIPPED, TASKS
from pigaming_app.storage.schema import from_json

DOCS = Path(__file__).resolve().parents[3] / "docs"
PAGE, FILES = DOCS / "benchmark.md", sorted((DOCS / "benchmark").glob("*.json"))
BLOCK = re.compile(r"(?<=<!-- baselines -->\n).*?(?=<!-- end -->)", re.DOTALL)


def read(path: Path) -> BenchmarkResults:
    return from_json(path.read_text("utf-8"), BenchmarkResults, FORMAT)


def table() -> Iterator[str]:
    yield "| task | method | trainings | score, % | share of wins by condition, % |"
    yield "|---|---|---|---|---|"
    order = [*TASKS]
    for found in sorted(
        map(read, FILES), key=lambda one: (order.index(one.task), -mean(run.score for run in one.runs))
    ):
        for score, low, high, count in by_budget(found).values():
            points = {
                name: [run.conditions[name].points for run in found.runs] for name in TASKS[found.task].conditions
            }
            each = (f"{name} {mean(row):.0f}" for name, row in points.items())  # of 100 matches
            cells = f"{100 * score:.1f} ({100 * low:.0f}–{100 * high:.0f}) | {', '.join(each)}"
            yield f"| `{found.task}` | {found.method} | {count} | {cells} |"


def test_the_table_is_that_of_the_results() -> None:
    assert FILES
    assert BLOCK.findall(PAGE.read_text("utf-8")) == ["\n".join([*table(), ""])]


def test_agents_lie_beside_their_results_and_are_small() -> None:
    for path in FILES:
        for run in read(path).runs:
            raw = (path.parent / run.agent).read_bytes()
            assert hashlib.sha256(raw).hexdigest() == run.sha256
            assert len(raw) <= 25_000


def test_the_baseline_learns_by_what_the_protocol_permits() -> None:
    task = read_task(DOCS / "benchmark" / "ppo.task.toml", TRAININGS["pitanks"])
    assert {*task.arenas} == {*SHIPPED["pitanks"]}
    assert not {*PARTNERS} & {name for one in task.line_ups for name in one.seats}


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_plays_out_as_it_says(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the hash of the engine, so that a change of the rules that changes no match needs no new results."""
    monkeypatch.setattr(room, "engine_hash", lambda *_: read(path).engine)
    verify(path, print)


if __name__ == "__main__":
    written = BLOCK.sub("\n".join([*table(), ""]).replace("\\", r"\\"), PAGE.read_text("utf-8"))
    sys.exit("--write is missing" if "--write" not in sys.argv else PAGE.write_text(written, "utf-8") < 0)
