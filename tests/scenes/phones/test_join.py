"""Phones in the arcade: the code in the lobby, seats, the reconnect page, and the operator's page."""

import json
from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest

from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.scene import CODE_SECONDS, Lobby
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import JoinByPhone
from pigaming_app.scenes.phones.link import TALLY_SECONDS, PhoneLink
from pigaming_app.scenes.phones.settings_page import PhonesPage
from pigaming_app.scenes.play.pause import Pause
from pigaming_app.scenes.play.reconnect import TIMEOUT, Reconnect
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.storage.settings import Settings
from pigaming_app.ui.draw import PLAYERS
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.phone_messages import BITS, SeatView, Touches
from pigaming_app.ui.input.phone_pads import Phones
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")

MOUSE = Device("mouse")


@pytest.fixture
def open_to_phones(arcade: Arcade) -> Iterator[Arcade]:
    """Phones are on, on the loopback address."""
    arcade.context.shared(phone_host).switch(True, "127.0.0.1", 0, {})
    yield arcade
    arcade.context.shared(phone_host).close()


def join(arcade: Arcade) -> Device:
    device = Device("phone", arcade.context.controls.phones.connect())
    arcade.frame()
    return device


def tap(arcade: Arcade, device: Device, button: Button) -> None:
    phones = arcade.context.controls.phones
    for buttons in (BITS[button], 0):
        phones.receive(device.number, Touches(buttons=buttons))
        arcade.frame()


def lobby_of(arcade: Arcade) -> Lobby:
    return arcade.open(Lobby(arcade.context, "pitanks"))


def test_the_lobby_opens_with_the_code_and_phones_join_on_it(open_to_phones: Arcade) -> None:
    arcade = open_to_phones
    lobby = lobby_of(arcade)
    arcade.frame()
    page = arcade.shown(JoinByPhone)
    one, two = join(arcade), join(arcade)
    tap(arcade, one, Button.FIRE)
    tap(arcade, two, Button.FIRE)
    assert lobby.seats.devices()[:2] == [one, two]
    assert arcade.shown(JoinByPhone) is page
    tap(arcade, two, Button.BACK)
    assert lobby.seats.devices()[:2] == [one, None], "turbo leaves the seat, as on a pad"
    tap(arcade, two, Button.FIRE)
    tap(arcade, one, Button.FIRE)
    assert arcade.shown(JoinByPhone) is page, "one is ready"
    tap(arcade, two, Button.FIRE)
    assert arcade.stack.top is lobby, "both are ready: the countdown runs"
    assert [place.ready for place in lobby.seats.places[:2]] == [True, True]
    for _ in range(90):
        arcade.frame()
    arcade.shown(MatchScene)


def test_a_pad_or_key_joins_through_the_code_at_once(open_to_phones: Arcade) -> None:
    lobby = lobby_of(open_to_phones)
    open_to_phones.frame()
    open_to_phones.shown(JoinByPhone)
    open_to_phones.press(Button.FIRE)
    assert open_to_phones.stack.top is lobby
    assert lobby.seats.devices()[0] == KEYS[0]
    open_to_phones.frame()
    assert open_to_phones.stack.top is lobby, "not twice"


def test_the_code_comes_back_while_nobody_acts(open_to_phones: Arcade) -> None:
    lobby = lobby_of(open_to_phones)
    open_to_phones.frame()
    open_to_phones.press(Button.BACK)
    assert open_to_phones.stack.top is lobby
    open_to_phones.context.idle = CODE_SECONDS + 1.0
    open_to_phones.frame()
    open_to_phones.shown(JoinByPhone)
    open_to_phones.context.idle = 61.0
    open_to_phones.frame()
    assert open_to_phones.stack.top is open_to_phones.title


def test_a_click_on_the_small_code_shows_the_large_one(open_to_phones: Arcade) -> None:
    lobby = lobby_of(open_to_phones)
    open_to_phones.frame()
    open_to_phones.press(Button.BACK)
    lobby.draw(open_to_phones.screen)
    open_to_phones.press(Button.POINT, device=MOUSE)
    open_to_phones.click(*next(spot.rect.center for spot in lobby.focus.spots if spot.name.startswith("code")))
    open_to_phones.shown(JoinByPhone)
    open_to_phones.click(960, 540)
    assert open_to_phones.stack.top is lobby


def test_start_on_a_phone_leads_on_to_the_match(open_to_phones: Arcade) -> None:
    lobby = lobby_of(open_to_phones)
    open_to_phones.frame()
    one = join(open_to_phones)
    tap(open_to_phones, one, Button.FIRE)
    tap(open_to_phones, one, Button.START)
    open_to_phones.shown(MatchSetupPage)
    assert open_to_phones.stack.scenes[-2] is lobby


def test_while_phones_are_off_nothing_of_them_is_shown(arcade: Arcade) -> None:
    lobby = lobby_of(arcade)
    arcade.context.idle = CODE_SECONDS + 1.0
    arcade.frame()
    assert arcade.stack.top is lobby
    assert lobby.page.code_seat is None
    assert not [spot for spot in lobby.focus.spots if spot.name.startswith("code")]


