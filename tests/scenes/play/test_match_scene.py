"""Matches as played: the countdown, unplugged pads, replacements, pauses, and the results."""

import math

import pygame
import pytest

from pigaming_app.ai.brain.kind import BrainPlayer, HumanPlayer, OneButtonPlayer
from pigaming_app.ai.game_ai import ONE_BUTTON, TURN
from pigaming_app.scenes.play.countdown import CENTRE, clear_of
from pigaming_app.scenes.play.device_table import DeviceTable
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import TIMEOUT, Reconnect, StillThere
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.results.winner import WinnersMoment
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.sim.angles import turn_to
from pigaming_app.ui.input.events import Button
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.scenes.measuring import lit_boxes
from tests.ui.input.virtual_pad import VirtualPad

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

COUNTDOWN = 3.8  # seconds until GO


def two_pads(arcade: Arcade, minutes: float = 1.0) -> tuple[MatchScene, VirtualPad, VirtualPad]:
    """A match of two pads that steer, running."""
    arcade.context.settings.pad_driving = TURN
    (one, first), (two, second) = arcade.plug(), arcade.plug()
    match = arcade.open(MatchScene(arcade.context, setup("human human off off", minutes), [first, second]))
    arcade.wait(COUNTDOWN + 0.1)
    return match, one, two


def test_nothing_moves_before_go_and_everything_after(arcade: Arcade) -> None:
    arcade.context.settings.pad_driving = TURN
    pad, device = arcade.plug()
    match = arcade.open(MatchScene(arcade.context, setup("human level5 off off", 1.0), [device, None, None, None]))
    pad.stick(0.0, -1.0)
    arcade.wait(COUNTDOWN - 0.1, draw=True)
    assert match.match.state.tick == 0
    assert arcade.sounds.heard == ["count", "count", "count"]
    begin = match.match.state.robots[0].x
    arcade.wait(1.1, draw=True)
    assert "go" in arcade.sounds.heard
    assert match.match.seconds == pytest.approx(1.0, abs=0.1)
    assert match.match.state.robots[0].x - begin > 100


def test_the_stick_is_read_on_the_tick_that_acts_on_it(arcade: Arcade) -> None:
    match, one, _ = two_pads(arcade)
    one.stick(0.0, -1.0)
    pygame.event.pump()
    match.runner.advance(0.021)
    assert match.match.state.actions[0].linear == 1.0


def test_a_pad_that_points_drives_where_the_stick_points_also_after_it_was_replugged(arcade: Arcade) -> None:
    arcade.context.settings.pad_driving = TURN
    pad, device = arcade.plug()
    arcade.context.driving.change(device, "pitanks", 1)
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off off", 5.0), [device]))
    assert match.runner.driver(0, device)[1] == "point"
    arcade.wait(COUNTDOWN + 0.1)
    pad.stick(0.0, 1.0)
    arcade.wait(1.5)
    robot = match.match.state.robots[0]
    assert robot.heading == pytest.approx(0.5 * math.pi, abs=0.1), "down the screen"
    pad.unplug()
    arcade.wait(0.1)
    arcade.context.settings.pad_driving = TURN
    new, other = arcade.plug()
    arcade.wait(1.0)
    new.tap("a")
    arcade.wait(4.0)
    assert match.devices[0] == other
    new.stick(1.0, 0.0)
    arcade.wait(1.5)
    assert abs(turn_to(robot.heading)) < 0.1, "right on the screen"


def test_time_is_up_then_the_results(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 level5 off"), [KEYS[0], None, None, None]))
    arcade.until(lambda: match.match.over)
    assert arcade.sounds.heard.count("tick") == 6
    last = match.match.state.tick
    waited = arcade.until(lambda: isinstance(arcade.stack.top, WinnersMoment))
    assert 1.4 <= waited <= 2.0
    arcade.until(lambda: isinstance(arcade.stack.top, Results))
    assert match.match.state.tick == last


def test_a_suspended_machine_causes_no_burst_of_ticks(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("level1 level5 off off", 1.0)))
    arcade.wait(COUNTDOWN + 0.2)
    before = match.match.state.tick
    arcade.frame(60.0)
    assert match.match.state.tick - before <= 4


@pytest.mark.parametrize("act", [Button.START, Button.BACK])
def test_a_pause_freezes_and_a_short_countdown_leads_back(arcade: Arcade, act: Button) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human human off off", 1.0), KEYS))
    arcade.wait(COUNTDOWN + 1.0)
    arcade.press(act, device=KEYS[1])
    assert arcade.shown(Pause).player == 1
    before = match.match.state.tick
    arcade.wait(5.0)
    arcade.press(act, device=KEYS[1])
    assert arcade.shown(MatchScene) is match
    arcade.wait(1.3, draw=True)
    assert match.match.state.tick == before
    arcade.wait(0.5, draw=True)
    assert match.match.state.tick > before


def test_turbo_on_a_pad_is_not_a_pause(arcade: Arcade) -> None:
    match, one, _ = two_pads(arcade)
    one.press("b")
    arcade.wait(0.2)
    assert arcade.shown(MatchScene) is match


