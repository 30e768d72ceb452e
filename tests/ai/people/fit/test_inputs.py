"""Decisions found in the recorded actions, against those that the hands of a model have made."""

from typing import Any

import numpy as np
import pytest

from pigaming_app.ai.people.fit.inputs import key_inputs, pointing_inputs
from pigaming_app.ai.people.fit.people import driving_of, recorded
from pigaming_app.ai.people.fit.wishes import watch
from pigaming_app.games import replay as replays
from pigaming_app.sim.record import digest
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


@pytest.mark.long
def test_compiled_the_models_wish_the_same() -> None:
    play, _, replay = watched("player")
    fast = watch("pitanks", replays.to_match(replay).state, recorded(replay), 0, True)
    assert np.array_equal(fast.wishes, play.wishes)
    assert np.array_equal(fast.poses, play.poses)
    assert digest(fast.end) == replay.digest
