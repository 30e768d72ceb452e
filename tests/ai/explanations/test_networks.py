"""Explanations of networks: exact for one decision, in words, and without effect on the match."""

from math import dist

import numpy as np
import pytest

from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.brain.thoughts import BULLET, MATE, OPPONENT, PERSON, PRIZE
from pigaming_app.ai.explanations.networks import make_explain, probabilities, topics_of
from pigaming_app.ai.explanations.percepts import SUBJECTS
from pigaming_app.ai.networks.files import brain_of
from pigaming_app.ai.networks.policy import Handicap, draw
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.sim.record import digest
from pigaming_app.ui.i18n import LANGUAGES, texts
from tests.ai.explanations.test_thoughts import thoughts
from tests.ai.networks.random_network import random_network
from tests.matches import match_of

ENCODING = ENCODINGS["pitanks"]


def match_with(network, seed=3, others="hand3 hand1 hand3"):
    """A match with a network on seat 0."""
    match = match_of("pitanks", f"idle {others}", "classic", 2.0, seed, "party")
    match.sit(0, BrainPlayer(brain_of(network), seed))
    return match


def test_asking_changes_neither_match_nor_mind_and_everything_told_has_words():
    watched, alone = (match_with(random_network(handicap=Handicap(0.1, 0.05, 0.5))) for _ in range(2))
    brain, words, told = watched.brains[0], [texts(language) for language in LANGUAGES], []
    assert thoughts(watched, 0).behaviour == "starts"
    for _ in range(600):
        watched.tick()
        alone.tick()
        told.append(thoughts(watched, 0))
        assert list(told[-1].choices.values()) in ([], brain.mind.choices)
    assert digest(watched.state) == digest(alone.state)
    assert digest(brain.mind) == digest(alone.brains[0].mind)
    for one in told:
        assert all(f"brain.{one.behaviour}" in text for text in words)
        assert all(0.0 <= value <= 1.0 for value in one.utilities.values())
        assert all(-1.0 <= value <= 1.0 for value in one.rose)
        if one.behaviour != "starts":
            assert one.utilities.keys() == SUBJECTS["pitanks"].topics.keys()
            assert [sum(chances) for chances in one.heads.values()] == pytest.approx([1.0] * 4)
    assert len({one.chosen for one in told}) > 2
    reasons = {*(f"looks_{topic}" for subject in SUBJECTS.values() for topic in subject.topics), "looks_nothing"}
    assert {one.reason for one in told if one.reason} <= reasons
    assert all(f"brain.because_{reason}" in text for reason in reasons for text in words)


def test_topics_cover_every_input_once_and_only_one_on_which_a_network_depends_counts():
    for encoding in ENCODINGS.values():
        places = [place for ranges in topics_of(encoding).values() for part in ranges for place in part]
        assert sorted(places) == list(range(encoding.size))
    for topic, ranges in topics_of(ENCODING).items():
        network = random_network(seed=5)
        kept = np.zeros_like(network.matrices[0])
        for part in ranges:
            kept[part] = 3 * network.matrices[0][part]
        network.matrices[0][:] = kept
        brain = brain_of(network)
        mind, weights, match = brain.mind(), brain.weights(False)[0], match_with(network)
        brain.reset(mind, 1)
        mind.inputs[:] = [100.0] * ENCODING.size
        mind.logits[:] = weights.logits(mind.inputs)
        shares = dict(make_explain(ENCODING)(match.state, 0, mind, weights).utilities)
        assert shares.pop(topic) > 0.1
        assert not any(shares.values())


def test_the_probabilities_are_those_by_which_choices_are_drawn():
    brain = brain_of(random_network(handicap=Handicap(sharpness=2.0)))
    mind = brain.mind()
    brain.reset(mind, 1)
    mind.logits[:] = [65536.0 * value for value in np.random.default_rng(1).normal(size=ENCODING.outputs)]
    chances = probabilities(ENCODING, mind.logits, mind.sharpness)[1]
    drawn = np.bincount([draw(mind, 3, 7) for _ in range(20_000)], minlength=7) / 20_000
    assert np.abs(drawn - chances).max() < 0.015


def test_things_are_marked_where_they_were_at_the_last_decision():
    network = random_network(seed=2)
    network.matrices[0][:] *= 2
    match, seen = match_with(network), set()
    mind, explain = match.brains[0].mind, make_explain(ENCODING)
    for _ in range(1500):
        before = match.state
        robots = [(robot.x, robot.y) for robot in before.robots[1:]]
        bullets = [(bullet.x, bullet.y) for bullet in before.bullets if bullet.alive]
        pickups = [(pickup.x, pickup.y) for pickup in before.pickups if pickup.alive]
        match.tick()
        if mind.wait != 5:
            continue
        things = {OPPONENT: robots, PRIZE: pickups, BULLET: [*bullets, *((m.x, m.y) for m in before.mines if m.alive)]}
        for sight in explain(match.state, 0, mind, match.brains[0].weights).percepts:
            near = min(dist((sight.x, sight.y), thing) for thing in things[sight.kind])
            assert near < 25.0 or near < 0.06 * dist(
                (sight.x, sight.y), (match.state.robots[0].x, match.state.robots[0].y)
            )
            seen.add(sight.kind)
    assert seen >= {OPPONENT, BULLET}


@pytest.mark.parametrize("game", ENCODINGS)
def test_networks_of_every_game_explain_themselves(game):
    match = match_of(game, ["idle"] * 4)
    for seat in range(4):
        network = random_network(seat, game)
        network.matrices[0][:] *= 3
        match.sit(seat, BrainPlayer(brain_of(network), seat))
    words, seen = texts("en"), set()
    for tick in range(300):
        match.tick()
        if tick % 10:
            continue
        for seat in range(4):
            told = thoughts(match, seat)
            assert f"brain.{told.behaviour}" in words
            assert all(-1.0 <= value <= 1.0 for value in told.rose)
            for sight in told.percepts:
                seen.add(sight.kind)
                robots = [(r.x, r.y) for i, r in enumerate(match.state.robots) if i != seat]
                near = min(dist((sight.x, sight.y), robot) for robot in robots)
                assert near < 80.0 or sight.kind not in (OPPONENT, MATE)
                people = [(worker.x, worker.y) for worker in getattr(match.state, "workers", [])]
                assert sight.kind != PERSON or min(dist((sight.x, sight.y), person) for person in people) < 80.0
    assert seen & {OPPONENT, MATE}
