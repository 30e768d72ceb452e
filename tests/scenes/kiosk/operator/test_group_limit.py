"""A group's time: from the title to the title, with a countdown, and never in the middle of a match."""

from pathlib import Path

import pytest

from pigaming_app.scenes.attract.scene import Attract
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.events.running import RunningEvent
from pigaming_app.scenes.events.setup.draft import Draft
from pigaming_app.scenes.events.setup.page import SetupPage
from pigaming_app.scenes.flow.scene import Home, Scene
from pigaming_app.scenes.kiosk.operator.group_limit import FAREWELL, WARNED, GroupLimit
from pigaming_app.scenes.play.scene import MatchScene
from tests.scenes.arcade import Arcade, Floor, setup
from tests.scenes.events.drawn import an_event


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.context.settings.group_minutes = 5


def test_the_title_returns_after_a_countdown(arcade: Arcade) -> None:
    limit, scenes = GroupLimit(arcade.context), [Floor(), Floor()]
    assert limit.update(300.0 - WARNED - 1, scenes) is None
    assert limit.sentence == ""
    limit.update(2.0, scenes)
    assert "60" in limit.sentence
    limit.update(11.0, scenes)
    assert "50" in limit.sentence
    assert limit.update(WARNED - 11.0, scenes) is None
    assert str(round(FAREWELL)) in limit.sentence
    assert limit.update(FAREWELL - 1.0, scenes) is None
    assert limit.update(1.5, scenes) == Home()
    assert limit.update(1.0, scenes[:1]) is None
    assert (limit.seconds, limit.farewell) == (0.0, None)


def test_a_match_is_played_to_its_end(arcade: Arcade) -> None:
    limit = GroupLimit(arcade.context)
    match = MatchScene(arcade.context, setup("level1 level1 off off"))
    after: list[Scene] = [Floor(), Floor()]
    playing = [*after, match]
    for _ in range(100):
        assert limit.update(10.0, playing) is None
    assert limit.sentence == arcade.context.words("operator.last_match")
    assert limit.update(1.0, after) is None
    assert limit.update(FAREWELL + 1.0, after) == Home()


def test_another_match_does_not_stop_the_countdown(arcade: Arcade) -> None:
    limit = GroupLimit(arcade.context)
    match = MatchScene(arcade.context, setup("level1 level1 off off"))
    limit.update(301.0, [Floor(), Floor()])
    assert limit.update(FAREWELL / 2, [Floor(), match]) is None
    assert limit.update(FAREWELL / 2, [Floor(), match]) == Home()


def test_attract_mode_takes_no_time(arcade: Arcade) -> None:
    limit = GroupLimit(arcade.context)
    assert limit.update(900.0, [Floor(), Attract(arcade.context)]) is None
    assert limit.seconds == 0.0


def test_an_event_has_no_limit(arcade: Arcade) -> None:
    limit, match = GroupLimit(arcade.context), MatchScene(arcade.context, setup("level1 level1 off off"))
    limit.update(299.0, [Floor(), Floor()])
    drafting: list[Scene] = [Floor(), Floor(), SetupPage(arcade.context, Draft(), lambda draft: ""), Floor()]
    assert limit.update(900.0, drafting) is None
    assert limit.sentence == ""
    assert limit.left == 1.0, "a group that goes back has the rest of its time"
    following = NextMatch(arcade.context, RunningEvent(Path("cup.json"), an_event()))
    for scene in (following, match, Floor(), following):
        for _ in range(3):
            assert limit.update(200.0, [Floor(), scene]) is None
            assert limit.sentence == ""
    limit.update(1.0, [Floor()])
    assert limit.update(301.0, [Floor(), Floor()]) is None
    assert limit.farewell == FAREWELL, "the next group has one again"


def test_no_limit_is_the_default(arcade: Arcade) -> None:
    arcade.context.settings.group_minutes = 0
    limit = GroupLimit(arcade.context)
    assert limit.update(1e6, [Floor(), Floor()]) is None
    assert limit.sentence == ""


def test_a_longer_limit_ends_the_countdown(arcade: Arcade) -> None:
    limit = GroupLimit(arcade.context)
    limit.update(301.0, [Floor(), Floor()])
    arcade.context.settings.group_minutes = 10
    assert limit.update(1.0, [Floor(), Floor()]) is None
    assert limit.farewell is None
