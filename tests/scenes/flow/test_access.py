"""Access control: seated pads, free pads, and idle people."""

import random

import pygame
import pytest

from pigaming_app.ai.brain.kind import BrainPlayer, HumanPlayer
from pigaming_app.scenes.flow.access import ESCAPE_SECONDS, OWNER_SECONDS, TAKE_SECONDS
from pigaming_app.scenes.lobby import seat_card
from pigaming_app.scenes.lobby.game_choice import GameChoice
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import Lobby, game_choice
from pigaming_app.scenes.lobby.seats import HUMAN
from pigaming_app.scenes.play.device_table import DeviceTable
from pigaming_app.scenes.play.drivers import ANSWER_LIMIT, IDLE_LIMIT
from pigaming_app.scenes.play.pause import CONFIRM_SECONDS, Pause
from pigaming_app.scenes.play.reconnect import StillThere
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import LATE, LEAVE, Results
from pigaming_app.scenes.title.scene import Title
from pigaming_app.ui.input.events import Button, Device
from tests.scenes.arcade import KEYS, Arcade, setup
from tests.ui.input.virtual_pad import PLAYSTATION, VirtualPad

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

RUNNING = 4.0  # seconds until a match runs
BUTTONS = ("b", "start", "x", "y", "up", "down", "left", "right", "rightshoulder")  # all but FIRE
EVERY = (
    Button.BACK,
    Button.START,
    Button.X,
    Button.Y,
    Button.UP,
    Button.DOWN,
    Button.LEFT,
    Button.RIGHT,
    Button.LEAVE_SEAT,
)


def tap(arcade: Arcade, pad: VirtualPad, *buttons: str) -> None:
    for button in buttons:
        pad.tap(button)
        arcade.frame()


def running(arcade: Arcade, brains: str, devices: list[Device], minutes: float = 3.0) -> MatchScene:
    match = arcade.open(MatchScene(arcade.context, setup(brains, minutes), devices))
    arcade.wait(RUNNING)
    return match


# ---- lobby and setup


def lobby_of(arcade: Arcade) -> Lobby:
    """A lobby right above the title."""
    arcade.stack.scenes[1:] = []
    return arcade.open(Lobby(arcade.context, "pitanks"))


def test_in_the_lobby_a_free_pad_can_join_and_nothing_else(arcade: Arcade) -> None:
    _, first = arcade.plug()
    guest, device = arcade.plug()
    page = lobby_of(arcade)
    arcade.press(Button.FIRE, Button.Y, device=first)
    before = [(place.kind, place.device, place.strength, place.ready) for place in page.seats.places]
    for _ in range(3):
        tap(arcade, guest, *BUTTONS[:1], *BUTTONS[2:])
    assert arcade.shown(Lobby) is page
    assert [(place.kind, place.device, place.strength, place.ready) for place in page.seats.places] == before
    assert not page.seats.teams
    tap(arcade, guest, "start")
    assert page.seats.seat_of(device) == 2
    assert arcade.shown(Lobby) is page, "START of a free pad joins and does not begin"
    tap(arcade, guest, "b")
    assert page.seats.seat_of(device) is None
    tap(arcade, guest, "b")
    assert arcade.shown(Lobby) is page


def test_in_a_full_lobby_a_free_pad_gets_only_a_notice(arcade: Arcade) -> None:
    page = lobby_of(arcade)
    for device in KEYS:
        arcade.press(Button.FIRE, device=device)
    seats = [place.device for place in page.seats.places]
    for act in (Button.FIRE, *EVERY):
        page.now.message = ""
        arcade.press(act, device=Device("pad", 9))
        assert [place.device for place in page.seats.places] == seats == KEYS
        assert act is not Button.FIRE or arcade.sounds.heard[-1] == "error"
        if act in (Button.FIRE, Button.START, Button.BACK):
            assert page.now.message == arcade.context.words("lobby.full")


def test_while_nobody_is_seated_any_device_begins_a_match_of_ais_or_goes_back(arcade: Arcade) -> None:
    lobby_of(arcade)
    arcade.press(Button.Y, device=KEYS[2])
    arcade.press(Button.Y, device=KEYS[3])
    arcade.press(Button.START, device=KEYS[1])
    arcade.shown(MatchSetupPage)
    arcade.press(Button.BACK, device=KEYS[3])
    arcade.shown(Lobby)
    arcade.press(Button.BACK, device=KEYS[0])
    assert arcade.stack.top is arcade.title


