"""Turns in the arcade: who waits is called when a match ends, and a locked phone keeps its seat until then."""

from collections.abc import Iterator

import pytest

from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.link import RESULT_SECONDS, PhoneLink
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import TIMEOUT, Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.phone_messages import BITS, LEFT_QUEUE, SeatView, Touches
from pigaming_app.ui.input.phone_pads import Phones
from pigaming_app.ui.input.phones.guest import Stage
from pigaming_app.ui.input.phones.roster import TURN_SECONDS, UNTOUCHED_SECONDS
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


class Crowd:
    """Visitors with phones in front of an arcade whose time is counted in frames."""

    def __init__(self, arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
        self.arcade, self.now = arcade, 0.0
        self.host = arcade.context.shared(phone_host)
        self.roster = self.host.roster
        self.roster.clock = lambda: self.now
        arcade.context.settings.phones = True
        self.host.switch(True, "127.0.0.1", 0, {})
        settings = arcade.context.settings
        settings.phones_network, settings.phones_port = "127.0.0.1", 0
        self.link = PhoneLink(arcade.context, lambda: self.now)
        self.tokens: dict[int, str] = {}
        self.shown: dict[int, SeatView] = {}
        monkeypatch.setattr(Phones, "show", lambda phones, number, view: self.shown.__setitem__(number, view))

    def scan(self) -> Device:
        admitted = self.roster.admit("", "10.0.0.1")
        assert not isinstance(admitted, str)
        self.tokens[admitted[0]] = admitted[1]
        self.frame()
        return Device("phone", admitted[0])

    def lock(self, device: Device) -> None:
        self.roster.leave(device.number)
        self.frame()

    def unlock(self, device: Device) -> None:
        admitted = self.roster.admit(self.tokens[device.number], "10.0.0.1")
        assert not isinstance(admitted, str)
        assert admitted[0] == device.number
        self.tokens[device.number] = admitted[1]
        self.frame()

    def tap(self, device: Device, button: Button = Button.FIRE) -> None:
        for buttons in (BITS[button], 0):
            self.roster.receive(device.number, Touches(buttons=buttons))
            self.frame()

    def frame(self, seconds: float = 1 / 60) -> None:
        self.now += seconds
        self.arcade.frame(seconds)
        self.link.update(self.arcade.stack.scenes)

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds * 4)):
            self.arcade.context.idle = 0.0
            self.frame(0.25)

    @property
    def acting(self) -> list[int]:
        return sorted(self.arcade.context.controls.phones.plugged)

    def match(self, *devices: Device | None) -> MatchScene:
        setup = setup_of("pitanks", ["human" if device else "level1" for device in devices], "classic", 2)
        match = self.arcade.open(MatchScene(self.arcade.context, setup, devices))
        while match.opening.countdown.locked:
            self.frame()
        return match

    def results(self, match: MatchScene) -> Results:
        """The match is over."""
        outcome = match.match.outcome()
        context = self.arcade.context
        page = Results(context, outcome, match.setup, match.devices, match.sequel.rematch)
        page.claims = []
        self.arcade.open(page)
        self.frame()
        return page


