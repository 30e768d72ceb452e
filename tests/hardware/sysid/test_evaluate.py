"""Identification of robots from recordings, and the simulator's prediction errors before and after."""

import gzip
import json
import sys

import numpy as np
import pytest

from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.recordings import MAX_DURATION, Recording, RecordingError, RobotRecording, load
from pigaming_app.hardware.run_writer import LONGEST, RecordingWriter, RunInMemory
from pigaming_app.hardware.signals import Fix, WheelCommand
from pigaming_app.hardware.sysid.evaluate import RecordingTooShort, errors, measure, predictions, replay
from pigaming_app.hardware.sysid.excitation import ExcitationPattern
from pigaming_app.hardware.sysid.identify import fit_pieces, identify, move_pieces, track
from pigaming_app.hardware.sysid.plots import draw
from pigaming_app.sim.drivetrain import MM, NOMINAL, Drivetrain, Wheel
from pigaming_app.storage.messages import OperatorError
from tests.floor import floor
from tests.hardware.mat import TRUE, Mat
from tests.hardware.sentences import refused

ODD = Drivetrain(Wheel(700.0, 0.045), Wheel(790.0, 0.025), 64.0, 0.09, 0.05)


def danced(seconds, noise=0.0, train=TRUE, fps=30):
    """A recording on the mat: commands, and fixes with noise."""
    mat = Mat(train=train)
    world = floor(poses=[(robot.x, robot.y, robot.heading) for robot in mat.robots])
    plant, dance, chance = RealPlant(world, mat.rig), ExcitationPattern(), np.random.default_rng(1)
    told_at, wheels, seen_at, poses = [], [], [], []
    for tick in range(round(seconds / 0.02)):
        plant.drive(dance.twists(mat.now, plant.sense()), 0.02)
        told_at.append(mat.now)
        wheels.append(mat.coming[-1][1])
        mat.pass_time()
        if tick % round(50 / fps) == 0:
            seen_at.append(mat.now)
            poses.append([(robot.x, robot.y, robot.heading) for robot in mat.robots])
    seen = np.array(poses) + chance.normal(size=(len(poses), 4, 3)) * np.array([0.8, 0.8, 0.012]) * noise
    courses = {}
    for i in range(4):
        told = np.array([one[i] or (0.0, 0.0) for one in wheels])
        courses[i] = RobotRecording(np.array(told_at), told, np.array(seen_at), seen[:, i])
    return Recording(MM, courses)


@pytest.fixture(scope="module")
def run():
    return danced(60.0, noise=1.0)


def test_a_track_of_both_wheels_alike_is_straight_and_late():
    told = np.array([0.0])
    course = RobotRecording(told, np.array([[0.5, 0.5]]), np.array([0.0, 3.0]), np.zeros((2, 3)))
    even = Drivetrain(Wheel(700.0, 0.0), Wheel(700.0, 0.0), 60.0, 0.1, 0.2)
    x, y, heading = track(course, even, 0.0, 3.0).at(np.array([3.0]))[0]
    assert x == pytest.approx(350.0 * (3.0 - 0.1 - 0.2), abs=0.5 * 0.005 * 350.0)
    assert (y, heading) == (0.0, 0.0)


def test_a_piece_of_track_is_laid_over_what_was_seen():
    bend = np.linspace(0.0, 1.0, 20)
    there = np.column_stack([100.0 * np.sin(bend), 100.0 * (1.0 - np.cos(bend)), bend])
    seen = move_pieces(there, np.array([0]), np.array([[300.0, 200.0, 0.7]]))
    fitted, move = fit_pieces(there, seen, np.array([0]))
    assert move[0] == pytest.approx([300.0, 200.0, 0.7])
    assert fitted == pytest.approx(seen)


@pytest.mark.long
def test_wheels_lag_and_dead_time_are_found_within_one_hundredth():
    courses = danced(45.0, noise=1.0, train=ODD).courses
    found = identify(courses[0], UNMEASURED)
    assert found.left.speed == pytest.approx(ODD.left.speed, rel=0.01)
    assert found.right.speed == pytest.approx(ODD.right.speed, rel=0.01)
    assert found.left.deadband == pytest.approx(ODD.left.deadband, abs=0.002)
    assert found.right.deadband == pytest.approx(ODD.right.deadband, abs=0.002)
    assert found.base == pytest.approx(ODD.base, rel=0.01)
    assert found.lag == pytest.approx(ODD.lag, abs=0.004)
    assert found.dead_time == pytest.approx(TRUE.dead_time, abs=0.003)  # the mat's, whatever the drivetrain says


@pytest.mark.long
def test_what_was_identified_foresees_much_better_what_was_held_out(run):
    for verdict in measure(Recording(run.mm, {i: run.courses[i] for i in (1, 3)})):
        for before, after in zip(verdict.before.mm, verdict.after.mm, strict=True):
            assert after < 0.35 * before
        assert verdict.after.mm[0] < 6.0
        assert verdict.after.degrees[0] < 2.0
        assert verdict.before.mm[2] > 60.0


@pytest.mark.long
def test_the_true_model_foresees_a_run_without_noise_and_so_does_what_was_identified_in_it():
    run = danced(30.0)
    course = run.courses[2]
    assert errors(course, TRUE, run.mm).mm[2] < 0.05
    assert len(predictions(course, TRUE, 1.0)) >= 40
    (verdict,) = measure(Recording(run.mm, {2: course}))
    assert verdict.after.mm[2] < 0.5
    assert verdict.before.mm[2] > 50.0


