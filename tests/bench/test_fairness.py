"""The measures of fairness on matches whose result is known."""

import json
import sys

import numpy as np
import pytest

from tests.bench import fairness, fairness_football
from tests.bench.fairness_pitanks import Grudges, company
from tests.bench.trial import SAMPLE, StandingStill, Trial, by_arena, of_robots


def trial(*brains, matches=3, minutes=0.1, variant="party"):
    return Trial("pitanks", variant, matches, 1, brains, minutes)


@pytest.fixture(autouse=True)
def _plain(monkeypatch):
    monkeypatch.setattr("tests.bench.trial.can_compile", lambda: False)


def test_idle_robots_tie_and_stand_still():
    found = company(trial("idle", "idle", "off", "off", matches=2, variant="plain"))["all"]
    assert found["ties"] == found["standing still, median"] == 1.0
    assert found["hits a match"] == 0.0
    assert "wins of seat 3" not in found


def test_standing_still_counts_from_the_first_second_and_only_while_free():
    batch = trial("idle", "idle", "off", "off", matches=1).batch()
    standing, robots = StandingStill(batch), of_robots(batch, "present") == 1
    moved = np.array([[False, True, False, False]])
    for sample in range(30):
        for robot in batch.matches[0].robots:
            robot.x += 3.0 if sample % 10 == 9 else 0.0  # never still for more than 0.9 s
        standing.sample(batch, robots)
    assert standing.shares(True)[0, :2].tolist() == [0.0, 0.0]
    for _ in range(30):
        standing.sample(batch, robots & moved)
    assert standing.shares(True)[0, :2].tolist() == [0.0, 0.5]


def test_slow_driving_is_standing_still():
    """20 px/s are 2 px in a sample."""
    batch = trial("idle", "idle", "off", "off", matches=1).batch()
    standing = StandingStill(batch)
    for _ in range(40):
        for robot, step in zip(batch.matches[0].robots, (1.9, 2.1, 0.0, 0.0), strict=True):
            robot.x += step
        standing.sample(batch, of_robots(batch, "present") == 1)
    assert standing.shares(True)[0, :2].tolist() == [1.0, 0.0]
    assert SAMPLE == 5


def test_the_victims_next_hit_on_the_same_robot_is_revenge():
    batch = trial("idle", "idle", "idle", "off", matches=1).batch()
    grudges, state = Grudges(1), batch.matches[0]
    for tick, shooter, victim in ((10, 0, 1), (20, 0, 2), (30, 1, 0), (40, 1, 0), (50, 2, 0), (60, 2, 1)):
        state.last_hit, state.last_shooter, state.last_victim = tick, shooter, victim
        grudges.sample(batch)
        grudges.sample(batch)
    assert grudges.share([0]) == pytest.approx(2 / 3)


def test_a_football_that_nobody_plays_rests_is_dropped_anew_and_the_match_is_a_tie():
    found = fairness_football.company(Trial("football", "standard", 3, 1, ("idle",) * 4, 0.2))["all"]
    assert found["ties"] == found["standing still, median"] == 1.0
    assert found["goals, a match"] == found["passes, a match"] == found["shots, a match"] == 0.0
    assert found["drops, a match"] == 11.0, "12 s and a minute of overtime: kick-off after one, then every six seconds"
    assert 0.15 < found["ball out of play"] < 0.2
    assert found["ball at rest"] + found["ball out of play"] == pytest.approx(1.0)


def test_the_matches_are_spread_over_the_arenas():
    setups = trial("idle", "idle", matches=10).setups
    assert [(name, len(numbers)) for name, numbers in by_arena(setups)][1:] == [
        ("classic", 2),
        ("courtyard", 2),
        ("islands", 2),
        ("labyrinth", 2),
        ("trenches", 2),
    ]
    assert len({setup.seed for setup in setups}) == 10


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_the_command_prints_every_measure(monkeypatch, capsys, form):
    words = ["fairness", "pitanks", "--variant", "plain", "--matches", "2", "--minutes", "0.05"]
    monkeypatch.setattr(sys, "argv", [*words, "--brains", "random,random,random,random", *form])
    assert fairness.main() == 0
    printed = capsys.readouterr().out
    if form:
        assert set(json.loads(printed)) == {"game", "variant", "brains", "four robots", "duels"}
    else:
        assert printed.count("most hits wins") == 2


def test_means_are_numbers_and_shares_are_percentages():
    assert fairness.cell("drops, a match", 0.03) == "0.0"
    assert fairness.cell("lead changes a race", 0.75) == "0.8"
    assert fairness.cell("ties", 0.03) == "3.0 %"
    assert (fairness.cell("matches", 3), fairness.cell("revenge", None)) == ("3", "")


def test_an_unknown_brain_is_named(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["fairness", "pitanks", "--brains", "nobody,idle"])
    assert fairness.main() == 2
    assert "nobody" in capsys.readouterr().err
