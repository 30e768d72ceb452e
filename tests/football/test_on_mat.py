"""A match of real robots, emulated: the ball is light on the mat, and nothing but the rules moves it."""

import pytest

pytest.importorskip("cv2")

from pigaming_app.hardware.proof import testbed, trials
from pigaming_app.jobs.bench.robots import TARGETS, MatMatch, on_mat
from tests.football.pitch import overlap
from tests.football.test_ball import SLOP


@pytest.mark.long
@pytest.mark.again
def test_real_robots_play_the_projected_ball_and_keep_out_of_the_walls(monkeypatch):
    """By level 5, in the arena with walls, with packets and frames lost. Poses are seen, late and with noise."""
    depths, shots, touched = list[float](), list[int](), set[int]()

    def noted(state, x, y, radius, depth=trials.entered):
        if not state.ball.out:
            depths.append(overlap(state))
            touched.add(state.ball.touched)
        shots.append(sum(player.shots for player in state.players))
        return depth(state, x, y, radius)

    monkeypatch.setattr(trials, "entered", noted)
    match = MatMatch("football", "bumpers", 30.0, 7, 0.5, brain="level5", carried=True)
    run = on_mat(match, testbed.Testbed(5, 30.0).ground)
    assert run.deepest_mm < TARGETS["wall_entry_mm"]
    assert 30.0 <= run.seconds - run.paused < 91.0, "level, it goes on for a minute at most"
    assert max(depths) <= SLOP, "the ball overlaps nothing where robots were seen"
    assert shots[-1] >= 1
    assert len(touched - {0}) >= 2
