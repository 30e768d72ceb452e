"""Matches of people whose traits are known, drawn at random, to calibrate what statistics say of traits."""

from collections.abc import Iterator, Sequence
from math import exp, log
from random import Random

import numpy as np

from pigaming_app.ai.brain.kind import BrainKind, Traits
from pigaming_app.ai.game_ai import LEVELS, POINT
from pigaming_app.ai.learning.batch import initial_states
from pigaming_app.ai.learning.rollout import cast_with_baselines, compiled_rollout
from pigaming_app.ai.people.fit.statistics import statistics
from pigaming_app.ai.people.fit.wishes import FIELDS, Watched, watch
from pigaming_app.ai.people.models import PersonModel, person_brain
from pigaming_app.ai.registry import AIS, find_brain, known_brains
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Setup
from pigaming_app.games.setup import longest, make_setup
from pigaming_app.sim.record import packed
from pigaming_app.sim.rng import SEEDS
from pigaming_app.sim.world import HZ, ROBOTS

PERSON = "beginner"  # a name that a setup may have; the brain is another
RANGES = {
    "reaction": (0.2, 0.9), "decisions": (1.8, 5.5), "timing": (0.03, 0.16), "aim": (0.08, 0.4),
    "lapses": (0.8, 9.0), "lapse": (0.35, 2.2), "stick": (0.08, 0.35),
}  # fmt: skip
AT_ONCE = 64  # matches


def drawn(random: Random, pointing: bool) -> Traits:
    """A person with traits far beyond those of the models in every direction."""
    numbers = {name: exp(random.uniform(log(low), log(high))) for name, (low, high) in RANGES.items()}
    numbers["stick"] *= pointing
    return Traits(
        spread=0.0, prediction=random.random(), tactics=random.random(), turbo=random.random() < 0.5, **numbers
    )


def matches_of(game: str, people: Sequence[PersonModel], count: int, seed: int) -> Iterator[list[Watched]]:
    """`count` matches of each of them against AIs of random levels. Raises ImportError without numba."""
    random, wishes = Random(seed), AIS[game].person
    assert wishes is not None
    kinds = [person_brain(PERSON, wishes, person) for person in people]
    rivals = {name: find_brain(game, name) for name in LEVELS}
    at_once = max(1, AT_ONCE // count)
    for first in range(0, len(kinds), at_once):
        some = kinds[first : first + at_once]
        line_ups = [_line_up(game, kind, rivals, random) for kind in some for _ in range(count)]
        seen = _played(game, line_ups, [*rivals.values(), *kinds])
        yield from (seen[i * count : (i + 1) * count] for i in range(len(some)))


def samples_of(
    game: str, driving: str, people: int, counts: Sequence[int], seed: int
) -> Iterator[tuple[Traits, dict[int, tuple[float, dict[str, float]]]]]:
    """People drawn at random, and after each of these numbers of matches the minutes and the statistics."""
    random, pointing = Random(seed), driving == POINT
    for first in range(0, people, AT_ONCE):
        some = [PersonModel(drawn(random, pointing), driving) for _ in range(min(AT_ONCE, people - first))]
        for person, plays in zip(some, matches_of(game, some, max(counts), seed * 1000003 + first), strict=True):
            yield (
                person.traits,
                {count: (minutes(plays[:count]), statistics(plays[:count], pointing)) for count in counts},
            )


def minutes(plays: Sequence[Watched]) -> float:
    """Length of all these matches."""
    return sum(len(play.actions) for play in plays) / (60.0 * HZ)


LineUp = tuple[Setup, int, list[tuple[BrainKind, int]]]  # setup, the person's seat, brain and seed of every seat


def _line_up(game: str, person: BrainKind, rivals: dict[str, BrainKind], random: Random) -> LineUp:
    seat, level = random.randrange(ROBOTS), random.choice(LEVELS)
    names = [PERSON if i == seat else level for i in range(ROBOTS)]
    seed, arena = random.randrange(SEEDS // ROBOTS), random.choice(arenas(game))
    setup = make_setup(game, names, arena, None, seed, None, None, known_brains(game, names))
    kinds = [person if i == seat else rivals[level] for i in range(ROBOTS)]
    return setup, seat, [(kind, seed * ROBOTS + i) for i, kind in enumerate(kinds)]


def _played(game: str, line_ups: Sequence[LineUp], kinds: Sequence[BrainKind]) -> list[Watched]:
    setups, seats, seated = zip(*line_ups, strict=True)
    cast, starts = cast_with_baselines(kinds, True), initial_states(setups)
    loop, states, minds = compiled_rollout(game, cast.families), packed(starts), cast.minds(seated)
    recorded = np.zeros((max(map(longest, setups)), len(setups), ROBOTS, len(FIELDS)))
    for tick in range(len(recorded)):
        loop(states, minds, cast.weights, 1)
        for i, name in enumerate(FIELDS):
            recorded[tick, :, :, i] = states["actions"][name]
    return [
        watch(game, start, np.ascontiguousarray(recorded[:end, i]), seat)
        for i, (start, end, seat) in enumerate(zip(starts, states["tick"], seats, strict=True))
    ]
