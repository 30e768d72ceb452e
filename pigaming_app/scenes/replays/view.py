"""Rows of the list of replays: game and arena, time, players with their points, a crown for the winners."""

from dataclasses import dataclass
from pathlib import Path

import pygame

from pigaming_app.games.arenas import parse
from pigaming_app.games.replay import Replay
from pigaming_app.scenes.recordings import store
from pigaming_app.scenes.views.hud.ai_sign import level_mark
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words, numeral

ROWS = 7
TOP, HIGH, PITCH = 212, 88, 104  # px
CROSS = 72  # px, width of the box that deletes
W = RIGHT - LEFT
GAME, ARENA, TIME, PLAYERS_X, SLOT = 32, 372, 712, 956, 172  # px from a row's left edge; px, width of a player
ROOM = 316  # px for the game and for the arena


@dataclass
class ReplayEntry:
    """One file of the list. `replay` is None while it is unread, and if it is damaged."""

    path: Path
    read: bool = False
    replay: Replay | None = None
    arena: str = ""

    def load(self, language: str) -> None:
        """Read the file."""
        self.read, self.replay = True, store.load(self.path)
        if self.replay:
            setup = self.replay.setup
            title = parse(setup.game, self.replay.source, setup.arena).title
            self.arena = title.get(language, Path(setup.arena).stem)


def row_box(i: int) -> pygame.Rect:
    """Rectangle of the i-th row of a page."""
    return pygame.Rect(LEFT, TOP + PITCH * i, W, HIGH)


def cross_box(i: int) -> pygame.Rect:
    """Rectangle of the cross in the i-th row."""
    return pygame.Rect(RIGHT - CROSS - 8, TOP + PITCH * i + (HIGH - CROSS) // 2, CROSS, CROSS)


def row(words: Words, entry: ReplayEntry, hot: bool) -> list[LitImage]:
    """The parts of the row of a file that has been read, top left at (0, 0)."""
    replay = entry.replay
    if replay is None:
        return [damaged(words("replays.damaged", name=entry.path.name))]
    seats = tuple(
        (seat, other.brain, replay.scores[seat], seat in replay.winners)
        for seat, other in enumerate(replay.setup.seats)
        if other.brain != "off"
    )
    when = words.moment(store.saved_at(entry.path))
    return [whole(entry.arena, when, seats), game_name(words(f"games.{replay.setup.game}"), hot)]


@cached
def game_name(game: str, hot: bool) -> LitImage:
    """Name of the game in a row; `hot`: the row is focused."""
    layer = Layer(GAME, 0, ROOM, HIGH)
    layer.canvas.text(game, fit_size(game, kit.LABEL, ROOM), GAME, HIGH / 2, kit.FOCUS if hot else kit.ICE, "head")
    return layer.render()


@cached
@resumable
def whole(arena: str, when: str, seats: tuple[tuple[int, str, int | None, bool], ...]) -> Steps[LitImage]:
    """A valid replay without its game; `seats`: seat, driver, points if known, whether it won."""
    layer, y = _frame(), HIGH / 2
    layer.canvas.body(arena, ARENA, y, kit.MIST, "l", fit_size(arena, kit.BODY, ROOM, "body"))
    layer.canvas.body(when, TIME, y, kit.MIST, "l", fit_size(when, kit.BODY, PLAYERS_X - TIME - 24, "body"))
    for i, (seat, brain, score, won) in enumerate(seats):
        x = PLAYERS_X + SLOT * i
        kit.badge(layer.glow, seat, x + 28, y + 4, 24)
        if text := level_mark(brain):
            layer.canvas.crisp.text(text, 28, x + 75, y + 22, kit.MIST, "head", "c")
        else:
            kit.icon(layer.glow, "pad" if brain == "human" else "ai", x + 76, y + 20, 13, kit.MIST, 3)
        if won:
            kit.icon(layer.glow, "crown", x + 76, y - 18, 15, kit.FOCUS, 3)
        if score is not None:
            said = numeral(score)
            size = fit_size(said, kit.LABEL, SLOT - 104, "hero")
            layer.canvas.text(said, size, x + 100, y + 4, kit.mix(kit.PLAYERS[seat], kit.WHITE, 0.3), "hero")
        yield
    return (yield from layer.render_steps())


@cached
@resumable
def damaged(line: str) -> Steps[LitImage]:
    """Row of a file that cannot be played."""
    layer = _frame()
    kit.icon(layer.glow, "cross", GAME + 20, HIGH / 2, 18, kit.ALARM, kit.THIN)
    room = W - GAME - 64 - CROSS - 40
    line, size = fit_text(line, kit.BODY, room, "body")
    layer.canvas.body(line, GAME + 64, HIGH / 2, kit.MIST, "l", size)
    yield
    return (yield from layer.render_steps())


@cached
@resumable
def question(sentence: str, label: str) -> Steps[LitImage]:
    """Row that asks for the second press; `sentence` contains {button}."""
    layer, y = _frame(), HIGH / 2
    before, _, after = sentence.partition("{button}")
    x = float(GAME)
    layer.canvas.text(before.strip(), kit.LABEL, x, y, kit.FOCUS, "head")
    x += kit.text_width(before.strip(), kit.LABEL) + 20
    kit.button(layer.canvas, x, y, label, kit.FOCUS)
    layer.canvas.text(after.strip(), kit.LABEL, x + kit.button_width(label) + 20, y, kit.FOCUS, "head")
    yield
    return (yield from layer.render_steps())


@cached
def cross(lit: bool) -> LitImage:
    """The cross that deletes; top left at (0, 0)."""
    layer = Layer(0, 0, CROSS, CROSS)
    kit.icon(layer.glow, "cross", CROSS / 2, CROSS / 2, 16, kit.FOCUS if lit else kit.STEEL, kit.THIN)
    return layer.render()


def _frame() -> Layer:
    layer = Layer(0, 0, W, HIGH)
    layer.glow.line(kit.cut_box(0, 0, W, HIGH, 16), kit.STEEL, kit.THIN, True)
    return layer
