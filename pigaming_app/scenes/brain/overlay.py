"""The brain overlay: selects a brain, queries it a few times a second, draws it every frame.

Read-only. Brains are queried after a tick, never within one, so the match is neither changed nor slowed.
"""

import math
from collections.abc import Mapping
from typing import Any

import pygame

from pigaming_app.ai.brain.kind import BrainPlayer
from pigaming_app.ai.brain.thoughts import PETALS, MoveKey, Thoughts
from pigaming_app.ai.explanations.registry import explain_of, thoughts_of
from pigaming_app.games.match import Match
from pigaming_app.scenes.brain import panels as cards
from pigaming_app.scenes.brain.floor_marks import FloorMarks
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.scenes.views.view import MatchView
from pigaming_app.sim.world import HEIGHT, WIDTH
from pigaming_app.ui.draw import ADD, PLAYERS
from pigaming_app.ui.i18n import Words

QUERY_PERIOD = 5  # ticks between two queries
EASE = 10.0  # 1/s, smoothing rate of bars and petals
GLOW = 6  # px of the panels' glow beside the clock
TILTED = 0.35  # deflection above which a stick counts as held


class BrainOverlay:
    """Shows the brain of one AI seat of a match, or none."""

    def __init__(self, match: Match, view: MatchView, words: Words) -> None:
        self.match, self.view, self.words = match, view, words
        self.seat: int | None = None
        self.thoughts = Thoughts("starts")
        self.queried = -QUERY_PERIOD  # tick of the last query
        self.rose = [0.0] * PETALS
        self.wishes: dict[str, float] = {}
        self.heads: dict[str, list[float]] = {}
        self.clock = 0.0

    @property
    def seats(self) -> list[int]:
        """The seats whose brains can explain themselves."""
        return [seat for seat in self.view.seats if self._explains(seat)]

    def next(self) -> None:
        """Show the first AI, then the next; after the last, none."""
        after = [seat for seat in self.seats if self.seat is None or seat > self.seat]
        self.seat = after[0] if after else None
        self.queried, self.rose, self.wishes, self.heads = -QUERY_PERIOD, [0.0] * PETALS, {}, {}

    def draw(self, screen: pygame.Surface, blend: float, seconds: float) -> None:
        """Draw it over the match, `seconds` after the previous picture."""
        if self.seat is None or not self._explains(self.seat):  # a player may have taken the seat
            self.seat = None
            return
        state = self.match.state
        if not self.queried <= state.tick < self.queried + QUERY_PERIOD:
            self.queried = state.tick
            self.thoughts = thoughts_of(self.match, self.seat) or Thoughts("starts")
        self._ease(seconds)
        self._floor(screen, state, self.seat, blend)
        self._boxes(screen, state, self.seat)

    def _explains(self, seat: int) -> bool:
        brain = self.match.brains[seat]
        return isinstance(brain, BrainPlayer) and explain_of(brain.kind, self.match.setup.game) is not None

    def _ease(self, seconds: float) -> None:
        """Smooth the displayed values towards the current thoughts."""
        self.clock += seconds
        part, thoughts = 1.0 - math.exp(-EASE * seconds), self.thoughts
        self.rose = [old + part * (new - old) for old, new in zip(self.rose, thoughts.petals, strict=True)]
        current: Mapping[str, float] = self.wishes
        self.wishes = {
            name: (old := current.get(name, 0.0)) + part * (new - old) for name, new in thoughts.utilities.items()
        }
        before = self.heads
        self.heads = {
            name: [old + part * (new - old) for old, new in zip(before.get(name, chances), chances, strict=True)]
            for name, chances in thoughts.heads.items()
        }

    def _floor(self, screen: pygame.Surface, state: Any, seat: int, blend: float) -> None:
        others = [self.view.pose(other, blend) for other in self.view.seats if other != seat]
        marks = FloorMarks(self.view.pose(seat, blend), others, PLAYERS[seat], self.clock)
        marks.sights(state, self.thoughts.percepts)
        marks.rose(self.rose, self.thoughts.percepts)
        screen.set_clip((LEFT, TOP, WIDTH, HEIGHT))
        screen.fblits(marks.light, ADD)
        screen.set_clip(None)

    def _boxes(self, screen: pygame.Surface, state: Any, seat: int) -> None:
        """Texts left of the clock, wishes right of it."""
        thoughts, clock = self.thoughts, self.view.clock
        left, right, w = LEFT, clock.right + 8, clock.left - 8 - LEFT
        cards.blank(screen, LEFT - 12, clock.left + GLOW)
        cards.blank(screen, clock.right - GLOW, LEFT + int(WIDTH) + 12)
        doing = self._word("brain.", thoughts.behaviour)
        because = self._word("brain.because_", thoughts.reason) if thoughts.reason else ""
        cards.draw_words(screen, left, w, seat, doing, because)
        screens = SCREENS[self.match.setup.game]
        if thoughts.moves:
            sure = f"{thoughts.names.get('percent', 0)} %", self.words("brain.sure")
            cards.draw_moves(screen, right, w, seat, thoughts.moves, thoughts.chosen, sure)
        elif thoughts.heads:
            aside = cards.heads_width(self.heads)
            cards.draw_wishes(screen, right, w, seat, self.wishes, thoughts.chosen, screens.signs, aside)
            cards.draw_heads(screen, right + w, seat, self.heads, thoughts.choices, screens.signs)
        else:
            cards.draw_wishes(screen, right, w, seat, self.wishes, thoughts.chosen, screens.signs)
            buttons = [("turbo", state.actions[seat].turbo)]
            if screens.fire:
                buttons.insert(0, ("fire", state.actions[seat].fire))
            cards.draw_held(screen, right + w, seat, held(state.actions[seat]), buttons)

    def _word(self, prefix: str, name: str) -> str:
        """The text for a behaviour or reason; its name, where a plug-in has no text."""
        key = f"{prefix}{name}"
        names = self.thoughts.names
        return self.words.counted(key, names.get("count"), **names) if key in self.words else name.replace("_", " ")


def held(action: Any) -> MoveKey:
    """Stick in three steps per axis, and fire."""
    linear, angular = (int(value > TILTED) - int(value < -TILTED) for value in (action.linear, action.angular))
    return linear, angular, int(action.fire)
