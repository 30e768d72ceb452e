"""The results: winner, rematch vote, initials."""

from dataclasses import replace
from datetime import datetime
from typing import Any

import pygame
import pytest

from pigaming_app.games.game import Outcome, Row, Setup
from pigaming_app.scenes.lobby.game_choice import GameChoice
from pigaming_app.scenes.lobby.scene import game_choice
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.high_scores import HighScores
from pigaming_app.scenes.results.initials import SECONDS, Initials
from pigaming_app.scenes.results.plot import Curve, LapPlot, scale, spread, team_curve, time_marks
from pigaming_app.scenes.results.rematch_vote import PATIENCE
from pigaming_app.scenes.results.scene import IDLE, Results
from pigaming_app.storage.scores import Scores, ScoreTable
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button, Device, InputEvent
from pigaming_app.ui.widgets.word_filter import HARMLESS, is_rude
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import lit_boxes

ALONE = ScoreTable("pitanks", "classic", "points", rules="plain", length=1, people=1)
LAP = ScoreTable("race", "classic", "lap", True, "standard", 3, 1)
RACE = replace(LAP, achievement="race")
LONG = 4.0  # s after which the page is complete and accepts input


def outcome(scores: dict[int, int], winners: tuple[int, ...], teams: tuple[int, ...] = (0, 1, 2, 3)) -> Outcome:
    """A match of one minute with these scores."""
    sums = {team: sum(scores[seat] for seat in scores if teams[seat] == team) for team in teams}
    seats = sorted(scores, key=lambda seat: (-sums[teams[seat]], teams[seat], -scores[seat]))
    facts = {"hits": 9, "taken": 12, "aim": 0.617}
    rows = [Row(seat, teams[seat], 1, scores[seat], facts, {"points": scores[seat]}, ()) for seat in seats]
    rows = [replace(row, place=1 + sum(sums[teams[seat]] > sums[row.team] for seat in seats)) for row in rows]
    series = tuple(((0.0, 0), (20.0, scores[seat])) if seat in scores else ((0.0, 0),) for seat in range(4))
    return Outcome(tuple(rows), winners, series, 60.0)


def results_of(arcade: Arcade, match: Setup, ended: Outcome, finished: bool = True, **more: Any) -> Results:
    """The results of a match whose people sat at the keyboard."""
    devices = [KEYS[i] if seat.brain == "human" else None for i, seat in enumerate(match.seats)]
    again = MatchScene(arcade.context, match, devices).sequel.rematch
    return Results(arcade.context, ended, match, devices, again, finished, game_choice=game_choice, **more)


def opened(arcade: Arcade, brains: str, ended: Outcome, finished: bool = True, teams=(0, 1, 2, 3)) -> Results:
    return arcade.open(results_of(arcade, setup(brains, 1.0, teams), ended, finished))


LOST = outcome({0: -4, 1: -1, 2: 5}, (2,))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(
    ("brains", "scores", "winners", "teams", "finished"),
    [
        ("human human level5 human", {0: 12, 1: -3, 2: 7, 3: 5}, (0,), (0, 1, 2, 3), True),
        ("human level3 off off", {0: -14, 1: 4}, (1,), (0, 1, 2, 3), True),
        ("human off human level1", {0: 3, 2: 3, 3: -6}, (), (0, 1, 2, 3), True),
        ("human human human level1", {0: -3, 1: -2, 2: 9, 3: -4}, (0, 2), (0, 1, 0, 1), True),
        ("human human human human", {0: 60, 1: -20, 2: -20, 3: -20}, (0,), (0, 1, 1, 1), True),
        ("human human off off", {0: 0, 1: 0}, (), (0, 1, 2, 3), False),
    ],
)
def test_every_ending_is_shown(arcade: Arcade, brains, scores, winners, teams, finished):
    opened(arcade, brains, outcome(scores, winners, teams), finished, teams)
    arcade.wait(2.4, fps=10, draw=True)
    whole = pygame.Rect(0, 0, 1920, 1080)
    edge = [box for box in lit_boxes(arcade.screen) if box.left < 20 or box.right > whole.right - 20]
    assert not edge, "a widget is clipped at the edge"


def test_players_still_firing_do_not_skip_the_results(arcade: Arcade) -> None:
    results = opened(arcade, "human human level5 off", LOST)
    for _ in range(10):
        arcade.press(Button.FIRE, Button.BACK, Button.START, Button.X)
        arcade.frame(0.1)
    assert arcade.stack.top is results
    assert not results.ballot.votes


