"""The page of a running event: the call for the next match, bracket and tables by turns, and the podium at the end.

What it shows are plain values: who plays, who is next and on which pad.
"""

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import partial
from time import monotonic

import pygame

from pigaming_app.events.event import Event
from pigaming_app.events.spec import Fixture
from pigaming_app.scenes.events import bracket_view, next_view, podium_page, table_view
from pigaming_app.scenes.events.drivers import driver_label, people_of, suggested
from pigaming_app.scenes.events.names import shortened, versus
from pigaming_app.scenes.events.next_page import EventMatch, NextMatch
from pigaming_app.scenes.events.overview import BRACKET, GROUPS, TEAM_FIGURES, Overview, heads_of, overview
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.features import board_text as text
from pigaming_app.scenes.features.board_page import BoardPart, Box
from pigaming_app.scenes.flow.match_words import brain_name
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.results.awards.moment import AwardsMoment
from pigaming_app.scenes.results.podium import FIRST, Podium, Stand
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.ui.draw import ARROWS, FOCUS, ICE, LABEL, MIST, TITLE
from pigaming_app.ui.draw.frame_budget import resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Device

TURN = 10.0  # s until the next page
CALL, PODIUM = "call", "podium"  # kinds of pages, besides those of an overview
HEAD: Box = (60, 34, 1800, 150)
FOOT: Box = (60, 940, 1800, 128)
TOP, H = 196, 744  # px: of what lies between them
EDGE = 12  # px of glow round a card or a column
STILL = FIRST + math.pi / 5  # s: age of a podium that stands, its winner on the step

match_box = text.CACHE.cached(resumable(bracket_view.match_box_steps))
table_row = text.CACHE.cached(resumable(table_view.table_row_steps))
card = text.CACHE.cached(resumable(next_view.frame_steps))


@dataclass(frozen=True)
class Called:
    """An entrant on a seat. `sign` and `driver`: icon and name of who or what drives, on a card; `device`: name of the
    device in a sentence, where arrow keys are a word; `brain`: name of the AI.
    """

    seat: int
    name: str
    sign: str
    driver: str
    device: str
    brain: str


@dataclass(frozen=True)
class EventNow:
    """A running event, the match that is being played and the open ones after it, the next one first."""

    running: RunningEvent
    playing: Fixture | None
    coming: tuple[Fixture, ...]
    called: tuple[Called, ...]  # of the first of `coming`


def event_match(scene: Scene | object) -> EventMatch | None:
    """The match of an event that a scene plays."""
    after = getattr(scene, "after", None)
    return after if isinstance(after, EventMatch) else None


def event_now(context: Context, scenes: Sequence[Scene]) -> EventNow | None:
    """The event on the stack, if any: a page of it, a match of it, or the moments after one."""
    for scene in reversed(scenes):
        page = scene
        while isinstance(page, WinnersMoment | AwardsMoment):
            page = page.then
        match = event_match(page)
        running = match.running if match else getattr(page, "running", None)
        if isinstance(running, RunningEvent):
            fixture = match.fixture if match and match.fixture.number not in running.event.outcomes else None
            coming = tuple(one for one in running.queue if one != fixture)
            claims = page.seats.claims if isinstance(page, NextMatch) else {}
            seats = called(context, running, coming[0], claims) if coming else ()
            return EventNow(running, fixture, coming, seats)
    return None


def called(context: Context, running: RunningEvent, fixture: Fixture, claims: dict[int, Device]) -> tuple[Called, ...]:
    """Who plays a match, and on which device; `claims`: the seats that are taken."""
    words, seats = context.words, people_of(running, fixture)
    free = {seat: fixture.entrants[seat] for seat in seats if seat not in claims}
    devices = suggested(context.controls, free, claims.values()) | claims
    found = []
    for seat, name in enumerate(fixture.entrants):
        brain = running.brain(name)
        device = None if brain else devices.get(seat)
        sign, driver = driver_label(words, context.controls, device, brain)
        device_name = words("match.arrows") if driver and driver[0] in ARROWS else driver
        robot = brain_name(words, fixture.game, brain) if brain else ""
        found.append(Called(seat, name, sign, driver, device_name, robot))
    return tuple(found)


