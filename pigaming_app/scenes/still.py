"""One picture of a match, without a window: for the command line and for tests."""

from pathlib import Path

import pygame

from pigaming_app.games.match import Match
from pigaming_app.scenes.views import VIEWS
from pigaming_app.scenes.words import Words
from pigaming_app.settings import Settings

SIZE = (1920, 1080)


def picture(match: Match, path: Path) -> None:
    """Save the match as it stands as a PNG file. Raises OSError."""
    pygame.display.init()
    pygame.font.init()
    pygame.display.set_mode(SIZE)
    screen = pygame.Surface(SIZE)
    players = [seat.brain for seat in match.setup.seats]
    view = VIEWS[match.setup.game](match.arena, match.state, players, Settings(), Words("en"))
    view.watch(match.state)
    view.draw(screen, match.state, 1.0, 0.0)
    try:
        pygame.image.save(screen, str(path))
    except pygame.error as reason:
        raise OSError(str(reason)) from reason
