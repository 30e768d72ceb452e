"""Attract mode: for each game in turn an AI match, a highlight, what features show, and the high scores.

Any input only ends it.
"""

import secrets
from collections.abc import Callable, Iterator
from functools import partial
from itertools import cycle

import pygame

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas, default_goal
from pigaming_app.games.game import FREE, Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.attract.clip import Clip
from pigaming_app.scenes.features.feature import Show
from pigaming_app.scenes.features.registry import features
from pigaming_app.scenes.flow.scene import Context, Home, Scene, StackOperation
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.scenes.play.runner import MatchRunner
from pigaming_app.scenes.recordings.store import highlights
from pigaming_app.scenes.results.high_scores import HighScores, contests
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.draw import BODY, FOCUS, LABEL, dim
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.caption import caption

MINUTES = 1.0  # length of a match
END_SECONDS = 2.5  # seconds for which the end of a match is shown
PAGE = 12.0  # seconds per page
PROMPT_Y, PAGE_PROMPT_Y = 984, 1020  # px; above PAGE_PROMPT_Y lies a page's own row
GLOWS = 6  # brightnesses of the prompt


class Attract:
    """The shows of each game, cyclically, from a random game; pushed over the title when idle."""

    untimed = waits = True

    def __init__(self, context: Context) -> None:
        self.context = context
        self.age = 0.0
        names = shown_games()
        first = secrets.randbelow(len(names))
        self.shows = (
            partial(make, game)
            for game in cycle(names[first:] + names[:first])
            for make in (self._match, self._highlight, *self._of_features(), self._best)
        )
        self.show: Scene | None = None
        self.clip: Clip | None = None  # the next highlight
        self.clip_ready = self.searched = False
        self._next()

    def on_enter(self) -> None:
        """Stop the music."""
        self.context.sounds.music(None)

    def handle(self, event: InputEvent) -> StackOperation:
        """Any input returns to the title without further effect; F4 shows the thoughts of the AIs."""
        if event.button is Button.BRAIN and isinstance(self.show, DemoMatch):
            if self.show.runner.brain:
                self.show.runner.brain.next()
            return None
        return None if event.button is Button.LOST else Home()

    def update(self, seconds: float) -> StackOperation:
        """Advance the show, or start the next one; meanwhile prepare the next highlight."""
        self.age += seconds
        self._prepare()
        if self.show is None or self.show.update(seconds) is not None:
            self._next()
        return None

    def draw(self, screen: pygame.Surface) -> None:
        """Draw the show and the prompt."""
        if self.show:
            self.show.draw(screen)
        level = round(GLOWS * abs((self.age % 1.0) * 2 - 1))
        color = dim(FOCUS, 0.45 + 0.55 * level / GLOWS)
        text = self.context.words("attract.press")
        size, y = (LABEL, PROMPT_Y) if isinstance(self.show, DemoMatch | Clip) else (BODY, PAGE_PROMPT_Y)
        caption(text, color, color, size, face="head").draw(screen, 960, y)

    def _next(self) -> None:
        self.show = next(show for show in (make() for make in self.shows) if show)
        self.show.on_enter()
        self.searched = False

    def _prepare(self) -> None:
        """Look for a highlight, once per show, and prepare it step by step."""
        if self.clip is None and not self.searched:
            self.searched = True
            highlight = self.context.shared(highlights).next()
            self.clip = Clip(self.context, highlight) if highlight else None
        self.clip_ready = self.clip is not None and (self.clip_ready or self.clip.prepare())

    def _highlight(self, game: str) -> Scene | None:
        """The highlight that has been prepared; None if there is none, or it is not ready."""
        if not self.clip_ready:
            return None
        clip, self.clip, self.clip_ready = self.clip, None, False
        return clip

    def _match(self, game: str) -> Scene:
        return DemoMatch(self.context, game)

    def _best(self, game: str) -> Scene | None:
        """High scores of the game; None if there are none."""
        tables = [table for table in contests(self.context.scores) if table.game == game]
        if not tables:
            return None
        best = HighScores(self.context, secrets.choice(tables))
        return TimedPage(best, best.show)

    def _of_features(self) -> Iterator[Callable[[str], Scene | None]]:
        """The shows of features."""
        for feature in features():
            if feature.show:
                yield partial(self._timed, feature.show)

    def _timed(self, make: Callable[[Context, str], Show | None], game: str) -> Scene | None:
        """A page of a feature for a while; None if it has none."""
        show = make(self.context, game)
        return TimedPage(show.page, show.paint) if show else None


class DemoMatch:
    """An AI match of one minute."""

    def __init__(self, context: Context, game: str) -> None:
        rules = games()[game]
        teams = rules.default.teams
        if rules.default.team_mode == FREE and secrets.randbelow(3) == 0:
            teams = (0, 1, 0, 1)
        one, two, three, four = (Seat(secrets.choice(LEVELS), team) for team in teams)
        arena, seats = secrets.choice(arenas(game)), (one, two, three, four)
        setup = Setup(
            game, arena, seats, MINUTES, new_seed(), rules.default.name, default_goal(game, rules.default.name, arena)
        )
        self.runner = MatchRunner(context, new_match(setup), loud=False)
        self.prewarmed = False
        self.over = 0.0

    def on_enter(self) -> None:
        pass

    def handle(self, event: InputEvent) -> StackOperation:
        return None

    def update(self, seconds: float) -> StackOperation:
        """Play; end a moment after the match."""
        self.prewarmed = self.prewarmed or self.runner.prewarm(3.0)
        self.runner.advance(seconds)
        self.over += seconds * self.runner.match.over
        return Home() if self.over > END_SECONDS else None

    def draw(self, screen: pygame.Surface) -> None:
        self.runner.draw(screen)


class TimedPage:
    """A page shown for a limited time."""

    def __init__(self, page: Scene, paint: Callable[[pygame.Surface], None]) -> None:
        self.page, self.paint, self.age = page, paint, 0.0

    def on_enter(self) -> None:
        self.page.on_enter()

    def handle(self, event: InputEvent) -> StackOperation:
        return None

    def update(self, seconds: float) -> StackOperation:
        """End after PAGE seconds."""
        self.age += seconds
        self.page.update(seconds)
        return Home() if self.age > PAGE else None

    def draw(self, screen: pygame.Surface) -> None:
        self.paint(screen)
