"""The inputs of Robot Race, checked against a match of hand-written brains; both bodies play alike."""

from math import cos, hypot, sin
from pathlib import Path

import numpy as np
import pytest

from pigaming_app.ai.learning.rollout import Batch
from pigaming_app.ai.networks.encoding import UNIT
from pigaming_app.ai.networks.files import brain_of
from pigaming_app.ai.networks.policy import Handicap
from pigaming_app.ai.networks.race import AHEAD, BOX, COURSE, ENCODING, NEAR, OILS, OTHER, OTHERS, PAD, POWERS, SIZE
from pigaming_app.ai.registry import BRAINS, find_brain
from pigaming_app.games.race.course import CoursePosition, distance_ahead, locate, segment_at
from pigaming_app.games.race.observation import SIGHT
from pigaming_app.games.setup import make_setup
from pigaming_app.sim.record import digest, to_bytes
from tests.ai.networks.random_network import random_network
from tests.matches import match_of

HANDICAP = Handicap(delay=0.2, error=0.1, sharpness=0.7, speed=0.9, form=0.2)
VARIANTS = "standard", "party"
ROOT = Path(__file__).parents[3]


def test_everything_is_seen_where_it_is():
    match = match_of("race", ["hand3"] * 4, "technical", 10.0, 4, "party", 5)
    state, senses, inputs, place = match.state, ENCODING.senses(), [0.0] * SIZE, CoursePosition()
    found = dict.fromkeys(("robot", "oil", "pad", "box", "item"), 0)
    while match.state.tick < 1500:
        match.tick()
        if state.tick % 10:
            continue
        me = state.robots[0]
        ENCODING.encode(state, 0, senses, inputs)
        assert all(-UNIT <= value <= UNIT and value == int(value) for value in inputs)
        seen = [value / UNIT for value in inputs]
        c, s = cos(me.heading), sin(me.heading)
        locate(state.course, me.x, me.y, place)
        along, aside = place.along, place.aside
        for i, ahead in enumerate(AHEAD):
            dx, dy = 450.0 * seen[COURSE + 6 * i], (1.2 * ahead + 40.0) * seen[COURSE + 6 * i + 1]
            if abs(seen[COURSE + 6 * i + 1]) < 1.0:
                locate(state.course, me.x + c * dx - s * dy, me.y + s * dx + c * dy, place)
                k, _ = segment_at(state.course, along + ahead)
                assert place.aside == pytest.approx(state.ideal[k], abs=8.0)
                assert distance_ahead(state.course, along, place.along) == pytest.approx(ahead, abs=25.0)
        for k in range(OTHERS, OILS, OTHER):
            if seen[k] and max(map(abs, seen[k + 1 : k + 3])) < 1.0:
                dx, dy = NEAR * seen[k + 1], 200.0 * seen[k + 2]
                x, y = me.x + c * dx - s * dy, me.y + s * dx + c * dy
                assert min(hypot(x - other.x, y - other.y) for other in state.robots[1:]) < 2.0
                found["robot"] += 1
        things = {"oil": [], "pad": state.pads, "box": [box for box in state.boxes if not box.pause]}
        for oil in state.oils:
            if oil.alive:
                thing = CoursePosition()
                locate(state.course, oil.x, oil.y, thing)
                things["oil"].append(thing)
        for name, k in (("oil", OILS), ("pad", PAD), ("box", BOX)):
            ways = {distance_ahead(state.course, along, thing.along): thing for thing in things[name]}
            nearest = min(ways, default=1e9)
            assert bool(seen[k]) == (nearest <= SIGHT)
            if seen[k] and abs(seen[k + 2]) < 1.0:
                assert SIGHT * (1.0 - seen[k + 1]) == pytest.approx(nearest, abs=2.0)
                asides = [thing.aside for way, thing in ways.items() if way == nearest]
                asides += [thing.aside for thing in things[name] if abs(thing.along - ways[nearest].along) < 1e-9]
                assert min(abs(aside + 100.0 * seen[k + 2] - one) for one in asides) < 1.0
                found[name] += 1
        assert sum(seen[POWERS : POWERS + 3]) == bool(state.racers[0].item)
        found["item"] += bool(state.racers[0].item)
    assert all(found.values()), found


@pytest.mark.long
@pytest.mark.again  # of `test_policy`, with this game
def test_both_bodies_play_the_same_race_to_the_last_bit():
    kinds = BRAINS["race"]
    one, two = brain_of(random_network(1, "race")), brain_of(random_network(2, "race", handicap=HANDICAP))
    setups = [make_setup("race", ["random"] * 4, "technical", 1.0, 5, name, None, list(kinds)) for name in VARIANTS]
    plain, fast = (Batch(setups, [one, two, kinds["hand3"], one], fast) for fast in (False, True))
    for batch in (plain, fast):
        batch.play(400)
    assert [digest(row) for row in fast.matches] == [digest(state) for state in plain.matches]
    for rows, minds in zip(fast.minds, plain.minds, strict=True):
        assert [digest(row) for row in rows] == [digest(mind) for mind in minds]


def test_a_bad_day_is_slower_by_no_more_than_the_form():
    brain = brain_of(random_network(1, "race", handicap=HANDICAP))
    minds = [brain.mind() for _ in range(50)]
    for seed, mind in enumerate(minds):
        brain.reset(mind, seed)
    speeds = np.array([mind.speed for mind in minds])
    assert 0.72 <= speeds.min() < 0.75
    assert 0.87 < speeds.max() <= 0.9


@pytest.mark.parametrize(
    ("game", "file"),
    [
        ("pitanks", "assets/brains/champion.npz"),
        ("factory", "assets/brains/factory.npz"),
        ("race", "assets/brains/race.npz"),
        ("football", "pigaming_football/brains/champion.npz"),
    ],
)
def test_a_shipped_network_plays_as_its_file_says(game, file):
    minds = []
    for name in ("net", str(ROOT / file)):
        kind = find_brain(game, name)
        mind = kind.mind()
        kind.begin(mind, 3)
        minds.append(to_bytes(mind))
    assert minds[0] == minds[1]
