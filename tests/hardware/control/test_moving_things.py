"""Things that move during a match: walls follow between ticks, wait for robots, and are repeated by a recording."""

import json
from dataclasses import replace

import pytest

from pigaming_app.games.arenas import load
from pigaming_app.hardware.control import match_recording
from pigaming_app.hardware.control.match_recording import MatchFileError, MatchRecorder
from pigaming_app.hardware.control.moving_things import MovingThings, ThingsMove, same_mud
from pigaming_app.hardware.control.recorded_plant import RecordedPlant, RobotTrack
from pigaming_app.sim.arena import build
from pigaming_app.sim.contact import in_wall
from pigaming_app.sim.things.spec import ThingSpec, Use
from pigaming_app.sim.world import World


def square(x: float, y: float, use: Use = Use.WALL) -> ThingSpec:
    return ThingSpec(use, ((x - 40.0, y - 40.0), (x + 40.0, y - 40.0), (x + 40.0, y + 40.0), (x - 40.0, y + 40.0)))


def world() -> World:
    """The classic arena with nobody in it."""
    made, arena = World(), load("pitanks", "classic")
    build(made, arena)
    return made


def test_a_wall_follows_its_thing_but_waits_for_the_robot_that_it_would_cover():
    made = world()
    first = made.wall_count
    things = MovingThings(made, first)
    things.wanted = (square(800.0, 450.0),)
    robot = made.robots[0]
    robot.x, robot.y = 800.0, 380.0
    assert things.update([robot]) == []  # 70 px from the middle: the wall would reach the robot
    assert made.wall_count == first
    robot.y = 200.0
    assert things.update([robot]) == [ThingsMove(0, things.wanted)]
    assert in_wall(made, 800.0, 450.0)
    things.wanted = (square(830.0, 450.0),)
    assert len(things.update([])) == 1  # at the very next tick
    things.wanted = (square(831.0, 450.0),)
    assert things.update([]) == []  # noise
    assert made.shifts == 2


def test_a_recording_repeats_moves_from_any_tick():
    moves = [ThingsMove(tick, (square(700.0 + tick, 450.0),)) for tick in (0, 0, 30)]
    made, still = world(), RobotTrack([0.0] * 32 * 60)
    first = made.wall_count
    plant = RecordedPlant(made, still, moves, first)
    plant.sense()
    assert (made.shifts, plant.shown_things) == (2, moves[1].things)
    made.tick = 30
    later = RecordedPlant(made, still, moves, first)  # as after a jump
    later.sense()
    assert (made.shifts, later.shown_things) == (3, moves[2].things)

    recorder = MatchRecorder(1.3)
    recorder.track, recorder.moves = still, [*moves, replace(moves[0], tick=55)]
    parts = match_recording.unpack(match_recording.pack(b"{}", recorder.recording(50, made.robots)))
    assert match_recording.recording_of(parts, 50).moves == tuple(moves)
    thin = {"use": "wall", "outline": [[0, 0], [9, 0]], "margin": 0}
    for wrong in ({"tick": 51}, {"tick": -1}, {"things": [7]}, {"things": [thin]}):
        move = {"tick": 0, "things": [], "routed": False} | wrong
        damaged = json.dumps({"faults": [], "moves": [move]}).encode()
        with pytest.raises(MatchFileError):
            match_recording.recording_of({**parts, match_recording.INCIDENTS: damaged}, 50)


def test_a_plan_round_moved_things_is_made_in_a_thread_and_recorded_with_its_tick():
    made = world()
    things = MovingThings(made, made.wall_count, (), lambda _: lambda match: setattr(match, "random", 7))
    things.wanted = (square(800.0, 100.0),)
    assert [move.routed for move in things.update([])] == [False]
    assert things._planner is not None
    things._planner.join()
    assert [move.routed for move in things.update([])] == [True]
    assert made.random == 7


def test_the_same_mud_in_two_scans_is_the_same_mud():
    assert same_mud([square(500.0, 500.0, Use.MUD), square(100.0, 100.0)], [square(506.0, 494.0, Use.MUD)])
    assert not same_mud([square(500.0, 500.0, Use.MUD)], [square(530.0, 500.0, Use.MUD)])
