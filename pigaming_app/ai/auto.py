"""Auto: opponents whose strength suits a person, found from match to match.

Within a match the effort of each robot follows the score (see `brain/effort`); here the strength with which the next
match begins is learned. Source: O. Missura, T. Gärtner, "Predicting dynamic difficulty", Advances in Neural
Information Processing Systems 24, 2011: the algorithm POSM, on a set of strengths in a single order.
"""

from pigaming_app.ai.brain.effort import AUTO

NAME = "auto"  # in the lobby and in the settings
FIRST = 3  # strength of somebody unknown, 0..8
TOO_EASY, TOO_HARD = 0.14, 0.2  # factors of belief after a victory and after a defeat: even at 45 wins of 100
FORGETTING = 0.03  # share of belief that is spread evenly after each match, since people learn and change places


class Estimate:
    """What is believed about one person: a weight for each of the strengths AUTO; at first as much below as above."""

    def __init__(self, first: int = FIRST) -> None:
        last = len(AUTO) - 1
        self.beliefs = [1.0 / (first if k < first else last - first if k > first else 1) for k in range(last + 1)]

    @property
    def strength(self) -> int:
        """The strength to play next, 0..8: that with about as much belief below it as above."""
        beliefs = self.beliefs
        return max(range(len(beliefs)), key=lambda k: min(sum(beliefs[: k + 1]), sum(beliefs[k:])))

    def update(self, effort: float, won: float) -> None:
        """Learn from a match. `effort`: of the opponents at its end, 0..1; `won`: the person's share of the victory."""
        last = len(AUTO) - 1
        met = min(max(effort * last, 0.5), last - 0.5)  # the greatest is never too easy, the least never too hard
        easy, hard = TOO_EASY**won, TOO_HARD ** (1.0 - won)
        weights = [
            belief * (easy if k < met + 0.5 else 1.0) * (hard if k > met - 0.5 else 1.0)
            for k, belief in enumerate(self.beliefs)
        ]
        total = sum(weights)
        self.beliefs = [(1.0 - FORGETTING) * weight / total + FORGETTING / len(AUTO) for weight in weights]
