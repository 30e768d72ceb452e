"""The desk that an arcade serves by itself: on by the operator's switch, for the event that is shown."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from pigaming_app.scenes.events import feature
from pigaming_app.scenes.events.desk import host as module
from pigaming_app.scenes.events.desk.host import CHECK_SECONDS, DeskHost, desk_host
from pigaming_app.scenes.events.feature import DeskService
from pigaming_app.scenes.events.manage.desk_page import DeskPage
from pigaming_app.scenes.events.manage.event_page import DESK, EventPage
from pigaming_app.scenes.events.next_page import NextMatch
from pigaming_app.scenes.flow.scene import Pop
from pigaming_app.storage.pin import PinFile
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import LANGUAGES
from pigaming_app.ui.input.events import Button
from tests.jobs.kiosk.test_supervisor import Clock
from tests.scenes.arcade import Arcade
from tests.scenes.events.desk.examples import PIN, new_event
from tests.scenes.events.drawn import an_event, running
from tests.ui.web.client import ask

pytestmark = pytest.mark.usefixtures("_no_threads_stay", "_nothing_prewarmed")
HERE = "127.0.0.1"


@pytest.fixture(autouse=True)
def _a_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path / "home"))
    monkeypatch.setattr(module, "PORT", 0)


@pytest.fixture
def host() -> Iterator[DeskHost]:
    host = DeskHost(0, Clock())
    yield host
    host.close()


def after(host: DeskHost, seconds: float) -> None:
    clock = host._clock
    assert isinstance(clock, Clock)
    clock.now += seconds


def test_without_a_pin_nothing_is_served_and_it_starts_once_there_is_one(tmp_path: Path, host: DeskHost) -> None:
    path = new_event(tmp_path)
    host.follow(path, HERE, "en")
    assert (host.trouble[0], host.url) == ("desk.no_pin", "")
    PinFile(folders().config).set(PIN)
    host.follow(path, HERE, "en")
    assert host.server is None, "not at every frame"
    after(host, CHECK_SECONDS)
    host.follow(path, HERE, "en")
    assert host.server
    assert "Ana" in ask(host.server, "/").text
    host.follow(None, HERE, "en")
    assert host.url == ""


def test_it_follows_the_event_and_the_network(tmp_path: Path, host: DeskHost) -> None:
    PinFile(folders().config).set(PIN)
    path = new_event(tmp_path)
    (tmp_path / "b").mkdir()
    other = new_event(tmp_path / "b", "Eva", "Fee", "Gil")
    host.follow(path, HERE, "en")
    before = host.server
    host.follow(path, HERE, "en")
    assert host.server is before
    host.follow(other, HERE, "de")
    assert host.server
    assert "Gil" in ask(host.server, "/").text
    host.follow(other, "nowhere", "de")
    assert host.trouble[0] == "phones.network_gone"
    host.follow(tmp_path / "gone.json", HERE, "de")
    assert host.trouble[0] == "events.damaged"


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_operator_switches_it_on_and_reads_where_it_is(arcade: Arcade, language: str) -> None:
    PinFile(folders().config).set(PIN)
    context = arcade.context
    context.settings.phones_network = HERE
    context.words.switch(language)
    run = running(an_event())
    service = DeskService(context)
    arcade.open(NextMatch(context, run))
    page = arcade.open(EventPage(context, run.path, run, Pop()))
    page.focus.move_to(DESK)
    arcade.press(Button.FIRE)
    shown = arcade.shown(DeskPage)
    shown.draw(arcade.screen)
    service.update(1.0, arcade.stack)
    assert shown.host.url == ""
    arcade.press(Button.RIGHT)
    assert context.settings.desk
    service.update(1.0, arcade.stack)
    try:
        assert shown.host.server
        assert run.event.entrants[0].name in ask(shown.host.server, "/").text
        shown.draw(arcade.screen)
        arcade.press(Button.LEFT)
        service.update(1.0, arcade.stack)
        assert shown.host.url == ""
    finally:
        service.close()
    assert context.shared(desk_host).server is None


def test_an_arcade_whose_desk_is_off_does_not_even_load_it(arcade: Arcade, monkeypatch: pytest.MonkeyPatch) -> None:
    service = DeskService(arcade.context)
    arcade.open(NextMatch(arcade.context, running(an_event())))
    service.update(feature.LIVE_SECONDS, arcade.stack)
    assert service._host is None
