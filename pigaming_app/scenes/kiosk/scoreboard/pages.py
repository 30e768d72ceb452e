"""The pages of the second screen."""

from functools import cached_property
from itertools import chain

from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.features.registry import features
from pigaming_app.scenes.flow.scene import Context

FIRST = "scores"  # name of the score page


class Pages:
    """The pages, made at first use, and the name of the chosen one."""

    def __init__(self, context: Context) -> None:
        self.context, self.chosen = context, FIRST

    @cached_property
    def pages(self) -> list[BoardPage]:
        """In the order of the F2 key, those of features last."""
        from pigaming_app.scenes.kiosk.scoreboard.score_page import ScorePage  # late: the title does not wait for these
        from pigaming_app.scenes.kiosk.scoreboard.standby_page import StandbyPage

        offers = [feature.board_pages(self.context) for feature in features() if feature.board_pages]
        return [StandbyPage(self.context), ScorePage(self.context), *chain.from_iterable(offers)]
