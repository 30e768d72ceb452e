"""A line of text: typed on the keyboard, or letter by letter with stick and button."""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Hints, Page
from pigaming_app.ui.draw import ALARM, BODY, BOLD, FOCUS, HERO, ICE, LINE, MIST, TITLE, cut_box
from pigaming_app.ui.draw.layers import LEFT, RIGHT, Layer, LitImage, fit_size, text
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import black_out, heading
from pigaming_app.ui.widgets.letter_picker import LetterPicker, cursor, draw_letters, letter_box

ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZÁÂÃÀÄÇÉÊÈÍÑÓÔÕÖÚÜ0123456789.,-!? "
LINE_BOX = pygame.Rect(LEFT, 250, RIGHT - LEFT, 120)
W, H, MIDDLE, HINT_Y = 216, 276, 600, 850  # px: letter box, its middle, the line below
CURSOR = "_"


class TextPage(Page):
    """`accept`: takes the text, and returns the sentence why not, if it cannot; `most`: characters; `exact`: spaces
    count as typed; `letters`: for stick and button.
    """

    idle, when_idle, lockout = 120.0, Pop(), 0.3

    def __init__(
        self,
        context: Context,
        title: str,
        before: str,
        most: int,
        accept: Callable[[str], str],
        exact: bool = False,
        letters: str = ALPHABET,
    ) -> None:
        super().__init__(context)
        self.asked, self.most, self.accept, self.exact = title, most, accept, exact
        self.text = before
        self.picker = LetterPicker(letters, letters[0])
        self.refusal = ""

    @property
    def hints(self) -> Hints:
        """The prompts of a pad, or of the keyboard, whose letters and space are typed."""
        own = [(Button.FIRE, "typing.letter"), (Button.X, "typing.erase")]
        typed = self.context.controls.last.kind == "keys"
        ways_out = [(Button.START, "typing.save"), (Button.BACK, "typing.back")]
        return [*([] if typed else own), *ways_out]

    def on_enter(self) -> None:
        """Take over the letters of the keyboard."""
        self.context.controls.typist = self.type

    def on_leave(self) -> None:
        """Give the keyboard back."""
        self.context.controls.typist = None

    def type(self, letter: str) -> None:
        """Add a typed letter; a backspace erases the last one."""
        self.refusal = ""
        if letter == "\b":
            self._erase()
        elif self.age >= self.lockout:
            self._add(letter)

    def press(self, event: InputEvent) -> StackOperation:
        """UP and DOWN turn the letter, FIRE and RIGHT add it, X and LEFT erase the last one, START saves."""
        if event.button not in (Button.POINT, Button.FOUND, Button.LOST):
            self.refusal = ""
        match event.button:
            case Button.UP | Button.DOWN:
                self._turn(-1 if event.button is Button.UP else 1)
            case Button.FIRE | Button.RIGHT:
                self._add(self.picker.spelled)
            case Button.X | Button.LEFT:
                self._erase()
            case Button.START:
                return self._save()
            case Button.CLICK if event.at and abs(event.at[0] - 960) <= W / 2:
                self._click(event.at[1] - MIDDLE)
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.picker.update(seconds)
        return None

    @property
    def heading(self) -> LitImage:
        return heading(self.asked, f"{len(self.text)} / {self.most}")

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the text and the letter."""
        words = self.context.words
        black_out(screen, LINE_BOX)
        line_box().draw(screen, *LINE_BOX.topleft)
        shown = self.text + CURSOR
        room = LINE_BOX.w - 80
        text(shown, fit_size(shown, TITLE, room), ICE, "head", "l", room).draw(
            screen, LINE_BOX.x + 40, LINE_BOX.centery
        )
        letter_box(W, H).draw(screen, 960, MIDDLE)
        draw_letters(screen, self.picker, [960], MIDDLE, HERO, 60, ICE)
        cursor(W, H, 36, 20, BOLD, (H / 2 + 48, 30, 230)).draw(screen, 960, MIDDLE)
        text(self.refusal or words("typing.how"), BODY, ALARM if self.refusal else MIST).draw(screen, 960, HINT_Y)

    # ---- inside

    def _turn(self, by: int) -> None:
        self.context.sounds.play(self.picker.turn(by))

    def _add(self, letter: str) -> None:
        full = len(self.text) >= self.most
        self.text += "" if full else letter
        self.context.sounds.play("refused" if full else "accept")

    def _erase(self) -> None:
        self.context.sounds.play("back" if self.text else "refused")
        self.text = self.text[:-1]

    def _click(self, below: float) -> None:
        """A click on the letter adds it; above or below it, it turns."""
        if abs(below) <= H / 2:
            self._add(self.picker.spelled)
        elif abs(below) <= H / 2 + 90:
            self._turn(-1 if below < 0 else 1)

    def _save(self) -> StackOperation:
        self.refusal = self.accept(self.text if self.exact else " ".join(self.text.split()))
        self.context.sounds.play("refused" if self.refusal else "ready")
        return None if self.refusal else Pop()


@cached
def line_box() -> LitImage:
    """The box round the text; top left at (0, 0)."""
    layer = Layer(0, 0, *LINE_BOX.size)
    layer.glow.line(cut_box(0, 0, *LINE_BOX.size, 20), FOCUS, LINE, True)
    return layer.render()
