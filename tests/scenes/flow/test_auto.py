"""Auto in the arcade: the strength of each person, by device and game, and how matches with it are played and kept."""

from typing import Any

import pytest

from pigaming_app.ai.auto import FIRST, NAME
from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.games.match import Match
from pigaming_app.games.replay import decode, encode, verify
from pigaming_app.scenes.flow.auto import AutoStrengths
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.high_scores import contest, counts
from pigaming_app.ui.input.events import Button
from tests.matches import match_of, setup_of
from tests.scenes.arcade import KEYS, Arcade

ANA, BEN = KEYS[0], KEYS[1]


@pytest.fixture
def auto(arcade: Arcade) -> AutoStrengths:
    return arcade.context.shared(AutoStrengths)


def ended(brains: str, points: tuple[int, ...], efforts: float) -> Match:
    """A match that is over, with these points, whose AIs tried so hard at the end."""
    match = match_of("pitanks", brains, variant="plain")
    for seat, robot in enumerate(match.state.robots):
        robot.score = points[seat]
        if seat:
            mind: Any = vars(match.brains[seat])["mind"]
            mind.effort.now = efforts
    return match


def test_a_stranger_meets_a_middling_strength_on_all_seats_that_follow(auto: AutoStrengths) -> None:
    setup = auto.resolved(setup_of("pitanks", f"human {NAME} level5 auto9"), [ANA])
    assert [seat.brain for seat in setup.seats] == ["human", AUTO[FIRST], "level5", AUTO[FIRST]]


def test_victories_make_the_next_match_harder_and_defeats_easier(auto: AutoStrengths) -> None:
    known = [auto.resolved(setup_of("pitanks", "human auto4 auto4 auto4"), [ANA]).seats[1].brain]
    for _ in range(3):
        auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 0.6), [ANA])
        known.append(auto.resolved(setup_of("pitanks", "human auto4 auto4 auto4"), [ANA]).seats[1].brain)
    assert known[-1] >= AUTO[6]
    for _ in range(6):
        auto.learn(ended("human auto4 auto4 auto4", (0, 9, 9, 9), 0.1), [ANA])
    assert auto.resolved(setup_of("pitanks", "human auto4 auto4 auto4"), [ANA]).seats[1].brain <= AUTO[1]


def test_two_people_meet_the_mean_of_what_suits_them(auto: AutoStrengths) -> None:
    for _ in range(6):
        auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 1.0), [ANA])
        auto.learn(ended("human auto4 auto4 auto4", (0, 9, 9, 9), 0.0), [BEN])
    strengths = [
        AUTO.index(auto.resolved(setup_of("pitanks", "human human auto1 auto1"), people).seats[2].brain)
        for people in ([ANA], [BEN], [ANA, BEN])
    ]
    assert strengths[0] > strengths[2] > strengths[1]
    assert strengths[2] == pytest.approx((strengths[0] + strengths[1]) / 2, abs=0.5)


def test_matches_against_levels_and_driven_by_an_ai_teach_nothing(auto: AutoStrengths) -> None:
    match = match_of("pitanks", "human level1 level1 level1", variant="plain")
    auto.learn(match, [ANA])
    auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 1.0), [ANA], [0])
    assert auto.resolved(setup_of("pitanks", "human auto4"), [ANA]).seats[1].brain == AUTO[FIRST]


def test_another_game_begins_where_the_last_one_was_and_another_person_anew(auto: AutoStrengths) -> None:
    for _ in range(6):
        auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 1.0), [ANA])
    assert auto.resolved(setup_of("race", "human auto4"), [ANA]).seats[1].brain >= AUTO[6]
    auto.forget(BEN)
    assert auto.resolved(setup_of("race", "human auto4"), [ANA]).seats[1].brain >= AUTO[6]
    auto.forget(ANA)
    assert auto.resolved(setup_of("race", "human auto4"), [ANA]).seats[1].brain == AUTO[FIRST]


def test_the_arcade_plays_what_was_learned_and_learns_from_it(arcade: Arcade, auto: AutoStrengths) -> None:
    """From the lobby with what it offers first to the match, its end, and the rematch."""
    for _ in range(6):
        auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 1.0), [ANA])
    arcade.open(Lobby(arcade.context, "pitanks"))
    arcade.press(Button.FIRE, Button.START)
    arcade.shown(MatchSetupPage)
    arcade.wait(1.0)
    arcade.press(Button.START)
    scene = arcade.reach(MatchScene)
    met = [seat.brain for seat in scene.setup.seats[1:]]
    assert len({*met}) == 1
    assert met[0] in AUTO[6:]
    before = list(auto.estimates[ANA, "pitanks"].beliefs)
    arcade.finish(0, 9, 9, 9)
    arcade.skip_moments()
    assert auto.estimates[ANA, "pitanks"].beliefs != before


def test_who_leaves_the_seat_is_forgotten(arcade: Arcade, auto: AutoStrengths) -> None:
    arcade.open(Lobby(arcade.context, "pitanks"))
    arcade.press(Button.FIRE)
    auto.learn(ended("human auto4 auto4 auto4", (9, 1, 1, 1), 1.0), [ANA, BEN])
    assert (ANA, "pitanks") in auto.estimates
    arcade.press(Button.BACK)
    assert (ANA, "pitanks") not in auto.estimates


def test_results_enter_tables_of_their_own() -> None:
    against, alone = (setup_of("pitanks", f"human {brain} {brain} {brain}") for brain in ("auto2", "level3"))
    assert counts(against, 0)
    assert contest(against, 0).auto
    assert not contest(alone, 0).auto
    assert contest(against, 0) != contest(alone, 0)


def test_a_replay_holds_the_strengths_and_plays_the_same() -> None:
    match = match_of("pitanks", "auto2 auto7 auto7 auto7", minutes=0.1)
    while not match.over:
        match.tick()
    replay = decode(encode(match), "one")
    assert [seat.brain for seat in replay.setup.seats] == ["auto2", "auto7", "auto7", "auto7"]
    assert verify(replay)
