"""The baselines of docs/benchmark.md, whose agents lie beside their results."""

import hashlib
from pathlib import Path

import pytest

from pigaming_app.ai.ppo.registry import TASKS as TRAININGS
from pigaming_app.ai.ppo.task_file import read_task
from pigaming_app.gym.benchmark import results as room
from pigaming_app.gym.benchmark.results import verify
from pigaming_app.gym.benchmark.tasks import PARTNERS, SHIPPED
from tests.bench.benchmark_curves import LADDER, METHODS, CurvePoint, curves, filed, resulted, results_of

DOCS = Path(__file__).resolve().parents[3] / "docs"
FILES = sorted((DOCS / "benchmark").glob("*.json"))


def test_agents_lie_beside_their_results_and_are_small() -> None:
    for path in FILES:
        for run in results_of(path).runs:
            raw = (path.parent / run.agent).read_bytes()
            assert hashlib.sha256(raw).hexdigest() == run.sha256
            assert len(raw) <= (60_000 if run.agent.startswith("table") else 25_000)


def test_the_baseline_learns_by_what_the_protocol_permits() -> None:
    task = read_task(DOCS / "benchmark" / "ppo.task.toml", TRAININGS["pitanks"])
    assert {*task.arenas} == {*SHIPPED["pitanks"]}
    assert not {*PARTNERS} & {name for one in task.line_ups for name in one.seats}


def test_each_training_stands_once_on_its_curve_and_nearly_fills_its_budget() -> None:
    found = [*filed(), *resulted()]
    assert {*filed()} & {*resulted()} == set()
    assert len({point[:3] for point in found}) == len(found)
    for point in found:
        assert point.method in METHODS
        assert 0.8 * point.budget <= point.decisions <= point.budget in LADDER


def test_a_curve_has_means_and_intervals_of_students_t() -> None:
    """Of 0.2, 0.3, 0.7: 0.4, and 4.303 times 0.26458 / sqrt 3 to either side (W. S. Gosset, 1908), within 0 and 1."""
    made = [CurvePoint("ppo", 1_000_000, seed, 999_000, score) for seed, score in ((1, 0.2), (2, 0.3), (3, 0.7))]
    ((middle, low, high, count),) = curves(made)["ppo"].values()
    assert middle == pytest.approx(0.4)
    assert (low, high, count) == (0.0, 1.0, 3)
    ((_, low, high, _),) = curves([point._replace(score=0.4 + point.score / 10) for point in made])["ppo"].values()
    assert (high - low) / 2 == pytest.approx(4.303 * 0.026458 / 3**0.5, rel=1e-4)
    assert not curves(made[:2]), "three trainings at least, as the protocol says"


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_plays_out_as_it_says(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the hash of the engine, so that a change of the rules that changes no match needs no new results."""
    monkeypatch.setattr(room, "engine_hash", lambda *_: results_of(path).engine)
    verify(path, print)
