"""The pages of the second screen that the arcade always has."""

from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.scoreboard.camera_page import CameraPage
from pigaming_app.scenes.scoreboard.event_page import EventPage
from pigaming_app.scenes.scoreboard.score_page import ScorePage
from pigaming_app.scenes.scoreboard.standby_page import StandbyPage


def complete(context: Context) -> None:
    """Add them to the pages of the second screen, round any others, unless they are there."""
    pages = context.board_pages
    if not any(page.name == StandbyPage.name for page in pages):
        pages[:] = [StandbyPage(context), ScorePage(context), EventPage(context), *pages, CameraPage()]
