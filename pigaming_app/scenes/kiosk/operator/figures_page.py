"""The figures of a day: a chart of the matches per hour, and numbers beside it. They can be exported as CSV."""

import logging
from collections.abc import Sequence
from datetime import date
from itertools import cycle

import pygame

from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.scene import Context, StackOperation
from pigaming_app.scenes.kiosk.day_report import DayReport, report_of, to_csv
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.storage.day_log import days, now
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import folders
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw import ALARM, BODY, ICE, LABEL, MIST, Color
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import RIGHT, Layer, LitImage, fit_text, span, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.arrows import as_direction, draw_arrows
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, frame

FOLDER = "reports"  # of exports, in the data folder
PANEL = pygame.Rect(span(8, 4)[0], 210, span(8, 4)[1], 700)
PITCH = 66  # px from line to line
log = logging.getLogger("pigaming")
X, Y, W, H = 170, 270, 1010, 476  # px: the plot without its labels
FEWEST_HOURS = 8
COLORS: tuple[kit.Color, ...] = (kit.FOCUS, kit.ICE, (90, 120, 176), kit.ORANGE, kit.GREEN, kit.PURPLE)
OTHERS = ""
LEGEND_Y, ROW_H, GAP = 866, 52, 24  # px
ONE_ROW = 4  # names in it
Bars = tuple[tuple[int, tuple[int, ...]], ...]  # hour, and its matches by game


