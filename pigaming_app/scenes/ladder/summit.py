"""The end of a climb: at the top, or where the person stopped. Then the three letters, if it is among the best."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import pygame

from pigaming_app.events.ladder import LEVELS, table_of, worth
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.scene import Context, Scene, StackOperation, Swap
from pigaming_app.scenes.ladder.climber import Climber
from pigaming_app.scenes.ladder.climbers import Climbers, format_climb
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.results.celebration import SIZES, TUMBLES, Celebration, confetti
from pigaming_app.scenes.results.initials import Initials, Qualification, places
from pigaming_app.scenes.results.winner import big_robot, title
from pigaming_app.scenes.views.sprites.stars import star
from pigaming_app.storage.scores import Score
from pigaming_app.ui.draw import FOCUS, HERO, ICE, LABEL, LINE, MIST, PLAYERS, STEEL
from pigaming_app.ui.draw.frame_budget import PrewarmQueue, Steps, resumable
from pigaming_app.ui.draw.layers import Layer, LitImage, backdrop, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.labels import blit_sprite

STAY = 12.0  # s until it ends by itself
VOLLEYS = (0.4, 1.4, 2.6, 4.0)  # s, of confetti at the top
STAR_Y, STAR_R, STAR_PITCH, STAR_EVERY = 190, 62, 190, 0.25  # px, and s from star to star
ROBOT_Y, SCALE, FLOOR_Y = 508, 3.2, 660  # px
TITLE_Y, LINE_Y = 784, 900


class Summit(Page):
    """The last page of a climber with at least one robot beaten."""

    idle, lockout = math.inf, 1.2
    closing = Button.FIRE, Button.START, Button.CLICK
    hints = ((Button.FIRE, "results.on"),)

    def __init__(self, context: Context, climber: Climber) -> None:
        self.access = Access(context, lambda: [climber.device])
        super().__init__(context, gate=self.access)
        self.climber, self.climb = climber, climber.climb
        self.line = context.words("ladder.summit" if self.climb.at_top else "ladder.stopped")
        self.size = fit_size(self.line, HERO * 3 // 4, 1640, "hero")
        self.celebration = Celebration("pitanks", [0], [PLAYERS[0]])
        self.volleys = [*VOLLEYS] if self.climb.at_top else []
        self.queue = PrewarmQueue(self._jobs())

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        self.context.sounds.music("title")
        self.context.sounds.play("fanfare" if self.climb.at_top else "win")

    def leave(self) -> StackOperation:
        """Any button goes on."""
        return self._next()

    def advance(self, seconds: float) -> StackOperation:
        """Animate; go on after a while."""
        self.queue.work(0.0)
        self.celebration.update(seconds)
        while self.volleys and self.volleys[0] <= self.age:
            self.volleys.pop(0)
            self.celebration.volley()
        return self._next() if self.age >= STAY else None

    def show(self, screen: pygame.Surface) -> None:
        """Draw the robot on the last rung, without a heading."""
        words, climb = self.context.words, self.climb
        screen.blit(backdrop(), (0, 0))
        floor().draw(screen)
        self.celebration.draw(screen)
        for i in range(LEVELS):
            lit = i < climb.beaten and self.age >= STAR_EVERY * (i + 1)
            star(lit, STAR_R).draw(screen, 960 + STAR_PITCH * (i - (LEVELS - 1) / 2), STAR_Y)
        blit_sprite(screen, big_robot(0, SCALE), 960, ROBOT_Y)
        blit_sprite(screen, title(self.line, self.size, FOCUS if climb.at_top else ICE), 960, TITLE_Y)
        line = words("ladder.lost_one") if climb.lost == 1 else words("ladder.lost_count", lost=climb.lost)
        text(line, LABEL, MIST, "head").draw(screen, 960, LINE_Y)

    def draw_foot(self, screen: pygame.Surface) -> None:
        """Draw the prompt once it counts."""
        if self.age >= self.lockout:
            super().draw_foot(screen)

    # ---- inside

    def _next(self) -> StackOperation:
        """The three letters, if the climb is among the best of today or of all time; else the table."""
        table, value = table_of(self.climb.game), worth(self.climb)
        ranks, device = places(self.context, table, value, ()), self.climber.device
        if not ranks or not self.context.controls.connected(device):
            self.climber.forget()
            return Swap(Climbers(self.context, self.climb.game))
        claims = [Qualification(0, device, ((table, value),), (ranks,))]
        return Swap(Initials(self.context, claims, self._table, format_climb))

    def _table(self, fresh: Sequence[Score]) -> Scene:
        """The table with the new row. Without letters the climb stays in the file, and can be taken up again."""
        if fresh:
            self.climber.forget()
        return Climbers(self.context, self.climb.game, fresh)

    def _jobs(self) -> Iterator[Callable[[], object]]:
        yield backdrop
        yield floor
        for lit in (False, True):
            yield partial(star, lit, STAR_R)
        yield partial(big_robot, 0, SCALE)
        yield partial(title, self.line, self.size, FOCUS if self.climb.at_top else ICE)
        if self.volleys:
            for color in dict.fromkeys(self.celebration.colors):
                for size in SIZES:
                    for tumble in range(TUMBLES):
                        yield partial(confetti, "pitanks", 0, color, size, tumble)


@cached
@resumable
def floor() -> Steps[LitImage]:
    """The last rung, on which the robot stands."""
    layer = Layer(560, FLOOR_Y - 20, 800, 40)
    layer.glow.neon([(600, FLOOR_Y), (1320, FLOOR_Y)], STEEL, LINE)
    return (yield from layer.render_steps())
