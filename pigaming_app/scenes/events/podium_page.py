"""The end of an event: the robots of the first three on the podium, with their names, and confetti."""

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.events.spec import Standing
from pigaming_app.scenes.events.paper.certificates import print_certificates
from pigaming_app.scenes.events.paper.sheet import PrintJob, can_pdf
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.table_page import TablePage
from pigaming_app.scenes.flow.scene import Context, Pop, Push, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.scenes.results.celebration import SIZES, TUMBLES, Celebration, confetti
from pigaming_app.scenes.results.podium import APART, FIRST, HEIGHTS, ORDER, REVEALS, RISE, STEP_W, Podium, Stand
from pigaming_app.ui.draw import BODY, FOCUS, ICE, MIST, PLAYERS, SUB, THIN, TITLE, GlowCanvas, icon, text_width
from pigaming_app.ui.draw.frame_budget import PrewarmQueue, run_to_end
from pigaming_app.ui.draw.layers import RIGHT, LitImage, backdrop, fit_text, text, word, wrap
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import heading

VOLLEYS = (FIRST + 0.2, FIRST + 1.3, FIRST + 2.6, FIRST + 4.4)  # s, of confetti
FOOT, NAME_Y = 800, 872  # px: foot of the podium, middle of the names
REST, REST_X, REST_Y, REST_PITCH = 6, 1330, 290, 104  # places beside the podium; px
FEWEST_BESIDE = 3
LINE_H = 46  # px, of a name in two lines
NAME_ROOM = STEP_W + APART - 20  # px
SIGN_W = 72  # px, for the sign of an AI before its name


