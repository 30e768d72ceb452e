"""The explanation of each brain. A plug-in's brain has its own; one of ours is explained by its decision function."""

from collections.abc import Callable
from typing import Any

from pigaming_app.ai.brain.effort import AUTO
from pigaming_app.ai.brain.kind import BrainKind, BrainPlayer, NoWeights, SimpleMind, act_randomly, stand_still
from pigaming_app.ai.brain.thoughts import Thoughts
from pigaming_app.ai.explanations import classic, fsm, gunner, tables
from pigaming_app.ai.explanations.networks import make_explain
from pigaming_app.ai.explanations.percepts import SUBJECTS
from pigaming_app.ai.networks.policy import is_network_mind
from pigaming_app.ai.networks.registry import ENCODINGS
from pigaming_app.ai.pitanks.classic import think as classic_think
from pigaming_app.ai.pitanks.fsm import think as fsm_think
from pigaming_app.ai.pitanks.gunner import think as gunner_think
from pigaming_app.ai.qlearning.table import think as table_think
from pigaming_app.ai.registry import AIS
from pigaming_app.games.match import Match
from pigaming_app.games.registry import OURS
from pigaming_app.games.simple import MatchState
from pigaming_app.storage.optional import optional

Explain = Callable[[Any, int, Any, Any], Thoughts]


def explain_idle(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> Thoughts:
    return Thoughts("idle", "always")


def explain_random(match: MatchState, seat: int, mind: SimpleMind, weights: NoWeights) -> Thoughts:
    """All moves with equal value, and the one drawn last."""
    action = match.actions[seat]
    moves = {(ahead, turn, fire): 0.0 for ahead in (1, 0, -1) for turn in (-1, 0, 1) for fire in (0, 1)}
    chosen = int(action.linear), int(action.angular), int(action.fire)
    return Thoughts("random", "dice", names={"percent": 6}, moves=moves, chosen=chosen)


BY_THINK: dict[Any, Explain] = {
    stand_still: explain_idle,
    act_randomly: explain_random,
    classic_think: classic.explain,
    fsm_think: fsm.explain,
    gunner_think: gunner.explain,
    table_think: tables.explain,
}
for game in OURS:
    if room := optional(f"ai.explanations.{game}"):
        BY_THINK |= room.BY_THINK


def explain_of(kind: BrainKind, game: str) -> Explain | None:
    """The function that explains a brain of a game, with the arguments of its `think`; None if nothing does."""
    if kind.explain:
        return kind.explain
    if kind.name in AUTO and (ends := AIS[game].auto) and (inner := explain_of(ends[0], game)):
        return lambda match, seat, mind, weights: inner(match, seat, mind.inner, weights)
    if game in SUBJECTS and is_network_mind(kind.mind, ENCODINGS[game]):
        return make_explain(ENCODINGS[game])
    return BY_THINK.get(kind.think)


def thoughts_of(match: Match, seat: int) -> Thoughts | None:
    """The present reasoning of the brain on a seat; None for people, and for brains that nothing explains."""
    brain = match.brains[seat]
    if not isinstance(brain, BrainPlayer):
        return None
    explain = explain_of(brain.kind, match.setup.game)
    return explain(match.state, seat, brain.mind, brain.weights) if explain else None
