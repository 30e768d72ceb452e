"""The job `bench robots` on a small scale: a match of every game, and its figures."""

import json

import pytest

pytest.importorskip("cv2")

from pigaming_app.ai.networks.files import encode
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.games.registry import games
from pigaming_app.hardware.proof import testbed, trials
from pigaming_app.jobs.bench import robots as bench_robots
from pigaming_app.jobs.bench.robots import TARGETS, MatMatch, jobs, on_mat, reached
from pigaming_app.jobs.cli import main
from tests.ai.networks.random_network import random_network
from tests.cases import one_in


@pytest.fixture(scope="module")
def ground():
    """A calibration of the emulated arena."""
    return testbed.Testbed(5, 30.0).ground


@pytest.mark.parametrize("game", one_in(4, ENCODINGS))
def test_a_match_of_networks_on_the_mat_plays_to_its_end(game, ground, tmp_path):
    arena, path = jobs()[list(games()).index(game)].arena, tmp_path / "mine.npz"
    path.write_bytes(encode(random_network(1, game)))
    run = on_mat(MatMatch(game, arena, 30.0, 8, 0.05, brain=str(path), carried=True), ground)
    assert run.deepest_mm < TARGETS["wall_entry_mm"]
    over = 60.0 if game == "football" else 0.0  # networks without training score none, so overtime runs to its end
    assert 3.0 + over <= run.seconds - run.paused < 4.0 + over


@pytest.mark.long
@pytest.mark.again
@pytest.mark.parametrize("arena", ["labyrinth", "trenches"])
def test_knocked_out_robots_keep_out_of_the_walls_on_the_mat(ground, monkeypatch, arena):
    """They reverse blindly; the virtual walls stop them."""
    seen = {"hits": 0}

    def noted(state, x, y, radius, depth=trials.entered):
        seen["hits"] = sum(tank.taken for tank in state.tanks)
        return depth(state, x, y, radius)

    monkeypatch.setattr(trials, "entered", noted)
    run = on_mat(MatMatch("pitanks", arena, 30.0, 7, 0.3, brain="hand2", carried=True, variant="party"), ground)
    assert seen["hits"] >= 10
    assert run.deepest_mm < TARGETS["wall_entry_mm"]


def test_twenty_minutes_are_played_in_every_game():
    planned = jobs()
    assert sum(job.minutes for job in planned) == 20.0
    assert {job.game for job in planned} == set(games())
    assert {job.fps for job in planned} == {30.0, 60.0}
    assert {job.variant for job in planned if job.game == "pitanks"} == {None, "party"}
    assert sorted(job.game for job in planned if job.brain) == ["football", "pitanks"]


def test_figures_are_compared_with_what_they_must_reach():
    assert all(reached(dict(TARGETS)).values())
    found = reached({**TARGETS, "frames_complete": 0.99, "tracker_ms": 5.0})
    assert [key for key, good in found.items() if not good] == ["tracker_ms", "frames_complete"]


def test_the_job_prints_exactly_these_figures(monkeypatch, capsys):
    monkeypatch.setattr(bench_robots, "measure", lambda note: dict(TARGETS))
    assert main(["bench", "robots", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == TARGETS
    assert main(["bench", "robots"]) == 0
    assert "everything is reached" in capsys.readouterr().err
    monkeypatch.setattr(bench_robots, "stops_outside", lambda note: ({"SIGSTOP": 0.299}, {"kill -9": 0.301}))
    assert main(["bench", "robots", "--arcade", "--json"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out) == {"arcade_worst_stop_ms": 301.0}
    assert "not reached: arcade_worst_stop_ms" in said.err
    assert main(["bench", "pitanks", "--arcade"]) == 2


def test_what_fails_is_one_line(monkeypatch, refused):
    def fails(note):
        raise bench_robots.Unproven("race in classic, seed 3: the match did not end: []")

    monkeypatch.setattr(bench_robots, "measure", fails)
    assert refused("bench", "robots").endswith("the match did not end: []\n")
