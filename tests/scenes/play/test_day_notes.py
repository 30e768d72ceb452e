"""Every match is noted in the day log exactly once: at its end, when it is left, and when it has several rounds."""

from datetime import date
from pathlib import Path

import pytest

from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.scene import Home
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.storage.day_log import DayLog, PlayedMatch, read_day
from tests.scenes.arcade import KEYS, Arcade, setup

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade, tmp_path: Path) -> None:
    arcade.context.day_log = DayLog(tmp_path)


def notes(folder: Path) -> list[PlayedMatch]:
    records, skipped = read_day(folder, date.today())
    assert skipped == 0
    return [record for record in records if isinstance(record, PlayedMatch)]


def test_a_match_is_noted_as_soon_as_it_is_over(arcade: Arcade, tmp_path: Path) -> None:
    scene = arcade.open(MatchScene(arcade.context, setup("human level1 level1 off", minutes=0.05), [KEYS[0]]))
    arcade.until(lambda: scene.ending.begun)
    (found,) = notes(tmp_path)
    assert (found.game, found.people, found.ais, found.robots, found.complete) == ("pitanks", 1, 2, "simulated", True)
    assert found.seconds == pytest.approx(3.0, abs=0.05)
    arcade.stack.apply(Home())
    assert len(notes(tmp_path)) == 1


def test_a_match_that_is_left_is_noted_as_such(arcade: Arcade, tmp_path: Path) -> None:
    scene = arcade.open(MatchScene(arcade.context, setup("level1 level1 off off")))
    arcade.stack.apply(Home())
    assert notes(tmp_path) == []  # it had not begun
    scene = arcade.open(MatchScene(arcade.context, setup("level1 level1 off off")))
    arcade.until(lambda: scene.match.state.tick > 10)
    arcade.stack.apply(Home())
    (found,) = notes(tmp_path)
    assert not found.complete


def test_three_rounds_are_one_match(arcade: Arcade, tmp_path: Path) -> None:
    rounds = Rounds(3)
    arcade.open(MatchScene(arcade.context, setup("level1 level1 off off", minutes=0.02), rounds=rounds))
    arcade.until(lambda: rounds.done and bool(notes(tmp_path)), 120.0)
    (found,) = notes(tmp_path)
    assert found.seconds == pytest.approx(sum(outcome.seconds for outcome in rounds.outcomes), abs=0.05)