def test_the_pause_menu_restarts_shows_the_controls_and_ends(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off off", 1.0), KEYS[:1]))
    arcade.wait(COUNTDOWN + 1.0)
    arcade.press(Button.START, Button.DOWN, Button.DOWN, Button.FIRE)
    arcade.shown(DeviceTable)
    arcade.press(Button.BACK, Button.UP, Button.FIRE)
    arcade.shown(Pause)
    arcade.press(Button.FIRE)
    arcade.frame()
    fresh = arcade.shown(MatchScene)
    assert fresh is not match
    assert fresh.match.state.tick == 0
    assert fresh.setup.seed != match.setup.seed
    assert fresh.devices[0] == KEYS[0]
    arcade.press(Button.START, Button.UP, Button.FIRE)
    arcade.shown(Pause)
    arcade.press(Button.FIRE)
    assert not arcade.reach(Results).numbers.finished  # type: ignore[attr-defined]
    assert len(arcade.stack.scenes) == 3


def test_a_pulled_pad_pauses_and_any_free_pad_takes_its_seat(arcade: Arcade) -> None:
    match, one, two = two_pads(arcade)
    two.unplug()
    arcade.frame()
    arcade.frame()
    page = arcade.shown(Reconnect)
    assert page.seat == 1
    before = match.match.state.tick
    one.tap("a")
    arcade.wait(2.0, draw=True)
    assert arcade.stack.top is page, "the pad of the other seat is not free"
    three, device = arcade.plug()
    assert page.replugged
    arcade.shown(Reconnect)
    three.tap("a")
    arcade.frame()
    assert arcade.shown(MatchScene) is match
    assert match.devices[1] == device
    arcade.wait(1.6)
    three.stick(0.0, -1.0)
    arcade.wait(0.5)
    assert match.match.state.tick > before
    assert match.match.state.actions[1].linear == 1.0


def test_a_key_cluster_may_take_over_and_an_ai_at_once(arcade: Arcade) -> None:
    match, one, two = two_pads(arcade)
    one.unplug()
    two.unplug()
    arcade.frame()
    arcade.frame()
    assert arcade.shown(Reconnect).seat == 0
    arcade.press(Button.FIRE, device=KEYS[2])
    arcade.frame()
    assert arcade.shown(Reconnect).seat == 1, "one after the other"
    arcade.wait(1.1)
    arcade.press(Button.X, device=KEYS[2])
    arcade.frame()
    arcade.shown(MatchScene)
    assert match.devices[:2] == [KEYS[2], None]
    assert isinstance(match.match.brains[0], HumanPlayer)
    assert isinstance(match.match.brains[1], BrainPlayer)


def test_when_the_ring_has_run_out_an_ai_drives_until_somebody_comes_back(arcade: Arcade) -> None:
    match, _, two = two_pads(arcade)
    assert match.runner.view.players[:2] == ["human", "human"]
    two.unplug()
    arcade.until(lambda: isinstance(arcade.stack.top, Reconnect))
    waited = arcade.until(lambda: arcade.stack.top is match)
    assert waited == pytest.approx(TIMEOUT, abs=0.2)
    arcade.wait(2.0)
    assert isinstance(match.match.brains[1], BrainPlayer)
    back, device = arcade.plug()
    assert match.devices[1] is None
    assert match.runner.view.players[:2] == ["human", "level3"], "the view marks the AI"
    back.tap("a")
    arcade.frame(draw=True)
    assert arcade.shown(MatchScene) is match, "no pause"
    assert match.devices[1] == device
    assert isinstance(match.match.brains[1], HumanPlayer)
    assert match.runner.view.players[:2] == ["human", "human"], "and the mark goes"


def test_with_one_button_the_robot_drives_by_itself_and_sets_no_record(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    arcade.context.driving.chosen[device] = ONE_BUTTON
    match = arcade.open(MatchScene(arcade.context, setup("human human off off", 1.0), [device, KEYS[0]]))
    assert isinstance(match.match.brains[0], OneButtonPlayer)
    assert isinstance(match.match.brains[1], HumanPlayer)
    assert (match.drivers.people, match.drivers.assisted) == ([0, 1], {0})
    assert match.runner.view.players[:2] == ["human", "human"]
    arcade.wait(COUNTDOWN + 2.0)
    assert match.match.state.tanks[0].shots == 0
    pad.tap("a")
    arcade.wait(0.5)
    assert match.match.state.tanks[0].shots == 1


def test_a_mashed_button_does_not_give_the_seat_to_an_ai(arcade: Arcade) -> None:
    match, one, two = two_pads(arcade)
    two.unplug()
    arcade.frame()
    arcade.frame()
    for button in ("x", "b", "a"):
        one.tap(button)
        arcade.frame()
    assert arcade.shown(Reconnect)
    arcade.wait(1.0)
    one.tap("b")
    arcade.frame()
    arcade.shown(Pause)
    one.tap("b")
    arcade.frame()
    arcade.frame()
    assert arcade.shown(Reconnect).seat == 1, "the menu does not forget who is missing"
    assert match.devices[1] is not None


def test_a_match_without_input_asks_and_then_returns_to_the_title(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human level1 off off", 5.0), KEYS[:1]))
    arcade.until(lambda: isinstance(arcade.stack.top, StillThere), 70.0)
    assert match.match.seconds == pytest.approx(60.0, abs=1.0)
    arcade.shown(StillThere)
    arcade.press(Button.LEFT)
    assert arcade.stack.top is match
    arcade.until(lambda: isinstance(arcade.stack.top, StillThere), 70.0)
    arcade.until(lambda: arcade.stack.top is arcade.title, 20.0)


def test_a_held_stick_counts_as_input(arcade: Arcade) -> None:
    match, one, _ = two_pads(arcade, 3.0)
    one.stick(1.0, 0.0)
    arcade.wait(70.0, fps=20)
    assert arcade.stack.top is match


def test_a_match_of_ais_never_asks(arcade: Arcade) -> None:
    arcade.open(MatchScene(arcade.context, setup("level1 level1 off off", 1.2)))
    arcade.until(lambda: isinstance(arcade.stack.top, Results), 85.0)


def test_a_seat_without_a_device_is_driven_by_an_ai_that_gives_way(arcade: Arcade) -> None:
    match = arcade.open(MatchScene(arcade.context, setup("human human off off", 1.0), [KEYS[0], None]))
    assert match.drivers.replaced == [1]
    arcade.press(Button.FIRE, device=KEYS[0])
    assert match.drivers.replaced == [1]
    arcade.press(Button.FIRE, device=KEYS[3])
    assert match.devices[1] == KEYS[3]


def test_the_numbers_before_a_match_stand_where_they_hide_no_robot() -> None:
    assert clear_of([(260.0, 240.0), (1660.0, 940.0)]) == CENTRE
    x, y = clear_of([(900.0, 540.0)])
    assert abs(x - 900) > 300 or abs(y - 540) > 250
    assert 370 <= y <= 830, "its ring stays inside the arena"
    assert clear_of([(x, y) for x in range(200, 1800, 300) for y in range(200, 1000, 200)]) == CENTRE, "nowhere is free"


@pytest.mark.parametrize(("speed", "records"), [(1.0, 1), (0.5, 0), (2.0, 0)])
def test_only_a_match_at_real_speed_sets_records(arcade: Arcade, speed: float, records: int) -> None:
    scene = arcade.open(MatchScene(arcade.context, setup("human level3 off off", 0.05), [KEYS[0]], speed))
    arcade.until(lambda: scene.match.state.tick > 100)
    scene.match.state.robots[0].score = 9
    arcade.until(lambda: scene.ending.next is not None)
    assert scene.ending.next
    assert len(scene.ending.next.claims) == records  # type: ignore[attr-defined]


def race(arcade: Arcade) -> MatchScene:
    """A race of a person and an AI, before its countdown."""
    return MatchScene(arcade.context, setup_of("race", "human random", "classic", 1.0, goal=1), [KEYS[0]])


def test_hints_are_drawn_from_go_to_the_end(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    match, drawn = race(arcade), []
    monkeypatch.setattr(match.runner, "draw_hints", lambda screen, devices: drawn.append(devices))
    match.draw(arcade.screen)
    assert drawn == []
    while match.opening.countdown.locked:
        match.opening.countdown.update(0.1)
    match.draw(arcade.screen)
    assert drawn == [match.devices]
    match.match.state.over = 1
    match.draw(arcade.screen)
    assert len(drawn) == 1


@pytest.mark.parametrize(("y", "side"), [(60.0, 1), (300.0, 1), (820.0, -1)])
def test_a_hint_stays_in_the_picture_and_clear_of_the_sign(arcade: Arcade, y: float, side: int) -> None:
    match = race(arcade)
    robot = match.match.state.robots[0]
    robot.x, robot.y = 20.0, y
    match.runner.view.hints = {0: "race.back_hint"}
    box = drawn_hints(arcade, match)
    assert pygame.Rect(LEFT, TOP, 1600, 900).contains(box)
    assert (box.centery - TOP - y) * side > 80.0


def test_a_hint_names_the_button_and_an_ai_gets_none(arcade: Arcade) -> None:
    match = race(arcade)
    match.runner.view.hints = {1: "race.back_hint"}
    assert drawn_hints(arcade, match).w == 0
    widths = []
    for device in KEYS[:3]:
        match.devices[0], match.runner.view.hints = device, {0: "race.back_hint"}
        widths.append(drawn_hints(arcade, match).w)
    assert len(set(widths)) == 3  # SPACE, R CTRL, U


def drawn_hints(arcade: Arcade, match: MatchScene) -> pygame.Rect:
    """The part of the screen that the hints take."""
    arcade.screen.fill("black")
    match.runner.draw_hints(arcade.screen, match.devices)
    boxes = lit_boxes(arcade.screen, 8)
    return boxes[0].unionall(boxes[1:]) if boxes else pygame.Rect(0, 0, 0, 0)