def next_line(words: Words, now: EventNow) -> str:
    """The next match in one line: names with their devices; empty if there is none."""
    names = [f"{shortened(one.name)} ({one.device})" if one.device else shortened(one.name) for one in now.called]
    return words("scoreboard.next", names="  –  ".join(names)) if names else ""


def now_line(words: Words, now: EventNow) -> str:
    """The match that is being played in one line; empty if there is none."""
    return words("scoreboard.now", names=versus(now.playing.entrants)) if now.playing else ""


class EventBoardPage:
    """Shows the event on the stack. `clock`: time, s, by which its pages turn."""

    name = "event"

    def __init__(self, context: Context, clock: Callable[[], float] = monotonic) -> None:
        self.context, self.clock = context, clock
        self._of: tuple[Event, int | None, str] | None = None  # of `_overview`: event, match, language
        self._overview: Overview | None = None
        self._since = 0.0

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart] | None:
        """Head and foot, and one of the pages between them; None without an event."""
        now = event_now(self.context, scenes)
        if now is None:
            self._of = self._overview = None
            return None
        shown = self._read(now)
        pages = self._pages(now, shown)
        kind, number = pages[int((self.clock() - self._since) / TURN) % len(pages)]
        words, event = self.context.words, now.running.event
        call = "events.sudden_death" if now.coming and now.coming[0].extra else "events.next"
        title = words(call) if kind == CALL else event.spec.title
        right = words("events.over") if event.over else progress_line(words, event)
        parts = [BoardPart(HEAD, (title, right), partial(_head, title, right)), self._foot(now, kind)]
        if kind == CALL:
            parts += [_card(one, len(now.called)) for one in now.called]
        elif kind == PODIUM:
            parts.append(_podium(now))
        elif kind == BRACKET:
            parts += _bracket(shown, number)
        elif kind == GROUPS:
            parts.append(_groups(shown, number))
        else:
            parts += _table(shown, kind, number)
        return parts

    def _read(self, now: EventNow) -> Overview:
        """The overview of the event, derived again when it has changed."""
        event, playing = now.running.event, now.playing.number if now.playing else None
        of = (event, playing, self.context.words.language)
        if self._overview is None or self._of is None or self._of[0] is not event or self._of[1:] != of[1:]:
            self._overview, self._of = overview(self.context.words, event, playing), of
            self._since = self.clock()
        return self._overview

    def _pages(self, now: EventNow, shown: Overview) -> list[tuple[str, int]]:
        """The pages by turns: the call or the podium, then bracket and tables, beginning with the next match."""
        first = [(CALL, 0)] if now.called else [(PODIUM, 0)] if now.running.event.over else []
        return [*first, *shown.pages[shown.first :], *shown.pages[: shown.first]]

    def _foot(self, now: EventNow, kind: str) -> BoardPart:
        words = self.context.words
        lines = [line for line in (now_line(words, now), "" if kind == CALL else next_line(words, now)) if line]
        if kind == CALL and len(now.coming) > 1:
            names = [versus(fixture.entrants) for fixture in now.coming[1:4]]
            lines.append(next_view.following(lambda those: words("events.then", names=those), names, FOOT[2] - 72))
        content = (*lines, now.playing is not None)
        return BoardPart(FOOT, content, partial(_foot, tuple(lines), now.playing is not None))


def _head(title: str, right: str, surface: pygame.Surface) -> None:
    h = surface.get_height()
    wide = text.write(surface, title, TITLE, LEFT - HEAD[0], 72, ICE, "head", "l", 1000)
    room = RIGHT - LEFT - wide - 60
    text.write(surface, right, LABEL, RIGHT - HEAD[0], 72, MIST, "head", "r", room)
    text.rule(surface.subsurface((LEFT - HEAD[0], 0, RIGHT - LEFT, h)), h - 10)


