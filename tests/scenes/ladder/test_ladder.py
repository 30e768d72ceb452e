"""The Ladder on the screen: played from the choice to the letters, offers, ends by hand, pulled pads, damaged files."""

from pathlib import Path

import pytest

from pigaming_app.ai.game_ai import LEVELS
from pigaming_app.events import climb_files
from pigaming_app.events.ladder import Climb, table_of, worth
from pigaming_app.events.league_files import Ratings, Strength, file_name
from pigaming_app.games.registry import OURS, games
from pigaming_app.scenes.flow.scene import Swap
from pigaming_app.scenes.ladder.choice import LadderChoice
from pigaming_app.scenes.ladder.climber import Climber
from pigaming_app.scenes.ladder.climbers import Climbers
from pigaming_app.scenes.ladder.rungs import LadderPage, after_match
from pigaming_app.scenes.ladder.strengths import Strengths, shown
from pigaming_app.scenes.ladder.summit import Summit
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.initials import Initials
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.settings import folders
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade) -> None:
    arcade.open(LadderChoice(arcade.context, "pitanks"))


def saved() -> list[Climb]:
    return [entry.climb for entry in climb_files.saved_climbs(folders().data)[0]]


def begin(arcade: Arcade, device: Device = KEYS[0]) -> MatchScene:
    """From the ladder into the match."""
    arcade.shown(LadderPage)
    arcade.wait(LadderPage.lockout + 0.1)
    arcade.press(Button.FIRE, device=device)
    return arcade.shown(MatchScene)


def play(arcade: Arcade, own: int, other: int, device: Device = KEYS[0]) -> None:
    """A match of PiTanks with this score, and the moments after it."""
    begin(arcade, device)
    arcade.finish(own, other)
    arcade.skip_moments(device)


def play_unseen(arcade: Arcade, own: int, other: int) -> None:
    """The same without pictures and the winner's moment."""
    climber, scene = page(arcade).climber, begin(arcade)
    state = scene.match.state
    state.robots[0].score, state.robots[1].score = own, other
    state.rules.ticks = state.tick + 1
    while not scene.match.over:
        scene.match.tick()
    arcade.stack.apply(Swap(after_match(climber, scene)))


def page(arcade: Arcade) -> LadderPage:
    return arcade.shown(LadderPage)


