"""Screenshot of a match without a window, for the command line and tests."""

from pathlib import Path

import pygame

from pigaming_app.games.match import Match
from pigaming_app.scenes.views.registry import SCREENS
from pigaming_app.sim.world import DT
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.png import png_of

SIZE = (1920, 1080)


class Screenshot:
    """Renders a match to a file; watching some ticks first makes shots and treads visible."""

    def __init__(self, match: Match) -> None:
        pygame.display.init()
        pygame.font.init()
        pygame.display.set_mode(SIZE)
        self.match, self.screen = match, pygame.Surface(SIZE)
        players = [seat.brain for seat in match.setup.seats]
        self.view = SCREENS[match.setup.game].view(match.arena, match.state, players, Settings(), Words("en"))

    def watch(self) -> None:
        """Record the tick just played."""
        self.view.watch(self.match.state)
        self.view.draw(self.screen, self.match.state, 1.0, DT)

    def pixels(self, seconds: float) -> bytes:
        """The current state of the match, `seconds` after the last picture.

        Rows of pixels from the top, three bytes each: red, green, blue.
        """
        self.view.draw(self.screen, self.match.state, 1.0, seconds)
        return pygame.image.tobytes(self.screen, "RGB")

    def picture(self, path: Path) -> None:
        """Save the current state of the match as a PNG file. Raises NotSaved."""
        self.view.draw(self.screen, self.match.state, 1.0, 0.0)
        write_atomic(path, png_of(self.screen))