def test_a_run_of_a_few_seconds_is_too_short():
    with refused(RecordingTooShort, "Robot 1"):
        measure(danced(5.0))


def test_a_robot_that_stood_still_is_left_out():
    run = danced(22.0)
    still = run.courses[0]
    still.poses[:] = still.poses[0]
    assert [one.robot for one in measure(Recording(run.mm, {0: still, 1: run.courses[1]}))] == [1]
    with refused(RecordingTooShort, "No robot"):
        measure(Recording(run.mm, {0: still}))


def test_a_run_played_again_in_the_simulator_stays_near_for_a_while_and_nearer_when_it_knows_the_robots(run):
    def miss(drivetrains):
        again = replay(Recording(run.mm, {0: run.courses[0].between(0.0, 8.0)}), drivetrains)[0]
        return float(np.hypot(*(again.seen - again.predicted)[:, :2].T).mean())

    assert miss([TRUE] * 4) < 0.3 * miss([NOMINAL] * 4)
    assert miss([TRUE] * 4) < 40.0


def test_a_recorded_run_comes_back_as_it_was(tmp_path):
    recorder = RecordingWriter(tmp_path / "run.jsonl", 1.3)
    for i in range(60):
        recorder.record_commands(0.02 * i, [WheelCommand(0.1, 0.2), None, None, None])
        recorder.record_fixes(0.02 * i + 0.05, 0.02 * i, [Fix(0, 100.0 + i, 200.0, 6.2 + 0.01 * i, 0.02 * i)])
    recorder.close()
    run = load(tmp_path / "run.jsonl")
    assert run.mm == 1.3
    assert list(run.courses) == [0]
    course = run.courses[0]
    assert course.wheels[3] == pytest.approx([0.1, 0.2])
    assert course.poses[:, 2].max() == pytest.approx(6.79)  # no jump at a whole turn
    assert len(course.pose_times) == 60


def test_a_recording_that_breaks_off_leaves_the_one_before(tmp_path):
    path = tmp_path / "run.jsonl"
    path.write_text("the one before")
    for end in (RecordingWriter.discard, RecordingWriter.close):
        recorder = RecordingWriter(path, 1.3)
        recorder.record_commands(0.0, [None] * 4)
        assert path.read_text() == "the one before"
        end(recorder)
        assert [one.name for one in tmp_path.iterdir()] == ["run.jsonl"]
    assert path.read_text().count("\n") == 2


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "too little"),
        ("hello\n" * 3, "line 1"),
        ('{"kind": "sent"}\n{}\n', "line 1"),
        ('{"kind": "head", "format": "pigaming-run-9", "mm": 1}\n{}\n', "line.format: expected"),
        ('{"kind": "head", "format": "pigaming-run-1", "mm": 1.3}\n', "too little"),
        ('{"kind": "sent", "time": 1.0, "seq": 1, "wheels": [null, null, null, null]}\n{}\n', "not a run"),
        (
            '{"kind": "head", "format": "pigaming-run-1", "mm": 1.3}\n'
            '{"kind": "seen", "captured": NaN, "time": 0, "fixes": [[0, 1, 2, 3]]}\n{}\n',
            "line 2",
        ),
    ],
)
def test_what_is_no_run_is_refused_in_one_line(tmp_path, text, said):
    file = tmp_path / "run.jsonl"
    file.write_text(text)
    with pytest.raises(RecordingError, match=r"run\.jsonl") as caught:
        load(file)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_run_that_broke_off_in_the_middle_of_a_line_is_still_good(tmp_path):
    file = tmp_path / "run.jsonl"
    recorder = RecordingWriter(file, 1.3)
    for i in range(60):
        recorder.record_commands(0.02 * i, [None] * 4)
        recorder.record_fixes(0.02 * i, 0.02 * i, [Fix(1, 5.0, 5.0, 0.0, 0.02 * i)])
    recorder.close()
    file.write_text(file.read_text() + json.dumps({"kind": "seen"})[:9])
    assert list(load(file).courses) == [1]


def test_a_run_in_memory_ends_before_it_is_too_long_to_be_read_and_fixes_keep_their_own_times():
    run = RunInMemory(1.3)
    fixes = [Fix(1, 5.0, 5.0, 0.0, 999.9), Fix(0, 5.0, 5.0, 0.0, 999.8), Fix(1, 5.0, 5.0, 0.0, 999.8)]
    run.record_fixes(1000.0, 1000.0, fixes)
    run.record_commands(1000.0 + LONGEST, [None] * 4)
    size = len(run.compressed())
    run.record_commands(1001.0 + LONGEST, [None] * 4)
    run.record_fixes(1001.0 + LONGEST, 1001.0 + LONGEST, [])
    assert len(run.compressed()) == size
    assert LONGEST < MAX_DURATION
    lines = [json.loads(line) for line in gzip.decompress(run.compressed()).splitlines()]
    assert [(line["captured"], len(line["fixes"])) for line in lines if line["kind"] == "seen"] == [
        (999.8, 2),
        (999.9, 1),
    ]


@pytest.mark.long
def test_two_pictures_are_drawn(run, tmp_path):
    pytest.importorskip("matplotlib")
    run = Recording(MM, {1: run.courses[1].between(0.0, 24.0)})
    made = draw(run, measure(run), tmp_path / "plots")
    assert [path.name for path in made] == ["horizon.png", "paths.png"]
    assert all(path.read_bytes()[:4] == b"\x89PNG" for path in made)


def test_without_matplotlib_there_is_one_sentence(run, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with refused(OperatorError, "matplotlib"):
        draw(run, [], tmp_path)
