"""The language key of the title: the next language at once, for a moment its name, and how to go on to the next."""

import pygame

from pigaming_app.scenes.flow.scene import Context
from pigaming_app.ui.draw import FOCUS, LABEL, TITLE
from pigaming_app.ui.draw.layers import word
from pigaming_app.ui.i18n import NAMES
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.labels import black_out, call_to_action, frame

SECONDS = 2.0
BOX = pygame.Rect(560, 476, 800, 300)
LEAVING = (Button.UP, Button.DOWN, Button.LEFT, Button.RIGHT, Button.FIRE, Button.START, Button.BACK, Button.CLICK)


class LanguageName:
    """The name of the language, over the tiles, for `left` s more."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.left = 0.0

    def next(self) -> None:
        """Change to the next language and show its name."""
        words = self.context.words
        words.switch(words.following)
        self.context.settings.language = words.language
        self.context.sounds.play("accept")
        self.left = SECONDS

    def left_by(self, event: InputEvent) -> bool:
        """Take the name away by a direction, FIRE or a click, which have no other effect then; true if so."""
        leaves = self.left > 0.0 and event.button in LEAVING
        if leaves:
            self.left = 0.0
            self.context.sounds.play("move")
        return leaves

    def update(self, seconds: float) -> None:
        self.left = max(0.0, self.left - seconds)

    def draw(self, screen: pygame.Surface) -> None:
        if not self.left:
            return
        words, label = self.context.words, self.context.controls.label(None, Button.Y)
        black_out(screen, BOX)
        frame(*BOX.size).draw(screen, *BOX.topleft)
        word(NAMES[words.language], TITLE + 24, FOCUS).draw(screen, BOX.centerx, BOX.y + 112)
        sentence = words("title.again", button="{button}" if label else "").strip()
        call_to_action(sentence, words.key_name(label), LABEL).draw(screen, BOX.centerx, BOX.bottom - 84)
