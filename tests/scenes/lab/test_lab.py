"""The Lab: training, knobs, challenge matches, and training resumed afterwards."""

import gc
import weakref
from itertools import combinations
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pygame
import pytest

from pigaming_app.ai.qlearning.recipe import RECIPES
from pigaming_app.ai.reward_quantities import QUANTITIES
from pigaming_app.scenes.brain.rose import PETALS
from pigaming_app.scenes.flow.scene import Home, Pop, Stack, StackOperation
from pigaming_app.scenes.lab import progress, scene
from pigaming_app.scenes.lab import trainer as trainer
from pigaming_app.scenes.lab import view as page
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.lab.layout import CURVE, KNOB_NAMES, MATCH, PLOT, SPEED
from pigaming_app.scenes.lab.learning_curve import Measure, room, smoothed
from pigaming_app.scenes.lab.pages.challenge import ROBOT, Challenge, ChallengeResult
from pigaming_app.scenes.lab.pages.compare_page import ComparePage
from pigaming_app.scenes.lab.pages.line_page import LinePage
from pigaming_app.scenes.lab.pages.menu import LabMenu
from pigaming_app.scenes.lab.scene import Lab
from pigaming_app.scenes.lab.sides import LabSide
from pigaming_app.scenes.lab.view import notice
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.title.scene import Title
from pigaming_app.sim.record import digest
from pigaming_app.ui.draw.layers import wrap_balanced
from pigaming_app.ui.draw.theme import BODY, text_width
from pigaming_app.ui.i18n import LANGUAGES, Words
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from pigaming_app.ui.widgets.button_prompts import ROOM, places
from tests.scenes.arcade import KEYS, Arcade
from tests.scenes.measuring import lit_boxes
from tests.ui.input.virtual_pad import VirtualPad

SAFE = pygame.Rect(96, 54, 1728, 972)


@pytest.fixture(autouse=True)
def _prepared(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "MATCHES", {True: 2, False: 2})
    monkeypatch.setattr(progress, "MINUTES", {True: 0.2, False: 0.2})
    arcade.open(Lab(arcade.context, fast=False))
    arcade.wait(0.5, fps=4)


def lab(arcade: Arcade) -> Lab:
    return arcade.shown(Lab)


def learn(arcade: Arcade, matches: int) -> None:
    """Train for some matches at full speed."""
    training = lab(arcade).table.training
    arcade.until(lambda: training.matches >= matches, 600.0)


