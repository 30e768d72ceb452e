"""Between two matches of a climb: the ladder, the last match, and the next one.

After two clear losses weaker robots are offered here, and only here.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import pygame

from pigaming_app.events.ladder import LEVELS, Climb
from pigaming_app.scenes.flow.access import Access
from pigaming_app.scenes.flow.match_words import LIT
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation, Swap
from pigaming_app.scenes.ladder import rungs_view as view
from pigaming_app.scenes.ladder.climber import Climber, begun, device_of
from pigaming_app.scenes.ladder.climbers import game_name
from pigaming_app.scenes.ladder.summit import Summit
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.play.drivers import new_seed
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.scenes.views.sprites.robot import seat_robot
from pigaming_app.ui.draw import FOCUS, ICE, LABEL, MIST, SUB
from pigaming_app.ui.draw.frame_budget import PrewarmQueue
from pigaming_app.ui.draw.layers import backdrop, paragraph, span, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.focus import Focus, FocusSpot
from pigaming_app.ui.widgets.labels import black_out, chip

X, W = span(6, 6)
SAID_Y, NEXT_Y, STANDING_Y = 240, 334, 424  # px
ITEMS_Y, ITEM_H, ITEM_PITCH = 494, 84, 104  # px
NOTE_Y, NOTE_PITCH = 842, 54  # px: middle of the first line about the focused item, and from line to line
PLAY, EASIER, ANEW, STOP = "play", "easier", "anew", "stop"
GLAD = ("won", "up")  # of what happened last


class LadderPage(Page):
    """The page of a climber. `said`: key of what happened last; empty: nothing yet. `saved`: false: it is lost if the
    arcade ends.
    """

    title, idle, lockout = "ladder.title", 60.0, 0.6
    hints = ((Button.FIRE, "ladder.hint_ok"), (Button.BACK, "ladder.hint_later"))

    def __init__(self, context: Context, climber: Climber, said: str = "", saved: bool = True) -> None:
        self.climber, self.said = climber, said
        self.access = Access(context, lambda: [self.climber.device])
        super().__init__(context, Focus(self.spots()), self.access)
        self.going = False  # a match is wanted, but not loaded yet
        if not saved:
            self.show_message(context.words("app.unsaved"), wrong=True)
        self.queue = PrewarmQueue(self._jobs())

    @property
    def climb(self) -> Climb:
        """The climb."""
        return self.climber.climb

    def prewarm(self, milliseconds: float) -> bool:
        """Prewarm the page for at most this many milliseconds; True when complete."""
        return self.queue.work(milliseconds)

    def on_enter(self) -> None:
        """Start the music, and the way up."""
        self.context.sounds.music("title")
        if self.said == "up":
            self.context.sounds.play("win")

    def handle(self, event: InputEvent) -> StackOperation:
        """FIRE and START do what is selected, BACK leaves the climb for later."""
        return None if self.going else super().handle(event)

    def choose(self, name: str, event: InputEvent) -> StackOperation:
        if not self.context.controls.connected(self.climber.device):
            self.climber = replace(self.climber, device=device_of(event))
        self.context.sounds.play("accept")
        return self._do(name)

    def advance(self, seconds: float) -> StackOperation:
        """Begin a match as soon as it is loaded."""
        return self._begin() if self.going else None

    @property
    def subtitle(self) -> str:
        return game_name(self.context.words, self.climb.game)

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the ladder, what happened last, and the items."""
        words, climb = self.context.words, self._shown()
        view.draw_ladder(screen, climb, self.age / view.CLIMB_SECONDS if self.said == "up" else 1.0, self.age)
        said = self.said or "welcome"
        color = FOCUS if said in GLAD else ICE
        text(words(f"ladder.{said}"), SUB, color, "head", "l", W).draw(screen, X, SAID_Y)
        following = words("ladder.next", game=words(f"games.{climb.next_game}"), stars=LIT * climb.level)
        text(following, LABEL, ICE, "head", "l", W).draw(screen, X, NEXT_Y)
        view.standing(climb.wins, climb.losses).draw(screen, X, STANDING_Y)
        black_out(screen, *(spot.rect for spot in self.focus.spots))
        for spot in self.focus.spots:
            label, state = words(f"ladder.{spot.name}"), "focus" if spot.name == self.focus.name else "off"
            chip(label, W, state, ITEM_H).draw(screen, *spot.rect.topleft)
        for i, line in enumerate(paragraph(self._note(), W, 2, MIST)):
            line.draw(screen, X, NOTE_Y + NOTE_PITCH * i)
        self.focus.draw(screen)

    def spots(self) -> list[FocusSpot]:
        """The items that are possible now."""
        names = [PLAY]
        if self.climb.offers_easier:
            names.append(EASIER)
        if self.climb != Climb(self.climb.game):
            names += [STOP] if self.said else [ANEW, STOP]
        boxes = (pygame.Rect(X, ITEMS_Y + ITEM_PITCH * i, W, ITEM_H) for i in range(len(names)))
        return [FocusSpot(name, box) for name, box in zip(names, boxes, strict=True)]

    # ---- inside

    def _shown(self) -> Climb:
        """The climb as drawn: while weaker robots are selected, with them."""
        return self.climb.made_easier() if self.focus.name == EASIER else self.climb

    def _note(self) -> str:
        """The sentence about the focused item."""
        words, climb = self.context.words, self.climb
        if self.focus.name == STOP and climb.beaten:
            return words("ladder.stop_line", stars=LIT * climb.beaten, lost=climb.lost)
        return words("ladder.stop_nothing" if self.focus.name == STOP else f"ladder.{self.focus.name}_line")

    def _do(self, item: str) -> StackOperation:
        if item == STOP:
            if self.climb.beaten:
                return Swap(Summit(self.context, self.climber))
            self.climber.forget()
            return Pop()
        if item == ANEW:
            self.climber = begun(self.climb.game, self.climber.device)
        elif item == EASIER:
            self._change(self.climb.made_easier(), "easier_done")
            return None
        elif self.climb.offers_easier:
            self._change(self.climb.kept_hard(), self.said)
        self.going = True
        return self._begin()

    def _change(self, climb: Climb, said: str) -> None:
        """Change the climb, save it, and offer what is now possible."""
        self.climber, self.said = replace(self.climber, climb=climb), said
        if not self.climber.save():
            self.show_message(self.context.words("app.unsaved"), wrong=True)
        self.focus.set_spots(self.spots())
        self.focus.move_to(PLAY)

    def _begin(self) -> StackOperation:
        """Swap to the next match, or return None while it is being loaded."""
        setup = self.climb.setup(new_seed())
        if not self.context.preloader.ready(setup.game, setup.arena):
            return None
        after = partial(after_match, self.climber)
        return Swap(MatchScene(self.context, setup, [self.climber.device], after=after))

    def _jobs(self) -> Iterator[Callable[[], object]]:
        climb = self.climb
        yield backdrop
        yield view.rails
        for rung in range(1, LEVELS + 1):
            yield partial(view.stars, climb.level_on(rung), view.state_of(climb, rung))
        for seat in (0, 1):
            yield partial(seat_robot, seat, view.UP, view.SCALE)
        for name in ("ladder.play", "ladder.easier", "ladder.stop"):
            for state in ("off", "focus"):
                yield partial(chip, self.context.words(name), W, state, ITEM_H)


def after_match(climber: Climber, scene: MatchScene) -> AfterMatch:
    """The page after a match: the ladder again, or the summit. A match in which an AI has driven counts for nothing,
    one that was ended by hand counts as lost.
    """
    before = climber.climb
    if 0 in scene.drivers.assisted:
        climb, said = before, "assisted"
    elif not scene.match.over:
        climb, said = before.after_loss(clear=False), "ended"
    else:
        outcome = scene.match.outcome()
        climb = before.after(outcome)
        lost = "again" if climb.losses < before.losses or not climb.losses else "lost"
        won = "up" if climb.rung > before.rung else "won"
        said = "tied" if not outcome.winners else won if 0 in outcome.winners else lost
    climber = replace(climber, climb=climb, device=scene.devices[0] or climber.device)
    saved = climber.save()
    if climb.at_top:
        return Summit(scene.context, climber)
    return LadderPage(scene.context, climber, said, saved)
