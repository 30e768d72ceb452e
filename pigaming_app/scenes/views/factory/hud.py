"""HUD of Robot Factory: each team's score, robots and pallets, and the clock.

Panels are baked into the background when their content changes.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from pigaming_app.games.factory.state import DELIVERED, ICE, TEAMS, Factory
from pigaming_app.scenes.views.background import Background, Bit
from pigaming_app.scenes.views.factory import order_cards, panels, star_panel
from pigaming_app.scenes.views.factory.order_cards import STEPS, Order
from pigaming_app.scenes.views.factory.panels import NUMBER, H, Mate, W, X, Y
from pigaming_app.scenes.views.hud.ai_sign import ai_of, name_of
from pigaming_app.scenes.views.hud.parts import CLOCK, EDGE, HudParts, clock_jobs, drawn, pulse, word_bits
from pigaming_app.scenes.views.sprites.teams import TEAMS as COLORS
from pigaming_app.sim.world import HZ
from pigaming_app.ui.draw import ALARM, FOCUS, LABEL, Color, readable
from pigaming_app.ui.draw import ICE as WHITE
from pigaming_app.ui.draw.frame_budget import Job
from pigaming_app.ui.draw.layers import wrap_balanced
from pigaming_app.ui.i18n import Words

ROBOT, CRATES = 268, 330  # px from a panel's outer edge, at least
ROBOT_ROOM = 62  # px from the end of the number to the robots' middle
CALLS = {"one_to_go": 2 * HZ, "stolen": HZ, "expired": HZ}  # ticks for which a call covers a panel
CLOCK_Y = 82


class FactoryHud:
    """Keeps the HUD up to date. `players`: driver of each seat; AIs are marked."""

    def __init__(self, background: Background, players: list[str], state: Factory, words: Words | None = None) -> None:
        self.background, self.players, self.words = background, players, words
        self.parts = HudParts(background)
        self.teams = (ICE,) if state.rules.allies else tuple(range(TEAMS))
        self.delivered = list(state.delivered)
        self.names: Sequence[str] = ()  # by seat; of entrants, or of phones
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
            self.parts.show("clock", self._overtime, CLOCK.x, CLOCK.w, partial(word_bits, self._overtime))
        else:
            self.parts.countdown(state, CLOCK_Y)
        return new

    def _show_panel(self, state: Factory, team: int) -> None:
        bits: Callable[[], Iterator[Bit]]
        content: tuple[Any, ...]
        color = FOCUS if not state.rules.party and state.delivered[team] == state.rules.pallets - 1 else WHITE
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

    @property
    def _overtime(self) -> str:
        """Words in place of the clock; | parts lines."""
        words = self.words("factory.next_point") if self.words else ""
        return "|".join(wrap_balanced(words, 2, readable(LABEL), "head"))

    def _mates(self, state: Factory, team: int) -> tuple[Mate, ...]:
        return tuple(
            (i, ai_of(self.players[i]), name_of(self.names, i), round(16 * robot.turbo))
            for i, robot in enumerate(state.robots)
            if robot.present and robot.team == team
        )

    def jobs(self, state: Factory) -> Iterator[Job]:
        """Prewarm jobs: samples of the panels, and of the words over them."""
        party = bool(state.rules.party)
        yield from clock_jobs(CLOCK_Y)
        for team in self.teams:
            yield partial(pulse, COLORS[team], W, H)
            for key in ("stolen", "expired") if party else ("one_to_go",):
                if self.words:
                    yield drawn(call_bits, team, self.words(f"factory.{key}"), call_color(key, team))
        if state.rules.allies:
            yield from star_panel.jobs(state)
            return
        rushes = [Order(form, STEPS // 2, urgent) for form in range(DELIVERED) for urgent in (False, True) if party]
        for team in self.teams:
            shown, goal = tuple(Order(form) for form in range(DELIVERED + 1)), 0 if party else state.rules.pallets
            for i in range(10):
                for color in (WHITE, FOCUS):
                    yield drawn(team_bits, team, i, goal, color, self._mates(state, team), shown)
            yield from (drawn(order_cards.bits, team, (order,), 0, W, False) for order in rushes)
        if party and self.words:
            yield drawn(word_bits, self._overtime)


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
    robot = max(ROBOT, round(NUMBER + wide) + ROBOT_ROOM)
    crates = robot + CRATES - ROBOT
    yield from panels.robot_bits(mates, (x + W - robot if mirrored else x + robot,))
    left, right = (x + 16, x + W - crates) if mirrored else (x + crates, x + W - 16)
    yield from order_cards.bits(team, shown, left, right, mirrored)


def call_color(key: str, team: int) -> Color:
    """Good news in the team's colour, bad news in that of an alarm."""
    return COLORS[team] if key == "one_to_go" else ALARM


def call_bits(team: int, text: str, color: Color) -> Iterator[Bit]:
    """A call that covers a team's panel."""
    yield panels.banner(text, color), (X[team] - EDGE, Y - EDGE), None
