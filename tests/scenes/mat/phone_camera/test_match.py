"""A whole match whose camera is a phone in a real browser: Chromium, fed with the pictures of the emulated arena.

Its fake camera is a canvas on which every picture of the renderer is drawn, with the time of its exposure by the
system's clock, as phones tell it (`captureTime`). From there on all is real: the page, its encoders, HTTPS, and the
clocks of both sides. The arena's time passes at a pace that this computer holds; the page's clock follows it, so that
delays are those of a phone that is so much quicker. `-s` prints figures.
"""

import asyncio
import base64
import math
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("cryptography")

import cv2

from pigaming_app.games.match import Match
from pigaming_app.games.registry import games
from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.hardware.control.real_plant import RealPlant
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.drivers.driver import LinkSite
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.emulator.arena import SHOWS_AFTER, EmulatedArena
from pigaming_app.hardware.emulator.camera import CameraTraits, FrameTiming
from pigaming_app.hardware.emulator.radio import MODERATE
from pigaming_app.hardware.emulator.realtime import LOOK_EVERY, RealtimeArena
from pigaming_app.hardware.emulator.robots import RADIUS
from pigaming_app.hardware.proof.trials import ButtonMasher, entered
from pigaming_app.hardware.session.emulated import calibrated
from pigaming_app.hardware.session.lighting import Lighting
from pigaming_app.hardware.session.robot_session import new_rig
from pigaming_app.hardware.vision import camera as camera_reader
from pigaming_app.hardware.vision import discovery
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.hardware.vision.phone import PhoneCapture
from pigaming_app.jobs.bench.robots import TARGETS
from pigaming_app.sim.world import DT, ROBOTS
from pigaming_app.storage.settings import PHONE
from tests.matches import setup_of
from tests.scenes.mat.phone_camera.served import Served, data_folder, trusting, until
from tests.scenes.phones.browser import Browser, Page, chromium, running_browser

pytestmark = [
    pytest.mark.long,
    pytest.mark.again,  # minutes; its parts are in test_browser.py, and a match with any camera in bench robots
    pytest.mark.alone,
    pytest.mark.skipif(not chromium(), reason="no Chromium: apt-get install chromium"),
    pytest.mark.usefixtures("_no_threads_stay"),
]
GAME = "pitanks"
FPS, REFRESH = 30.0, 30  # pictures a second; interval of complete ones
RATE = 20.0  # pictures a second that must arrive at least
LEARNS = 20.0  # s of driving until the delay of a camera is known
OUT = 1.5  # s for which a locked phone stays locked
LOCKED_AT = (0.4, 0.7)  # shares of the match
SOURCE = """
const pace = PACE, real = performance.now.bind(performance);
const asked = HTMLVideoElement.prototype.requestVideoFrameCallback;
performance.now = () => pace * real();
HTMLVideoElement.prototype.requestVideoFrameCallback = function (use) {
    const captured = () => pace * (window.captured - performance.timeOrigin);
    return asked.call(this, (now) => use(pace * now, { captureTime: captured() }));
};
if (navigator.mediaDevices) navigator.mediaDevices.getUserMedia = async () => {
    const canvas = document.createElement("canvas"), ink = canvas.getContext("2d", { alpha: false });
    [canvas.width, canvas.height] = [1280, 720];
    const stream = canvas.captureStream(0), track = stream.getVideoTracks()[0];
    window.film = async (jpeg, captured) => {
        const bytes = Uint8Array.from(atob(jpeg), (letter) => letter.charCodeAt(0));
        ink.drawImage(await createImageBitmap(new Blob([bytes], { type: "image/jpeg" })), 0, 0);
        window.captured = captured;
        track.requestFrame();
        return true;
    };
    return stream;
};
"""


class SlowArena(RealtimeArena):
    """An arena whose time passes at a share of real time, and skips nothing: the page's clock runs on."""

    pace = 1.0

    def _run(self) -> None:
        began, before = time.monotonic(), self.arena.clock()
        while not self._ended.wait(LOOK_EVERY):
            due = before + self.pace * (time.monotonic() - began)
            while self.arena.clock() + DT < due and not self._ended.is_set():
                self.arena.advance(DT)  # in pieces, for the threads that read it
            self.arena.advance(due - self.arena.clock())