def test_an_operator_holds_escape_to_leave_a_lobby_that_others_sit_in(arcade: Arcade) -> None:
    _, first = arcade.plug()
    lobby_of(arcade)
    arcade.press(Button.FIRE, device=first)
    arcade.key("ESCAPE", 0.3)
    arcade.shown(Lobby)
    arcade.key("ESCAPE", ESCAPE_SECONDS + 0.2)
    assert arcade.stack.top is arcade.title


def test_a_shared_key_counts_for_the_seated_half_of_the_keyboard(arcade: Arcade) -> None:
    page = lobby_of(arcade)
    arcade.key("SPACE")
    arcade.key("SPACE")
    arcade.key("UP")  # a key of an unseated cluster
    assert page.seats.places[0].ready
    arcade.key("ESCAPE")
    assert not page.seats.places[0].ready


def test_empty_seats_name_the_button_of_every_device_that_could_join(arcade: Arcade) -> None:
    _, xbox = arcade.plug()
    arcade.plug(name="PS4 Controller", usb=PLAYSTATION)
    arcade.plug(plain=True)
    for language, space, control in (("en", "SPACE", "R CTRL"), ("pt", "ESPAÇO", "CTRL DIR")):
        arcade.context.words.switch(language)
        page = Lobby(arcade.context, "pitanks")
        assert page.page.invited == ("A", "Cross", "1", space, control, "U")
        assert len(seat_card.rows_of(page.page.invited)) == 2, "they fit on a card"
        page.seats.join(xbox)
        page.seats.join(KEYS[1])
        assert [*page.page.invited] == ["Cross", "1", space, "U"]


def test_in_setup_only_seated_devices_choose(arcade: Arcade) -> None:
    page = Lobby(arcade.context, "pitanks")
    page.seats.join(KEYS[0])
    page.seats.add_ai()
    scene = arcade.open(MatchSetupPage(arcade.context, "pitanks", page.seats))
    arcade.wait(1.0)
    before = (scene.chosen, scene.focus.name)
    for act in (Button.FIRE, *EVERY):
        arcade.press(act, device=KEYS[1])
        assert arcade.shown(MatchSetupPage) is scene
        assert (scene.chosen, scene.focus.name) == before
    arcade.press(Button.FIRE, device=KEYS[0])
    arcade.shown(MatchScene)


# ---- match and pause


def test_in_a_match_nothing_on_a_free_pad_pauses(arcade: Arcade) -> None:
    _, first = arcade.plug()
    guest, _ = arcade.plug()
    match = running(arcade, "human level1 off off", [first])
    tap(arcade, guest, *BUTTONS, "a")
    arcade.press(Button.BACK, Button.START, device=KEYS[0])
    arcade.frame()
    assert arcade.shown(MatchScene) is match
    assert match.devices == [first, None, None, None]


def test_an_operator_holds_escape_to_pause_pads_and_to_take_a_pause_over(arcade: Arcade) -> None:
    pad, first = arcade.plug()
    match = running(arcade, "human level1 off off", [first])
    arcade.key("ESCAPE", 0.4)
    assert arcade.stack.top is match
    arcade.key("ESCAPE", ESCAPE_SECONDS + 0.2)
    assert arcade.shown(Pause).access.owner.kind == "keys"
    arcade.key("ESCAPE")
    assert arcade.stack.top is match
    tap(arcade, pad, "start")
    assert arcade.shown(Pause).access.owner == first
    arcade.key("ESCAPE", ESCAPE_SECONDS + 0.2)
    assert arcade.shown(Pause).access.owner.kind == "keys"


def test_while_ais_play_alone_any_device_pauses(arcade: Arcade) -> None:
    guest, _ = arcade.plug()
    match = running(arcade, "level1 level1 off off", [])
    for button in ("start", "b"):
        tap(arcade, guest, button)
        arcade.shown(Pause)
        tap(arcade, guest, "start")
        assert arcade.stack.top is match


def test_a_pause_belongs_to_its_owner_for_twenty_seconds(arcade: Arcade) -> None:
    match = running(arcade, "human human off off", KEYS[:2])
    arcade.press(Button.START, device=KEYS[1])
    page = arcade.shown(Pause)
    for act in (Button.FIRE, *EVERY):
        for device in (KEYS[0], KEYS[3]):
            arcade.press(act, device=device)
            assert arcade.shown(Pause) is page
            assert page.focus.name == "continue"
    arcade.press(Button.DOWN, Button.DOWN, Button.FIRE, device=KEYS[1])
    arcade.press(Button.BACK, device=KEYS[0])
    arcade.shown(DeviceTable)
    arcade.wait(OWNER_SECONDS + 0.2)
    arcade.press(Button.BACK, device=KEYS[3])
    arcade.shown(DeviceTable)
    arcade.press(Button.BACK, device=KEYS[0])
    assert arcade.shown(Pause) is page
    arcade.press(Button.START, device=KEYS[3])
    assert arcade.shown(Pause) is page
    arcade.press(Button.START, device=KEYS[0])
    assert arcade.stack.top is match


