"""The figures of the reproduction on results that are known."""

import json

import pytest

from tests.bench import reproduce_table
from tests.bench.reproduce_table import Result, Row, summary


@pytest.mark.parametrize(
    ("reward", "found", "published"),
    [(1, (32, 68, 0), 1), (1, (24, 73, 3), 1), (1, (23, 77, 0), 0), (1, (32, 64, 4), 0), (2, (88, 12, 0), 1)],
)
def test_a_result_is_as_published_within_95_percent(reward, found, published):
    assert reproduce_table.is_published(reward, Result(*found)) == published


def test_the_published_wins_have_a_percentile_and_some_seeds_never_win():
    found = [Result(0, 100, 0), Result(0, 0, 100), Result(32, 68, 0), Result(90, 10, 0), Result(10, 80, 10)]
    seen = summary(1, found)
    assert ([*seen.histogram.values()], seen.percentile) == (
        [2, 1, 1, 0, 0, 1, 0],
        0.7,
    )  # three have fewer wins, one as many
    assert (seen.never, seen.reproduced) == (0.4, 0.2)
    assert seen.never_95 == pytest.approx((0.118, 0.769), abs=0.001)


def test_the_command_prints_every_seed_and_the_verdict(monkeypatch, capsys):
    """Two seeds whose results are given; without the shipped robots, which take seconds to train."""
    given = [Row(seed, Result(32, 68, 0), Result(0, 100, 0), Result(75, 1, 24)) for seed in (25, 26)]
    monkeypatch.setattr(reproduce_table, "rows", lambda recipes, seeds, fast: iter(given[: len(seeds)]))
    words = ["reproduce_table", "--seeds", "25", "26", "--set", "exposure=0"]
    monkeypatch.setattr("sys.argv", words)
    assert reproduce_table.main() == 0
    printed = capsys.readouterr().out
    assert "percentile 50.0 of 2 seeds; 0.0 % of them never win" in printed
    assert "100.0 % of them never win" in printed
    assert "by wins against classic: ahead in 2, level in 0, behind in 0" in printed
    assert "head to head: ahead in 2, level in 0, behind in 0 of 2 seeds" in printed
    monkeypatch.setattr("sys.argv", [*words, "--json"])
    assert reproduce_table.main() == 0
    told = json.loads(capsys.readouterr().out)
    assert set(told) == {"set", "published", "summary", "verdict", "seeds"}
    assert told["seeds"][1] == {"seed": 26, "one": [32, 68, 0], "two": [0, 100, 0], "duel": [75, 1, 24]}
