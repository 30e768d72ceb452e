"""The chart of a day: matches per hour as bars, stacked by game."""

from collections.abc import Sequence
from itertools import cycle

from pigaming_app.scenes.kiosk.day_report import DayReport
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import fit_text

X, Y, W, H = 170, 270, 1010, 476  # px: the plot without its labels
FEWEST_HOURS = 8
COLORS: tuple[kit.Color, ...] = (kit.FOCUS, kit.ICE, (90, 120, 176), kit.ORANGE, kit.GREEN, kit.PURPLE)
OTHERS = ""
LEGEND_Y, ROW_H, GAP = 866, 52, 24  # px
ONE_ROW = 4  # names in it
Bars = tuple[tuple[int, tuple[int, ...]], ...]  # hour, and its matches by game


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
