"""The baselines of docs/benchmark.md, whose agents lie beside their results."""

import hashlib
from pathlib import Path

import pytest

from pigaming_app.ai.ppo.registry import TASKS as TRAININGS
from pigaming_app.ai.ppo.task_file import read_task
from pigaming_app.gym.benchmark import results as room
from pigaming_app.gym.benchmark.results import verify
from pigaming_app.gym.benchmark.tasks import PARTNERS, SHIPPED
from tests.bench.figures.derived import results_of

DOCS = Path(__file__).resolve().parents[3] / "docs"
FILES = sorted((DOCS / "benchmark").glob("*.json"))


def test_agents_lie_beside_their_results_and_are_small() -> None:
    for path in FILES:
        for run in results_of(path).runs:
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
    monkeypatch.setattr(room, "engine_hash", lambda *_: results_of(path).engine)
    verify(path, print)
