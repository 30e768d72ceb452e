"""Attract mode: for one game after the other an AI match, how to play, the best scores. Any input ends it, and does
nothing else."""

import secrets
from collections.abc import Callable
from functools import partial
from itertools import cycle

import pygame

from pigaming_app.ai import STRENGTHS, seated
from pigaming_app.games import GAMES
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import FREE, Seat, Setup
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Home, Scene, Turn
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.play.scene import new_seed
from pigaming_app.scenes.results.high_score_tables import contests
from pigaming_app.scenes.results.high_scores import HighScores
from pigaming_app.ui.draw import BODY, FOCUS, LABEL, dim
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.caption import caption

MINUTES = 1.0  # of a match
AFTER = 2.5  # seconds for which its end is shown
PAGE = 12.0  # seconds for a page
PROMPT_Y, PAGE_PROMPT_Y = 984, 1020  # px; a page's own row ends above
LEVELS = 6  # brightnesses of the prompt


class Attract:
    """Three shows for each game, round and round, from a random game on; opened over the title when nobody is there."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.age = 0.0
        games, first = list(GAMES), secrets.randbelow(len(GAMES))
        self.shows = (
            partial(make, game)
            for game in cycle(games[first:] + games[:first])
            for make in (self._match, self._howto, self._best)
        )
        self.show: Scene | None = None
        self._next()

    def entered(self) -> None:
        """Quiet: nobody is listening."""
        self.context.sounds.music(False)

    def on(self, event: InputEvent) -> Turn:
        """Whatever is pressed, back to the title, where it counts for nothing; F4 shows what the AIs think."""
        if event.button is Button.BRAIN and isinstance(self.show, DemoMatch):
            self.show.runner.brain.next()
            return None
        return None if event.button is Button.LOST else Home()

    def update(self, seconds: float) -> Turn:
        """Let the show go on, or begin the next one."""
        self.age += seconds
        if self.show is None or self.show.update(seconds) is not None:
            self._next()
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """The show, and what to press."""
        if self.show:
            self.show.draw(screen)
        level = round(LEVELS * abs((self.age % 1.0) * 2 - 1))
        color = dim(FOCUS, 0.45 + 0.55 * level / LEVELS)
        text = self.context.words("attract.press")
        size, y = (LABEL, PROMPT_Y) if isinstance(self.show, DemoMatch) else (BODY, PAGE_PROMPT_Y)
        caption(text, color, color, size, face="head").draw(screen, 960, y)

    def _next(self) -> None:
        self.show = next(show for show in (make() for make in self.shows) if show)
        self.show.entered()

    def _match(self, game: str) -> Scene:
        return DemoMatch(self.context, game)

    def _howto(self, game: str) -> Scene:
        from pigaming_app.scenes.howto.scene import HowTo

        page = HowTo(self.context, game)
        return TimedPage(page, page.draw)

    def _best(self, game: str) -> Scene | None:
        """Tables of the game in which somebody has scored."""
        there = [one for one in contests(self.context.scores) if one.game == game]
        if not there:
            return None
        best = HighScores(self.context, secrets.choice(there))
        return TimedPage(best, best.paint)


class DemoMatch:
    """AIs play for a minute."""

    def __init__(self, context: Context, game: str) -> None:
        rules = GAMES[game]
        teams = secrets.choice((rules.teams, rules.teams, (0, 1, 0, 1))) if rules.sides == FREE else rules.teams
        one, two, three, four = (Seat(secrets.choice(STRENGTHS), team) for team in teams)
        arena, seats = secrets.choice(arenas(game)), (one, two, three, four)
        setup = Setup(game, arena, seats, MINUTES, new_seed(), rules.variants[0], rules.default_goal)
        self.runner = MatchRunner(context, seated(setup), loud=False)
        self.warm = False
        self.over = 0.0

    def entered(self) -> None:
        """Nothing to begin."""

    def on(self, event: InputEvent) -> Turn:
        """Nobody is asked."""

    def update(self, seconds: float) -> Turn:
        """Play; then stand for a moment."""
        self.warm = self.warm or self.runner.warm(3.0)
        self.runner.advance(seconds)
        self.over += seconds * self.runner.match.over
        return Home() if self.over > AFTER else None

    def draw(self, screen: pygame.Surface) -> None:
        """The match."""
        self.runner.draw(screen)


class TimedPage:
    """A page that is only looked at."""

    def __init__(self, page: Scene, paint: Callable[[pygame.Surface], None]) -> None:
        self.page, self.paint, self.age = page, paint, 0.0

    def entered(self) -> None:
        """Begin it."""
        self.page.entered()

    def on(self, event: InputEvent) -> Turn:
        """Nobody is asked."""

    def update(self, seconds: float) -> Turn:
        """Stay a while."""
        self.age += seconds
        self.page.update(seconds)
        return Home() if self.age > PAGE else None

    def draw(self, screen: pygame.Surface) -> None:
        """The page, as `paint` shows it."""
        self.paint(screen)