def test_a_climb_from_the_first_rung_to_the_letters_and_the_table(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    play(arcade, 5, 0)
    assert (page(arcade).said, page(arcade).climb) == ("won", Climb("pitanks", wins=1))
    assert saved() == [Climb("pitanks", wins=1)]
    play_unseen(arcade, 5, 0)
    assert (page(arcade).said, page(arcade).climb.rung) == ("up", 2)
    arcade.wait(LadderPage.lockout + 0.1)
    page(arcade).climber = Climber(Climb("pitanks", rung=5, wins=1, beaten=4, lost=2), page(arcade).climber.number)
    play(arcade, 5, 0)
    assert arcade.shown(Summit).climb.at_top
    arcade.wait(Summit.lockout + 0.1, draw=True)
    arcade.press(Button.FIRE)
    arcade.shown(Initials)
    arcade.wait(0.6)
    arcade.press(Button.DOWN, Button.START)
    table = arcade.shown(Climbers)
    assert [(row.initials, row.score) for row in table.fresh] == [("BAA", worth(Climb("pitanks", beaten=5, lost=2)))]
    assert saved() == [], "it has ended"
    arcade.wait(0.5)
    arcade.press(Button.FIRE)
    assert "BAA ★★★★★" in arcade.shown(LadderChoice)._line("pitanks")


def test_a_climb_in_football_is_one_against_one_on_all_pitches(arcade: Arcade) -> None:
    """By the rules of the party: the next goal decides a level match. A loss by three goals is a clear one."""
    arcade.open(LadderPage(arcade.context, Climber(Climb("football"), 1, KEYS[0])))
    for own, other, said, clear in ((3, 0, "won", 0), (2, 1, "up", 0), (1, 3, "lost", 0), (1, 4, "again", 1)):
        climber, scene = page(arcade).climber, begin(arcade)
        state, setup = scene.match.state, scene.setup
        assert setup.arena == ("classic", "bumpers")[climber.climb.rung - 1]
        assert [bool(robot.present) for robot in state.robots] == [True, True, False, False]
        assert setup.seats[1].brain == f"level{climber.climb.rung}"
        state.robots[0].score = state.robots[1].score = 1
        state.tick = state.rules.ticks - 1
        scene.match.tick()
        assert (scene.match.over, state.golden_goal) == (0, 1)
        state.robots[0].score, state.robots[1].score = own, other
        scene.match.tick()
        assert scene.match.over
        arcade.stack.apply(Swap(after_match(climber, scene)))
        assert (page(arcade).said, page(arcade).climb.clear) == (said, clear)


def test_weaker_robots_are_offered_between_matches_and_shown_on_the_ladder(arcade: Arcade) -> None:
    arcade.open(LadderPage(arcade.context, Climber(Climb("pitanks", rung=3, beaten=2), 1, KEYS[0])))
    play_unseen(arcade, -5, 5)
    assert [spot.name for spot in page(arcade).focus.spots] == ["play", "stop"]
    play_unseen(arcade, -5, 5)
    assert [spot.name for spot in page(arcade).focus.spots] == ["play", "easier", "stop"]
    arcade.wait(LadderPage.lockout + 0.1)
    arcade.press(Button.DOWN)
    assert page(arcade)._shown().level == 2, "seen before it is chosen"
    arcade.press(Button.FIRE)
    assert page(arcade).climb.level == 2
    assert saved()[0].eased == (3,)
    assert begin(arcade).setup.seats[1].brain == "level2"


def test_a_match_ended_by_hand_is_lost_and_cannot_be_restarted(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    scene = begin(arcade)
    scene.opening.countdown.seconds_left = 0.05
    arcade.wait(1.0)
    arcade.press(Button.START)
    assert "restart" not in [spot.name for spot in arcade.shown(Pause).focus.spots]
    arcade.press(Button.UP, Button.FIRE, Button.FIRE)
    arcade.until(lambda: isinstance(arcade.stack.top, LadderPage))
    assert (page(arcade).said, page(arcade).climb.lost) == ("ended", 1)


def test_a_match_in_which_an_ai_drove_counts_for_nothing(arcade: Arcade) -> None:
    arcade.press(Button.FIRE)
    scene = begin(arcade)
    scene.opening.countdown.seconds_left = 0.05
    arcade.until(lambda: not scene.opening.countdown.locked)
    scene.drivers.assign(0, None)
    scene.drivers.assign(0, KEYS[2])
    scene.match.state.robots[0].score = 5
    scene.match.state.rules.ticks = scene.match.state.tick + 1
    arcade.until(lambda: isinstance(arcade.stack.top, LadderPage))
    assert (page(arcade).said, page(arcade).climb) == ("assisted", Climb("pitanks"))
    assert page(arcade).climber.device == KEYS[2], "whoever drove last goes on"


def test_only_the_climber_acts_until_the_pad_is_pulled(arcade: Arcade) -> None:
    pad, _ = arcade.plug()
    pad.tap("a")
    arcade.frame()
    mine = page(arcade).climber.device
    assert mine.kind == "pad"
    arcade.wait(LadderPage.lockout + 0.1)
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.shown(LadderPage)
    pad.unplug()
    arcade.wait(0.1)
    scene = begin(arcade, KEYS[1])
    assert scene.devices[0] == KEYS[1]


def test_a_climb_that_was_left_goes_on_and_one_that_ends_without_stars_is_gone(arcade: Arcade) -> None:
    climb_files.save(folders().data, 7, Climb("race", rung=2, beaten=1))
    climb_files.save(folders().data, 8, Climb("pitanks", wins=1))
    arcade.stack.scenes.pop()
    arcade.open(LadderChoice(arcade.context, "pitanks"))
    arcade.press(Button.FIRE)
    assert page(arcade).climb == Climb("pitanks", wins=1)
    assert [spot.name for spot in page(arcade).focus.spots] == ["play", "anew", "stop"]
    arcade.wait(LadderPage.lockout + 0.1)
    arcade.press(Button.UP, Button.FIRE)
    assert arcade.shown(LadderChoice).saved.keys() == {"race"}
    arcade.context.idle = 61.0
    arcade.frame()
    assert arcade.stack.top is arcade.title
    assert saved() == [Climb("race", rung=2, beaten=1)]


def refuse(path: Path, text: str) -> None:
    raise NotSaved(f"{path} was not saved: the disk is full.")


def test_a_damaged_file_is_told_in_one_line_and_a_full_disk_too(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folders().data).mkdir(parents=True, exist_ok=True)
    (folders().data / climb_files.FILE).write_bytes(b"\xff\xfe broken")
    choice = arcade.shown(LadderChoice)
    choice.on_enter()
    assert choice.message == arcade.context.words("ladder.damaged")
    arcade.shown(LadderChoice)
    monkeypatch.setattr(climb_files, "write_with_backup", refuse)
    arcade.open(LadderPage(arcade.context, Climber(Climb("pitanks"), 1, KEYS[0])))
    play_unseen(arcade, 5, 0)
    assert page(arcade).message
    assert page(arcade).climb.wins == 1, "the climb goes on"


def test_the_table_steps_through_the_games_and_a_mouse_drives_by_keyboard(arcade: Arcade) -> None:
    arcade.context.scores.add(table_of("all"), "ANA", worth(Climb("all", beaten=3, lost=4)))
    arcade.press(Button.Y)
    for game in ("factory", "race", "football", "all", "pitanks"):
        arcade.press(Button.RIGHT)
        assert arcade.shown(Climbers).game == game
    for button, game in ((Button.LEFT, "all"), (Button.RIGHT, "pitanks")):
        arcade.click(*arcade.shown(Climbers).arrows[button])
        assert arcade.shown(Climbers).game == game
    arcade.wait(0.5)
    arcade.press(Button.BACK)
    choice = arcade.shown(LadderChoice)
    arcade.click(*choice.focus.rect("all").center)
    assert page(arcade).climber.device == KEYS[0]
    assert page(arcade).climb.next_game == "pitanks"


def test_the_ratings_of_each_game_are_one_press_away_and_the_users_own_come_first(arcade: Arcade) -> None:
    arcade.press(Button.X)
    for game in (*games(), "pitanks"):
        page = arcade.shown(Strengths)
        assert page.game == game
        assert bool(page.ratings) == (game in (*OURS, "football"))
        arcade.wait(1.0)
        arcade.press(Button.RIGHT)
    folders().data.mkdir(parents=True, exist_ok=True)
    (folders().data / file_name("race")).write_text("{}", encoding="utf-8")
    arcade.press(Button.RIGHT)
    page = arcade.shown(Strengths)
    assert page.message
    assert page.ratings, "the shipped ones"
    arcade.press(Button.BACK)
    arcade.shown(LadderChoice)


def test_of_many_ais_the_page_shows_all_levels_and_the_best_others() -> None:
    names = [*(f"other{i}" for i in range(20)), *LEVELS]
    rated = tuple(Strength(name, 500.0 - 10.0 * i, (0.0, 600.0)) for i, name in enumerate(names))
    assert [row.brain for row in shown(Ratings("race", "party", 1, rated))] == [*names[:7], *LEVELS]
