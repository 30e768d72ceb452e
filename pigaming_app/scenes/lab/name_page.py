"""A name for the robot, chosen with a stick and one button: up and down change a letter, FIRE goes on, START saves."""

import pygame

from pigaming_app.scenes.flow.stack import Pop, Turn
from pigaming_app.scenes.lab.bench import IDLE, Bench
from pigaming_app.scenes.lab.saved_robots import LENGTH, LETTERS, NotKept, keep, names, proposal
from pigaming_app.ui.draw import (
    ALARM,
    BODY,
    FOCUS,
    ICE,
    LINE,
    MIST,
    STEEL,
    THIN,
    Color,
    brackets,
    cut,
    icon,
    panel,
)
from pigaming_app.ui.draw.layers import Lit, Pane, backdrop
from pigaming_app.ui.draw.surface_cache import cached
from pigaming_app.ui.draw.text import text, word
from pigaming_app.ui.input.events import Act, Press
from pigaming_app.ui.widgets.labels import heading

DEAF = 0.3  # seconds in which presses are ignored
ROLL = 0.09  # seconds in which a letter rolls into its place
W, H, GAP, MIDDLE = 176, 240, 32, 510  # px of a letter's box
SIZE = 168  # px of a letter


class Naming:
    """Asks for a name and saves the robot under it."""

    def __init__(self, lab: Bench) -> None:
        self.lab, self.house = lab, lab.house
        self.letters = [LETTERS.index(letter) for letter in (lab.name or proposal()).ljust(LENGTH)]
        self.slot = 0
        self.age = self.rolling = 0.0
        self.rolled = 0
        self.taken = False  # the name belongs to another robot; START again replaces it
        self.prompts = self.house.prompts(
            [(Act.FIRE, "results.next_letter"), (Act.BACK, "lab.hint_back"), (Act.START, "lab.hint_save")],
        )

    def entered(self) -> None:
        """Nothing to begin."""

    @property
    def name(self) -> str:
        """What is spelled now."""
        return "".join(LETTERS[letter] for letter in self.letters).strip()

    def on(self, press: Press) -> Turn:
        """Choose letters; START saves; BACK goes a letter back, and from the first one to the Lab."""
        press = self.prompts.meant(press)
        if self.age < DEAF:
            return None
        if press.act is not Act.START:
            self.taken = self.taken and press.act is Act.POINT
        match press.act:
            case Act.UP | Act.DOWN:
                self._roll(-1 if press.act is Act.UP else 1)
            case Act.RIGHT | Act.FIRE:
                self._move(min(LENGTH - 1, self.slot + 1))
            case Act.LEFT:
                self._move(max(0, self.slot - 1))
            case Act.BACK if self.slot == 0:
                self.house.sounds.play("back")
                return Pop()
            case Act.BACK:
                self._move(self.slot - 1)
            case Act.START:
                return self._save()
            case Act.CLICK if press.at:
                self._click(press.at)
            case _:
                pass
        return None

    def update(self, seconds: float) -> Turn:
        """Let a letter roll."""
        self.age += seconds
        self.rolling += seconds
        return Pop() if self.house.idle > IDLE else None

    def draw(self, screen: pygame.Surface) -> None:
        """Paint the question and the letters."""
        screen.blit(backdrop(), (0, 0))
        words = self.house.words
        heading(words("lab.name_title")).draw(screen)
        for i, letter in enumerate(self.letters):
            box().draw(screen, middle(i), MIDDLE)
            dy = self.rolled * 50 * max(0.0, 1 - self.rolling / ROLL) if i == self.slot else 0.0
            if LETTERS[letter] != " ":
                word(LETTERS[letter], SIZE, FOCUS if i == self.slot else ICE).draw(screen, middle(i), MIDDLE + dy)
        here().draw(screen, middle(self.slot), MIDDLE)
        said, color = self._said()
        text(said, BODY, color).draw(screen, 960, MIDDLE + 290)
        self.prompts.draw(screen)

    # ---- inside

    def _said(self) -> tuple[str, Color]:
        words = self.house.words
        if self.taken:
            return words("lab.taken", name=self.name), ALARM
        return words("lab.name_how"), MIST

    def _roll(self, by: int) -> None:
        self.letters[self.slot] = (self.letters[self.slot] + by) % len(LETTERS)
        self.rolled, self.rolling = by, 0.0
        self.house.sounds.play("move")

    def _move(self, slot: int) -> None:
        if slot != self.slot:
            self.house.sounds.play("accept" if slot > self.slot else "back")
        self.rolled, self.slot = 0, slot

    def _click(self, at: tuple[float, float]) -> None:
        """The upper half of a letter's column goes one letter back, the lower one on."""
        for i in range(LENGTH):
            if abs(at[0] - middle(i)) <= W / 2 and abs(at[1] - MIDDLE) <= H / 2 + 90:
                self.slot = i
                if abs(at[1] - MIDDLE) > H / 2:
                    self._roll(-1 if at[1] < MIDDLE else 1)

    def _save(self) -> Turn:
        """Save it, unless the name is another robot's and this is the first time that START was pressed."""
        name = self.name
        if not name:
            self.house.sounds.play("refused")
            return None
        if name != self.lab.name and name in names() and not self.taken:
            self.taken = True
            self.house.sounds.play("refused")
            return None
        words = self.house.words
        try:
            self.lab.workshop.hold(lambda training: keep(training, name))
            self.lab.name = name
            self.lab.say(words("lab.saved", name=name))
        except NotKept as trouble:
            self.lab.say(words(str(trouble)), wrong=True)
        return Pop()


def middle(slot: int) -> float:
    """Where a letter stands, x in px."""
    return 960 + (slot - (LENGTH - 1) / 2) * (W + GAP)


@cached
def box() -> Lit:
    """A letter's box, round (0, 0)."""
    pane = Pane(-W / 2, -H / 2, W, H)
    panel(pane.hot, -W / 2, -H / 2, W, H)
    pane.hot.line(cut(-W / 2, -H / 2, W, H, 20), STEEL, THIN, True)
    return pane.done()


@cached
def here() -> Lit:
    """The corners round the letter that is chosen, and what changes it; round (0, 0)."""
    pane = Pane(-W / 2 - 20, -230, W + 40, 460)
    brackets(pane.hot, -W / 2, -H / 2, W, H, FOCUS, 36, 20)
    for side, name in ((-1, "up"), (1, "down")):
        icon(pane.hot, name, 0, side * (H / 2 + 48), 30, FOCUS, LINE)
    return pane.done()