class Stage:
    """The arena with a calibrated phone above it, and the rig that looks through it."""

    def __init__(self, seed: int) -> None:
        traits = CameraTraits(size=(1280, 720))
        self.arena = EmulatedArena(seed, FrameTiming(FPS, 0.0), MODERATE, REFRESH, traits=traits)
        self.ground = calibrated(self.arena)
        self.lighting = Lighting(seed)
        self.passing = SlowArena(self.arena)
        self.late: list[tuple[float, float, float]] = []  # s of the clock; mm; rad: errors of all robots' poses
        self.stops: list[float] = []  # s
        self.deepest, self.alarms, self.over = -math.inf, 0, False

    def choose_pace(self, film_seconds: float) -> float:
        """A pace that this computer holds, where a picture takes so many s to reach the page."""
        began = time.monotonic()
        self.arena.advance(1.0)
        frames = [self.arena.camera.newest() for _ in range(3)]
        assert any(frames)
        alone = time.monotonic() - began
        self.passing.pace = min(1.0, 0.3 / alone, 0.4 / (FPS * film_seconds))
        return self.passing.pace

    async def film(self, page: Page) -> None:
        """Show each picture to the page as soon as it was exposed."""
        while not self.over:
            frame = await asyncio.to_thread(self.arena.camera.newest)
            if frame is None:
                await asyncio.sleep(0.001)
            else:
                await show(page, frame.image, (self.arena.clock() - frame.captured) / self.passing.pace)

    def open(self, camera: Camera) -> None:
        arena = self.arena
        site = LinkSite(arena.arena_id, arena.clock, "EMU0", open_port=lambda _: arena.radio.open)
        link = OURS["api2"].open(site)
        self.rig = new_rig(camera, link, self.ground, arena.clock, [UNMEASURED] * ROBOTS)
        self.rig.start()

    def play(self, lock: Callable[[bool], None], minutes: float) -> Match:
        """Pair the robots, as the wizard does, which measures the delay of the phone's camera; then play a match.

        `lock(True)` locks the phone, which happens twice. Returns the match at its end.
        """
        self._wait(lambda: len(self.rig.link.telemetry) == ROBOTS)
        pairing = Pairing(self.rig)
        self._wait(pairing.tick)
        assert [finding.case for finding in pairing.findings] == [PairingCase.FITS] * ROBOTS, pairing.findings
        match = Match(setup_of(GAME, "human human human human", "", minutes), lambda world: RealPlant(world, self.rig))
        plant: Any = match.plant
        for seat in range(ROBOTS):
            match.sit(seat, ButtonMasher(seat))
            robot = match.state.robots[seat]
            self.arena.place(seat, (robot.x, robot.y, robot.heading))

        def placed() -> bool:
            self._clear(plant)
            return bool(plant.take_places())

        self._wait(placed)
        self.lighting.show(busy=True)
        locks = [share * 60.0 * minutes for share in LOCKED_AT]
        while not match.over:
            if locks and match.seconds > locks[0] and not plant.safety.pauses and self._drives():
                locks.pop(0)
                self._lock(lock, plant)
            if plant.safety.pauses:
                self._clear(plant)
                plant.watch()
            else:
                match.tick()
                self._note(match.state)
            self._pass()
        return match

    def _lock(self, lock: Callable[[bool], None], plant: RealPlant) -> None:
        began = self.arena.clock()
        lock(True)
        end = began + OUT
        while self.arena.clock() < end:
            plant.sense()
            plant.drive([(200.0, 0.0)] * ROBOTS, DT)
            self._pass()
        assert any(fault.name == "camera" for fault in plant.faults)
        self.stops.append(max(self.arena.last_driven) - began)
        lock(False)

    def _drives(self) -> bool:
        return self.arena.clock() - max(self.arena.last_driven) < 0.05

    def _wait(self, done: Callable[[], object]) -> None:
        end = self.arena.clock() + 90.0
        while not done():
            assert self.arena.clock() < end
            self._pass()

    def _clear(self, plant: RealPlant) -> None:
        for robot in plant.safety.latched:
            self.alarms += 1
            plant.clear_fault(robot)

    def _note(self, world: Any) -> None:
        """The truth beside what the rig takes for it."""
        seen, true = self.rig.sense(), self.arena.poses()
        now = self.arena.clock()
        for one, (x, y, heading) in zip(seen, true, strict=True):
            away = self.ground.mm * math.hypot(one.x - x, one.y - y)
            self.late.append((now, away, abs(math.remainder(one.heading - heading, math.tau))))
        depths = (entered(world, x, y, RADIUS / self.ground.mm) for x, y, _ in true)
        self.deepest = max(self.deepest, self.ground.mm * max(depths))

    def _pass(self) -> None:
        """Light the mat, and wait for the next tick of the clock."""
        due = self.arena.clock() + DT
        self.arena.project(self.lighting.picture(self.rig.sense(SHOWS_AFTER)))
        while self.arena.clock() < due:
            time.sleep(0.001)