def test_f4_of_the_keyboard_works_in_any_match_but_ends_no_pause_of_another_device(arcade: Arcade) -> None:
    pad, first = arcade.plug()
    match = running(arcade, "human level1 off off", [first])
    arcade.key("F4")
    assert match.runner.brain
    assert match.runner.brain.seats == [1]
    tap(arcade, pad, "start")
    page = arcade.shown(Pause)
    arcade.key("F4")
    assert arcade.shown(Pause) is page


def test_an_unplugged_pad_owns_no_pause(arcade: Arcade) -> None:
    (_, first), (two, second) = arcade.plug(), arcade.plug()
    running(arcade, "human human off off", [first, second])
    tap(arcade, two, "start")
    page = arcade.shown(Pause)
    arcade.press(Button.START, device=first)
    assert arcade.shown(Pause) is page
    two.unplug()
    arcade.frame()
    arcade.press(Button.START, device=first)
    assert arcade.stack.top is not page


@pytest.mark.parametrize(("name", "downs"), [("restart", 1), ("end", 3)])
def test_restart_and_end_ask_once(arcade: Arcade, name: str, downs: int) -> None:
    match = running(arcade, "human level1 off off", KEYS[:1])
    arcade.press(Button.START)
    page = arcade.shown(Pause)
    arcade.press(*[Button.DOWN] * downs)
    assert page.focus.name == name
    arcade.press(Button.FIRE)
    arcade.wait(CONFIRM_SECONDS + 0.2, draw=True)
    arcade.press(Button.FIRE, Button.UP, Button.DOWN, Button.FIRE)
    assert arcade.shown(Pause) is page, "time and another item take the question back"
    assert not match.restart_requested
    assert not match.stop_requested
    arcade.press(Button.FIRE)
    assert match.restart_requested or match.stop_requested


# ---- taps