def test_a_rematch_wants_everyone_and_brings_new_luck(arcade: Arcade) -> None:
    results = opened(arcade, "human human level5 off", LOST)
    arcade.wait(LONG)
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.frame()
    assert arcade.shown(Results) is results
    arcade.press(Button.FIRE, device=KEYS[3])
    arcade.frame()
    assert arcade.stack.top is results, "a free key cluster has no vote"
    arcade.press(Button.FIRE, device=KEYS[0])
    arcade.frame()
    match = arcade.shown(MatchScene)
    assert match.devices == [KEYS[0], KEYS[1], None, None]
    assert replace(match.setup, seed=0) == replace(results.setup, seed=0)
    assert match.setup.seed != results.setup.seed
    assert len(arcade.stack.scenes) == 3, "match setup is still below"


def test_start_waits_for_nobody(arcade: Arcade) -> None:
    opened(arcade, "human human level5 off", LOST)
    arcade.wait(LONG)
    arcade.press(Button.START, device=KEYS[1])
    assert arcade.shown(MatchScene).devices[:2] == [KEYS[0], KEYS[1]]


def test_an_absent_player_does_not_hold_up_the_rematch(arcade: Arcade) -> None:
    opened(arcade, "human human level5 off", LOST)
    arcade.wait(LONG)
    arcade.press(Button.FIRE, device=KEYS[0])
    waited = arcade.until(lambda: isinstance(arcade.stack.top, MatchScene))
    assert waited == pytest.approx(PATIENCE, abs=0.2)
    assert arcade.shown(MatchScene).devices == [KEYS[0], None, None, None]


def test_a_free_pad_votes_for_a_seat_whose_pad_has_gone(arcade: Arcade) -> None:
    results = opened(arcade, "human human level5 off", LOST)
    results.ballot.devices[1] = Device("pad", 999)
    arcade.wait(LONG)
    arcade.press(Button.FIRE, device=KEYS[0])
    arcade.press(Button.FIRE, device=KEYS[2])
    arcade.frame()
    assert arcade.shown(MatchScene).devices[:2] == [KEYS[0], KEYS[2]]


def test_other_ways_on(arcade: Arcade) -> None:
    opened(arcade, "human human level5 off", LOST)
    arcade.wait(LONG)
    arcade.press(Button.Y)
    arcade.wait(1.0, draw=True)
    arcade.shown(HighScores)
    arcade.press(Button.FIRE)
    arcade.shown(Results)
    arcade.press(Button.X)
    arcade.shown(GameChoice)
    arcade.press(Button.BACK)
    arcade.shown(Results)
    opened(arcade, "human human level5 off", LOST)
    arcade.until(lambda: arcade.stack.top is arcade.title, IDLE + 1.0)


def test_the_prompts_can_be_clicked(arcade: Arcade) -> None:
    results = opened(arcade, "human human level5 off", LOST)
    arcade.wait(LONG)
    arcade.click(960, 500)
    assert arcade.stack.top is results
    arcade.click(300, 980)
    arcade.shown(MatchScene)


def test_all_enter_three_letters_at_once_each_on_the_own_device(arcade: Arcade) -> None:
    results = opened(arcade, "human human level5 human", outcome({0: 4, 1: 9, 2: 12, 3: -7}, (2,)))
    page = arcade.reach(Initials)
    assert [claim.seat for claim in page.claims] == [0, 1], "an AI and a loss do not count"
    arcade.press(Button.DOWN, device=KEYS[1])
    arcade.wait(1.0)
    for button in (Button.UP, Button.FIRE, Button.DOWN, Button.DOWN, Button.FIRE, Button.BACK, Button.FIRE):
        arcade.press(button, device=KEYS[1])
        arcade.press(Button.DOWN, device=KEYS[3])  # the other players have no effect
        arcade.press(Button.START, device=KEYS[2])
        arcade.frame(draw=True)
    arcade.press(Button.DOWN, device=KEYS[0])
    assert [page.spellings[KEYS[seat]].spelled for seat in (0, 1)] == ["BAA", "ZCA"]
    arcade.press(Button.START, device=KEYS[0])
    assert arcade.shown(Initials) is page, "START of one player does not accept the letters of another"
    arcade.press(Button.FIRE, device=KEYS[1])
    arcade.wait(2.0, draw=True)
    assert [row.initials for row in arcade.shown(HighScores).fresh] == ["BAA", "ZCA"]
    arcade.press(Button.FIRE)
    assert arcade.shown(Results) is results
    saved, said = Scores.load(folders().data)
    assert not said
    assert [(row.initials, row.score) for row in saved.best(replace(ALONE, people=3))] == [("ZCA", 9), ("BAA", 4)]