@pytest.fixture
def crowd(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> Iterator[Crowd]:
    crowd = Crowd(arcade, monkeypatch)
    yield crowd
    crowd.host.close()


def test_six_phones_four_may_act_and_two_see_their_place(crowd: Crowd) -> None:
    crowd.arcade.open(Lobby(crowd.arcade.context, "pitanks"))
    six = [crowd.scan() for _ in range(6)]
    assert crowd.acting == [0, 1, 2, 3]
    assert [crowd.shown[device.number].before for device in six] == [-1, -1, -1, -1, 0, 1]
    lobby = crowd.arcade.stack.scenes[-2]
    assert isinstance(lobby, Lobby)
    for device in six:
        crowd.tap(device)
    assert lobby.seats.devices() == six[:4], "A of those who wait does nothing"
    assert [crowd.shown[device.number].seat for device in six] == [0, 1, 2, 3, -1, -1]


def test_pads_in_the_lobby_leave_fewer_places(crowd: Crowd) -> None:
    lobby = crowd.arcade.open(Lobby(crowd.arcade.context, "pitanks"))
    crowd.frame()
    lobby.seats.join(KEYS[0])
    lobby.seats.join(KEYS[1])
    four = [crowd.scan() for _ in range(4)]
    assert crowd.acting == [0, 1]
    assert crowd.shown[four[2].number].before == 0
    lobby.seats.leave(0)
    crowd.frame()
    crowd.frame()
    assert crowd.acting == [0, 1, 2]


@pytest.mark.parametrize("page", ["", "phones", "controls"])
def test_a_pause_takes_no_seat_from_those_who_play(crowd: Crowd, page: str) -> None:
    six = [crowd.scan() for _ in range(6)]
    match = crowd.match(*six[:4])
    crowd.tap(six[0], Button.START)
    pause = crowd.arcade.stack.top
    assert isinstance(pause, Pause)
    if page:
        pause.focus.move_to(page)
        crowd.tap(six[0])
        assert crowd.arcade.stack.top is not pause
    crowd.wait(2 * TURN_SECONDS)
    assert crowd.acting == [0, 1, 2, 3]
    assert not any(guest.played for guest in crowd.roster.guests())
    for _ in range(2 if page else 1):
        crowd.tap(six[0], Button.BACK)
    assert crowd.arcade.stack.top is match
    crowd.wait(1)
    assert match.devices == six[:4]


def test_those_who_wait_see_the_match_and_play_the_next_one(crowd: Crowd) -> None:
    six = [crowd.scan() for _ in range(6)]
    match = crowd.match(*six[:4])
    crowd.wait(1)
    assert crowd.shown[4].line.count("·") == 4, "four robots and the clock"
    match.match.state.robots[0].score = 7
    crowd.wait(1)
    assert "7" in crowd.shown[5].line
    page = crowd.results(match)
    assert crowd.acting == [0, 1, 2, 3], "the result is seen first"
    crowd.wait(RESULT_SECONDS + 0.5)
    assert crowd.acting == [0, 1, 4, 5], "of those who played, two have a second turn: there are four seats"
    assert crowd.shown[2].place
    assert (crowd.shown[2].before, crowd.shown[3].before) == (0, 1)
    for device in (six[4], six[5], six[0], six[1]):
        crowd.tap(device)
    assert [device and device.number for device in page.ballot.devices] == [0, 1, 4, 5]
    crowd.frame()
    again = crowd.arcade.shown(MatchScene)
    assert [device and device.number for device in again.devices] == [0, 1, 4, 5]


def test_the_winner_stays_if_the_operator_likes(crowd: Crowd) -> None:
    crowd.arcade.context.settings.phones_stay = True
    eight = [crowd.scan() for _ in range(8)]
    match = crowd.match(*eight[:4])
    match.match.state.robots[2].score = 9
    crowd.results(match)
    crowd.wait(RESULT_SECONDS + 0.5)
    assert crowd.acting == [2, 4, 5, 6]


def test_initials_come_before_the_next_turn(crowd: Crowd) -> None:
    five = [crowd.scan() for _ in range(5)]
    match = crowd.match(*five[:4])
    page = crowd.results(match)
    page.claims = [object()]  # type: ignore[list-item]
    for _ in range(40):
        page.age = 0.0
        crowd.frame(0.25)
    assert crowd.acting == [0, 1, 2, 3]


def test_a_match_that_is_left_counts_as_a_turn(crowd: Crowd) -> None:
    five = [crowd.scan() for _ in range(5)]
    match = crowd.match(five[0], five[1], None, None)
    crowd.frame()
    crowd.arcade.stack.scenes.remove(match)
    crowd.frame()
    crowd.frame()
    assert [guest.number for guest in crowd.roster.guests() if guest.played] == [0, 1]
    assert crowd.acting == [0, 2, 3, 4]


def test_a_locked_phone_keeps_its_seat_from_other_phones_until_the_match_ends(crowd: Crowd) -> None:
    three = [crowd.scan() for _ in range(3)]
    match = crowd.match(three[0], three[1], None, None)
    crowd.lock(three[1])
    page = crowd.arcade.shown(Reconnect)
    crowd.tap(three[2])
    assert crowd.arcade.shown(Reconnect) is page, "a phone that drives nothing does not take it either"
    crowd.wait(TIMEOUT + 0.5)
    assert crowd.arcade.shown(MatchScene) is match
    assert match.devices[1] is None, "an AI drives"
    crowd.tap(three[2])
    crowd.roster.receive(2, Touches(buttons=BITS[Button.FIRE]))
    crowd.wait(1)
    assert match.devices == [three[0], None, None, three[2]], "held, FIRE takes an AI's seat, not the phone's"
    crowd.unlock(three[1])
    crowd.tap(three[1])
    assert match.devices[1] == three[1]


def test_a_pad_or_key_may_take_the_seat_that_an_ai_drives_for_a_phone(crowd: Crowd) -> None:
    two = [crowd.scan() for _ in range(2)]
    match = crowd.match(two[0], two[1], None, None)
    crowd.lock(two[1])
    crowd.wait(TIMEOUT + 0.5)
    assert 1 in match.drivers.takeable_by(KEYS[0])
    assert 1 not in match.drivers.takeable_by(Device("phone", 7))
    assert 1 in match.drivers.takeable_by(two[1])


def test_one_phone_halts_a_match_once(crowd: Crowd) -> None:
    two = [crowd.scan() for _ in range(2)]
    match = crowd.match(*two)
    crowd.lock(two[1])
    crowd.arcade.shown(Reconnect)
    crowd.unlock(two[1])
    crowd.tap(two[1])
    assert crowd.arcade.stack.top is match
    for _ in range(3):
        crowd.lock(two[1])
        crowd.frame()
        assert crowd.arcade.stack.top is match, "nobody else waits for it again"
        assert match.devices[1] is None
        crowd.unlock(two[1])
        crowd.tap(two[1])
        assert match.devices[1] == two[1], "any button, and it drives"
    crowd.lock(two[0])
    crowd.arcade.shown(Reconnect)


def test_a_turn_on_a_full_match_does_not_pass_and_in_the_lobby_it_does(crowd: Crowd) -> None:
    five = [crowd.scan() for _ in range(5)]
    crowd.match(*five[:4])
    crowd.wait(TURN_SECONDS / 10)
    assert crowd.acting == [0, 1, 2, 3]
    crowd.arcade.open(Lobby(crowd.arcade.context, "pitanks"))
    crowd.arcade.stack.scenes[:-1] = [crowd.arcade.title]
    crowd.frame()
    called = crowd.acting
    crowd.wait(TURN_SECONDS + 1)
    assert crowd.acting != called


def test_who_has_left_the_queue_is_told_and_comes_back_by_a_press(crowd: Crowd) -> None:
    five = [crowd.scan() for _ in range(5)]
    crowd.now += UNTOUCHED_SECONDS + 1
    crowd.frame()
    guest = crowd.roster.guest(4)
    assert guest
    assert guest.stage is Stage.IDLE
    assert crowd.shown[4].before == LEFT_QUEUE
    crowd.tap(five[4])
    assert crowd.shown[4].before == 0
