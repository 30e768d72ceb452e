"""The job `bench` measures memory: a fresh arcade stays small."""

import pytest

from pigaming_app.games.registry import games
from pigaming_app.jobs.bench import memory as bench_memory


@pytest.mark.long
def test_the_title_of_a_fresh_arcade_needs_at_most_150_mb() -> None:
    assert ("title", "lobby", *games()) == bench_memory.STATES
    found = bench_memory.measured_alone("title")
    assert found is None or 30.0 < found <= 150.0
