"""The operator's pages of phones: the list of all, the Wi-Fi, a new code, and how turns pass."""

from collections.abc import Iterator

import pygame
import pytest

from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.pages.text_page import TextPage
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.join import JoinByPhone
from pigaming_app.scenes.phones.link import PhoneLink
from pigaming_app.scenes.phones.list_page import PhoneList
from pigaming_app.scenes.phones.settings_page import PhonesPage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.input.events import Button, Device
from pigaming_app.ui.input.phone_messages import Wish, WishKind
from pigaming_app.ui.input.phones.roster import Roster
from pigaming_app.ui.web.code import wifi_text
from tests.scenes.arcade import Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


@pytest.fixture
def roster(arcade: Arcade) -> Iterator[Roster]:
    """Six phones, of which two have names; phones are on."""
    settings = arcade.context.settings
    settings.phones, settings.phones_network, settings.phones_port = True, "127.0.0.1", 0
    PhoneLink(arcade.context).update(arcade.stack.scenes)
    host = arcade.context.shared(phone_host)
    for i in range(6):
        admitted = host.roster.admit("", f"10.0.0.{i}")
        assert not isinstance(admitted, str)
    host.roster.wish(0, Wish(WishKind.NAME, text="Ana"))
    host.roster.wish(5, Wish(WishKind.NAME, text="Zoë"))
    arcade.frame()
    yield host.roster
    host.close()


def test_the_list_shows_all_and_sends_one_away_or_bans_it(arcade: Arcade, roster: Roster) -> None:
    page = arcade.open(PhoneList(arcade.context))
    page.draw(arcade.screen)
    assert [guest.name for guest in page.guests] == ["Ana", "", "", "", "", "Zoë"]
    assert page.subtitle == "6 / 32"
    arcade.press(Button.DOWN, Button.FIRE)
    arcade.frame()
    assert [guest.number for guest in page.guests] == [0, 2, 3, 4, 5]
    assert page.message == "Phone 2 was sent away."
    page.focus.move_to("5")
    arcade.press(Button.X)
    arcade.frame()
    page.draw(arcade.screen)
    assert [guest.number for guest in page.guests] == [0, 2, 3, 4]
    assert page.message == "Zoë is banned."
    assert roster.admit("", "10.0.0.5") == "removed"
    for _ in range(4):
        arcade.press(Button.FIRE)
        arcade.frame()
    page.draw(arcade.screen)
    assert page.guests == []
    arcade.press(Button.FIRE, Button.X, Button.BACK)
    assert arcade.stack.top is not page


def test_no_phone_acts_on_the_list(arcade: Arcade, roster: Roster) -> None:
    """A phone is always a visitor's; the guard before all scenes keeps it off."""
    from pigaming_app.scenes.flow.access import Right, Roles, right_of

    page = arcade.open(PhoneList(arcade.context))
    assert right_of([page]) is Right.SETTINGS
    assert not arcade.context.shared(Roles).may(Device("phone", 0), Right.SETTINGS)


def test_a_removed_player_leaves_the_lobby(arcade: Arcade, roster: Roster) -> None:
    lobby = arcade.open(Lobby(arcade.context, "pitanks"))
    lobby.seats.join(Device("phone", 0))
    roster.remove(0)
    arcade.frame()
    assert lobby.seats.devices() == [None] * 4


def row(arcade: Arcade, name: str) -> PhonesPage:
    page = arcade.open(PhonesPage(arcade.context))
    page.focus.move_to(name)
    return page


def test_the_wifi_is_typed_kept_and_shown_beside_the_page(arcade: Arcade, roster: Roster) -> None:
    cv2 = pytest.importorskip("cv2", reason="the extra `hardware` is not installed")
    from pigaming_app.ui.draw.pixels import pixels_of

    for name, typed in (("wifi", "Gäste; 1"), ("wifi_key", 'a  b"c')):
        page = row(arcade, name)
        arcade.press(Button.FIRE)
        typing = arcade.shown(TextPage)
        arcade.wait(TextPage.lockout + 0.1)
        for letter in typed:
            typing.type(letter)
        arcade.press(Button.START)
        assert arcade.stack.top is page
        page.draw(arcade.screen)
    kept = Settings.load(folders().config)[0]
    assert (kept.phones_wifi, kept.phones_wifi_key) == ("Gäste; 1", 'a  b"c')
    url = arcade.context.shared(phone_host).url
    arcade.open(JoinByPhone(arcade.context, lambda: [None] * 4)).draw(arcade.screen)
    seen = pygame.transform.smoothscale(arcade.screen, (1440, 810))
    found, texts, _, _ = cv2.QRCodeDetectorAruco().detectAndDecodeMulti(pixels_of(seen))
    assert found
    assert set(texts) == {url.upper(), wifi_text("Gäste; 1", 'a  b"c')}


def test_a_new_code_is_made_by_a_held_button_and_everybody_has_to_scan_it(arcade: Arcade, roster: Roster) -> None:
    host = arcade.context.shared(phone_host)
    before = host.url
    page = row(arcade, "renew")
    arcade.press(Button.FIRE)
    assert host.url == before, "a tap is not enough"
    page.held()
    assert host.url not in ("", before)
    assert roster.guests() == []
    assert page.message


def test_the_switches_are_settings(arcade: Arcade, roster: Roster) -> None:
    for name in ("stay", "teams"):
        page = row(arcade, name)
        arcade.press(Button.RIGHT)
        page.draw(arcade.screen)
    kept = Settings.load(folders().config)[0]
    assert (kept.phones_stay, kept.phones_teams) == (True, True)


def test_a_new_lobby_begins_with_teams_if_the_operator_likes(arcade: Arcade, roster: Roster) -> None:
    link = PhoneLink(arcade.context)
    for on in (False, True):
        arcade.context.settings.phones_teams = on
        lobby = arcade.open(Lobby(arcade.context, "pitanks"))
        link.update([lobby])
        assert lobby.seats.teams is on
    lobby.seats.teams = False
    link.update([lobby])
    assert not lobby.seats.teams, "people may change it"