async def show(page: Page, image: Any, age: float = 0.0) -> None:
    """Put a picture that was exposed `age` s ago on the canvas, with its time, as cameras of phones have it."""
    captured = 1000.0 * (time.time() - age)
    ok, jpeg = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, 92])
    assert ok
    await page.ask(
        "Runtime.evaluate",
        expression=f"film('{base64.b64encode(jpeg.tobytes()).decode()}', {captured})",
        awaitPromise=True,
    )


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    return data_folder(tmp_path)


@pytest.fixture
def browser(kept: Path) -> Iterator[str]:
    with running_browser(trusting(kept)) as address:
        yield address


def test_a_match_of_the_default_length_is_played_through_a_phone(
    kept: Path, browser: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    played(Stage(4), kept, browser, monkeypatch, float(games()[GAME].default.default_minutes))


def played(stage: Stage, kept: Path, browser: str, monkeypatch: pytest.MonkeyPatch, minutes: float) -> None:
    served = Served(kept, browser, stage.arena.clock)
    monkeypatch.setattr(discovery, "FEED", served.feed)
    monkeypatch.setattr(PhoneCapture.__init__, "__defaults__", (False, False, served.feed))
    rates: list[float] = []
    delays: list[float] = []

    async def story(browser: Browser) -> None:
        page = await browser.phone(served.host.url, source=SOURCE.replace("PACE", "1.0"))
        await page.until("typeof window.film === 'function'")
        blank, began = np.zeros((720, 1280), np.uint8), time.monotonic()
        for _ in range(20):
            await show(page, blank)
        pace = stage.choose_pace((time.monotonic() - began) / 20)
        for name in ("STALE", "RETRY"):  # waits in real time
            monkeypatch.setattr(camera_reader, name, getattr(camera_reader, name) / pace)
        await page.ask("Page.navigate", url="about:blank")
        page = await browser.phone(served.host.url, source=SOURCE.replace("PACE", f"{pace}"))
        await page.until("typeof window.film === 'function'")
        loop = asyncio.get_running_loop()

        def lock(locked: bool) -> None:
            asked: Future[None] = asyncio.run_coroutine_threadsafe(page.lock(locked), loop)
            asked.result()

        async def watch() -> None:
            while not stage.over:
                await asyncio.sleep(0.2)
                if served.feed.live:
                    rates.append(served.feed.rate)
                    delays.append(served.feed.delay)

        with stage.passing:
            tasks = [asyncio.create_task(stage.film(page)), asyncio.create_task(watch())]
            with Camera(PHONE, stage.arena.clock, fresh=True) as camera:
                await until(camera.newest)
                stage.open(camera)
                try:
                    match = await asyncio.to_thread(stage.play, lock, minutes)
                finally:
                    stage.rig.close()
            stage.over = True
            await asyncio.gather(*tasks)
        assert match.over

    try:
        served.play(story)
    finally:
        served.host.close()
    known = np.array([(mm, turned) for at, mm, turned in stage.late if at > stage.late[0][0] + LEARNS])
    assert stage.rig.tracker.delay is not None
    mm, degrees = np.sqrt((known**2).mean(axis=0)) * (1.0, 180.0 / math.pi)
    print(
        f"\npace {stage.passing.pace:.2f}, {np.median(rates):.1f} pictures/s, delay {1e3 * np.median(delays):.0f} ms, "
        f"{stage.rig.tracker.delay.seconds * 1e3:.0f} ms more measured; {mm:.2f} mm, {degrees:.2f} degrees (RMS); "
        f"{stage.deepest:.1f} mm into a wall, {stage.alarms} alarms; stops "
        + ", ".join(f"{1e3 * stop:.0f} ms" for stop in stage.stops)
    )
    assert np.median(rates) >= RATE
    assert mm <= TARGETS["pose_rmse_mm"]
    assert degrees <= TARGETS["pose_rmse_deg"]
    assert stage.deepest <= TARGETS["wall_entry_mm"]
    assert stage.alarms == 0
    assert len(stage.stops) == len(LOCKED_AT)
    assert max(stage.stops) <= TARGETS["worst_stop_ms"] / 1e3