class EventPodiumPage(Page):
    """The podium of an event that is over."""

    idle, lockout = math.inf, 1.5
    stay = 6.0

    def __init__(self, context: Context, running: RunningEvent) -> None:
        super().__init__(context)
        self.running = running
        self.best = podium_rows(running)
        steps = [Stand(row.place, (i,)) for i, row in enumerate(self.best)]
        self.rest, self.robots = places_below(running), robots_of(running)
        self.podium = Podium(centre(self.rest), FOOT, steps)
        seats = list(range(len(self.best)))
        self.celebration = Celebration("pitanks", seats, [PLAYERS[seat] for seat in seats])
        self.volleys = [*VOLLEYS]
        self.sounds = [*self.podium.sounds(), (FIRST, "fanfare", None)]
        self.queue = PrewarmQueue(self._jobs())
        self.printing: PrintJob | None = None

    @property
    def hints(self) -> Hints:
        """Certificates need Pillow."""
        paper = [(Button.Y, "events.hint_certificates")] if can_pdf() else []
        return [(Button.FIRE, "events.hint_table"), *paper, (Button.BACK, "events.hint_back")]

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        self.context.sounds.music("title")

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE shows the whole table, Y prints the certificates into a file."""
        if event.button in (Button.FIRE, Button.START, Button.UP):
            self.context.sounds.play("accept")
            return Push(TablePage(self.context, self.running))
        if event.button is Button.Y and self.printing is None and can_pdf():
            self.context.sounds.play("accept")
            self.printing = print_certificates(self.running.event, self.running.path, self.context.words)
        return None

    def advance(self, seconds: float) -> StackOperation:
        """Reveal the steps, then shoot confetti. A correction may have opened a match again."""
        if not self.running.event.over:
            return Pop()
        self.queue.work(2.0)
        if self.printing and self.printing.work():
            self._printed(self.printing)
            self.printing = None
        self.celebration.update(seconds)
        while self.sounds and self.sounds[0][0] <= self.age:
            _, name, player = self.sounds.pop(0)
            self.context.sounds.play(name, player)
        while self.volleys and self.volleys[0] <= self.age:
            self.volleys.pop(0)
            self.celebration.volley()
        return None

    @property
    def heading(self) -> LitImage:
        return heading(self.running.event.spec.title, self.context.words("events.over"), FOCUS)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the podium, the names and the confetti."""
        self.celebration.draw(screen)
        self.podium.draw(screen, self.age)
        shown = {i for i in range(len(self.best)) if self.age >= REVEALS[i] + RISE}
        rest = self.rest if self.age >= FIRST + RISE else []
        draw_names(screen, self.podium.x, self.best, rest, shown, self.robots)

    @property
    def message(self) -> str:
        return self.context.words("events.printing") if self.printing else super().message

    def _printed(self, job: PrintJob) -> None:
        words = self.context.words
        self.show_message(words("events.poster", name=job.name) if job.saved else words("app.unsaved"), not job.saved)
        self.context.sounds.play("ready" if job.saved else "error")

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the prompts once they count."""
        if self.age >= self.lockout:
            super().draw_foot(screen)

    def _jobs(self) -> Iterator[Callable[[], object]]:
        yield backdrop
        yield lambda: run_to_end(self.podium.prewarm())
        for color in dict.fromkeys(self.celebration.colors):
            for shape in self.celebration.players:
                for size in SIZES:
                    for tumble in range(TUMBLES):
                        yield partial(confetti, "pitanks", shape, color, size, tumble)


def centre(rest: Sequence[Standing]) -> int:
    """x of the podium, px: further left with places beside it."""
    return 600 if rest else 960


def draw_names(
    screen: pygame.Surface,
    middle: float,
    best: Sequence[Standing],
    rest: Sequence[Standing],
    shown: Collection[int],
    robots: Collection[str],
    dx: int = 0,
    dy: int = 0,
) -> None:
    """Draw the names below the steps `shown`, by index, of a podium at x = `middle`, and the places beside it, all
    moved by (dx, dy) px. `robots`: the names that get the sign of an AI.
    """
    for i, row in enumerate(best):
        if i in shown:
            sign = SIGN_W if row.entrant in robots else 0
            lines, size = name_lines(row.entrant, TITLE if i == 0 else SUB, NAME_ROOM - sign)
            x = dx + middle + (STEP_W + APART) * (ORDER.index(i) - 1)
            for k, line in enumerate(lines):
                y = dy + NAME_Y + LINE_H * (k - (len(lines) - 1) / 2)
                word(line, size, FOCUS if i == 0 else ICE).draw(screen, x + sign / 2, y)
            if sign:
                robot_sign().draw(screen, x - max(text_width(line, size, "hero") for line in lines) / 2, dy + NAME_Y)
    for i, row in enumerate(rest):
        x, y = dx + REST_X + 40, dy + REST_Y + REST_PITCH * i
        text(str(row.place), SUB, MIST, "head", "r").draw(screen, dx + REST_X, y)
        if row.entrant in robots:
            robot_sign().draw(screen, x + SIGN_W / 2 - 8, y)
            x += SIGN_W
        name, size = fit_text(row.entrant, SUB, round(dx + RIGHT - x), "hero", BODY)
        text(name, size, ICE, "hero", "l").draw(screen, x, y)


def name_lines(name: str, size: int, room: float) -> tuple[list[str], int]:
    """A name in one line of `size` px or less, a long one in two at BODY size, and the size."""
    line, fitting = fit_text(name, size, room, "hero", BODY)
    if line == name:
        return [name], fitting
    first, *rest = wrap(name, BODY, room, "hero")
    return [fit_text(part, BODY, room, "hero", BODY)[0] for part in (first, " ".join(rest)) if part], BODY


@cached
def robot_sign() -> LitImage:
    """The sign of an AI, centred on (0, 0)."""
    return LitImage(icon(GlowCanvas(96, 96), "ai", 48, 48, 28, MIST, THIN).lit(0.5), (-48, -48))


def robots_of(running: RunningEvent) -> frozenset[str]:
    """The entrants that are AIs."""
    names = (entrant.name for entrant in running.event.entrants)
    return frozenset(name for name in names if running.brain(name) and not running.is_person(name))


def podium_rows(running: RunningEvent) -> list[Standing]:
    """The first three of the table; of teams, if there are any."""
    event = running.event
    return list((event.team_standings or event.standings)[: len(HEIGHTS)])


def places_below(running: RunningEvent) -> list[Standing]:
    """The next of the table after those on the podium, unless they are only one or two."""
    event = running.event
    rows = (event.team_standings or event.standings)[len(HEIGHTS) :][:REST]
    return list(rows) if len(rows) >= FEWEST_BESIDE else []