def _foot(lines: Sequence[str], playing: bool, surface: pygame.Surface) -> None:
    """One or two lines; the match that is being played is brighter."""
    for i, line in enumerate(lines):
        y = surface.get_height() / 2 + 58 * (i - (len(lines) - 1) / 2)
        color = FOCUS if i == 0 and (playing or len(lines) == 1) else ICE
        text.write(surface, line, LABEL, LEFT - FOOT[0], y, color, "head", "l", RIGHT - LEFT)


def _card(one: Called, count: int) -> BoardPart:
    place = next_view.card_rect(one.seat, count).inflate(2 * EDGE, 2 * EDGE)
    return BoardPart((place.x, place.y, place.w, place.h), one, partial(_paint_card, one))


def _paint_card(one: Called, surface: pygame.Surface) -> None:
    state = next_view.AI if one.brain else next_view.TAKEN
    card(one.seat, one.name, one.sign, one.driver, state).draw(surface, EDGE, EDGE)
    next_view.draw_robot(surface, one.seat, EDGE, EDGE, 0.0, False)
    if one.brain or one.device:
        next_view.note_bar(one.brain or one.device).draw(surface, EDGE, EDGE)


def _podium(now: EventNow) -> BoardPart:
    best, rest = podium_page.podium_rows(now.running), podium_page.places_below(now.running)
    box = (60, TOP, 1800, H)
    robots = podium_page.robots_of(now.running)
    content = (*((row.place, row.entrant) for row in (*best, *rest)), robots)

    def paint(surface: pygame.Surface) -> None:
        dx, dy, middle = -box[0], -box[1], podium_page.centre(rest)
        steps = [Stand(row.place, (i,)) for i, row in enumerate(best)]
        Podium(dx + middle, dy + podium_page.FOOT, steps).draw(surface, STILL)
        podium_page.draw_names(surface, middle, best, rest, range(len(best)), robots, dx, dy)

    return BoardPart(box, content, paint)


def _bracket(shown: Overview, number: int) -> list[BoardPart]:
    """A part for each column; all are drawn in each of them, as the lines between whole rounds cross its border."""
    page, heads = shown.bracket[number], shown.stages(number)
    pitch = bracket_view.W + bracket_view.GAP
    parts = []
    for i, column in enumerate(page):
        x = LEFT + i * pitch - bracket_view.GAP // 2
        joined = [other for other in page[max(0, i - 1) : i + 2] if other.whole and column.whole]
        content: Hashable = (column, heads[i], *joined)

        def paint(surface: pygame.Surface, x: int = x) -> None:
            bracket_view.draw_bracket(surface, page, heads, -x, -TOP, match_box)

        parts.append(BoardPart((x, TOP, pitch, H), content, paint))
    return parts


def _groups(shown: Overview, number: int) -> BoardPart:
    heads = heads_of(shown.words, TEAM_FIGURES)

    def paint(surface: pygame.Surface) -> None:
        table_view.draw_groups(surface, shown.groups, heads, number, -LEFT + EDGE, -TOP, table_row)

    return BoardPart((LEFT - EDGE, TOP, RIGHT - LEFT + 2 * EDGE, H), (shown.groups, heads, number), paint)


def _table(shown: Overview, kind: str, number: int) -> list[BoardPart]:
    """A part for each column of a table."""
    rows, heads = shown.table(kind)
    grid = table_view.grid_of(len(rows))
    page = rows[number * grid.size : (number + 1) * grid.size]
    pitch = (RIGHT - LEFT + table_view.GAP) // grid.columns
    parts = []
    for i in range(-(-len(page) // grid.rows)):
        x = LEFT + i * pitch - EDGE

        def paint(surface: pygame.Surface, x: int = x) -> None:
            table_view.draw_table(surface, rows, heads, number, math.inf, -x, -TOP, table_row)

        content: Hashable = (page[i * grid.rows : (i + 1) * grid.rows], heads, grid)
        parts.append(BoardPart((x, TOP, pitch, H), content, paint))
    return parts