def test_after_ten_seconds_letters_are_taken_as_they_are_but_not_those_of_somebody_who_only_fired(
    arcade: Arcade,
) -> None:
    opened(arcade, "human human human off", outcome({0: 4, 1: 9, 2: 3}, (1,)))
    arcade.until(lambda: isinstance(arcade.stack.top, Initials))
    arcade.wait(1.0)
    arcade.press(Button.UP, device=KEYS[0])
    arcade.press(*[Button.FIRE] * 30, device=KEYS[1])
    waited = 1.0 + arcade.until(lambda: isinstance(arcade.stack.top, HighScores))
    assert waited == pytest.approx(SECONDS, abs=0.2)
    assert [row.initials for row in arcade.shown(HighScores).fresh] == ["ZAA"]


def test_rude_words_and_their_look_alikes_are_refused(arcade: Arcade) -> None:
    assert all(
        map(is_rude, ("ASS", "AZZ", "FUK", "FVK", "FUC", "KVM", "DYK", "PUT", "CRL", "KRL", "FDP", "QUS", "TLT"))
    )
    assert not any(map(is_rude, ("AAA", "ANA", "BOB", "JOE", "MAX", "RUI", "ZOE", "LIS", "EVA", HARMLESS)))
    opened(arcade, "human off off human", outcome({0: 4, 3: 3}, (0,)))
    arcade.until(lambda: isinstance(arcade.stack.top, Initials))
    arcade.wait(1.0)
    for device in (KEYS[0], KEYS[3]):
        arcade.press(Button.RIGHT, *[Button.UP] * 8, Button.RIGHT, *[Button.DOWN] * 18, Button.START, device=device)
    page = arcade.shown(Initials)
    assert page.spellings[KEYS[0]].refused
    assert not page.spellings[KEYS[0]].done
    arcade.press(Button.UP, Button.FIRE, device=KEYS[0])
    assert [row.initials for row in arcade.reach(HighScores).fresh] == ["ASR", HARMLESS]


def test_only_the_top_eight_of_today_or_ever_are_asked_the_match_itself_included(arcade: Arcade) -> None:
    for score in (20, 19, 18, 17, 16, 15, 14):
        arcade.context.scores.add(replace(ALONE, people=3), "ABC", score)
    opened(arcade, "human human human off", outcome({0: 4, 1: 9, 2: 3}, (1,)))
    assert [(claim.seat, claim.places) for claim in arcade.reach(Initials).claims] == [
        (1, ((("results.today", 8), ("results.ever", 8)),))
    ]


def test_eight_better_ones_long_ago_leave_todays_table(arcade: Arcade) -> None:
    long_ago = datetime(2020, 5, 1, 12)
    for _ in range(9):
        arcade.context.scores.add(replace(ALONE, people=2), "ABC", 20, long_ago)
    opened(arcade, "human off off human", outcome({0: 4, 3: 5}, (3,)))
    assert [claim.places for claim in arcade.reach(Initials).claims] == [
        ((("results.today", 2),),),
        ((("results.today", 1),),),
    ]


def test_a_seat_for_which_an_ai_drove_claims_nothing(arcade: Arcade) -> None:
    ended = outcome({0: 4, 1: 9}, (1,))
    results = results_of(arcade, setup("human human off off", 1.0), ended, ai_assisted={1})
    assert [claim.seat for claim in results.claims] == [0]


def test_enter_counts_for_nobody_while_two_players_share_a_keyboard(arcade: Arcade) -> None:
    opened(arcade, "human human off off", outcome({0: 4, 1: 9}, (1,)))
    arcade.until(lambda: isinstance(arcade.stack.top, Initials))
    arcade.wait(1.0)
    arcade.press(Button.UP, device=KEYS[1])
    arcade.stack.top.handle(InputEvent(Button.START, KEYS[1], among=(KEYS[1], KEYS[0], KEYS[2], KEYS[3])))
    assert not any(spelling.done for spelling in arcade.shown(Initials).spellings.values())


def test_nobody_chooses_and_nothing_is_written(arcade: Arcade) -> None:
    results = opened(arcade, "human level5 off off", outcome({0: 4, 1: -4}, (0,)))
    arcade.until(lambda: isinstance(arcade.stack.top, Initials))
    arcade.until(lambda: arcade.stack.top is results)
    assert not arcade.context.scores.tables()


@pytest.mark.parametrize("finished", [False, True])
def test_a_match_that_was_broken_off_and_a_low_score_are_no_records(arcade: Arcade, finished: bool) -> None:
    for _ in range(10 * finished):
        arcade.context.scores.add(ALONE, "ABC", 20)
    results = opened(arcade, "human level5 off off", outcome({0: 4, 1: -4}, (0,)), finished=finished)
    arcade.wait(5.0)
    assert arcade.stack.top is results