def test_taps_in_a_frame_of_almost_a_second_fire_once_each(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    controls = arcade.context.controls
    for _ in range(2):
        pad.tap("a")
    pygame.time.wait(800)
    assert [event.button for event in controls.presses(pygame.event.get())] == [Button.FIRE, Button.FIRE]
    pygame.time.wait(200)
    assert [controls.drive(device).fire for _ in range(6)] == [True, False, True, False, False, False]


def test_a_tap_of_both_shoulders_in_one_frame_is_the_all_stop(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    pad.tap("leftshoulder", "rightshoulder")
    assert [event.button for event in arcade.context.controls.presses(pygame.event.get())] == [Button.STOP]
    assert [arcade.context.controls.drive(device).turbo for _ in range(2)] == [True, False]


def test_taps_are_bounded_and_belong_to_their_device(arcade: Arcade) -> None:
    (pad, device), (_, other) = arcade.plug(), arcade.plug()
    controls = arcade.context.controls
    for _ in range(50):
        pad.tap("a")
    controls.presses(pygame.event.get())
    assert sum(controls.drive(device).fire for _ in range(100)) == 4
    assert not controls.drive(other).fire
    pad.tap("a")
    pad.unplug()
    controls.presses(pygame.event.get())
    assert not controls.drive(device).fire


def test_a_tap_in_a_menu_or_the_countdown_does_not_fire_in_the_match(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    match = MatchScene(arcade.context, setup("human level1 off off", 1.0), [device])
    pad.tap("a")
    arcade.frame()
    arcade.open(match)
    arcade.wait(2.0)
    pad.tap("a")
    arcade.until(lambda: match.match.state.tick > 10)
    tap(arcade, pad, "start")
    tap(arcade, pad, "a")
    arcade.wait(2.5)
    assert arcade.stack.top is match
    assert not any(match.match.log.ticks[12 * tick + 2] & 1 for tick in range(match.match.state.tick))
    pad.tap("a")
    arcade.frame()
    arcade.wait(0.1)
    fired = [match.match.log.ticks[12 * tick + 2] & 1 for tick in range(match.match.state.tick)]
    assert sum(fired) == 1


# ---- seats with a new driver


def test_an_idle_seat_is_asked_then_an_ai_drives_until_a_button_is_pressed(arcade: Arcade) -> None:
    (one, first), (two, second) = arcade.plug(), arcade.plug()
    match = running(arcade, "human human off off", [first, second])
    one.stick(0.0, -1.0)
    arcade.wait(IDLE_LIMIT - 1.0, fps=20)
    assert not match.drivers.idle.prompted()
    arcade.until(lambda: bool(match.drivers.idle.prompted()))
    assert list(match.drivers.idle.prompted()) == [1]
    arcade.stack.top.draw(arcade.screen)
    tap(arcade, two, "x")
    assert not match.drivers.idle.prompted(), "any button answers"
    arcade.wait(IDLE_LIMIT + 1.0, fps=20)
    before = match.match.state.tick
    arcade.until(lambda: isinstance(match.match.brains[1], BrainPlayer))
    assert match.match.state.tick - before == pytest.approx((ANSWER_LIMIT - 1.0) * 50, abs=20), (
        "nobody else had to wait"
    )
    assert arcade.stack.top is match
    assert isinstance(match.match.brains[0], HumanPlayer)
    tap(arcade, two, "a")
    assert match.devices[:2] == [first, second]
    assert isinstance(match.match.brains[1], HumanPlayer)


def test_paused_time_does_not_count_as_idle(arcade: Arcade) -> None:
    match = running(arcade, "human human off off", KEYS[:2])
    arcade.press(Button.START)
    arcade.wait(IDLE_LIMIT + ANSWER_LIMIT + 5.0, fps=10)
    arcade.press(Button.START)
    arcade.wait(3.0)
    assert arcade.stack.top is match
    assert match.devices[:2] == KEYS[:2]


def test_when_all_are_idle_the_match_asks_and_the_first_press_returns_its_seat(arcade: Arcade) -> None:
    match = running(arcade, "human human off off", KEYS[:2], 5.0)
    arcade.until(lambda: isinstance(arcade.stack.top, StillThere), 70.0)
    assert match.devices[:2] == [None, None]
    arcade.press(Button.LEFT, device=KEYS[1])
    assert arcade.stack.top is match
    assert match.devices[:2] == [None, KEYS[1]]


def test_a_free_pad_takes_an_ais_seat_by_holding_fire_and_a_tap_is_not_enough(arcade: Arcade) -> None:
    _, first = arcade.plug()
    guest, device = arcade.plug()
    match = running(arcade, "human level1 level1 off", [first])
    tap(arcade, guest, "a", "a", "a")
    arcade.wait(TAKE_SECONDS + 0.2, draw=True)
    assert match.devices == [first, None, None, None]
    guest.press("a")
    arcade.wait(TAKE_SECONDS + 0.2, draw=True)
    guest.release("a")
    assert match.devices == [first, None, device, None]
    assert isinstance(match.match.brains[2], HumanPlayer)
    assert 2 in match.drivers.assisted, "what the AI scored is no record of the newcomer"
    tap(arcade, guest, "start")
    arcade.shown(Pause)
    match.restart()
    arcade.press(Button.START, device=device)
    arcade.frame()
    again = arcade.shown(MatchScene)
    assert again.devices == [first, None, device, None]
    assert isinstance(again.match.brains[2], HumanPlayer)


# ---- results


def ended(arcade: Arcade, brains: str, devices: list[Device]) -> Results:
    arcade.open(MatchScene(arcade.context, setup(brains, 0.02), devices, game_choice=game_choice))
    return arcade.reach(Results)


def test_b_leaves_the_results_only_late_and_held(arcade: Arcade) -> None:
    pad, device = arcade.plug()
    results = ended(arcade, "human level1 off off", [device])
    for _ in range(12):
        tap(arcade, pad, "b")
        arcade.wait(0.2)
    pad.press("b")
    arcade.until(lambda: results.age > LATE + 1.0)
    assert arcade.shown(Results) is results, "a button that is still held from the match"
    pad.release("b")
    arcade.frame()
    tap(arcade, pad, "b", "b", "b")
    assert arcade.shown(Results) is results
    pad.press("b")
    arcade.wait(LEAVE + 0.1)
    assert arcade.stack.top is arcade.title


def test_on_the_results_a_free_pad_can_only_take_an_ais_seat(arcade: Arcade) -> None:
    _, first = arcade.plug()
    guest, device = arcade.plug()
    results = ended(arcade, "human level1 off off", [first])
    arcade.wait(LATE + 1.0)
    tap(arcade, guest, *BUTTONS, "a")
    guest.press("b")
    arcade.wait(1.0)
    guest.release("b")
    assert arcade.shown(Results) is results
    assert not results.ballot.votes
    guest.press("a")
    arcade.wait(TAKE_SECONDS + 0.2, draw=True)
    guest.release("a")
    assert results.ballot.votes == {1}
    arcade.press(Button.FIRE, device=first)
    arcade.frame()
    match = arcade.shown(MatchScene)
    assert match.devices[:2] == [first, device]
    assert [seat.brain for seat in match.setup.seats[:2]] == ["human", "human"]


def test_change_game_keeps_all_seats(arcade: Arcade) -> None:
    ended(arcade, "human off human level5", [KEYS[2], None, KEYS[0], None])  # type: ignore[list-item]
    arcade.wait(3.0)
    arcade.press(Button.X, device=KEYS[1])
    arcade.shown(Results)
    arcade.press(Button.X, device=KEYS[0])
    page = arcade.shown(GameChoice)
    assert page.focus.name != "pitanks"
    arcade.press(Button.FIRE, *EVERY, device=KEYS[1])
    assert arcade.shown(GameChoice) is page
    arcade.press(Button.FIRE, device=KEYS[2])
    there = arcade.shown(Lobby)
    assert there.game == "factory"
    assert [place.device for place in there.seats.places] == [KEYS[2], None, KEYS[0], None]
    assert there.seats.places[3].strength == "level5"
    assert len(arcade.stack.scenes) == 2, "the title lies below, not the lobby of the game before"


def test_the_title_names_the_button_of_the_device_used_last_and_what_it_opens(arcade: Arcade) -> None:
    pad, device = arcade.plug(name="PS4 Controller", usb=PLAYSTATION)
    scene = arcade.open(Title(arcade.context))
    assert scene.call_text == ("Press {button} to play", "SPACE")
    tap(arcade, pad, "down")
    assert arcade.context.controls.last == device
    assert scene.call_text == ("How to play: press {button}", "Cross")
    pad.unplug()
    arcade.frame()
    assert scene.call_text[1] == "SPACE", "not the button of a pad that is gone"


# ---- random input


def test_four_mashers_and_a_guest_change_only_their_own_seats(arcade: Arcade) -> None:
    chance = random.Random(9)
    page = lobby_of(arcade)
    acts = [
        act
        for act in Button
        if act not in (Button.START, Button.X, Button.POINT, Button.CLICK, Button.FOUND, Button.LOST)
    ]
    for _ in range(4000):
        arcade.stack.scenes[1:] = [page]
        device, act = chance.choice([*KEYS, Device("pad", 7)]), chance.choice(acts)
        people = [place.device for place in page.seats.places]
        before = {place.device: (i, place.ready) for i, place in enumerate(page.seats.places) if place.kind == HUMAN}
        arcade.press(act, device=device)
        after = {place.device: (i, place.ready) for i, place in enumerate(page.seats.places) if place.kind == HUMAN}
        for other in people:
            if other and other != device:
                assert after[other] == before[other], f"{act} of {device} changed the seat of {other}"


@pytest.mark.long
def test_thousands_of_presses_by_everybody_on_every_screen(arcade: Arcade) -> None:
    chance = random.Random(4)
    arcade.stack.scenes[1:] = []
    acts = [act for act in Button if act not in (Button.POINT, Button.CLICK, Button.FOUND, Button.LOST)]
    seen = set()
    for i in range(3000):
        if len(arcade.stack.scenes) == 1:
            arcade.open(Lobby(arcade.context, ("pitanks", "factory", "race")[i % 3]))
        arcade.press(chance.choice(acts), device=chance.choice([*KEYS, Device("pad", 7)]))
        top = arcade.stack.top
        seen.add(type(top).__name__)
        if isinstance(top, MatchScene):
            driving = [device for device in top.devices if device]
            assert len(driving) == len(set(driving)), "nobody drives two seats"
            assert Device("pad", 7) not in driving or top.context.controls.connected(Device("pad", 7))
            if chance.random() < 0.01:
                top.stop()
        if i % 4 == 0:
            arcade.stack.apply(arcade.stack.top.update(chance.choice((0.02, 0.05, 0.4))))
    assert {"Lobby", "MatchSetupPage", "MatchScene", "Pause"} <= seen
