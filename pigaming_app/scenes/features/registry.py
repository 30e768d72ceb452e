"""The features of this installation. One that is not there is left out: no tile, row or page leads to it."""

import logging
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from pigaming_app.scenes.features.feature import Feature, JoinOffer, MatchOverlay, MenuItem
from pigaming_app.scenes.flow.scene import Context, RobotMat, Scene
from pigaming_app.scenes.launch import Options
from pigaming_app.storage.optional import is_there, optional
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.window import Pin

if TYPE_CHECKING:  # the title does not wait for these
    from pigaming_app.games.match import Match
    from pigaming_app.scenes.views.view import MatchView

NAMES = (
    *("attract", "brain", "controls", "howto", "ladder", "events"),
    *("lab", "editor", "replays", "phones", "bots", "kiosk", "mat", "playtest"),
)

log = logging.getLogger("pigaming")


@cache
def features() -> tuple[Feature, ...]:
    """The features with screens that are there, in the order of NAMES."""
    return tuple(feature for name in NAMES if (feature := declared(f"scenes.{name}")))


def declared(room: str) -> Feature | None:
    """The feature that a room declares, or None unless all its rooms are there. Mistakes in its module are raised."""
    module = optional(f"{room}.feature")
    if module is None:
        return None
    feature = module.FEATURE
    assert isinstance(feature, Feature)
    missing = [room for room in (*feature.rooms, *feature.needs) if not is_there(room)]
    if missing:
        log.warning("%s is not offered: %s is missing", feature.name, missing[0])
    return None if missing else feature


def menu() -> dict[str, MenuItem]:
    """The items of the title's menu, from left to right."""
    items = {feature.name: feature.menu for feature in features() if feature.menu}
    return dict(sorted(items.items(), key=lambda item: item[1].place))


def draw_arena(context: Context, game: str) -> Callable[[], Scene] | None:
    """Opens the page of a game's drawn arenas; None if none can be drawn."""
    return next((feature.draw_arena(context, game) for feature in features() if feature.draw_arena), None)


def next_line(context: Context, scenes: Sequence[Scene]) -> str:
    """What comes next for everybody, in one line for the second screen; empty: nothing."""
    lines = (feature.next_line(context, scenes) for feature in features() if feature.next_line)
    return next((line for line in lines if line), "")


def without_limit(scenes: Sequence[Scene]) -> bool:
    """True if the time limit of a group does not apply to these scenes."""
    return any(feature.without_limit(scenes) for feature in features() if feature.without_limit)


def saved_brains() -> list[Path]:
    """Files of PiTanks robots that visitors have trained, newest first."""
    return [path for feature in features() if feature.saved_brains for path in feature.saved_brains()]


def mat_of(context: Context, options: Options) -> RobotMat | None:
    """The mat with real robots that the options ask for, if there can be one."""
    return next((feature.mat(context, options) for feature in features() if feature.mat), None)


def corner_pin(corners: Sequence[float]) -> Pin | None:
    """The warp of the picture to these corners, if there can be one. Raises OperatorError."""
    return next((feature.corner_pin(corners) for feature in features() if feature.corner_pin), None)


def join_offer(context: Context) -> JoinOffer | None:
    """The way to take a seat without a device at hand, if there is one."""
    return next((feature.join(context) for feature in features() if feature.join), None)


def match_overlay(match: "Match", view: "MatchView", words: Words) -> MatchOverlay | None:
    """What can be drawn over a match for one of its AIs, if anything."""
    return next((feature.overlay(match, view, words) for feature in features() if feature.overlay), None)


def has_overlay() -> bool:
    """True if something can be drawn over a match for one of its AIs."""
    return any(feature.overlay for feature in features())


def idle_page(context: Context) -> Scene | None:
    """The page over the title while nobody plays, if there is one."""
    return next((feature.idle(context) for feature in features() if feature.idle), None)