class FiguresPage(Page):
    """Today first; left and right show other days."""

    untimed = True
    title, stay = "operator.figures", 5.0
    hints = (
        (Button.RIGHT, "operator.hint_day"),
        (Button.FIRE, "operator.hint_export"),
        (Button.BACK, "options.hint_back"),
    )

    def __init__(self, context: Context) -> None:
        super().__init__(context, Focus([FocusSpot("export", PANEL)]))
        self.data = folders().data
        today = now().date()
        self.days = sorted({*days(self.data), today})
        self.trouble = False  # the log cannot be read
        self.report = DayReport(today)
        self._show(today)

    def press(self, event: InputEvent) -> StackOperation:
        """Left and right change the day, FIRE exports it."""
        event = as_direction(event, self.arrows)
        if event.button in (Button.LEFT, Button.RIGHT):
            at = self.days.index(self.report.day) + (1 if event.button is Button.RIGHT else -1)
            if 0 <= at < len(self.days):
                self.context.sounds.play("move")
                self._show(self.days[at])
        elif event.button in (Button.FIRE, Button.START):
            self._export()
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the day, its chart and its numbers."""
        words, report = self.context.words, self.report
        text(words.day(report.day), LABEL, ICE, "head", "r").draw(screen, RIGHT - 80, 112)
        draw_arrows(screen, self.arrows)
        black_out(screen, PANEL)
        frame(*PANEL.size).draw(screen, *PANEL.topleft)
        names = games_of(report, shown_games())
        chart(bars_of(report, names), tuple(_short(words, game) for game in names)).draw(screen)
        if not report.matches:
            text(words("operator.no_matches"), LABEL, MIST, "head", "c", 900).draw(screen, 675, 520)
        for i, (name, value, color) in enumerate(lines(words, report, self.trouble)):
            y = PANEL.y + 53 + PITCH * i
            text(name, BODY, MIST, "body", "l", 360).draw(screen, PANEL.x + 36, y)
            text(value, LABEL, color, "head", "r", 230).draw(screen, PANEL.right - 36, y)

    @property
    def arrows(self) -> dict[Button, tuple[int, int]]:
        """The arrows beside the date, where there are other days."""
        at = self.days.index(self.report.day)
        left = {Button.LEFT: (RIGHT - 410, 112)} if at > 0 else {}
        return {**left, **({Button.RIGHT: (RIGHT - 20, 112)} if at < len(self.days) - 1 else {})}

    def _show(self, day: date) -> None:
        try:
            self.report, self.trouble = report_of(self.data, day), False
        except OSError as error:
            log.warning("The day log cannot be read: %s.", describe_error(error))
            self.report, self.trouble = DayReport(day), True

    def _export(self) -> None:
        """Write the matches of the day as CSV."""
        path = self.data / FOLDER / f"pigaming-{self.report.day}.csv"
        if self.save(lambda: write_atomic(path, to_csv(self.report).encode())):
            self.context.sounds.play("accept")
            self.show_message(self.context.words("operator.exported", file=f"{FOLDER}/{path.name}"))


def _short(words: Words, game: str) -> str:
    """The short name of a game, also of one that was removed since, or of all others."""
    if game == OTHERS:
        return words("operator.others")
    key = f"events.short_{game}"
    return words(key) if key in words else game_title(words, game)


def lines(words: Words, report: DayReport, trouble: bool) -> list[tuple[str, str, Color]]:
    """Name, value and colour of the numbers."""
    minutes, seconds = divmod(round(report.mean_seconds), 60)
    busiest = "–" if report.busiest_hour is None else f"{report.busiest_hour}:00"
    crashes = report.crashes + report.failures
    batteries = [(robot, figures.last) for robot, figures in report.batteries.items()]
    out = [
        ("matches", str(len(report.matches)), ICE),
        ("left", str(report.left), ICE),
        ("people", str(report.people), ICE),
        ("mean", f"{minutes}:{seconds:02}" if report.matches else "–", ICE),
        ("busiest", busiest, ICE),
        ("crashes", "?" if trouble else str(crashes), ALARM if crashes or trouble else ICE),
    ]
    named = [(words(f"operator.{name}"), value, color) for name, value, color in out]
    volts = [
        (words("operator.battery", robot=robot), words("fleet.volts", volts=f"{v:.1f}"), ICE) for robot, v in batteries
    ]
    return [*named, *volts]


def games_of(report: DayReport, shown: Sequence[str]) -> tuple[str, ...]:
    """The games of the bars, at most one for each colour; OTHERS, as the last one, stands for those played least.

    `shown`: the games of the title; the day may have others, which were removed since.
    """
    played = report.games
    every = [*shown, *(game for game in played if game not in shown)]
    if len(every) <= len(COLORS):
        return tuple(every)
    most = sorted(every, key=lambda game: -played.get(game, 0))[: len(COLORS) - 1]
    return (*(game for game in every if game in most), OTHERS)


def bars_of(report: DayReport, games: Sequence[str]) -> Bars:
    """Bars of at least FEWEST_HOURS successive hours round those with matches; other games count as the last one."""
    hours, names = report.hours, list(games)
    first, last = (min(hours), max(hours)) if hours else (9, 16)
    while last - first + 1 < FEWEST_HOURS:
        if first > 0 and (last == 23 or (last - first) % 2):
            first -= 1
        else:
            last += 1
    out = []
    for hour in range(first, last + 1):
        counts = [0] * len(names)
        for game, count in hours.get(hour, {}).items():
            counts[names.index(game) if game in names else -1] += count
        out.append((hour, tuple(counts)))
    return tuple(out)


def step_of(most: int) -> int:
    """The step between lines of the chart, so that there are at most five."""
    step, factors = 1, cycle((2, 2.5, 2))
    while step * 5 < most:
        step = round(step * next(factors))
    return step


@cached
@resumable
def chart(bars: Bars, names: tuple[str, ...]) -> Steps[LitImage]:
    """The bars with their axes and the names of the games."""
    layer = Layer(96, 200, 1130, 720)
    most = max(1, *(sum(counts) for _, counts in bars))
    step = step_of(most)
    top = step * -(-most // step)
    for value in range(0, top + 1, step):
        y = Y + H - H * value / top
        layer.glow.line([(X, y), (X + W, y)], kit.dim(kit.STEEL, 1.0 if value == 0 else 0.6), kit.HAIR)
        layer.canvas.body(str(value), X - 24, y, kit.MIST, "r", 36)
    yield
    pitch = W / len(bars)
    for i, (hour, counts) in enumerate(bars):
        x, below = X + pitch * i, 0
        for game, count in enumerate(counts):
            if count:
                high = H * count / top
                box = kit.cut_box(
                    x + 0.16 * pitch, Y + H - H * below / top - high + 2, 0.68 * pitch, max(4, high - 4), 3
                )
                layer.glow.fill(box, COLORS[game])
                below += count
        if len(bars) <= 12 or i % 2 == 0:
            layer.canvas.body(str(hour), x + pitch / 2, Y + H + 36, kit.MIST, "c", 36)
        yield
    rows = [names[:3], names[3:]] if len(names) > ONE_ROW else [names]
    room = W // max(map(len, rows)) - GAP
    labels = [fit_text(name, kit.BODY, room - 48, "body") for name in names]
    size = min(size for _, size in labels)
    for game, (name, _) in enumerate(labels):
        row, column = divmod(game, len(rows[0]))
        x, y = X + column * (room + GAP), LEGEND_Y + round(ROW_H * (row - (len(rows) - 1) / 2))
        layer.glow.fill(kit.cut_box(x, y - 16, 32, 32, 6), COLORS[game])
        layer.canvas.body(name, x + 48, y, kit.ICE, "l", size)
    yield
    return (yield from layer.render_steps())
