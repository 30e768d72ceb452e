"""One button: an AI drives, the person's button fires, lifts, boosts or uses what the robot has."""

import pytest

from pigaming_app.ai.brain.kind import OneButtonPlayer
from pigaming_app.ai.game_ai import ONE_BUTTON
from pigaming_app.ai.registry import AIS, make_person
from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.ui.input.events import StickState
from tests.matches import match_of

NOTHING, FIRE, TURBO = StickState(), StickState(fire=True), StickState(turbo=True)


def pressed(game: str, press: StickState, every: int = 25, arena: str = "") -> Match:
    """A match of a minute; seat 0 has one button, which goes down once in `every` ticks, and sticks that drift."""
    match = match_of(game, "human idle", arena, minutes=1.0, seed=5)
    drift = StickState(linear=-1.0, angular=1.0)
    read = lambda: press if match.state.tick % every < every // 2 else drift  # noqa: E731
    match.sit(0, make_person(game, ONE_BUTTON, read, 7))
    return match


def played(match: Match, seconds: float) -> Match:
    while match.seconds < seconds and not match.over:
        match.tick()
    return match


@pytest.mark.parametrize("game", games())
def test_every_game_offers_it(game: str) -> None:
    assert ONE_BUTTON in AIS[game].driving
    assert isinstance(make_person(game, ONE_BUTTON, lambda: NOTHING, 1), OneButtonPlayer)


@pytest.mark.parametrize("press", [FIRE, TURBO])
def test_shots_are_the_persons_and_hit_as_the_robot_aims(press: StickState) -> None:
    match = played(pressed("pitanks", press), 40.0)
    assert match.state.robots[0].score > 0


def test_without_a_press_nothing_is_fired() -> None:
    match = pressed("pitanks", NOTHING)
    fired = 0
    while match.seconds < 20.0:
        match.tick()
        fired += match.state.actions[0].fire
    start = match.arena.starts[0]
    robot = match.state.robots[0]
    assert not fired
    assert (robot.x, robot.y) != (start.x, start.y), "but it drives"
    assert match.state.robots[0].score <= 0


def test_pallets_are_lifted_and_delivered_by_the_button() -> None:
    waiting = played(pressed("factory", NOTHING), 20.0)
    assert waiting.state.loads[0].pallet == 0
    match = played(pressed("factory", FIRE, 40), 60.0)
    assert match.state.robots[0].score > 0


def test_the_button_is_the_turbo_of_the_race() -> None:
    slow, fast = played(pressed("race", NOTHING), 15.0), played(pressed("race", FIRE, 60), 15.0)
    assert fast.state.racers[0].progress > slow.state.racers[0].progress > 0.0


def test_a_ball_is_caught_while_the_button_is_held_and_shot_when_it_is_released() -> None:
    shots, longest = [], []  # the latter: ticks for which a ball was held
    for press, every in ((NOTHING, 60), (FIRE, 10_000), (FIRE, 60)):
        match = pressed("football", press, every, "surprise-7")  # on others it runs into the other robot first
        charges = [match.state.ball.charge]
        while match.seconds < 55.0:
            match.tick()
            charges.append(match.state.ball.charge)
        shots.append(match.state.players[0].shots)
        longest.append(max(charges))
    hold = match.state.rules.hold
    assert longest[0] == shots[0] == 0
    assert longest[1] == hold - 1, "until it is shot by itself"
    assert 0 < longest[2] <= 30
    assert shots[2] > shots[1] > 0
