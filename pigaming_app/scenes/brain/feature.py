"""What an AI thinks (F4) as a feature: its view of a match, over it."""

from typing import TYPE_CHECKING

from pigaming_app.scenes.features.feature import Feature, MatchOverlay
from pigaming_app.ui.i18n import Words

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.games.match import Match
    from pigaming_app.scenes.views.view import MatchView


def overlay(match: "Match", view: "MatchView", words: Words) -> MatchOverlay:
    from pigaming_app.scenes.brain.overlay import BrainOverlay

    return BrainOverlay(match, view, words)


FEATURE = Feature(
    "brain", rooms=("scenes.brain", "ai.explanations"), overlay=overlay, preload=("pigaming_app.scenes.brain.overlay",)
)
