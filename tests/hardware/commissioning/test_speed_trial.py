"""A test drive lowers the top speed of robots that respond late, until they stay out of walls without an alarm."""

import pytest

from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.match import Match
from pigaming_app.hardware.commissioning.speed_trial import ENTRY_MM, SpeedTrial
from pigaming_app.hardware.control.kinematics import IDEAL
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.emulator.radio import RadioChannel
from pigaming_app.hardware.proof import testbed
from pigaming_app.hardware.proof.trials import ButtonMasher, play
from pigaming_app.hardware.session.store import save_tops, tops_by_radio
from pigaming_app.sim.world import HEIGHT, ROBOTS, WIDTH
from pigaming_app.storage.settings import Settings, folders
from tests.cases import one_in
from tests.hardware.mat import EVEN, Mat

BODY = 47.5  # mm
ONE, TWO, THREE, FOUR = (Seat("random", team) for team in range(ROBOTS))
SETUP = Setup("pitanks", "classic", (ONE, TWO, THREE, FOUR), 0.4, 3, "classic")


def driven(mat, seconds=20.0, rounds=12):
    """The test drive of all robots on a mat, and how deep each really came into an edge, mm, in its last round."""
    drive = SpeedTrial(mat.rig, range(ROBOTS), seconds)
    deepest, number, inside = [0.0] * ROBOTS, 1, set[int]()
    for _ in range(round(rounds * seconds * 50)):
        done = drive.tick()
        mat.pass_time()
        if drive.rounds != number:
            deepest, number, inside = [0.0] * ROBOTS, drive.rounds, set[int]()
        for i, robot in enumerate(mat.robots):
            depth = BODY / mat.rig.mm + max(-robot.x, -robot.y, robot.x - WIDTH, robot.y - HEIGHT)
            if depth < 0.0:
                inside.add(i)
            if i in inside:
                deepest[i] = max(deepest[i], depth * mat.rig.mm)
        if done:
            return drive, deepest
    raise AssertionError("the drive has no end")


def test_robots_that_respond_as_declared_keep_their_speed():
    mat = Mat(train=EVEN)
    drive, deepest = driven(mat)
    assert drive.rounds == 1
    assert drive.tops_mm == dict.fromkeys(range(ROBOTS), 0)
    assert max(deepest) <= ENTRY_MM
    assert mat.rig.recorder is None
    mat.pass_time(0.2)
    assert all(robot.command is None or tuple(robot.command) == (0.0, 0.0) for robot in mat.robots)


@pytest.mark.parametrize(("late", "known"), one_in(2, [(0.2, 0.15), (0.3, 0.22)]))
def test_robots_that_respond_later_than_is_known_are_slowed_until_it_holds(late, known):
    """This mat predicts by the known delay, along a straight line: worse than any tracker."""
    mat = Mat(train=EVEN)
    mat.dead_time, mat.correction = late, IDEAL._replace(late=known)
    drive, deepest = driven(mat)
    assert drive.rounds > 1
    assert not drive.late
    assert not drive.failed
    assert max(deepest) <= ENTRY_MM + 1.0
    assert 0 < min(top for top in drive.tops_mm.values() if top) < 600


def test_a_robot_that_is_out_of_sight_ends_the_drive():
    mat = Mat(train=EVEN)
    mat.robots[2].hidden = True
    drive, _ = driven(mat, rounds=4)
    assert drive.held_up
    assert set(drive.tops_mm.values()) == {0}


def test_speeds_are_kept_by_radio_and_those_of_absent_robots_stay():
    assert tops_by_radio({0: 300, 1: 0}, (1, 0, 2, 3), []) == [0, 300, 0, 0]
    assert tops_by_radio({0: 0}, (1, 0, 2, 3), [500, 300, 0, 400]) == [500, 0, 0, 400]


def test_the_command_saves_what_a_drive_has_found_and_the_rig_has_it_the_next_time(home):
    save_tops({0: 300}, (1, 0, 2, 3))
    assert Settings.load(folders().config)[0].tops == [0, 300, 0, 0]


@pytest.mark.long
@pytest.mark.again
def test_robots_of_300_ms_play_a_match_after_their_test_drive():
    """Their driver declares 30; 280 at most are measured. At full speed, two came 12 and 13 mm into an edge."""
    bed = testbed.Testbed(5, 30.0, channel=RadioChannel(soonest=0.27, latest=0.278))
    bed.session.find()
    drive = SpeedTrial(bed.rig, range(ROBOTS), 20.0)
    while not drive.tick():
        bed.tick()
    assert not drive.late
    assert not drive.held_up
    assert any(drive.tops_mm.values())
    match = Match(SETUP, lambda world: RealPlant(world, bed.rig))
    for seat in range(ROBOTS):
        match.sit(seat, ButtonMasher(seat))
    run = play(bed, match, 24.0)
    assert run.deepest_mm <= ENTRY_MM
    assert run.alarms == 0
