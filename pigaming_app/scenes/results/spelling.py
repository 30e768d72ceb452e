"""Initials of one player. Model only: no drawing, no sound."""

from pigaming_app.storage.scores import LETTERS
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.letter_picker import LetterPicker
from pigaming_app.ui.widgets.word_filter import HARMLESS, is_rude

SHAKE = 0.5  # s, shaking of rejected letters


class Spelling:
    """Letter entry: up and down change a letter, FIRE goes on and accepts the last one, START accepts all, BACK goes
    back.

    FIRE accepts only if at least one letter was changed, so that hammering does not fill the tables with AAA.
    """

    def __init__(self) -> None:
        self.picker = LetterPicker(LETTERS, 3 * LETTERS[0])
        self.turned = self.done = False
        self.shaking = SHAKE

    @property
    def spelled(self) -> str:
        """The current letters."""
        return self.picker.spelled

    @property
    def taken(self) -> str | None:
        """The initials to enter at the timeout; None if no letter was chosen."""
        if not (self.done or self.turned):
            return None
        return HARMLESS if is_rude(self.spelled) else self.spelled

    @property
    def refused(self) -> bool:
        """True shortly after a rejection."""
        return self.shaking < SHAKE

    @property
    def last(self) -> bool:
        """True if the last letter is selected."""
        return self.picker.slot == len(self.picker.letters) - 1

    def handle(self, button: Button) -> str | None:
        """Handle a button; returns the name of the sound to play."""
        match button:
            case Button.BACK | Button.LEAVE_SEAT if self.done:
                self.done = False
                return "back"
            case _ if self.done:
                return None
            case Button.UP | Button.DOWN:
                self.turned = True
                return self.picker.turn(-1 if button is Button.UP else 1)
            case Button.LEFT | Button.BACK | Button.LEAVE_SEAT:
                return self.picker.move(-1)
            case Button.RIGHT:
                return self.picker.move(1)
            case Button.FIRE if not self.last:
                return self.picker.move(1)
            case Button.FIRE:
                return self._accept(self.turned)
            case Button.START:
                return self._accept(True)
        return None

    def update(self, seconds: float) -> None:
        self.picker.update(seconds)
        self.shaking += seconds

    def _accept(self, chosen: bool) -> str:
        if not chosen or is_rude(self.spelled):
            self.shaking = 0.0
            return "refused"
        self.done = True
        return "ready"
