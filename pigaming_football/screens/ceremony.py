"""Ceremonies of Robot Football, of two seconds each: teams and ball before the kick-off, and a goal once more.

The scene holds the match meanwhile: after a goal the rules let robots drive on, and nobody could see where.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from pigaming_app.api.look import STYLE, Batch, SimpleView, put
from pigaming_app.api.rules import HZ

from . import sprites
from .ball_track import BallTrack

SECONDS = 2.0  # of a ceremony
IMPACT, IN_NET = 0.25, 0.2  # s before the replay, and after it: the ball in the net
SLOW = 0.6  # speed of the replay
TICKS = round(SLOW * (SECONDS - IMPACT - IN_NET) * HZ)  # that it shows
ENTER, NAME_X, NAME_Y = 0.4, 400.0, 760.0  # s in which the teams enter; px from a goal and from the top
FALL, LAND = 0.9, 1.5  # s at which the ball begins to fall, and lands
BRACKET = 110.0  # px from the corners of the pitch to those of the picture of a replay


class GoalReplay:
    """The ticks before a goal, in slow motion. `clip`: their states."""

    def __init__(self, clip: Any) -> None:
        self.clip, self.shown = clip, 0
        self.track = BallTrack(clip[0].ball)

    def place(self, since: float) -> tuple[int, float]:
        """The tick that is shown `since` s after the goal, and the share of the way to the next; -1: none."""
        played = (since - IMPACT) * SLOW * HZ - TICKS + len(self.clip) - 1
        if since < IMPACT or since > SECONDS - IN_NET:
            return -1, 0.0
        i = min(max(0, int(played)), len(self.clip) - 2)
        return i, min(max(0.0, played - i), 1.0)

    def follow(self, i: int, time: float) -> None:
        """Let the ball follow up to the tick after the i-th."""
        while self.shown <= i:
            self.shown += 1
            self.track.follow(self.clip[self.shown].ball, time)


def samples(view: SimpleView) -> Iterator[Callable[[], object]]:
    """Functions that make the pictures of ceremonies."""
    yield partial(view.announcement, view.word("football.kick_off"), STYLE.ice)
    for side in (0, 1):
        yield partial(sprites.team_name, view.word(f"lobby.side_{side + 1}"), side)
    for drop in range(sprites.DROPS):
        yield partial(sprites.falling, 0.0, drop)
    for corner in range(4):
        yield partial(sprites.bracket, corner)


def draw_teams(view: SimpleView, light: Batch, top: Batch) -> None:
    """The names of the teams, which come in from their sides, and the ball, which falls on its spot."""
    entered = 1.0 - (1.0 - min(1.0, view.since / ENTER)) ** 3
    for side in (0, 1):
        x = -400.0 + (NAME_X + 400.0) * entered
        at = view.on_canvas(x if side == 0 else 1600.0 - x, NAME_Y)
        put(light, sprites.team_name(view.word(f"lobby.side_{side + 1}"), side), *at)
    fallen = (view.since - FALL) / (LAND - FALL)
    if fallen >= 0.0:
        drop = min(sprites.DROPS - 1, int(fallen * fallen * sprites.DROPS))
        put(top, sprites.falling(0.0, drop), *view.on_canvas(800.0, 450.0))


def draw_brackets(view: SimpleView, light: Batch) -> None:
    """The corners of the picture of a replay."""
    for corner in range(4):
        x, y = (BRACKET if corner % 2 == 0 else 1600.0 - BRACKET), (BRACKET if corner < 2 else 900.0 - BRACKET)
        put(light, sprites.bracket(corner), *view.on_canvas(x, y))
