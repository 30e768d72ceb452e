"""People as models: what their hands do, seen from the actions alone; who finds them, and who does not."""

from collections import Counter
from itertools import pairwise

import pytest

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain.kind import NUMBERS, BrainPlayer, HumanPlayer
from pigaming_app.ai.game_ai import HELPED_TURN, LEVELS, TURN
from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.people.matches import Trial, places
from pigaming_app.ai.people.models import MASHER, PEOPLE
from pigaming_app.ai.people.series import series
from pigaming_app.ai.registry import AIS, BRAINS, find_brain, make_brain
from pigaming_app.games.match import victory
from pigaming_app.games.registry import games
from pigaming_app.games.setup import ChoiceError
from pigaming_app.sim.kernel import can_compile
from pigaming_app.sim.record import digest
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.ui.input.events import StickState
from tests.matches import match_of

EVERYBODY = ("masher", *PEOPLE)
BANDS = {  # wins in % against level 1, 2, ...: of four, or of two teams
    "masher": [(10, 30), (5, 100)],
    "beginner": [(40, 60), (25, 40), (10, 25)],
    "player": [(70, 100), (50, 70), (35, 55), (20, 35), (5, 20)],
    "expert": [(0, 100), (80, 100), (60, 100), (40, 60), (20, 40)],
}


def actions(game, name, seconds=20.0, seed=3):
    """What the seat of a person does in each tick: linear, angular, fire, turbo."""
    match = match_of(game, [name, *["level2"] * 3], minutes=2.0, seed=seed)
    rows = []
    while match.seconds < seconds and not match.over:
        match.tick()
        action = match.state.actions[0]
        rows.append((action.linear, action.angular, action.fire, action.turbo))
    return rows


def starts(rows, column):
    """How often a value of a column, or of its sign, begins that is not 0."""
    signs = [(row[column] > 0) - (row[column] < 0) for row in rows]
    return sum(after not in (0, before) for before, after in pairwise(signs))


@pytest.mark.parametrize("game", games())
def test_a_game_has_all_of_them_and_offers_none(game):
    assert all(find_brain(game, name).name == name for name in EVERYBODY)
    assert not {*EVERYBODY} & {*AIS[game].rivals, *BRAINS[game]}


def test_a_masher_presses_three_to_four_keys_a_second():
    """Of five keys; a press of a key that is down is not seen, and opposite keys cancel out."""
    rows = [row for seed in range(5) for row in actions("pitanks", "masher", 60.0, seed)]
    seen = sum(starts(rows, column) for column in (0, 1, 2)) / (len(rows) / HZ)
    assert 1.6 < seen < 4.0
    assert {row[:2] for row in rows} <= {(x, y) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0)}


class Masher:
    """Keys at random, as a person presses them who drives in the first style with help that a game offers."""

    def __init__(self, game, seed):
        styles = AIS[game].driving
        self.keys = BrainPlayer(MASHER, seed)
        self.person = HumanPlayer(lambda: self.pressed, styles.get(HELPED_TURN, styles[TURN]))

    def think(self, state, seat):
        self.keys.think(state, seat)
        action = state.actions[seat]
        self.pressed = StickState(action.linear, action.angular, bool(action.fire), bool(action.turbo))
        self.person.think(state, seat)


@pytest.mark.parametrize("game", games())
def test_a_masher_has_the_steering_help_of_a_game(game):
    """Its help is a kernel; that of people is the lobby's driving style."""
    matches = [match_of(game, ["masher", *["level2"] * 3], minutes=2.0, seed=3) for _ in range(2)]
    matches[1].sit(0, Masher(game, 3 * ROBOTS))
    while matches[0].seconds < 15.0 and not matches[0].over:
        for match in matches:
            match.tick()
    assert len({digest(match.state) for match in matches}) == 1


def test_a_beginner_has_keys_and_no_turbo():
    rows = actions("pitanks", "beginner", 60.0)
    assert {value for row in rows for value in row[:2]} == {-1.0, 0.0, 1.0}
    assert not any(row[3] for row in rows)
    assert any(row[2] for row in rows)


@pytest.mark.parametrize(("name", "most"), [("beginner", 3.2), ("player", 4.5), ("expert", 5.0)])
def test_the_drive_changes_no_more_often_than_a_person_decides(name, most):
    """On keys and stick alike; the stick of who points turns with the robot, but not the keys of who steers."""
    rows = actions("race", "beginner", 40.0) if name == "beginner" else actions("pitanks", name, 40.0)
    changed = sum(before[0] != after[0] for before, after in pairwise(rows)) if name == "beginner" else starts(rows, 2)
    assert changed / 40.0 < most


