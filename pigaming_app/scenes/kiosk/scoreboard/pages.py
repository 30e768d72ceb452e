"""The pages of the second screen."""

from itertools import chain

from pigaming_app.scenes.features.board_page import BoardPage
from pigaming_app.scenes.features.registry import features
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.kiosk.scoreboard.score_page import ScorePage
from pigaming_app.scenes.kiosk.scoreboard.standby_page import StandbyPage


class Pages:
    """`pages`: in the order of the F2 key, those of features last; `chosen`: the name of one."""

    def __init__(self, context: Context) -> None:
        self.chosen = ScorePage.name
        offers = [feature.board_pages(context) for feature in features() if feature.board_pages]
        self.pages: list[BoardPage] = [
            StandbyPage(context),
            ScorePage(context),
            *chain.from_iterable(offers),
        ]
