"""HUD of a game that is played for points: panels and clock, baked into the background when their content changes.

Free-for-all: one panel per seat, two on either side of the clock. Two teams: one on each side, their totals next to the
clock and linked to their panels.
"""

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import pygame

from pigaming_app.scenes.views.background import HUD_HEIGHT, Background, Bit
from pigaming_app.scenes.views.hud import parts
from pigaming_app.scenes.views.hud.ai_sign import ai_of, driver_tab, name_of
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import number_width
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import numeral

SUM_W, CLOCK_Y = 116, 84  # px


@dataclass(frozen=True)
class SeatPanel:
    """Panel of a seat."""

    seat: int
    x: int
    w: int


@dataclass(frozen=True)
class TeamPanel:
    """Box with a team's points; `mates`: the panels linked to it."""

    team: int
    x: int
    mates: tuple[SeatPanel, ...]


def layout(robots: Any, sum_w: int = SUM_W, duels: bool = False) -> tuple[list[SeatPanel], list[TeamPanel]]:
    """Positions of the panels and of the totals of two teams, `sum_w` px wide, the lower number on the left, as they
    may have sides of the arena. Two single robots have totals only with `duels`. Empty seats have no panel.
    """
    seats = [i for i, robot in enumerate(robots) if robot.present]
    teams = sorted({robots[i].team for i in seats})
    if len(teams) == 2 == len(seats):
        seats.sort(key=lambda i: robots[i].team)
    if len(teams) != 2 or (len(seats) == 2 and not duels):
        places = parts.XS.get(len(seats), ())
        return [SeatPanel(seat, x, parts.PANEL_W) for seat, x in zip(seats, places, strict=False)], []
    slots: list[SeatPanel] = []
    sums: list[TeamPanel] = []
    for side, team in enumerate(teams):
        members = [i for i in seats if robots[i].team == team]
        w = min(parts.PANEL_W, (648 - sum_w - 12 - 8 * (len(members) - 1)) // len(members))
        total = len(members) * w + 8 * (len(members) - 1)
        first = 808 - sum_w - 12 - total if side == 0 else 1112 + sum_w + 12
        mates = tuple(SeatPanel(seat, first + i * (w + 8), w) for i, seat in enumerate(members))
        slots += mates
        sums.append(TeamPanel(team, 808 - sum_w if side == 0 else 1112, mates))
    return slots, sums


class ScoreHud:
    """Keeps the HUD up to date. `players`: driver of each seat; AIs are marked. `has_turbo`: with turbo bars.

    Subclasses may override `color`, `leads`, `extras` and `extra_bits` (more in a panel), `sum_bits` and `show_clock`.
    """

    sum_w = SUM_W  # px, width of a team's total
    duels = False  # totals for two single robots as well

    def __init__(self, background: Background, state: Any, players: list[str], has_turbo: bool = True) -> None:
        self.background, self.players, self.has_turbo = background, players, has_turbo
        self.slots, self.sums = layout(state.robots, self.sum_w, self.duels)
        self.teams = [robot.team for robot in state.robots]
        self.parts = parts.HudParts(background)
        self.points: dict[int, int] = {}
        self.clock_words = ""  # in place of the clock; | parts lines
        self.names: Sequence[str] = ()  # by seat; of entrants, or of phones

    def show(self, state: Any) -> list[SeatPanel]:
        """Bake changed parts; returns the panels whose points changed."""
        points = {slot.seat: state.robots[slot.seat].score for slot in self.slots}
        totals = {panel.team: sum(points[slot.seat] for slot in panel.mates) for panel in self.sums}
        ahead = sole_leader(totals or points)
        changed = [slot for slot in self.slots if self.points.get(slot.seat, points[slot.seat]) != points[slot.seat]]
        for slot in self.slots:
            leads = self.leads(state, slot.seat, slot.seat == ahead) and not self.sums
            turbo = round(64 * state.robots[slot.seat].turbo) if self.has_turbo else None
            content = points[slot.seat], leads, self._driver(slot.seat), turbo, self.extras(state, slot.seat)
            self.parts.show(slot, content, slot.x - 4, slot.w + 8, partial(self._panel_bits, slot, *content))
        for panel in self.sums:
            total = totals[panel.team], self.leads(state, panel.mates[0].seat, panel.team == ahead)
            self.parts.update(panel, total, partial(self._bake_sum, panel, *total))
        self.show_clock(state)
        self.points = points
        return changed

    def jobs(self) -> Iterator[Callable[[], object]]:
        """Prewarm jobs: samples of the panels and of the clock."""
        turbo = 32 if self.has_turbo else None
        for slot in self.slots:
            yield partial(parts.pulse, self.color(slot.seat), slot.w)
            for score in (*range(10), -1):
                leads = bool(score % 2) and not self.sums
                yield parts.drawn(self._panel_bits, slot, score, leads, self._driver(slot.seat), turbo, ())
        for panel in self.sums:
            yield from (parts.drawn(self.sum_bits, panel, 0, leads) for leads in (True, False))
        yield from parts.clock_jobs(CLOCK_Y)

    def color(self, seat: int) -> kit.Color:
        """The colour of a seat's panel."""
        return kit.PLAYERS[seat]

    def leads(self, state: Any, seat: int, alone: bool) -> bool:
        """True for a seat that is marked as leading; `alone`: it, or its team, has the most points alone."""
        return alone

    def extras(self, state: Any, seat: int) -> Hashable:
        """What a panel shows besides points and turbo."""
        return ()

    def extra_bits(self, extras: Any, right: int, middle: int, room: int) -> list[Bit]:
        """Pieces for these, leftwards from `right` px, centred on `middle`, within `room` px."""
        return []

    def show_clock(self, state: Any) -> None:
        """Bake the clock if it has changed."""
        if self.clock_words:
            self.parts.show(
                "clock", self.clock_words, parts.CLOCK.x, parts.CLOCK.w, partial(parts.word_bits, self.clock_words)
            )
        else:
            self.parts.countdown(state, CLOCK_Y)

    def _driver(self, seat: int) -> tuple[str, str]:
        """The AI on a seat, and the name of an entrant; either may be empty."""
        return ai_of(self.players[seat]), name_of(self.names, seat)

    def _panel_bits(
        self, slot: SeatPanel, score: int, leads: bool, driver: tuple[str, str], turbo: int | None, extras: Hashable
    ) -> list[Bit]:
        """Pieces of a panel."""
        color, x, middle = self.color(slot.seat), slot.x, parts.Y + (38 if turbo is not None else parts.H // 2)
        text = numeral(score)
        size = parts.number_size(text, slot.w - 176, kit.readable(kit.SUB), kit.SUB, kit.LABEL)
        outline = frame(slot.seat, color, slot.w, leads, *driver, turbo is not None)
        bits: list[Bit] = [(outline, (x - parts.EDGE, parts.Y - parts.EDGE), None)]
        bits += parts.number_bits(text, size, x + 84, middle, kit.mix(color, kit.WHITE, 0.8))
        if turbo is not None:
            full, empty = (parts.turbo_cells(color, slot.w - 32, 10, lit) for lit in (True, False))
            bits += parts.bar_bits(full, empty, (x + 16, parts.Y + 72), (slot.w - 32) * turbo / 64)
        room = int(slot.w - 116 - number_width(text, size))
        return bits + self.extra_bits(extras, x + slot.w, middle, room)

    def sum_bits(self, panel: TeamPanel, points: int, leads: bool) -> list[Bit]:
        """Pieces of a team's total."""
        text, second = numeral(points), panel.x > 960
        size = parts.number_size(text, SUM_W - 16, kit.readable(kit.SUB), kit.SUB, kit.LABEL)
        x, y = panel.x + (SUM_W - number_width(text, size)) / 2, parts.Y + parts.H / 2 - 4
        bits: list[Bit] = [(sum_frame(leads, second), (panel.x - parts.EDGE, parts.Y - parts.EDGE), None)]
        return bits + parts.number_bits(text, size, x, y, kit.ICE)

    def _bake_sum(self, panel: TeamPanel, points: int, leads: bool) -> None:
        box = pygame.Rect(panel.x - 4, 0, self.sum_w + 8, HUD_HEIGHT)
        self.background.bake(box, self.sum_bits(panel, points, leads))
        inner = panel.x - 12 if panel.x < 960 else panel.x + self.sum_w
        gaps = [inner, *(slot.x + slot.w for slot in panel.mates[:-1])]
        for x, w in zip(gaps, [12] + [8] * len(gaps), strict=False):
            self.background.bake(
                pygame.Rect(x + 1, parts.Y, w - 2, parts.H), [(link(), (x - parts.EDGE, parts.Y - parts.EDGE), None)]
            )


def sole_leader(points: dict[int, int]) -> int | None:
    """The sole leader, if any."""
    best = max(points.values(), default=0)
    leaders = [who for who, score in points.items() if score == best]
    return leaders[0] if len(leaders) == 1 and len(points) > 1 else None


@cached
def frame(player: int, color: kit.Color, w: int, leads: bool, brain: str, name: str, turbo: bool) -> pygame.Surface:
    """Outline and badge of a panel, with the leader's crown and who drives."""
    ink = parts.plate(w, parts.H)
    outline = kit.cut_box(0, 0, w, parts.H)
    if leads:
        ink.fill(outline, kit.dim(color, 0.14))
    ink.line(outline, color, kit.LINE if leads else kit.THIN, True)
    kit.badge(ink, player, 44, 38 if turbo else parts.H / 2, 24)
    if leads:
        ink.solid(kit.cut_box(22, -22, 44, 32, 4))
        kit.icon(ink, "crown", 44, -6, 16, color, kit.THIN)
    driver_tab(ink, brain, name, 76, -4, w - 92, color)
    return ink.lit(0.7)


@cached
def sum_frame(leads: bool, second: bool) -> pygame.Surface:
    """Box of a team's total, with its team bars: one, or two for the second team."""
    ink = parts.plate(SUM_W, parts.H)
    if leads:
        ink.fill(kit.cut_box(0, 0, SUM_W, parts.H), kit.dim(kit.ICE, 0.10))
    ink.line(kit.cut_box(0, 0, SUM_W, parts.H), kit.ICE if leads else kit.STEEL, kit.LINE if leads else kit.THIN, True)
    for a, b in ((-24, -5), (5, 24)) if second else ((-18, 18),):
        ink.line([(SUM_W / 2 + a, parts.H - 13), (SUM_W / 2 + b, parts.H - 13)], kit.ICE, kit.THIN)
    if leads:
        ink.solid(kit.cut_box(SUM_W / 2 - 22, -22, 44, 36, 4))
        kit.icon(ink, "crown", SUM_W / 2, -4, 16, kit.ICE, kit.THIN)
    return ink.lit(0.7)


@cached
def link() -> pygame.Surface:
    """Two short bars between linked panels."""
    ink = kit.GlowCanvas(12 + 2 * parts.EDGE, parts.H + 2 * parts.EDGE).set_transform(parts.EDGE, parts.EDGE)
    for y in (30, 62):
        ink.line([(-6, y), (18, y)], kit.MIST, kit.LINE)
    return ink.plain()
