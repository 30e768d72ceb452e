"""Three letters that one player chooses with a stick and a button: the model, without drawing or sounds."""

from pigaming_app.storage.scores import LETTERS
from pigaming_app.ui.input.events import Act
from pigaming_app.ui.widgets.word_filter import HARMLESS, rude

ROLL = 0.09  # seconds in which a letter rolls into its place
SHAKE = 0.5  # seconds for which refused letters shake


class Spelling:
    """Up and down turn a letter, FIRE goes on and accepts the last one, START accepts all, BACK goes back.

    FIRE accepts only letters of which one was turned, so that whoever hammers on it does not fill the tables with AAA.
    """

    def __init__(self) -> None:
        self.letters, self.slot = [0, 0, 0], 0
        self.turned = self.done = False
        self.rolled, self.rolling, self.shaking = 0, ROLL, SHAKE

    @property
    def spelled(self) -> str:
        """The letters as they are now."""
        return "".join(LETTERS[letter] for letter in self.letters)

    @property
    def taken(self) -> str | None:
        """What enters the tables when time is up; None: nobody has chosen anything."""
        if not (self.done or self.turned):
            return None
        return HARMLESS if rude(self.spelled) else self.spelled

    @property
    def refused(self) -> bool:
        """The letters have just been refused."""
        return self.shaking < SHAKE

    def on(self, act: Act) -> str | None:
        """Answer a press of the player; the name of the sound that follows."""
        match act:
            case Act.BACK | Act.LEAVE if self.done:
                self.done = False
                return "back"
            case _ if self.done:
                return None
            case Act.UP | Act.DOWN:
                return self._turn(-1 if act is Act.UP else 1)
            case Act.LEFT | Act.BACK | Act.LEAVE:
                return self._move(self.slot - 1)
            case Act.RIGHT:
                return self._move(self.slot + 1)
            case Act.FIRE if self.slot < 2:
                return self._move(self.slot + 1)
            case Act.FIRE:
                return self._accept(self.turned)
            case Act.START:
                return self._accept(True)
        return None

    def update(self, seconds: float) -> None:
        """Let letters roll and shake."""
        self.rolling += seconds
        self.shaking += seconds

    def _turn(self, by: int) -> str:
        self.letters[self.slot] = (self.letters[self.slot] + by) % len(LETTERS)
        self.rolled, self.rolling, self.turned = by, 0.0, True
        return "move"

    def _move(self, slot: int) -> str | None:
        before, self.slot = self.slot, max(0, min(2, slot))
        self.rolled = 0
        if self.slot == before:
            return None
        return "accept" if self.slot > before else "back"

    def _accept(self, chosen: bool) -> str:
        if not chosen or rude(self.spelled):
            self.shaking = 0.0
            return "refused"
        self.done = True
        return "ready"
