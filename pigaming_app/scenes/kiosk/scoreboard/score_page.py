"""The page with the big score: clock, robots or teams with their drivers, best first."""

from collections.abc import Sequence
from functools import partial
from typing import Protocol, runtime_checkable

import pygame

from pigaming_app.scenes.features import board_text as text
from pigaming_app.scenes.features.board_page import BoardPart, Box
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.results.snapshot import MatchSnapshot, ShownMatch, Side, match_of, snapshot
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, LABEL, MIST, PLAYERS, STEEL, SUB, Color
from pigaming_app.ui.i18n import Words

CLOCK_SIZE, TOP, BOTTOM, LEFT, W = 190, 300, 1050, 60, 1800
ROW_MAX = 372  # px
HEAD: Box = (LEFT, 40, 620, 220)
CLOCK: Box = (690, 40, 540, 220)
STATE: Box = (1240, 40, 620, 220)


@runtime_checkable
class PartOfEvent(Protocol):
    """What follows a match of an event."""

    @property
    def names(self) -> Sequence[str]:
        """Who plays, in the order of the seats."""

    def round_line(self, words: Words) -> str:
        """Where the match stands in the event."""


class ScorePage:
    """Shows the match on the stack, and after its end its result, until another one begins."""

    name = "scores"

    def __init__(self, context: Context) -> None:
        self.context = context
        self.last: MatchSnapshot | None = None

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart] | None:
        """The current or last match; None before the first one."""
        found, on_top = match_of(scenes)
        if found is not None:
            self.last = shown_match(found, self.context.words, on_top)
        elif self.last is not None and self.last.state != "over":
            self.last = None  # it was left
        return match_parts(self.context, self.last) if self.last else None


def match_parts(context: Context, shown: MatchSnapshot) -> list[BoardPart]:
    """The parts of a match."""
    words = context.words
    head = words(f"games.{shown.game}"), shown.arena
    state = words(f"scoreboard.{shown.state}") if shown.state else ""
    parts = [
        BoardPart(HEAD, head, partial(_head, *head)),
        BoardPart(CLOCK, (shown.clock, shown.alarm), partial(_clock, shown.clock, ALARM if shown.alarm else ICE)),
        BoardPart(STATE, (state, shown.round), partial(_state, state, shown.round)),
    ]
    pitch = min(ROW_MAX, (BOTTOM - TOP) // max(1, len(shown.sides)))
    for i, side in enumerate(shown.sides):
        box = (LEFT, TOP + pitch * i, W, pitch - 16)
        parts.append(BoardPart(box, side, partial(paint_side, side, i + 1)))
    return parts


def color_of(side: Side) -> Color:
    """The colour of a robot; a team has none."""
    return PLAYERS[side.seats[0]] if len(side.seats) == 1 else ICE


def paint_side(side: Side, place: int, surface: pygame.Surface) -> None:
    """A row: badges with the icons of their drivers, name and score; a crown for the leader."""
    w, h = surface.get_size()
    color, middle = color_of(side), h / 2
    surface.blit(text.outline(w, h, color if side.leads else STEEL), (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    r, size = min(84 if len(side.seats) == 1 else 60, round(0.3 * h)), min(112, max(SUB, round(0.36 * h)))
    x = 40 + 1.5 * r
    for seat, sign in zip(side.seats, side.signs, strict=True):
        text.put(surface, text.player_badge(seat, r), x, middle)
        x += 1.6 * r
        text.put(surface, text.symbol(sign, round(0.7 * r), MIST), x + 0.7 * r, middle)
        x += 3.1 * r
    x -= 0.9 * r
    end = w - 60 - 3 * min(240, round(0.86 * h)) * 0.7
    if side.leads:
        text.put(surface, text.symbol("crown", 46, FOCUS), end - 60, middle)
        end -= 130
    if side.name:
        x += text.write(surface, side.name, size, x, middle, ICE, "head", "l", round(end - x - 30)) + 40
    if side.driver and end - x > 200:
        text.write(surface, side.driver, LABEL, x, middle, MIST, "body", "l", round(end - x - 30))
    text.write_number(surface, side.score, min(240, round(0.86 * h)), w - 48, middle, color, "r")


def _head(game: str, arena: str, surface: pygame.Surface) -> None:
    w, h = surface.get_size()
    text.write(surface, game, SUB + 24, 0, h / 2 - 34, ICE, "head", "l", w)
    text.write(surface, arena, LABEL, 0, h / 2 + 62, MIST, "body", "l", w)


def _clock(clock: str, color: Color, surface: pygame.Surface) -> None:
    w, h = surface.get_size()
    text.write_number(surface, clock, CLOCK_SIZE, w / 2, h / 2, color, "c")


def _state(state: str, round_line: str, surface: pygame.Surface) -> None:
    """State and round; a state alone in the middle."""
    w, h = surface.get_size()
    if state:
        text.write(surface, state, SUB, w, h / 2 - (34 if round_line else 0), FOCUS, "head", "r", w)
    if round_line:
        text.write(surface, round_line, LABEL, w, h / 2 + 62, MIST, "body", "r", w)


def shown_match(scene: ShownMatch, words: Words, on_top: bool) -> MatchSnapshot:
    """The match of a scene now, with the entrants and the round of an event."""
    after = getattr(scene, "after", None)
    if not isinstance(after, PartOfEvent):
        return snapshot(scene, words, on_top)
    return snapshot(scene, words, on_top, after.names, after.round_line(words))