def test_a_locked_phone_frees_its_seat_in_the_lobby(open_to_phones: Arcade) -> None:
    lobby = lobby_of(open_to_phones)
    open_to_phones.frame()
    one = join(open_to_phones)
    tap(open_to_phones, one, Button.FIRE)
    open_to_phones.context.controls.phones.disconnect(one.number)
    open_to_phones.frame()
    assert lobby.seats.devices() == [None] * 4
    assert "phone" in lobby.now.message


def match_with(arcade: Arcade, *devices: Device | None) -> MatchScene:
    setup = setup_of("pitanks", ["human" if device else "idle" for device in devices], "classic", 2, variant="plain")
    match = arcade.open(MatchScene(arcade.context, setup, devices))
    while match.opening.countdown.locked:
        arcade.frame()
    return match


def test_a_locked_phone_halts_the_match_and_goes_on_as_the_same_device(arcade: Arcade) -> None:
    one, two = join(arcade), join(arcade)
    match = match_with(arcade, one, two)
    phones = arcade.context.controls.phones
    phones.disconnect(two.number)
    arcade.frame()
    page = arcade.shown(Reconnect)
    assert page.seat == 1
    tap(arcade, one, Button.FIRE)
    assert arcade.shown(Reconnect) is page, "another player's phone does not take the seat"
    phones.connect(two.number)
    arcade.frame()
    assert page.replugged
    page.draw(arcade.screen)
    tap(arcade, two, Button.FIRE)
    assert arcade.stack.top is match
    assert match.devices[:2] == [one, two]


def test_without_an_answer_an_ai_drives_until_the_phone_returns(arcade: Arcade) -> None:
    one, two = join(arcade), join(arcade)
    match = match_with(arcade, one, two)
    phones = arcade.context.controls.phones
    phones.disconnect(two.number)
    arcade.frame()
    arcade.shown(Reconnect)
    arcade.frame(TIMEOUT + 0.1)
    assert arcade.stack.top is match
    assert match.devices[1] is None
    phones.connect(two.number)
    arcade.frame()
    tap(arcade, two, Button.FIRE)
    assert match.devices[1] == two


def test_a_phone_drives_pauses_and_does_not_pause_by_turbo(arcade: Arcade) -> None:
    one = join(arcade)
    match = match_with(arcade, one, None)
    phones = arcade.context.controls.phones
    heading = match.match.state.robots[0].heading
    phones.receive(one.number, Touches(0.0, 1.0, BITS[Button.BACK]))
    for _ in range(30):
        arcade.frame()
        phones.receive(one.number, Touches(0.0, 1.0, BITS[Button.BACK]))
    assert match.match.state.robots[0].heading != heading
    assert arcade.stack.top is match
    tap(arcade, one, Button.START)
    arcade.shown(Pause)


def test_the_pause_shows_the_code_while_phones_are_on(open_to_phones: Arcade) -> None:
    arcade = open_to_phones
    one = join(arcade)
    match_with(arcade, one, None)
    tap(arcade, one, Button.START)
    pause = arcade.shown(Pause)
    assert "phones" in [spot.name for spot in pause.focus.spots]
    pause.focus.move_to("phones")
    tap(arcade, one, Button.FIRE)
    arcade.shown(JoinByPhone).draw(arcade.screen)
    tap(arcade, one, Button.FIRE)
    arcade.shown(JoinByPhone)
    tap(arcade, one, Button.BACK)
    assert arcade.stack.top is pause


