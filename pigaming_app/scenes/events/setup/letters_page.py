"""The letters of an entrant with stick and button: three of them, then the next entrant."""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.events.names import shortened
from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.scenes.results.spelling import Spelling
from pigaming_app.ui.draw import ALARM, BODY, BOLD, HERO, ICE, LABEL, MIST
from pigaming_app.ui.draw.layers import text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.letter_picker import cursor, draw_letters, letter_box
from pigaming_app.ui.widgets.word_filter import is_rude

W, H, GAP, MIDDLE = 216, 276, 48, 500  # px, letter boxes
LETTERS = 3
RECENT, RECENT_ROOM, RECENT_Y, HINT_Y = 8, 180, 250, 800  # names shown, and px


class LettersPage(Page):
    """Entry of names, one after the other. `enter`: takes a name, and returns the sentence why not, if it cannot;
    `names`: those entered so far; `once`: leave after the first one.
    """

    title, when_idle, lockout = "events.letters", Pop(), 0.3
    hints = (
        (Button.FIRE, "results.next_letter"),
        (Button.START, "events.hint_enter"),
        (Button.BACK, "events.hint_back"),
    )

    def __init__(
        self, context: Context, enter: Callable[[str], str], names: Callable[[], list[str]], once: bool = False
    ) -> None:
        super().__init__(context)
        self.enter, self.names, self.once = enter, names, once
        self.spelling = Spelling()
        self.refusal = ""

    def press(self, event: InputEvent) -> StackOperation:
        """Change letters; FIRE on the last one and START enter the name."""
        if event.button is Button.CLICK and event.at:
            self._click(event.at)
            return None
        if event.button not in (Button.POINT, Button.FOUND, Button.LOST):
            self.refusal = ""
        if event.button is Button.START or (event.button is Button.FIRE and self.spelling.last):
            return self._enter(event.button is Button.START)
        if sound := self.spelling.handle(event.button):
            self.context.sounds.play(sound)
        return None

    def leave(self) -> StackOperation:
        """Go back one letter; leave from the first one."""
        self.refusal = ""
        if self.spelling.picker.slot == 0:
            return super().leave()
        self.context.sounds.play(self.spelling.handle(Button.BACK) or "back")
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.spelling.update(seconds)
        return None

    @property
    def subtitle(self) -> str:
        return self.context.words("events.count", count=len(self.names()))

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the last names, the letters, and how to change them."""
        words, names = self.context.words, self.names()
        text("   ".join(shortened(name, RECENT_ROOM) for name in names[-RECENT:]), LABEL, MIST, "head").draw(
            screen, 960, RECENT_Y
        )
        xs = [middle(i) for i in range(LETTERS)]
        for x in xs:
            letter_box(W, H).draw(screen, x, MIDDLE)
        draw_letters(screen, self.spelling.picker, xs, MIDDLE, HERO, 60, ICE)
        cursor(W, H, 36, 20, BOLD, (H / 2 + 48, 30, 230)).draw(screen, xs[self.spelling.picker.slot], MIDDLE)
        if self.refusal:
            text(self.refusal, BODY, ALARM).draw(screen, 960, HINT_Y)
        else:
            text(words("lab.name_how"), BODY, MIST).draw(screen, 960, HINT_Y)

    # ---- inside

    def _enter(self, by_start: bool) -> StackOperation:
        """Hand the name over, and begin the next one. Hammering FIRE enters no name, START enters AAA, too."""
        name = self.spelling.spelled
        rude = is_rude(name) or not (self.spelling.turned or by_start)
        self.refusal = self.context.words("results.another") if rude else self.enter(name)
        if self.refusal:
            self.context.sounds.play("refused")
            return None
        self.context.sounds.play("ready")
        self.spelling = Spelling()
        return Pop() if self.once else None

    def _click(self, at: tuple[float, float]) -> None:
        """A click on a letter selects it; above or below it, it turns."""
        for i in range(LETTERS):
            if abs(at[0] - middle(i)) <= W / 2 and abs(at[1] - MIDDLE) <= H / 2 + 90:
                self.spelling.picker.slot = i
                if abs(at[1] - MIDDLE) > H / 2:
                    button = Button.UP if at[1] < MIDDLE else Button.DOWN
                    self.context.sounds.play(self.spelling.handle(button) or "move")


def middle(slot: int) -> float:
    """Centre of a letter, x in px."""
    return 960 + (slot - (LETTERS - 1) / 2) * (W + GAP)
