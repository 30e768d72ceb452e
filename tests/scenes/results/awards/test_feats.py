"""What robots did, measured against their poses and against matches with a known course."""

from math import hypot, tau
from types import SimpleNamespace
from typing import Any

import pytest

from pigaming_app.scenes.results.awards.feats import EVERY, FeatRecorder, RobotFeats
from pigaming_app.sim.world import DT, HZ, Action
from tests.matches import match_of


def recorded(game: str, brains: str, ticks: int, seed: int = 1) -> tuple[Any, FeatRecorder, dict[str, float]]:
    """A match with its feats, and those of seat 0 measured tick by tick from its poses."""
    match, recorder = match_of(game, brains, minutes=1.0, seed=seed), FeatRecorder()
    me, way, turns = match.state.robots[0], 0.0, 0.0
    for _ in range(ticks):
        x, y, heading = me.x, me.y, me.heading
        match.tick()
        recorder.watch(match)
        way += hypot(me.x - x, me.y - y)
        turns += abs((me.heading - heading + tau / 2) % tau - tau / 2)
    return match, recorder, {"distance": way, "turning": turns}


@pytest.mark.parametrize("game", ["pitanks", "factory"])
def test_ways_and_turns_are_those_of_the_poses(game: str) -> None:
    """Sampled ten times a second, and by what the wheels do: a robot that pushes against a wall goes nowhere."""
    _, recorder, truth = recorded(game, "level3 level3", 20 * HZ)
    found = recorder.feats(0)
    assert found["distance"] == pytest.approx(truth["distance"], rel=0.2)
    assert found["meters"] == pytest.approx(truth["distance"] * 1.32 / 1000.0, rel=0.2), "on the nominal mat"
    assert found["turning"] == pytest.approx(truth["turning"], rel=0.2)


def scripted(scores: list[list[int]], taken: list[list[int]] | None = None, goal: int = 0) -> FeatRecorder:
    """The feats of a match in which these are scores and hits taken of each seat after each second."""
    robots = [SimpleNamespace(**dict.fromkeys(("x", "y", "linear", "angular", "boosting"), 0.0)) for _ in range(4)]
    for seat, robot in enumerate(robots):
        robot.present, robot.team, robot.score = seat < len(scores[0]), seat, 0
    state = SimpleNamespace(tick=0, robots=robots, actions=[Action() for _ in robots], taken=[0, 0, 0, 0])
    game = SimpleNamespace(
        timed=goal > 0,
        stats=lambda state, seat: {"taken": state.taken[seat]} if taken else {},
        ranking_key=lambda state, seat: float(state.robots[seat].score),
    )
    series, setup, recorder = [[(0.0, 0)] for _ in range(4)], SimpleNamespace(goal=goal), FeatRecorder()
    match = SimpleNamespace(state=state, game=game, setup=setup, series=series, plant=SimpleNamespace(mm=1.32))
    for second, line in enumerate(scores):
        for _ in range(HZ):
            state.tick += 1
            recorder.watch(match)  # type: ignore[arg-type]
        for seat, score in enumerate(line):
            robots[seat].score = score
            match.series[seat].append((second + 1.0, score))
        if taken:
            state.taken[: len(line)] = taken[second]
    return recorder


def test_a_comeback_is_the_gap_at_half_time_of_one_who_has_gained_a_place() -> None:
    recorder = scripted([[0, 0, 0], [6, 1, 2], [6, 1, 2], [6, 1, 2], [6, 7, 2], [6, 9, 2]])
    found = [recorder.feats(seat) for seat in range(3)]
    assert [feats["comeback"] for feats in found] == [0.0, 5.0, 0.0]
    assert [feats["led"] for feats in found] == [1.0, 0.0, 0.0]
    assert [feats["first"] for feats in found] == [2.0, 2.0, 2.0]
    assert [feats["finish"] for feats in found] == [0.0, 8.0, 0.0]


@pytest.mark.parametrize(("teams", "led"), [((0, 1, 2), [0.0, 0.0, 0.0]), ((0, 0, 1), [1.0, 1.0, 0.0])])
def test_nobody_leads_beside_another_one_but_a_team_does(teams: tuple[int, ...], led: list[float]) -> None:
    """Two are level at half time, as team mates always are; where nobody has a point, nobody leads."""
    recorder, level = scripted([[4, 4, 1]] * 6), scripted([[0, 0, 0]] * 6)
    for one in (recorder, level):
        assert one.match
        for robot, team in zip(one.match.state.robots, teams, strict=False):
            robot.team = team
    assert [recorder.feats(seat)["led"] for seat in range(3)] == led
    assert [level.feats(seat)["led"] for seat in range(3)] == [0.0, 0.0, 0.0]


def test_the_longest_escape_lies_between_two_hits() -> None:
    taken = [[1, 0], [1, 0], [1, 0], [2, 0], [2, 1], [2, 1]]
    recorder = scripted([[0, 0]] * 6, taken)
    assert recorder.feats(0)["escape"] == pytest.approx(3.0, abs=EVERY * DT)
    assert recorder.feats(1)["escape"] == pytest.approx(5.0, abs=EVERY * DT)
    assert "escape" not in scripted([[0, 0]] * 6).feats(0), "a game without hits"


def test_a_driver_who_waits_at_the_finish_is_not_called_patient() -> None:
    """The first seat has both laps after two seconds, the second after five."""
    recorder = scripted([[1, 0], [2, 1], [2, 1], [2, 1], [2, 2], [2, 2]], goal=2)
    assert [recorder.feats(seat)["rest"] for seat in (0, 1)] == pytest.approx([2.0, 5.0], abs=0.11)


def test_the_longest_straight_ends_where_a_robot_turns() -> None:
    tally, robot = RobotFeats(), SimpleNamespace(x=0.0, y=0.0, linear=100.0, angular=0.0, boosting=0)
    for angular, seconds in ((0.0, 1), (2.0, 1), (0.05, 3), (-2.0, 1), (0.0, 2)):
        robot.angular = angular
        for _ in range(seconds * HZ // EVERY):
            tally.add(robot, False, 0.0)
    assert tally.straight == pytest.approx(300.0)


def test_a_robot_that_is_knocked_back_does_not_drive_in_reverse() -> None:
    """By the rules of the party a hit robot moves back 72 px, whatever its driver does."""
    match, recorder = match_of("pitanks", "idle idle", variant="party"), FeatRecorder()
    start = match.state.robots[1].x, match.state.robots[1].y
    match.state.tanks[1].knocked_out = match.state.rules.knockout
    for _ in range(HZ):
        match.tick()
        recorder.watch(match)
    robot = match.state.robots[1]
    assert hypot(robot.x - start[0], robot.y - start[1]) > 50.0
    assert recorder.feats(1)["distance"] > 50.0
    assert recorder.feats(1)["reverse"] == 0.0


def test_the_recorder_changes_nothing_and_works_once_in_five_ticks() -> None:
    match, recorder, _ = recorded("pitanks", "level3 level1", 4 * HZ)
    assert [tally.samples for tally in recorder.tallies] == [4 * HZ // EVERY, 4 * HZ // EVERY, 0, 0]
    other = match_of("pitanks", "level3 level1", minutes=1.0)
    for _ in range(4 * HZ):
        other.tick()
    assert [(r.x, r.y, r.score) for r in match.state.robots] == [(r.x, r.y, r.score) for r in other.state.robots]
