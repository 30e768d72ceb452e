"""What networks need is fetched: a bar, what to do without it, and another try. It goes on when the page is left."""

from collections.abc import Callable

import pygame

from pigaming_app.scenes.flow.scene import Context, Pop, StackOperation
from pigaming_app.scenes.lab.background import BUILT, DONE, FETCHING, FOREIGN, RESTART, LabBackground
from pigaming_app.scenes.pages.page import Hints
from pigaming_app.scenes.pages.sheet import Sheet
from pigaming_app.scenes.play.pause import sheet_title
from pigaming_app.ui.draw import ALARM, FOCUS, ICE, STEEL, THIN, Color, cut_box
from pigaming_app.ui.draw.layers import Layer, paragraph
from pigaming_app.ui.input.events import Button, InputEvent
from pigaming_app.ui.widgets.dialog import HEAD, W, X

FINAL = (FETCHING, BUILT, FOREIGN, RESTART)  # states in which another try is of no use
ROOM, TEXT_Y, PITCH = W - 160, HEAD + 60, 64  # px: width of the sentences, middle of the first line, line pitch
BAR = pygame.Rect(X + 80, HEAD + 244, W - 160, 44)


class FetchPage(Sheet):
    """The page over `behind`. `ready` is called once everything is there."""

    idle, when_idle = 120.0, Pop()

    def __init__(self, context: Context, behind: Callable[[], pygame.Surface], ready: Callable[[], object]) -> None:
        super().__init__(context)
        self.lab_picture, self.ready = behind, ready
        self.fetch = context.shared(LabBackground).network_fetch
        self.fetch.start()

    @property
    def behind(self) -> pygame.Surface:
        return self.lab_picture()

    @property
    def state(self) -> str:
        """The state that is shown."""
        return FETCHING if self.fetch.state == DONE else self.fetch.state

    @property
    def color(self) -> Color:
        return ICE if self.state in (FETCHING, RESTART) else ALARM

    @property
    def look(self) -> tuple[str, str]:
        return self.context.words.language, self.state

    @property
    def hints(self) -> Hints:
        again = [(Button.FIRE, "lab.hint_again")] if self.state not in FINAL else []
        return [*again, (Button.BACK, "lab.hint_lab")]

    def press(self, event: InputEvent) -> StackOperation:
        """FIRE tries again after a failure."""
        if event.button in (Button.FIRE, Button.START) and self.state not in FINAL:
            self.context.sounds.play("accept")
            self.fetch.start()
        return None

    def advance(self, seconds: float) -> StackOperation:
        if self.fetch.state == DONE:
            self.context.sounds.play("win")
            self.ready()
            return Pop()
        return None

    def paint(self, screen: pygame.Surface) -> None:
        """Draw the sentences, and the progress."""
        state, words = self.state, self.context.words
        for i, line in enumerate(paragraph(words(f"lab.fetch_{state}"), ROOM, 3)):
            line.draw(screen, X + 80, TEXT_Y + PITCH * i)
        if state == FETCHING:
            pygame.draw.rect(screen, FOCUS, (BAR.x + 8, BAR.y + 8, round(self.fetch.share * (BAR.w - 16)), BAR.h - 16))

    def paint_sheet(self, layer: Layer) -> None:
        state, words = self.state, self.context.words
        sheet_title(layer, None, words("lab.fetch_title"), self.color)
        if state == FETCHING:
            layer.glow.line(cut_box(BAR.x, BAR.y, BAR.w, BAR.h, 10), STEEL, THIN, True)