def at_full_speed(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    """Full speed, with half a second per frame for interpreted training."""
    monkeypatch.setattr(trainer, "SLICE", 0.5)
    lab(arcade).table.speed = trainer.FASTEST


def test_from_the_title_into_the_lab_and_back_and_the_robot_is_still_there(arcade: Arcade) -> None:
    arcade.stack = Stack(Title(arcade.context))
    background = arcade.context.shared(LabBackground)
    background.lab = Lab(arcade.context, fast=False)
    for _ in range(2):
        title = arcade.shown(Title)
        title.focus.move_to("lab")
        arcade.press(Button.FIRE)
        assert lab(arcade) is background.lab
        arcade.wait(0.5)
        arcade.press(Button.BACK)
    assert lab_of(arcade).table.training.match.tick > 0
    assert lab_of(arcade).table.join()


@pytest.mark.parametrize("way", [Pop(), Home()], ids=["back", "home"])
def test_its_pictures_go_when_it_is_left(arcade: Arcade, way: StackOperation) -> None:
    here = lab(arcade)
    picture = weakref.ref(here.page)
    arcade.stack.apply(way)
    gc.collect()
    assert picture() is None
    arcade.open(here)
    arcade.wait(0.1, draw=True)
    assert lab(arcade).page


def lab_of(arcade: Arcade) -> Lab:
    arcade.shown(Title)
    scene = arcade.context.shared(LabBackground).lab
    assert isinstance(scene, Lab)
    return scene


def test_it_begins_with_an_empty_table_and_knows_nothing(controls: Controls, home: Path) -> None:
    fresh = Lab(Arcade(controls).context, fast=False)
    assert fresh.table.training.experiences == 0
    assert fresh.table.snapshot.knowing == 0.0
    fresh.on_enter()
    fresh.update(0.0)
    assert list(fresh.shown.signs) == ["unknown"] * PETALS
    assert fresh.shown.levels == [0] * PETALS


def test_while_it_is_watched_it_plays_in_real_time_and_ten_times_as_fast(arcade: Arcade) -> None:
    match = lab(arcade).table.training.match
    before = match.tick
    arcade.wait(1.0)
    assert match.tick - before == pytest.approx(50, abs=2)
    arcade.press(Button.Y)
    before = match.tick
    arcade.wait(1.0)
    assert match.tick - before == pytest.approx(500, abs=20)


@pytest.mark.long
def test_as_fast_as_it_can_it_learns_is_examined_and_has_a_plan(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    at_full_speed(arcade, monkeypatch)
    learn(arcade, 2)
    arcade.until(lambda: len(lab(arcade).table.progress.measures) >= 2, 600.0)
    arcade.wait(1.0)
    shown = lab(arcade).shown
    assert all(0.0 <= measure.share <= 1.0 for measure in shown.courses[0].measures)
    assert [measure.matches for measure in shown.courses[0].measures] == sorted(
        measure.matches for measure in shown.courses[0].measures
    )
    assert shown.knowing > 0.0
    assert any(shown.levels)
    assert sum(direction.seen for direction in lab(arcade).table.progress.plan if direction) > 1000


def test_painting_changes_nothing_of_what_is_learned(arcade: Arcade) -> None:
    table, match = lab(arcade).table.training.table, lab(arcade).table.training.match
    before = digest(table), digest(match)
    for _ in range(5):
        lab(arcade)
    assert (digest(table), digest(match)) == before


def test_a_knob_is_taken_turned_and_let_go(arcade: Arcade) -> None:
    here = lab(arcade)
    here.focus.move_to("still")
    arcade.press(Button.FIRE, *[Button.LEFT] * 3, Button.UP)
    assert here.table.recipe.still == -2.0
    assert lab(arcade).held == "still"
    arcade.press(Button.BACK)
    assert lab(arcade).held == "", "BACK releases the knob without leaving"
    arcade.press(Button.LEFT)
    assert here.table.recipe.still == -2.0
    arcade.frame()
    assert here.table.training.recipe.still == -2.0
    assert here.table.training.table.knobs.still == -2.0


def test_with_a_knob_in_hand_one_can_play_at_once(arcade: Arcade) -> None:
    lab(arcade).focus.move_to("hit")
    arcade.press(Button.FIRE, Button.X)
    arcade.shown(Challenge)


@pytest.mark.parametrize(("button", "end"), [(Button.RIGHT, 10.0), (Button.LEFT, -10.0)])
def test_a_knob_stops_at_its_ends(arcade: Arcade, button: Button, end: float) -> None:
    lab(arcade).focus.move_to("miss")
    arcade.press(Button.FIRE, *[button] * 25)
    assert lab(arcade).table.recipe.miss == end


def test_what_it_has_learned_stays_when_a_knob_is_turned(arcade: Arcade) -> None:
    before = lab(arcade).table.training.experiences
    lab(arcade).table.recipe = RECIPES[2]
    arcade.wait(0.5)
    assert lab(arcade).table.training.experiences > before > 0


def test_a_pad_reaches_everything(arcade: Arcade) -> None:
    here = lab(arcade)
    visited, ahead = {here.focus.name}, [here.focus.name]
    while ahead:
        start = ahead.pop()
        for button in (Button.DOWN, Button.LEFT, Button.UP, Button.RIGHT):
            here.focus.move_to(start)
            arcade.press(button)
            if here.focus.name not in visited:
                visited.add(here.focus.name)
                ahead.append(here.focus.name)
    assert visited == {"kind", "speed", "play", "sides", "line", *KNOB_NAMES}


def test_a_mouse_chooses_a_speed_and_turns_a_knob(arcade: Arcade) -> None:
    here = lab(arcade)
    for i in (2, 0, 1):
        left, wide = page.speed_part(i)
        arcade.click(SPEED.left + left + wide / 2, SPEED.centery)
        assert here.trainer.speed == i
    knob = here.focus.rect("hit")
    arcade.click(knob.left + 20, knob.centery)
    arcade.click(knob.left + 20, knob.centery)
    arcade.click(knob.right - 20, knob.centery)
    assert here.table.recipe.hit == 9.0


def test_play_against_it_and_come_back_and_train_on(arcade: Arcade) -> None:
    here = lab(arcade)
    here.name = "ZUMI"
    experiences = here.table.training.experiences
    arcade.press(Button.X, device=KEYS[1])
    fight = arcade.shown(Challenge)
    assert fight.inner.devices[0] == KEYS[1]
    assert fight.inner.runner.driver(ROBOT, None) == ("ZUMI", "ai")
    arcade.until(lambda: fight.inner.match.state.tick > 200)
    robot = fight.inner.match.state.robots[ROBOT]
    start = fight.inner.match.arena.starts[ROBOT]
    assert (robot.x, robot.y, robot.heading) != (start.x, start.y, start.heading), "the robot moves"
    while not fight.inner.match.over:
        fight.inner.match.tick()
    arcade.wait(3.0)
    arcade.shown(ChallengeResult)
    assert here.table.training.experiences == experiences, "training is paused"
    assert here.table.join()
    arcade.key("ESCAPE", 0.2)
    arcade.wait(5.0, fps=4)
    arcade.key("ESCAPE", 0.8)
    assert lab(arcade) is here
    arcade.wait(0.5)
    assert here.table.training.experiences > experiences


def test_one_can_look_into_the_brain_that_one_plays_against(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    at_full_speed(arcade, monkeypatch)
    arcade.wait(0.2)
    arcade.press(Button.X)
    fight = arcade.shown(Challenge)
    arcade.until(lambda: fight.inner.match.state.tick > 20)
    before = digest(fight.inner.match.state)
    arcade.press(Button.BRAIN)
    arcade.shown(Challenge)
    assert fight.inner.runner.brain
    assert fight.inner.runner.brain.seats == [ROBOT]
    assert digest(fight.inner.match.state) == before


def test_once_more_and_an_early_end(arcade: Arcade) -> None:
    arcade.press(Button.X)
    first = arcade.shown(Challenge)
    while not first.inner.match.over:
        first.inner.match.tick()
    arcade.wait(3.0)
    arcade.shown(ChallengeResult)
    arcade.press(Button.FIRE)
    second = arcade.shown(Challenge)
    assert second is not first
    arcade.wait(0.2)
    arcade.press(Button.START)
    arcade.shown(Pause).focus.move_to("restart")
    arcade.press(Button.FIRE, Button.FIRE)
    arcade.wait(0.1)
    third = arcade.shown(Challenge)
    assert third is not second
    arcade.press(Button.START)
    arcade.shown(Pause).focus.move_to("end")
    arcade.press(Button.FIRE, Button.FIRE)
    arcade.wait(0.1)
    lab(arcade)


def test_forgetting_everything_takes_two_presses(arcade: Arcade) -> None:
    here = lab(arcade)
    arcade.press(Button.START)
    arcade.shown(LabMenu).focus.move_to("anew")
    arcade.press(Button.FIRE)
    arcade.shown(LabMenu)
    assert here.table.training.experiences > 0
    arcade.press(Button.FIRE)
    assert here.table.training.experiences == 0
    assert lab(arcade) is here


def test_the_table_compares_what_it_knew_with_what_it_knows(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pigaming_app.scenes.lab.pages.compare_page.MINUTES", 0.1)
    monkeypatch.setattr("pigaming_app.scenes.lab.pages.compare_page.SLICE", 0.2)
    at_full_speed(arcade, monkeypatch)
    learn(arcade, 1)
    here = lab(arcade)
    arcade.press(Button.START)
    arcade.shown(LabMenu).focus.move_to("compare")
    arcade.press(Button.FIRE)
    table = arcade.shown(ComparePage)
    assert [player.own for player in table.players] == [True, True, False]
    arcade.until(lambda: not table.pairs, 600.0)
    arcade.shown(ComparePage)
    assert sum(player.won for player in table.players) == sum(player.lost for player in table.players)
    assert {player.won + player.tied + player.lost for player in table.players} == {4}
    points = [player.points for player in table.order()]
    assert points == sorted(points, reverse=True)
    arcade.press(Button.BACK)
    assert lab(arcade) is here


def test_what_it_knew_is_kept_at_the_start(arcade: Arcade) -> None:
    checkpoints = lab(arcade).table.checkpoints()
    assert set(checkpoints) == {0}
    assert (checkpoints[0].matches, checkpoints[0].experiences) == (0, 0)


def test_when_nobody_is_there_the_next_visitors_begin_with_an_empty_table(arcade: Arcade) -> None:
    here = lab(arcade)
    here.table.recipe = RECIPES[2]
    arcade.context.idle = Lab.idle + 1.0
    arcade.frame()
    assert arcade.stack.top is arcade.title
    assert here.table.training.experiences == 0
    assert here.table.recipe == scene.FIRST
    assert here.table.join()


def test_the_moment_in_which_it_beats_the_hand_made_robot_is_cheered_once(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = lab(arcade)
    monkeypatch.setattr(progress.TrainingProgress, "record_exam", lambda _: None)  # adds no measure of its own
    shares = (1.0, 0.0, 0.2, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0)
    measures = [Measure(i, share) for i, share in enumerate(shares)]
    for i in range(len(measures)):
        here.table.progress.measures = measures[: i + 1]
        lab(arcade)
        arcade.frame()
    assert arcade.sounds.heard.count("win") == 1
    assert here.message == arcade.context.words("lab.outdone")
    here.begin()
    arcade.frame()
    assert arcade.sounds.heard.count("win") == 1


def test_the_line_through_the_dots_moves_part_of_the_way_to_each() -> None:
    line = smoothed([Measure(0, 0.0), Measure(1, 1.0), Measure(2, 1.0)])
    assert line == pytest.approx([0.0, 0.3, 0.51])
    assert [room(matches) for matches in (0, 50, 50.5, 199)] == [50, 50, 100, 200]


@pytest.mark.parametrize("language", LANGUAGES)
def test_labels_fit_their_boxes(arcade: Arcade, language: str) -> None:
    words = Words(language)
    there = Lab(arcade.context, fast=False)
    for there.held in ("", KNOB_NAMES[0]):
        row = there.prompts
        ends = places(row.labels, ROOM)
        assert SAFE.left - 16 <= ends[0][0]
        assert ends[-1][1] <= SAFE.right + 16
    with VirtualPad() as pad:
        arcade.open(there)
        arcade.wait(0.1)
        pad.tap("b")
        arcade.wait(0.1)
        assert places(there.prompts.labels, ROOM)[-1][1] <= SAFE.right
    for name in KNOB_NAMES:
        lines = wrap_balanced(words(f"lab.{name}"), 2)
        assert len(lines) <= 2
        assert all(text_width(line, BODY, "body") <= 206 for line in lines)
    left, right = page.bar_ends(words)
    assert right - left > 300
    rights = {"won": 340, "tied": 200, "lost": 210, "points": 232}
    assert all(text_width(words(f"lab.{key}"), BODY, "body") < wide - 20 for key, wide in rights.items())


def test_nothing_in_the_lab_lies_on_something_else(arcade: Arcade) -> None:
    spots = lab(arcade).focus.spots
    assert all(SAFE.contains(spot.rect) for spot in spots)
    assert not [(a.name, b.name) for a, b in combinations(spots, 2) if a.rect.colliderect(b.rect)]


@pytest.mark.parametrize("key", ["lab.warming", "lab.preparing", "lab.first"])
@pytest.mark.parametrize("language", LANGUAGES)
def test_the_line_about_warming_up_stays_in_its_panel_and_off_the_match(
    controls: Controls, language: str, key: str
) -> None:
    lit = notice(Words(language)(key, seconds=10))
    rects = lit_boxes(lit.image)
    line = rects[0].unionall(rects[1:]).move(lit.at)
    assert CURVE.contains(line)
    assert line.right < PLOT.right, "the notice overlaps the percentage"
    assert not line.colliderect(MATCH)


# ---------------------------------------------------------------------------------- the reward as code, and two robots


def write(arcade: Arcade, line: str) -> None:
    """Write a line of code as the reward of the robot that is shown."""
    lab(arcade).focus.move_to("line")
    arcade.press(Button.FIRE)
    arcade.wait(0.5)
    page = arcade.shown(LinePage)
    for _ in page.text:
        page.type("\b")
    for letter in line:
        page.type(letter)
    arcade.press(Button.START)


def test_a_line_of_code_rewards_the_robot_at_once_and_a_turned_knob_changes_the_line(arcade: Arcade) -> None:
    here = lab(arcade)
    assert here.trainer.line == "10*hit - miss - behind"
    write(arcade, "10*hit-0.01*turned")
    assert lab(arcade) is here
    arcade.wait(0.5)
    assert here.shown.line == "10*hit - 0.01*turned"
    assert dict(here.shown.values) == {"hit": 10.0, "miss": 0.0, "behind": 0.0, "still": 0.0}
    assert here.table.training.table.rest.size == 4, "what is no knob is in the program"
    here.focus.move_to("hit")
    arcade.press(Button.FIRE, Button.LEFT, Button.FIRE)
    arcade.wait(0.1)
    assert here.shown.line == "9*hit - 0.01*turned"
    assert here.table.training.table.rest.size == 4


def test_a_wrong_line_says_why_and_changes_nothing(arcade: Arcade) -> None:
    here = lab(arcade)
    write(arcade, "10*hits")
    page = arcade.shown(LinePage)
    assert page.refusal == arcade.context.words("lab.line_name", found="hits", names=", ".join(QUANTITIES))
    arcade.press(Button.BACK)
    assert lab(arcade) is here
    assert here.trainer.line == "10*hit - miss - behind"


def test_a_stick_writes_a_line_too(arcade: Arcade) -> None:
    lab(arcade).focus.move_to("line")
    arcade.press(Button.FIRE)
    arcade.wait(0.5)
    arcade.press(*[Button.X] * 40, *[Button.UP] * 22, Button.FIRE, Button.START)  # from `a` back to `1`
    assert lab(arcade).trainer.line == "1"


def test_b_learns_beside_a_by_a_reward_of_its_own(arcade: Arcade) -> None:
    here = lab(arcade)
    experiences = here.table.training.experiences
    here.focus.move_to("sides")
    arcade.press(Button.FIRE)
    one, other = (side.table for side in here.sides)
    assert here.table is other
    assert other.training.experiences == 0
    assert other.line == one.line
    write(arcade, "-10*hit")
    arcade.wait(1.0)
    assert (one.line, other.line) == ("10*hit - miss - behind", "-10*hit")
    assert (one.training.table.knobs.hit, other.training.table.knobs.hit) == (10.0, -10.0)
    assert one.training.experiences > experiences
    assert other.training.experiences > 0
    for i, table in enumerate((one, other)):
        table.progress.measures = [Measure(0, 0.2 + 0.5 * i)]
    arcade.wait(0.1, draw=True)
    assert here.page
    assert here.page.curve.shares == [0.2, 0.7]
    here.focus.move_to("sides")
    arcade.press(Button.FIRE)
    assert here.table is one
    assert len(here.sides) == 2
    arcade.press(Button.Y)
    assert {side.table.speed for side in here.sides} == {1}
    arcade.context.idle = Lab.idle + 1.0
    arcade.frame()
    assert [side.table for side in here.sides] == [one], "the next visitors find one robot"


def test_a_change_of_the_reward_is_marked_on_the_curve(arcade: Arcade) -> None:
    here = lab(arcade)
    progress = here.table.progress
    for matches in (0, 7, 7, 9):
        progress.snapshot.matches = matches
        here.reward_by("hit" if matches == 9 else "miss")
    assert here.side.course("table").changes == [7, 9]
    here.begin()
    assert here.side.course("table").changes == ()


@pytest.mark.parametrize("speed", [0, 1, 2])
def test_the_first_point_comes_within_ten_seconds_and_is_announced(
    arcade: Arcade, monkeypatch: pytest.MonkeyPatch, speed: int
) -> None:
    """Also where an examination takes much longer; the page counts down."""
    monkeypatch.setattr(progress, "MATCHES", {True: 1000, False: 1000})
    clock = [100.0]
    for module in (progress, trainer):
        monkeypatch.setattr(module, "perf_counter", lambda: clock[0])
    monkeypatch.setattr(trainer, "SLICE", 0.0)  # a training of no ticks: the loops below play the examination
    here = lab(arcade)
    here.begin()
    here.trainer.speed, began, announced = speed, clock[0], []
    while not here.table.progress.measures:
        clock[0] += 0.05
        here.table.progress.record_exam()
        if exam := here.table.progress.exam_due(speed == trainer.FASTEST):
            exam.play(20)
        announced.append(here.trainer.first_point)
        assert clock[0] < began + 10.0
    assert here.trainer.first_point is None
    assert announced[0] in (7, 8)
    shown = [seconds for seconds in announced if seconds]
    assert shown == sorted(shown, reverse=True)


def test_matches_a_second_are_counted_as_they_come() -> None:
    class Counted:
        snapshot = SimpleNamespace(matches=0)

    side = LabSide(cast(Any, Counted()), cast(Any, None))
    assert side.rate == 0.0
    for _ in range(300):
        Counted.snapshot.matches += 8
        side.follow("table", 1 / 60)
    assert side.rate == pytest.approx(480.0)
    for _ in range(150):
        side.follow("table", 1 / 60)
    assert side.rate == 0.0
