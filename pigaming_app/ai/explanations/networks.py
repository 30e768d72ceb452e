"""Explanation of a network: what its decision depends on, and how likely each of its choices was.

Dependence on a topic is measured by occlusion: its inputs are set to 0, the logits computed again, and the measure is
the total variation distance between the probabilities of the choices with and without them, 0 to 1, of the head where
it is largest. It is exact for this one decision, but blind to topics that replace each other (Zeiler and Fergus, ECCV
2014, section 4.2). It costs one forward pass a topic, all of them in one call.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from math import pi
from typing import TYPE_CHECKING, Any

from pigaming_app.ai.brain.thoughts import Thoughts, behaviour_of, blend, towards
from pigaming_app.ai.explanations.percepts import SUBJECTS
from pigaming_app.ai.networks.encoding import Encoding
from pigaming_app.ai.networks.policy import LOGIT, NetworkMind
from pigaming_app.ai.networks.subject import Subject, perceived
from pigaming_app.games.simple import MatchState

if TYPE_CHECKING:
    from pigaming_app.ai.networks.layers import Layers

Explain = Callable[[Any, int, Any, Any], Thoughts]

MATTERS = 0.05  # share of the choice from which on a topic counts
TILTED = 0.3  # deflection above which the stick counts as held


@cache
def make_explain(encoding: Encoding) -> Explain:
    """The explanation of a game's networks."""
    topics, subject = topics_of(encoding), SUBJECTS[encoding.game]
    shoots = subject.fire == "shoot"  # elsewhere a press may be without effect
    names = [subject.fire if name == "fire" else name for name, _ in encoding.heads]

    def explain(match: MatchState, seat: int, mind: NetworkMind, weights: "Layers") -> Thoughts:
        if not any(mind.inputs):
            return Thoughts("starts")
        chances = probabilities(encoding, mind.logits, mind.sharpness)
        shares = _shares(encoding, topics, chances, mind, weights)
        first = max(shares, key=lambda topic: shares[topic])
        action = match.actions[seat]
        heads = dict(zip(names, chances, strict=True))
        return Thoughts(
            behaviour=behaviour_of(_step(action.linear), _step(action.angular), int(action.fire and shoots)),
            reason=f"looks_{first}" if shares[first] >= MATTERS else "looks_nothing",
            percepts=tuple(
                sight for topic, sight in perceived(subject, match, seat, mind.inputs) if shares[topic] >= MATTERS
            ),
            rose=_rose(subject, heads),
            utilities=shares,
            chosen=first if shares[first] >= MATTERS else "",
            heads=heads,
            choices=dict(zip(names, map(int, mind.choices), strict=True)),
        )

    return explain


def topics_of(encoding: Encoding) -> dict[str, list[range]]:
    """Places of the inputs of each topic."""
    places, first = {}, 0
    for group, length in encoding.groups:
        places[group] = range(first, first + length)
        first += length
    return {topic: [places[group] for group in groups] for topic, groups in SUBJECTS[encoding.game].topics.items()}


def probabilities(encoding: Encoding, logits: Sequence[float], sharpness: float) -> list[list[float]]:
    """Probability of each choice, by head; as `policy.odds`, which draws the choices."""
    chances, first = [], 0
    for _, count in encoding.heads:
        own = logits[first : first + count]
        best = max(own)
        odds = [max(0.0, 1.0 + sharpness * (logit - best) * LOGIT / 64.0) ** 64 for logit in own]
        total = sum(odds)
        chances.append([one / total for one in odds])
        first += count
    return chances


def _shares(
    encoding: Encoding,
    topics: Mapping[str, Sequence[range]],
    chances: list[list[float]],
    mind: NetworkMind,
    weights: "Layers",
) -> dict[str, float]:
    """Dependence of the choices on each topic; topics whose inputs are 0 anyway are not computed."""
    shares, rows = dict.fromkeys(topics, 0.0), {}
    for topic, places in topics.items():
        if any(any(mind.inputs[place.start : place.stop]) for place in places):
            rows[topic] = list(mind.inputs)
            for place in places:
                rows[topic][place.start : place.stop] = [0.0] * len(place)
    for topic, logits in zip(rows, weights.logits_of([*rows.values()]), strict=True):
        shares[topic] = _distance(chances, probabilities(encoding, logits, mind.sharpness))
    return shares


def _distance(chances: Sequence[Sequence[float]], others: Sequence[Sequence[float]]) -> float:
    """Largest total variation distance of a head."""
    return max(
        min(1.0, 0.5 * sum(abs(a - b) for a, b in zip(one, other, strict=True)))
        for one, other in zip(chances, others, strict=True)
    )


def _rose(subject: Subject, heads: Mapping[str, Sequence[float]]) -> Sequence[float]:
    """Expected speed in each direction; a full turn of the stick leads to the side."""
    roses = []
    for speed, driven in zip(subject.drives, heads["drive"], strict=True):
        for side, turned in zip(subject.turns, heads["turn"], strict=True):
            bearing = 0.5 * pi * side if speed > 0.0 else pi - 0.5 * pi * side
            roses.append(towards(bearing, abs(speed) * driven * turned))
    return blend(*roses)


def _step(deflection: float) -> int:
    return int(deflection > TILTED) - int(deflection < -TILTED)