def test_presses_of_fire_last_as_long_as_a_hand_needs():
    rows = [row[2] for row in actions("pitanks", "player", 60.0)]
    held, lengths = 0, []
    for fire in rows:
        if not fire and held:
            lengths.append(held)
        held = held + 1 if fire else 0
    assert lengths
    assert min(lengths) >= 3


def test_two_matches_of_the_same_seed_are_the_same_and_people_differ():
    assert actions("pitanks", "beginner", 5.0) == actions("pitanks", "beginner", 5.0)
    reactions = Counter(round(mind_of("beginner", seed).inner.senses.delay, 3) for seed in range(50))
    assert len(reactions) > 40
    assert 0.4 < sorted(reactions)[25] < 0.8


def mind_of(name, seed):
    return make_brain("pitanks", name, seed).mind


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs the extra train")
@pytest.mark.parametrize("game", games())
def test_people_play_alike_in_both_bodies(game):
    match = match_of(game, ["beginner", "player", "expert", "masher"], minutes=0.4, seed=4)
    kinds = [find_brain(game, name) for name in ("beginner", "player", "expert", "masher")]
    batches = [Batch([match.setup], kinds, fast) for fast in (False, True)]
    for batch in batches:
        batch.play(24 * HZ)
    assert digest(batches[0].ended()[0]) == digest(batches[1].ended()[0])


def test_a_tie_is_shared_by_those_at_the_top():
    match = match_of("pitanks", ["idle"] * 4, minutes=0.05, seed=1)
    while not match.over:
        match.tick()
    assert [victory(games()["pitanks"], match.state, seat) for seat in range(4)] == [0.25] * 4
    match.state.robots[1].score = match.state.robots[2].score = 1
    assert [victory(games()["pitanks"], match.state, seat) for seat in range(4)] == [0.0, 0.5, 0.5, 0.0]


def test_a_mate_is_of_the_same_kind_and_seats_and_arenas_take_turns():
    setups = [*Trial("football", 24).setups("beginner", "level1")]
    for setup, seat in setups:
        assert [one.brain for one in setup.seats] == ["beginner" if i % 2 == seat % 2 else "level1" for i in range(4)]
    assert Counter(seat for _, seat in setups) == dict.fromkeys(range(4), 6)
    assert len({setup.arena for setup, _ in setups}) == 3
    assert len({setup.seed for setup, _ in setups}) == 24


@pytest.mark.parametrize("scale", ["colour=2", "reaction", "reaction=x", "reaction=-1", "reaction=nan"])
def test_a_scale_that_makes_no_sense_is_refused(scale):
    with pytest.raises(ChoiceError):
        places(Trial("pitanks", 1, minutes=0.05), ["player"], ["level1"], scale)
    with pytest.raises(ChoiceError):
        next(series(Trial("pitanks", 1, minutes=0.05), ["player"], scale=scale))


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs the extra train")
@pytest.mark.parametrize("game", games())
def test_levels_suit_people(game):
    """A short form of the table in docs/people.md: 100 matches a cell, so 13 points beside the bands of the tuning, 2.6
    standard errors.
    """
    found = places(Trial(game, 100), EVERYBODY if game in ("pitanks", "football") else EVERYBODY[1:], LEVELS)
    shares = {(one.person, one.level): 100.0 * one.share for one in found}
    for person, bands in BANDS.items():
        for level, (low, high) in zip(LEVELS, bands, strict=False):
            share = shares.get((person, level), low)
            assert low - 13.0 <= share <= high + 13.0, (person, level, share)


def test_every_trait_can_be_scaled():
    for trait in NUMBERS:
        before = PEOPLE["player"].traits
        assert getattr(before.scaled(trait, 1.1), trait) == pytest.approx(1.1 * getattr(before, trait))


@pytest.mark.again
@pytest.mark.long
@pytest.mark.skipif(not can_compile(), reason="needs the extra train")
@pytest.mark.parametrize("game", games())
def test_auto_suits_everybody_after_three_matches(game):
    """A short form of the table in docs/people.md: 20 series, hence wider bounds than the 30 to 50 % of the tuning."""
    for one in series(Trial(game, 160), EVERYBODY, (0, len(AUTO) - 1)):
        assert 0.2 < one.share < 0.6, (one.person, one.first, one.wins)
        assert one.interval[0] < one.share < one.interval[1]