def test_axes_hold_every_score_and_zero() -> None:
    assert scale(-3, 12) == (-5, 15, 5)
    assert scale(0, 0) == (0, 2, 1)
    assert scale(-14, 0) == (-15, 0, 5)
    for low, high in ((-130, 7), (0, 1), (-1, 0), (-40, 61)):
        bottom, top, step = scale(low, high)
        assert bottom <= low <= 0 <= high <= top
        assert (top - bottom) // step <= 6


def test_ticks_of_the_time_axis() -> None:
    assert time_marks(180.0) == [0, 60, 120, 180]
    assert time_marks(60.0) == [0, 15, 30, 45, 60]
    assert time_marks(6.0) == [0, 2, 4, 6]


def test_badges_do_not_overlap_and_stay_on_the_page() -> None:
    assert spread([100, 110, 500], 54, 600) == [100, 154, 500]
    assert spread([590, 110, 595], 54, 600) == [546, 110, 600]


def test_a_team_is_the_sum_of_its_robots() -> None:
    curve = team_curve((0, 2), [((0.0, 0), (3.0, 1)), ((0.0, 0), (2.0, -1), (5.0, -2))])
    assert curve.series[-3:] == ((2.0, -1), (3.0, 0), (5.0, -1))


def race(arcade: Arcade, lap: int, whole: int) -> Results:
    """A race of three laps on the classic track, won by player 1, with best lap and total time in ms."""
    match = setup_of("race", "human level5", "classic", 10, 3, goal=3)
    facts = {"laps": 3, "best": lap / 1000.0, "total": whole / 1000.0}
    rows = [
        Row(0, 0, 1, 3, facts, {"lap": lap, "race": whole}, (lap / 1000.0, 12.0, 11.5)),
        Row(1, 1, 2, 2, facts, {"lap": lap + 500, "race": 0}, (12.5, 13.0)),
    ]
    ended = Outcome(tuple(rows), (0,), (((0.0, 0), (30.0, 3)), ((0.0, 0), (30.0, 2)), ((0.0, 0),), ((0.0, 0),)), 60.0)
    return arcade.open(results_of(arcade, match, ended))


def test_three_letters_stand_for_the_best_lap_and_the_best_race(arcade: Arcade) -> None:
    race(arcade, 9_870, 30_120)
    [claim] = arcade.reach(Initials).claims
    assert (claim.seat, [(table.achievement, value) for table, value in claim.achievements]) == (
        0,
        [("lap", 9_870), ("race", 30_120)],
    )
    arcade.wait(1.0)
    arcade.press(Button.START, device=KEYS[0])
    arcade.wait(2.0, draw=True)
    arcade.shown(HighScores)
    saved, said = Scores.load(folders().data)
    assert not said
    assert [row.score for row in saved.best(LAP)] == [9_870]
    assert [row.score for row in saved.best(RACE)] == [30_120]
    assert not saved.best(replace(RACE, length=5)), "five laps are another race"


def test_a_slow_race_with_a_fast_lap_claims_the_lap_alone(arcade: Arcade) -> None:
    for _ in range(10):
        arcade.context.scores.add(RACE, "ABC", 20_000)
    race(arcade, 9_870, 30_120)
    [claim] = arcade.reach(Initials).claims
    assert [table.achievement for table, _ in claim.achievements] == ["lap"]


def test_laps_are_plotted_from_near_the_best_on_and_the_best_is_ringed() -> None:
    curves = [Curve((0,), ((1.0, 9.87), (2.0, 12.0), (3.0, 11.5))), Curve((1,), ((1.0, 12.5),)), Curve((2,), ())]
    plot = LapPlot(100, 100, 800, 500, curves, 3)
    assert plot.low <= 9.87 < plot.low + plot.step, "the axis begins just below the best lap, not at 0"
    assert plot.high >= 12.5
    [(x, y)] = plot.marked()
    assert x == pytest.approx(plot.to_screen(1.0, 9.87)[0])
    assert y == pytest.approx(plot.to_screen(1.0, 9.87)[1], abs=5.0)
    assert [label for _, label in plot.marks()] == ["1", "2", "3"]
    assert len(plot.corners(curves[1].series)) == 2, "a single lap is a visible stroke"
    assert len(plot.heads(0.1)) == 0
    assert len(plot.heads(1.0)) == 2, "a driver without a lap has no line"
    assert LapPlot(100, 100, 800, 500, [Curve((0,), ())], 3).marked() == []


@pytest.mark.parametrize(("brain", "records"), [("level1", 0), ("idle", 0), ("classic", 0), ("level3", 1), ("q2", 1)])
def test_a_record_needs_an_opponent_no_weaker_than_normal(arcade: Arcade, brain: str, records: int) -> None:
    results = opened(arcade, f"human {brain} off off", outcome({0: 4, 1: -4}, (0,)))
    assert len(results.claims) == records