def test_phones_are_told_their_seats(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: dict[int, SeatView] = {}
    monkeypatch.setattr(Phones, "show", lambda self, number, view: shown.__setitem__(number, view))
    now = [0.0]
    link = PhoneLink(arcade.context, lambda: now[0])
    lobby = lobby_of(arcade)
    free, seated = join(arcade), join(arcade)
    tap(arcade, seated, Button.FIRE)
    link.update(arcade.stack.scenes)
    assert shown[free.number].seat == -1
    assert shown[seated.number] == SeatView(0, "#{:02x}{:02x}{:02x}".format(*PLAYERS[0]), False)
    assert arcade.stack.top is lobby
    match_with(arcade, None, seated)
    now[0] += TALLY_SECONDS
    link.update(arcade.stack.scenes)
    assert shown[seated.number] == SeatView(1, "#{:02x}{:02x}{:02x}".format(*PLAYERS[1]), True, "0", "2:00")
    assert not shown[free.number].playing
    tap(arcade, seated, Button.START)
    arcade.shown(Pause)
    link.update(arcade.stack.scenes)
    assert shown[seated.number].seat == 1
    assert not shown[seated.number].playing, "X and Y count in a menu"


def test_a_phone_shows_its_score_four_times_a_second_at_most_and_its_place(arcade: Arcade) -> None:
    sent: list[tuple[float, SeatView]] = []
    now = [0.0]
    phones = arcade.context.controls.phones
    one, two = join(arcade), join(arcade)
    match = match_with(arcade, one, two)

    def note(number: int, text: str) -> None:
        message = json.loads(text)
        if number == two.number and "state" in message:
            sent.append((now[0], SeatView(**message["state"])))

    phones.send = note
    link = PhoneLink(arcade.context, lambda: now[0])
    for frame in range(180):
        now[0] = frame / 60
        match.match.state.robots[1].score = frame
        phones.receive(two.number, Touches())
        link.update(arcade.stack.scenes)
    assert [int(view.score) for _, view in sent] == list(range(0, 180, 15))
    assert all(view.clock == "2:00" for _, view in sent)
    outcome = match.match.outcome()
    arcade.open(Results(arcade.context, outcome, match.setup, match.devices, lambda *_: arcade.title))
    now[0] += TALLY_SECONDS
    link.update(arcade.stack.scenes)
    view = sent[-1][1]
    assert view.place == {1: "1st", 2: "2nd", 3: "3rd", 4: "4th"}[next(r.place for r in outcome.rows if r.seat == 1)]
    assert (view.seat, view.playing, view.clock) == (1, False, "")


@pytest.mark.parametrize("kiosk", [False, True])
@pytest.mark.parametrize("name", ["title", "lobby", "match", "pause", "results", "phones"])
def test_a_phone_may_come_and_go_on_any_screen(arcade: Arcade, name: str, kiosk: bool) -> None:
    arcade.context.kiosk = kiosk
    link, phones = PhoneLink(arcade.context), arcade.context.controls.phones
    one = join(arcade)
    if name in ("match", "pause", "results"):
        match = match_with(arcade, one, KEYS[0])
        if name == "pause":
            tap(arcade, one, Button.START)
            arcade.shown(Pause)
        if name == "results":
            outcome = match.match.outcome()
            arcade.open(Results(arcade.context, outcome, match.setup, match.devices, lambda *_: arcade.title))
    elif name != "title":
        arcade.open(Lobby(arcade.context, "pitanks") if name == "lobby" else PhonesPage(arcade.context))
    top = arcade.stack.top
    two = join(arcade)
    for _ in range(3):
        arcade.frame()
        link.update(arcade.stack.scenes)
        top.draw(arcade.screen)
    phones.disconnect(two.number)
    arcade.frame()
    link.update(arcade.stack.scenes)
    assert arcade.stack.top is top, "a phone that only comes and goes disturbs nobody"
    phones.connect(two.number)
    arcade.frame()
    assert arcade.context.controls.connected(two)


def test_the_link_follows_the_settings(arcade: Arcade) -> None:
    link, settings, host = PhoneLink(arcade.context), arcade.context.settings, arcade.context.shared(phone_host)
    link.update(arcade.stack.scenes)
    assert not host.on
    settings.phones, settings.phones_network, settings.phones_port = True, "127.0.0.1", 0
    link.update(arcade.stack.scenes)
    try:
        assert host.url
        assert host.server is not None
        assert host.server.texts["page_player"] == "Player {player}"
        arcade.context.words.switch("pt")
        link.update(arcade.stack.scenes)
        assert host.server.texts["page_player"] == "Jogador {player}"
    finally:
        settings.phones = False
        link.update(arcade.stack.scenes)
    assert host.server is None


def test_the_operators_page_changes_and_keeps_the_settings(arcade: Arcade, home: Path) -> None:
    page = arcade.open(PhonesPage(arcade.context))
    page.draw(arcade.screen)
    arcade.press(Button.RIGHT)
    assert arcade.context.settings.phones
    assert Settings.load(home / "config")[0].phones
    arcade.press(Button.FIRE)
    assert not arcade.context.settings.phones
    if page.networks:
        arcade.press(Button.DOWN, Button.RIGHT)
        assert arcade.context.settings.phones_network == page.networks[0].name
        arcade.press(Button.LEFT)
        assert arcade.context.settings.phones_network == ""
    arcade.press(Button.UP, Button.UP, Button.FIRE)
    assert arcade.stack.top is page, "phones are off: there is no code"
    assert page.message
    page.draw(arcade.screen)
    arcade.press(Button.BACK)
    assert arcade.stack.top is not page


def test_trouble_is_one_sentence_on_both_pages(arcade: Arcade) -> None:
    arcade.context.shared(phone_host).switch(True, "a network that is gone", 8787, {})
    try:
        for page in (PhonesPage(arcade.context), JoinByPhone(arcade.context, lambda: [])):
            arcade.open(page)
            page.draw(arcade.screen)
            arcade.press(Button.BACK)
        assert lobby_of(arcade).page.code_seat is None
    finally:
        arcade.context.shared(phone_host).close()


def test_the_large_code_in_the_picture_can_be_read(open_to_phones: Arcade) -> None:
    cv2 = pytest.importorskip("cv2", reason="the extra `hardware` is not installed")
    from pigaming_app.ui.draw.pixels import pixels_of

    url = open_to_phones.context.shared(phone_host).url
    page = JoinByPhone(open_to_phones.context, lambda: [None] * 4)
    page.draw(open_to_phones.screen)
    seen = pygame.transform.smoothscale(open_to_phones.screen, (960, 540))
    text, _, _ = cv2.QRCodeDetectorAruco().detectAndDecode(pixels_of(seen))
    assert text == url.upper()
