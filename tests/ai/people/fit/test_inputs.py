"""Decisions found in the recorded actions, against those that the hands of a model have made."""

from math import cos, sin
from typing import Any

import numpy as np
import pytest

from pigaming_app.ai.people.fit.inputs import key_inputs, pointing_inputs
from pigaming_app.ai.people.fit.people import driving_of, recorded
from pigaming_app.ai.people.fit.wishes import watch
from pigaming_app.games import replay as replays
from pigaming_app.sim.record import copy, digest
from tests.matches import match_of


def watched(name, seconds=20.0, seed=3):
    """The first seconds of a person of that name, and the ticks at which their hands decided."""
    match = match_of("pitanks", [name, *["level2"] * 3], minutes=2.0, seed=seed)
    person: Any = match.brains[0]
    hands, decided = person.mind.hands, []
    while match.seconds < seconds:
        waited = hands.wait
        match.tick()
        if hands.wait > waited:
            decided.append(match.state.tick - 1)
    replay = replays.recorded(match)
    return watch("pitanks", replays.to_match(replay).state, recorded(replay), 0, False), decided, replay


def test_every_decision_that_is_found_is_one() -> None:
    for name, inputs in (("beginner", key_inputs), ("player", pointing_inputs), ("expert", pointing_inputs)):
        play, decided, _ = watched(name)
        found = inputs(play).decisions
        assert len(found) > 10
        assert np.mean(np.isin(found, decided)) > 0.97, name


def test_of_a_stick_nearly_every_decision_is_found() -> None:
    play, decided, _ = watched("player")
    moving = [tick for tick in decided if np.any(play.actions[tick, :2])]
    assert np.mean(np.isin(moving, pointing_inputs(play).decisions)) > 0.95


def test_driving_styles_show_in_the_actions() -> None:
    assert [driving_of(watched(name, 10.0)[0]) for name in ("beginner", "player")] == ["turn", "point"]


def test_to_ask_models_changes_nothing_in_the_match() -> None:
    play, _, replay = watched("player")
    assert digest(play.end) == replay.digest
    assert np.ptp(play.wishes[:, :, 1], axis=1).max() > 0.5  # they differ


def test_models_aim_at_who_stands_still_where_they_stand() -> None:
    match = match_of("pitanks", ["player", *["idle"] * 3], minutes=1.0, seed=4)
    places = []
    while match.seconds < 8.0:
        places.append([(robot.x, robot.y) for robot in match.state.robots])
        match.tick()
    replay = replays.recorded(match)
    play = watch("pitanks", replays.to_match(replay).state, recorded(replay), 0, False)
    at = np.array(places)
    ways = np.arctan2(*np.moveaxis(at[:, 1:] - at[:, :1], 2, 0)[::-1])
    still = (at[:, 1:] == at[0, 1:]).all(axis=(1, 2))  # until the first is hit
    some = still & np.isfinite(play.sights[:, 1, 0])
    assert some.sum() > 50
    for sight in (play.sights[some, 1, 0], play.sights[some, 1, 1]):  # standing, so they are met where they are
        off = np.abs((sight[:, None] - ways[some] + np.pi) % (2.0 * np.pi) - np.pi).min(axis=1)
        assert np.median(off) < 0.01
        assert off.max() < 0.1  # a model looks ten times a second


def test_models_remember_the_shots_of_the_person() -> None:
    """Who turns slowly past a target and does not fire is told to all the while; after a shot a gunner waits first."""
    start = match_of("pitanks", ["idle"] * 4, minutes=1.0, seed=0).state
    robot, target = start.robots[:2]
    target.x, target.y = robot.x + 300.0 * cos(robot.heading + 0.5), robot.y + 300.0 * sin(robot.heading + 0.5)
    actions = np.zeros((200, 4, 5))
    actions[:, 0, :2] = 0.3, 0.1
    wished = watch("pitanks", copy(start), actions, 0, False).wishes[:, 1, 2]
    first = int(np.flatnonzero(wished)[0])
    assert wished[first : first + 80].all()
    actions[first - 45, 0, 2] = 1.0  # beside the target; the gun is loaded again after half a second
    wished = watch("pitanks", copy(start), actions, 0, False).wishes[:, 1, 2]
    assert not wished[: first + 30].any()
    assert wished[first + 50 : first + 80].all()


@pytest.mark.long
def test_compiled_the_models_wish_the_same() -> None:
    play, _, replay = watched("player")
    fast = watch("pitanks", replays.to_match(replay).state, recorded(replay), 0, True)
    assert np.array_equal(fast.wishes, play.wishes)
    assert np.array_equal(fast.sights, play.sights, equal_nan=True)
    assert np.array_equal(fast.poses, play.poses)
    assert digest(fast.end) == replay.digest
