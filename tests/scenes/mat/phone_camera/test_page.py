"""A phone is chosen in the wizard and by --camera; what is kept; who serves it, and until when."""

import io
import json
import struct
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

pytest.importorskip("cv2")
pytest.importorskip("aiohttp")
pytest.importorskip("cryptography")

from pigaming_app.hardware.calibration.site import RealCalibrationSite
from pigaming_app.hardware.vision.phone import FEED, PhoneFeed
from pigaming_app.jobs.mat import sessions
from pigaming_app.jobs.terminal.options import RigOptions
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.mat.calibration.setup_page import CalibrationPage
from pigaming_app.scenes.mat.feature import PhoneCameraService, service
from pigaming_app.scenes.mat.phone_camera import host as hosts
from pigaming_app.scenes.mat.phone_camera.host import FILE, PhoneCameraHost, phone_camera_host
from pigaming_app.scenes.mat.phone_camera.page import PhoneCameraPage
from pigaming_app.storage.settings import PHONE, Settings, folders
from pigaming_app.ui.i18n import LANGUAGES, Words, english
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import Arcade

pytestmark = pytest.mark.usefixtures("_no_threads_stay")
ONE = "1" * 32


@pytest.fixture
def arcade(controls: Controls, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Arcade]:
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setattr(hosts, "PORT", 0)
    monkeypatch.setattr(PhoneCameraHost.__init__, "__defaults__", (FEED, 0))
    monkeypatch.setattr(FEED, "trusted", "")
    arcade = Arcade(controls)
    arcade.context.settings.phones_network = "127.0.0.1"
    yield arcade
    arcade.context.shared(phone_camera_host).close()


def jpeg() -> bytes:
    file = io.BytesIO()
    Image.new("L", (1280, 720), 90).save(file, "JPEG")
    return file.getvalue()


def test_the_wizard_offers_a_phone_and_serves_it_from_then_on(arcade: Arcade) -> None:
    context = arcade.context
    serving = service(context, Options())
    assert isinstance(serving, PhoneCameraService)
    wizard = arcade.open(CalibrationPage(context, RealCalibrationSite()))
    serving.update(0.1, arcade.stack)
    assert not serving.on
    wizard.focus.move_to("phone")
    arcade.press(Button.FIRE)
    page = arcade.stack.top
    assert isinstance(page, PhoneCameraPage)
    arcade.frame(draw=True)
    assert Settings.load(folders().config)[0].camera == PHONE
    host = context.shared(phone_camera_host)
    assert host.url.startswith("https://127.0.0.1:")
    arcade.press(Button.BACK)
    assert arcade.stack.top is wizard
    assert wizard.number == PHONE
    assert wizard.value("camera").options == ("A phone",)
    url = host.url
    serving.update(0.1, arcade.stack)
    assert host.url == url, "it stays when the page has gone"
    context.settings.camera = 0
    serving.update(0.1, arcade.stack)
    assert host.url == ""
    wizard.on_leave()


def test_a_phone_of_the_command_line_is_served_at_once(arcade: Arcade) -> None:
    wizard = CalibrationPage(arcade.context, RealCalibrationSite(), PHONE)
    assert (wizard.number, arcade.context.settings.camera) == (PHONE, PHONE)


def test_address_and_calibrated_phone_survive_a_restart(tmp_path: Path) -> None:
    def host(feed: PhoneFeed) -> PhoneCameraHost:
        found = PhoneCameraHost(lambda: tmp_path, feed, 0)
        found.follow(True, "127.0.0.1", english())
        return found

    feed, again = PhoneFeed(), PhoneFeed()
    first = host(feed)
    feed.trusted = ONE
    first.follow(True, "127.0.0.1", english())
    token = first.url.rpartition("/")[2]
    first.close()
    assert json.loads((tmp_path / FILE).read_text()) == {"token": token, "phone": ONE}
    second = host(again)
    assert second.url.rpartition("/")[2] == token
    assert again.trusted == ONE
    second.close()
    (tmp_path / FILE).write_text('{"token": "../../etc"}')
    third = host(PhoneFeed())
    assert third.url.rpartition("/")[2] not in (token, "etc")
    third.close()


def test_a_network_that_is_not_there_is_told(tmp_path: Path) -> None:
    host = PhoneCameraHost(lambda: tmp_path, PhoneFeed(), 0)
    host.follow(True, "nowhere", english())
    assert host.trouble
    assert (host.trouble.key, host.url) == ("network_gone", "")


def test_a_folder_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    host = PhoneCameraHost(lambda: tmp_path / "file", PhoneFeed(), 0)
    host.follow(True, "127.0.0.1", english())
    assert host.trouble
    assert host.trouble.key == "no_certificate"


def test_jobs_serve_the_phone_while_they_run(arcade: Arcade, capsys: pytest.CaptureFixture[str]) -> None:
    Settings(phones_network="127.0.0.1").save(folders().config)
    link = FEED.join(ONE, lambda text: None, lambda code: None)
    now = FEED.clock()
    link.receive(struct.pack(">Bdd", 2, now, now))
    link.receive(struct.pack(">Bd", 1, FEED.clock()) + jpeg())
    with sessions.robots_of(RigOptions(camera=PHONE)) as session:
        assert session.site.name == "real"
        assert "PiGaming: open https://127.0.0.1:" in capsys.readouterr().err
    link.gone()
    Settings(phones_network="nowhere").save(folders().config)
    with pytest.raises(Refusal, match="nowhere"), sessions.robots_of(RigOptions(camera=PHONE)):
        pass


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_of_the_phone_has_all_its_texts(language: str) -> None:
    texts = hosts.page_texts(Words(language))
    assert all(texts.values())
    script = (Path(hosts.__file__).parents[4] / "assets/phones/camera.js").read_text(encoding="utf-8")
    states = {key for key in texts if key not in ("take", "again", "certificate", "running", "old")}
    assert [state for state in states if f'"{state}"' not in script] == []
