"""The phone as camera in a real browser: Chromium, whose camera is a film by the renderer of the emulated arena.

The certificate is checked: Chromium accepts no other key. Times are compared with a time code in the picture, drawn by
the browser's own clock, and no ping is involved in it.
"""

import math
import time
from collections.abc import Iterator
from pathlib import Path
from random import Random

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("cryptography")

import cv2

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.emulator.arena import EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits, FrameTiming
from pigaming_app.hardware.proof.outside import steady_light
from pigaming_app.hardware.session.emulated import calibrated
from pigaming_app.hardware.vision import discovery
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.hardware.vision.markers import WEARERS, MarkerDetector
from pigaming_app.hardware.vision.phone import PhoneCapture
from pigaming_app.storage.settings import PHONE
from pigaming_app.ui.i18n import english
from tests.scenes.mat.phone_camera.served import Served, data_folder, trusting, until
from tests.scenes.mat.phone_camera.time_code import drawn_at, film_of
from tests.scenes.phones.browser import Browser, chromium, running_browser

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(not chromium(), reason="no Chromium: apt-get install chromium"),
    pytest.mark.usefixtures("_no_threads_stay"),
]
SCENES, HELD = 6, 10  # scenes of the film, and pictures of each
PAGE_STATE = "document.getElementById('state').dataset.state"

Poses = list[tuple[float, float, float]]


class Film:
    """Robots that stand at random places, scene by scene, as a file for Chromium's fake camera."""

    def __init__(self, path: Path) -> None:
        self.path = path
        arena = EmulatedArena(3, FrameTiming(8.0, 0.0), traits=CameraTraits(size=(1280, 720)))
        self.ground: GroundPlane = calibrated(arena)
        arena.project(steady_light())
        arena.cleared = False
        random, self.truth = Random(5), list[Poses]()
        with path.open("wb") as film:
            for _ in range(SCENES):
                for robot in range(4):  # each in its quarter, apart from the others
                    x, y = 800 * (robot % 2), 450 * (robot // 2)
                    place = x + random.uniform(120, 680), y + random.uniform(100, 350), random.uniform(0, math.tau)
                    arena.place(robot, place)
                arena.advance(0.2)
                while arena.camera.newest() is None:
                    arena.advance(0.002)
                self.truth.append(arena.poses())
                arena.advance(0.05)
                frame = arena.camera.newest()
                assert frame
                ok, jpeg = cv2.imencode(".jpg", frame.image, [cv2.IMWRITE_JPEG_QUALITY, 95])
                assert ok
                film.write(jpeg.tobytes() * HELD)


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Film:
    return Film(tmp_path_factory.mktemp("film") / "mat.mjpeg")


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return data_folder(tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="module")
def browser(film: Film, kept: Path) -> Iterator[str]:
    with running_browser(
        trusting(kept),
        "--use-fake-ui-for-media-stream",
        "--use-fake-device-for-media-stream=fps=30",
        f"--use-file-for-fake-video-capture={film.path}",
    ) as address:
        yield address


@pytest.fixture
def served(kept: Path, browser: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[Served]:
    served = Served(kept, browser)
    monkeypatch.setattr(discovery, "FEED", served.feed)
    monkeypatch.setattr(PhoneCapture.__init__, "__defaults__", (False, False, served.feed))
    yield served
    served.host.close()


def test_poses_are_those_of_the_renderer(served: Served, film: Film) -> None:
    """Within 2 mm and 1 degree, through two compressions; none of the pictures is from between two scenes."""
    detector, seen = MarkerDetector(WEARERS), set[int]()
    errors: list[tuple[float, float]] = []

    async def story(browser: Browser) -> None:
        page = await browser.phone(served.host.url)
        with Camera(PHONE, fresh=True) as camera:
            while seen != {*range(SCENES)}:
                frame = await until(camera.newest)
                assert frame.image.shape == (720, 1280)
                marks = detector.refine(frame.image, detector.detect(frame.image))
                fixes = {fix.robot: fix for fix in film.ground.fixes(marks, 0.0) if not isinstance(fix, str)}
                assert {*fixes} == {*range(4)}
                apart = [
                    max(math.dist((fixes[i].x, fixes[i].y), poses[i][:2]) for i in range(4)) for poses in film.truth
                ]
                scene = int(np.argmin(apart))
                seen.add(scene)
                for i, (_, _, heading) in enumerate(film.truth[scene]):
                    turned = math.remainder(fixes[i].heading - heading, math.tau)
                    errors.append((apart[scene] * film.ground.mm, abs(math.degrees(turned))))
            assert await page.value(PAGE_STATE) == "running"
            assert await page.value("document.getElementById('video').videoHeight") == 720

    served.play(story)
    assert max(mm for mm, _ in errors) < 2.0
    assert max(degrees for _, degrees in errors) < 1.0


def test_the_time_of_capture_is_that_of_the_time_code(served: Served) -> None:
    """A canvas is drawn every 16 ms and filmed 30 times a second."""
    late: list[float] = []
    wall = time.time() - time.monotonic()

    async def story(browser: Browser) -> None:
        await browser.phone(served.host.url, source=film_of())
        with Camera(PHONE) as camera:
            while len(late) < 60:
                frame = await until(camera.newest)
                captured = frame.captured + wall
                late.append(captured - drawn_at(frame.image, captured))

    served.play(story)
    assert abs(np.median(late)) < 0.020


def test_lock_loss_and_return_are_told_to_the_arcade_and_to_the_holder(served: Served) -> None:
    async def story(browser: Browser) -> None:
        page = await browser.phone(served.host.url)
        with Camera(PHONE, fresh=True) as camera:
            await until(camera.newest)
            await page.lock(True)
            fault = await until(lambda: camera.fault)
            assert fault.key == "no_phone"
            await page.lock(False)
            await until(lambda: camera.fault is None and camera.newest())
            address = served.host.server.port if served.host.server else 0
            served.host.close()  # as when the Wi-Fi is gone
            await until(lambda: camera.fault and camera.fault.key == "no_phone")
            await page.until(f"{PAGE_STATE} === 'lost'")
            served.host.port = address
            served.host.follow(True, "127.0.0.1", english())
            await until(lambda: camera.fault is None and camera.newest())
            await page.until(f"{PAGE_STATE} === 'running'")
            await page.ask("Page.navigate", url="about:blank")  # the tab is closed
            await until(lambda: camera.fault and camera.fault.key == "no_phone")
            browser.errors.clear()  # of the sockets without a server

    served.play(story)


@pytest.mark.again
def test_another_phone_takes_over_and_the_first_takes_back(served: Served) -> None:
    async def story(browser: Browser) -> None:
        one = await browser.phone(served.host.url)
        with Camera(PHONE, fresh=True) as camera:
            await until(camera.newest)
        with Camera(PHONE) as camera:  # of a match
            await until(camera.newest)
            other = await browser.phone(served.host.url)
            await other.until(f"{PAGE_STATE} === 'running'")
            await one.until(f"{PAGE_STATE} === 'elsewhere'")
            await until(lambda: camera.fault and camera.fault.key == "other_phone")
            await one.tap("act")
            await until(lambda: camera.fault is None and camera.newest())
            await other.until(f"{PAGE_STATE} === 'elsewhere'")
        old = await browser.phone(f"{served.host.url[:-1]}{'a' if served.host.url[-1] != 'a' else 'b'}")
        await old.until("document.body.textContent.includes('no longer valid')")
        browser.errors.clear()  # the refused page

    served.play(story)
