"""The page between matches: the program's name, the time of day, and the best results of today."""

from collections.abc import Sequence
from functools import partial

import pygame

from pigaming_app.games.registry import games
from pigaming_app.scenes.features import board_text as text
from pigaming_app.scenes.features.board_page import BoardPart, Box
from pigaming_app.scenes.features.registry import next_line
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.results.high_scores import format_score
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.storage.day_log import now
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, MIST, STEEL, SUB
from pigaming_app.ui.draw.layers import fit_size
from pigaming_app.ui.i18n import Words

ROWS = 4
COLUMNS = 4  # games at most, those with results first
TOP, H, GAP, LEFT, W = 420, 600, 36, 60, 1800
INSET = 36  # px, from a column to its texts
FOOT: Box = (LEFT, 930, W, 110)
Best = tuple[tuple[str, str], ...]  # initials and result


class StandbyPage:
    """Always has something to show."""

    name = "standby"

    def __init__(self, context: Context) -> None:
        self.context = context

    def parts(self, scenes: Sequence[Scene]) -> Sequence[BoardPart]:
        """Name, time and a column for each game; of a running event, who is next."""
        words, clock = self.context.words, f"{now():%H:%M}"
        parts = [
            BoardPart((LEFT, 50, 1180, 220), "name", _name),
            BoardPart((1260, 50, 600, 220), clock, partial(_clock, clock)),
            BoardPart((LEFT, 290, W, 110), words("scoreboard.today"), partial(_headline, words("scoreboard.today"))),
        ]
        following = next_line(self.context, scenes)
        if following:
            parts.append(BoardPart(FOOT, following, partial(_foot, following)))
        rows, h = (ROWS - 1, H - FOOT[3]) if following else (ROWS, H)
        names = sorted(shown_games(), key=lambda game: not best_today(self.context.scores, game, words)[1])[:COLUMNS]
        w = (W - GAP * (len(names) - 1)) // len(names)
        size = min(fit_size(words(f"games.{game}"), SUB, w - 2 * INSET, "head") for game in names)
        for i, game in enumerate(names):
            content = (words(f"games.{game}"), *best_today(self.context.scores, game, words))
            best = content[2][:rows]
            column = partial(_column, words(f"games.{game}"), size, best, words("best.first"))
            parts.append(BoardPart((LEFT + i * (w + GAP), TOP, w, h), (*content, words.language), column))
        return parts


def best_today(scores: Scores, game: str, words: Words) -> tuple[str, Best]:
    """Achievement and best results of today in the game's table with the most of them; no achievement without any."""
    found = [(table, scores.best(table, days=1)) for table in scores.tables() if _countable(table, game)]
    if not any(rows for _, rows in found):
        return "", ()
    table, rows = max(found, key=lambda pair: len(pair[1]))
    return table.achievement, tuple(
        (row.initials, words.decimal(format_score(row.score, table))) for row in rows[:ROWS]
    )


def _countable(table: ScoreTable, game: str) -> bool:
    achievements = [achievement.name for achievement in games()[game].record_kinds]
    return table.game == game and table.achievement in achievements


def _name(surface: pygame.Surface) -> None:
    text.write(surface, "PiGaming", 190, 0, surface.get_height() / 2, FOCUS, "hero", "l", surface.get_width())


def _clock(clock: str, surface: pygame.Surface) -> None:
    w, h = surface.get_size()
    text.write_number(surface, clock, 150, w, h / 2, ICE, "r")


def _headline(title: str, surface: pygame.Surface) -> None:
    w, h = surface.get_size()
    text.write(surface, title, SUB, 0, h / 2 - 12, ICE, "head", "l", w)
    text.rule(surface, h - 8)


def _foot(line: str, surface: pygame.Surface) -> None:
    w, h = surface.get_size()
    text.write(surface, line, SUB, 0, h / 2 + 10, FOCUS, "head", "l", w)


def _column(game: str, size: int, rows: Best, empty: str, surface: pygame.Surface) -> None:
    """The best results of a game, all in one size; `size`: of its name."""
    w, h = surface.get_size()
    surface.blit(text.outline(w, h, STEEL), (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    text.write(surface, game, size, INSET, 74, ICE, "head")
    if not rows:
        text.write(surface, empty, LABEL, w / 2, h / 2 + 40, MIST, "head", "c", w - 2 * INSET)
        return
    row_size = min(fit_size(f"{initials}  {score}", SUB, w - 2 * INSET, "hero") for initials, score in rows)
    for i, (initials, score) in enumerate(rows):
        y, color = 196 + 104 * i, FOCUS if i == 0 else ICE
        text.write(surface, initials, row_size, INSET, y, color, "hero")
        text.write(surface, score, row_size, w - INSET, y, color, "hero", "r")
