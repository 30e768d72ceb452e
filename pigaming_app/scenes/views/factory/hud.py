"""HUD of Robot Factory: each team's score, robots and pallets, and the clock.

Panels are baked into the background when their content changes.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import pygame

from pigaming_app.games.factory.state import DELIVERED, ICE, TEAMS, Factory
from pigaming_app.scenes.views.background import Background, Bit
from pigaming_app.scenes.views.factory import order_cards, panels, star_panel
from pigaming_app.scenes.views.factory.order_cards import Order
from pigaming_app.scenes.views.factory.panels import EDGE, NUMBER, H, Mate, W, X, Y
from pigaming_app.scenes.views.hud.ai_sign import ai_of, name_of
from pigaming_app.scenes.views.hud.parts import CLOCK, HudParts
from pigaming_app.scenes.views.sprites.factory import TEAMS as COLORS
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, LABEL, SUB, Color, GlowCanvas
from pigaming_app.ui.draw import ICE as WHITE
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_size, glyph, wrap_balanced
from pigaming_app.ui.i18n import Words

ROBOT, CRATES = 268, 330  # px from a panel's outer edge
CALLS = {"one_to_go": 2 * HZ, "stolen": HZ, "expired": HZ}  # ticks for which a call covers a panel
CLOCK_Y = 82


class FactoryHud:
    """Keeps the HUD up to date. `players`: driver of each seat; AIs are marked."""

    def __init__(self, background: Background, players: list[str], state: Factory, words: Words | None = None) -> None:
        self.background, self.players, self.words = background, players, words
        self.parts = HudParts(background)
        self.teams = (ICE,) if state.rules.allies else tuple(range(TEAMS))
        self.delivered = list(state.delivered)
        self.names: Sequence[str] = ()  # of the first seats, in an event
        self.calls: dict[int, tuple[str, int]] = {}  # by team: the call on its panel, and the tick at which it ends

    def call(self, team: int, key: str, tick: int) -> None:
        """Cover a team's panel with a call (a key of CALLS) that begins at `tick`."""
        self.calls[team] = key, tick + CALLS[key]

    def show(self, state: Factory) -> list[int]:
        """Bake changed panels; returns the teams with new deliveries."""
        new = [team for team in self.teams if state.delivered[team] > self.delivered[team]]
        self.delivered = list(state.delivered)
        for team in self.teams:
            self._show_panel(state, team)
        if state.rules.allies:
            star_panel.show_stars(self.parts, state, self._mates(state, ICE))
        elif self.words and state.rules.party and state.tick >= state.rules.ticks:
            call = self.words("factory.next_point")
            self.parts.show("clock", call, CLOCK.x, CLOCK.w, partial(overtime_bits, call))
        else:
            self.parts.countdown(state, CLOCK_Y)
        return new

    def _show_panel(self, state: Factory, team: int) -> None:
        bits: Callable[[], Iterator[Bit]]
        content: tuple[Any, ...]
        color = FOCUS if lacks_one(state, team) else WHITE
        key, end = self.calls.get(team, ("", 0))
        if self.words and state.tick < end:
            content = self.words(f"factory.{key}"), call_color(key, team)
            bits = partial(call_bits, team, *content)
        elif state.rules.allies:
            content = star_panel.progress(state), color
            bits = partial(star_panel.progress_bits, *content)
        else:
            number = state.points[team] if state.rules.party else state.delivered[team]
            goal = 0 if state.rules.party else state.rules.pallets
            content = number, goal, color, self._mates(state, team), order_cards.orders(state, team)
            bits = partial(team_bits, team, *content)
        self.parts.show(team, content, X[team] - 8, W + 16, bits)

    def _mates(self, state: Factory, team: int) -> tuple[Mate, ...]:
        return tuple(
            (i, ai_of(self.players[i]), name_of(self.names, i), round(16 * robot.turbo))
            for i, robot in enumerate(state.robots)
            if robot.present and robot.team == team
        )

    def jobs(self, state: Factory) -> Iterator[Job]:
        """Prewarm jobs for the pieces of the panels."""
        for team in self.teams:
            yield partial(panels.pulse, team)
            for char in "0123456789":
                yield from (partial(glyph, char, SUB, color) for color in (WHITE, FOCUS))
            for key in ("stolen", "expired") if state.rules.party else ("one_to_go",):
                if self.words:
                    yield partial(panels.banner, self.words(f"factory.{key}"), call_color(key, team))
        if state.rules.allies:
            yield from star_panel.jobs(state)
            return
        for team in self.teams:
            named = tuple((seat, brain, name, 0) for seat, brain, name, _ in self._mates(state, team) if name)
            yield partial(panels.frame, team, mates=named)
            for form in range(DELIVERED + 1):
                yield partial(panels.small_crate, team, form, order_cards.SIZES[0][0])
        if state.rules.party:
            yield from order_cards.jobs()
            if self.words:
                yield partial(overtime, self.words("factory.next_point"))


def lacks_one(state: Factory, team: int) -> bool:
    """True if a team has exactly one more pallet to deliver."""
    return bool(not state.rules.party and state.delivered[team] == state.rules.pallets - 1)


def team_bits(
    team: int, number: int, goal: int, color: Color, mates: tuple[Mate, ...], shown: tuple[Order, ...]
) -> Iterator[Bit]:
    """Pieces of a team's panel; the second team's is mirrored."""
    x, mirrored = X[team], team != ICE
    named = tuple((seat, brain, name, 0) for seat, brain, name, _ in mates if name)
    yield panels.frame(team, mates=named), (x - EDGE, Y - EDGE), None
    text, rest = str(number), f"/{goal}" if goal else ""
    wide = panels.count_width(text, rest)
    yield from panels.count_bits(text, rest, x + W - NUMBER - wide if mirrored else x + NUMBER, color)
    yield from panels.robot_bits(mates, (x + W - ROBOT if mirrored else x + ROBOT,))
    left, right = (x + 16, x + W - CRATES) if mirrored else (x + CRATES, x + W - 16)
    yield from order_cards.bits(team, shown, left, right, mirrored)


def call_color(key: str, team: int) -> Color:
    """Good news in the team's colour, bad news in that of an alarm."""
    return COLORS[team] if key == "one_to_go" else ALARM


def call_bits(team: int, text: str, color: Color) -> Iterator[Bit]:
    """A call that covers a team's panel."""
    yield panels.banner(text, color), (X[team] - EDGE, Y - EDGE), None


def overtime_bits(text: str) -> Iterator[Bit]:
    """The words that replace the clock in overtime."""
    yield panels.centred(overtime(text), CLOCK.centerx, CLOCK_Y)


@cached
def overtime(text: str) -> pygame.Surface:
    """A short call in two lines, as wide as the clock."""
    lines = wrap_balanced(text, 2, LABEL, "hero")
    size = min(fit_size(line, LABEL, CLOCK.w - 16, "hero") for line in lines)
    ink = GlowCanvas(CLOCK.w, H + 20)
    for i, line in enumerate(lines):
        ink.text(line, size, CLOCK.w / 2, (H + 20) / 2 + 52 * (i - (len(lines) - 1) / 2), FOCUS, "hero", "c")
    return ink.lit(0.7)
