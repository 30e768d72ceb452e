"""The next match: a card for each seat, what is played, and who follows. Top left of a card at (0, 0)."""

import math
from collections.abc import Callable, Sequence

import pygame

from pigaming_app.events.spec import Fixture
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.events.names import versus
from pigaming_app.scenes.events.running import RunningEvent, progress_line
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.flow.match_words import game_title, match_length, sudden_death_key
from pigaming_app.scenes.lobby import seat_card
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.frame_budget import Steps, resumable
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, fit_text, text
from pigaming_app.ui.draw.sprites import HEADINGS, step
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.widgets.labels import blit_sprite
from pigaming_app.ui.widgets.player_card import BAR, BAR_Y, MIDDLE, H, W

TOP, PITCH = 200, W + 24  # px
NAME_Y, ROBOT_Y, SCALE, TABLE_R = 176, 350, 1.35, 92  # px; robot scale
TAKEN, WANTED, AI = "taken", "wanted", "ai"  # states of a seat
MESSAGE_Y, THEN_Y, PROMPTS_Y = 846, 906, 988  # px


def card_rect(index: int, count: int) -> pygame.Rect:
    """The rectangle of one of `count` cards, centred on the page."""
    return pygame.Rect(960 - (PITCH * count - 24) // 2 + PITCH * index, TOP, W, H)


def frame_steps(seat: int, name: str, sign: str, driver: str, state: str) -> Steps[LitImage]:
    """A card with its seat, the name of the entrant, and icon and name of their device; keys with arrows are drawn."""
    layer, color = Layer(0, 0, W, H), kit.PLAYERS[seat]
    if state == WANTED:
        layer.glow.dashes(kit.cut_box(0, 0, W, H, 20), kit.dim(color, 0.8), kit.THIN, 22, 16)
    else:
        kit.panel(layer.glow, 0, 0, W, H, color, kit.LINE if state == TAKEN else kit.THIN)
    kit.badge(layer.glow, seat, 68, 70, 34)
    kit.icon(layer.glow, sign, 144, 70, 30, kit.MIST, 4)
    if driver and all(mark in kit.ARROWS for mark in driver):
        for i, mark in enumerate(driver):
            kit.icon(layer.glow, kit.ARROWS[mark], 210 + 44 * i, 70, 15, kit.MIST, 5)
    else:
        layer.canvas.body(driver, 188, 70, kit.MIST, "l", fit_size(driver, kit.BODY, W - 206, "body"))
    name, size = fit_text(name, kit.TITLE, W - 56, "hero", kit.LABEL)
    layer.canvas.text(name, size, MIDDLE, NAME_Y, kit.ICE, "hero", "c")
    yield
    return (yield from layer.render_steps())


frame = cached(resumable(frame_steps))


@cached
@resumable
def note_bar(sentence: str) -> Steps[LitImage]:
    """The bar of an AI: its stars, or its name; or that of a device."""
    layer = Layer(*BAR)
    layer.canvas.text(sentence, fit_size(sentence, kit.LABEL, W - 72), MIDDLE, BAR_Y, kit.ICE, "head", "c")
    yield
    return (yield from layer.render_steps())


def draw_robot(screen: pygame.Surface, seat: int, x: int, y: int, clock: float, taken: bool) -> None:
    """Draw the robot of a seat on its turntable, on a card at (x, y); it hops once the seat is taken."""
    turn = int(clock * (14 if taken else 3)) % seat_card.TURNS
    seat_card.turntable(seat, turn, taken, TABLE_R).draw(screen, round(x + MIDDLE), y + ROBOT_Y)
    hop = 8 * abs(math.sin(clock * 7 + seat)) if taken else 0.0
    sprite = seat_card.robot(seat, step(seat_card.UP, HEADINGS), SCALE)
    blit_sprite(screen, sprite, x + MIDDLE, y + ROBOT_Y - hop)


def match_line(words: Words, fixture: Fixture, setup: Setup | None) -> str:
    """Game, length and arena in one line, or how an extra match ends; the game alone if it cannot be played."""
    if setup is None:
        return game_title(words, fixture.game)
    if fixture.extra:
        return "  ·  ".join((words(f"games.{setup.game}"), words(sudden_death_key(setup.game))))
    arena = arena_title(load_cached(setup.game, setup.arena), words.language)
    length = match_length(words, games()[setup.game], setup.minutes, setup.goal)
    return "  ·  ".join((words(f"games.{setup.game}"), length, arena))


def draw_following(screen: pygame.Surface, words: Words, running: RunningEvent) -> None:
    """Draw who plays after the next match, or that this arcade is cut off, and how far the event is."""
    line = progress_line(words, running.event)
    text(line, kit.BODY, kit.MIST, "body", "r").draw(screen, RIGHT, THEN_Y)
    room = RIGHT - LEFT - 48 - kit.text_width(line, kit.BODY, "body")
    sentence, color = words("events.alone") if running.alone else "", kit.FOCUS
    if not sentence and (then := [versus(other.entrants) for other in running.queue[1:4]]):
        sentence, color = following(lambda names: words("events.then", names=names), then, room), kit.MIST
    sentence, size = fit_text(sentence, kit.LABEL, room)
    text(sentence, size, color, "head", "l").draw(screen, LEFT, THEN_Y)


def following(sentence: Callable[[str], str], matches: Sequence[str], room: float) -> str:
    """As many of the next matches in one line as fit into `room` px at LABEL size. `sentence`: the text round them."""
    lines = [sentence("   ·   ".join(matches[:count])) for count in range(len(matches), 0, -1)]
    return next((line for line in lines if kit.text_width(line, kit.LABEL) <= room), lines[-1])
