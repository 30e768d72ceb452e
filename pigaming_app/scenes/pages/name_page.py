"""Name entry with a stick and one button: up and down change a letter, FIRE goes on, START saves."""

import pygame

from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.pages.page import Page
from pigaming_app.ui import draw as kit
from pigaming_app.ui.draw.layers import LEFT, RIGHT, text
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.letter_picker import LetterPicker, cursor, draw_letters, letter_box

LETTERS = " ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
W, H, GAP, MIDDLE = 176, 240, 32, 510  # px, letter boxes
SIZE = 168  # px, letter size


class NamePage(Page):
    """A page that asks for a name of at most `length` letters; `title`: key of its heading."""

    when_idle, lockout = Pop(), 0.3
    hints = ((Button.FIRE, "results.next_letter"), (Button.BACK, "lab.hint_back"), (Button.START, "lab.hint_save"))

    def __init__(self, context: Context, title: str, name: str, length: int, idle: float) -> None:
        super().__init__(context)
        self.title, self.idle, self.length = title, idle, length
        self.spell(name)
        self.pitch = min(W + GAP, (RIGHT - LEFT) // length)
        self.taken = False  # the name is in use; START again overwrites
        self.unusable = False  # the name was refused

    # ---- of the page

    def is_taken(self, name: str) -> bool:
        """True if something else has this name, so that START is to be pressed twice."""
        raise NotImplementedError

    @property
    def proposal(self) -> str:
        """A name in place of an empty one, if there is one."""
        return ""

    def is_possible(self, name: str) -> bool:
        """True for a valid name."""
        return bool(name)

    def keep(self, name: str) -> StackOperation:
        """Save under a name, and leave."""
        raise NotImplementedError

    # ---- scene

    @property
    def name(self) -> str:
        """The current spelling."""
        return self.picker.spelled.strip()

    def press(self, event: InputEvent) -> StackOperation:
        """Edit letters; START saves."""
        if event.button is not Button.START:
            pointing = event.button is Button.POINT
            self.taken, self.unusable = self.taken and pointing, self.unusable and pointing
        match event.button:
            case Button.UP | Button.DOWN:
                self._play(self.picker.turn(-1 if event.button is Button.UP else 1))
            case Button.RIGHT | Button.FIRE:
                self._play(self.picker.move(1))
            case Button.LEFT:
                self._play(self.picker.move(-1))
            case Button.START:
                return self._save()
            case Button.CLICK if event.at:
                self._click(event.at)
        return None

    def leave(self) -> StackOperation:
        """Go back one letter; leave from the first one."""
        self.taken = self.unusable = False
        if self.picker.slot == 0:
            return super().leave()
        self._play(self.picker.move(-1))
        return None

    def advance(self, seconds: float) -> StackOperation:
        self.picker.update(seconds)
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the letters, and how to change them."""
        xs = [self.middle(i) for i in range(len(self.picker.letters))]
        w = self.pitch - GAP
        for x in xs:
            letter_box(w, H).draw(screen, x, MIDDLE)
        draw_letters(screen, self.picker, xs, MIDDLE, SIZE * w // W, 50, kit.ICE)
        cursor(w, H, 36, 20, kit.BOLD, (H / 2 + 48, 30, 230)).draw(screen, xs[self.picker.slot], MIDDLE)
        line, color = self._hint()
        text(line, kit.BODY, color).draw(screen, 960, MIDDLE + 290)

    def spell(self, name: str) -> None:
        """Begin with a name."""
        self.picker = LetterPicker(LETTERS, name[: self.length].ljust(self.length))

    def middle(self, slot: int) -> float:
        """Centre of a letter, x in px."""
        return 960 + (slot - (len(self.picker.letters) - 1) / 2) * self.pitch

    # ---- inside

    def _hint(self) -> tuple[str, kit.Color]:
        words = self.context.words
        if self.unusable:
            return words("lab.unusable"), kit.ALARM
        if self.taken:
            return words("lab.taken", name=self.name), kit.ALARM
        return words("lab.name_how"), kit.MIST

    def _play(self, sound: str | None) -> None:
        if sound:
            self.context.sounds.play(sound)

    def _click(self, at: tuple[float, float]) -> None:
        """The upper half of a letter's column selects the previous letter, the lower half the next."""
        for i in range(len(self.picker.letters)):
            if abs(at[0] - self.middle(i)) <= (self.pitch - GAP) / 2 and abs(at[1] - MIDDLE) <= H / 2 + 90:
                self.picker.slot = i
                if abs(at[1] - MIDDLE) > H / 2:
                    self._play(self.picker.turn(-1 if at[1] < MIDDLE else 1))

    def _save(self) -> StackOperation:
        """Save, unless the name is impossible, or in use and not yet confirmed."""
        if not self.name and self.proposal:
            self.spell(self.proposal)
            self.context.sounds.play("move")
            return None
        if not self.is_possible(self.name):
            self.unusable = True
            self.context.sounds.play("refused")
            return None
        if self.is_taken(self.name) and not self.taken:
            self.taken = True
            self.context.sounds.play("refused")
            return None
        return self.keep(self.name)
