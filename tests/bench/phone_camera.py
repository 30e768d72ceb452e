"""JPEG over WebSocket, as the arcade does it, against WebRTC by aiortc: delay and rate of the same film in Chromium.

    python -X pigaming -m tests.bench.phone_camera [SECONDS] [ROUNDS]

Each picture of 1280 x 720 px is a mat with noise, and shows when it was drawn, in black and white blocks. The delay is
measured from there to the picture in this process, decoded. Both take turns. WebRTC needs aiortc (pip install aiortc),
which the arcade does not.
"""

import asyncio
import base64
import json
import os
import platform
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from aiohttp import web
from aiohttp.test_utils import unused_port

from pigaming_app.hardware.calibration.boards import BOARD
from pigaming_app.hardware.vision import discovery
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.hardware.vision.phone import PhoneCapture, PhoneFeed
from pigaming_app.scenes.mat.phone_camera.host import PhoneCameraHost
from pigaming_app.storage.settings import PHONE
from pigaming_app.ui.i18n import english
from tests.scenes.mat.phone_camera.time_code import drawn_at, film_of
from tests.scenes.phones.browser import browsing, running_browser

BROWSER = ("--ignore-certificate-errors", "--use-fake-ui-for-media-stream")
WARM_UP = 5.0  # s, in which WebRTC raises its rate
OFFER = """
(async () => {
    const wires = new RTCPeerConnection(), stream = await navigator.mediaDevices.getUserMedia();
    const track = stream.getVideoTracks()[0];
    track.contentHint = "detail";
    const sender = wires.addTrack(track, stream), how = sender.getParameters();
    how.degradationPreference = "balanced";
    how.encodings[0].maxBitrate = 20e6;
    await sender.setParameters(how);
    await wires.setLocalDescription(await wires.createOffer());
    while (wires.iceGatheringState !== "complete") await new Promise((done) => setTimeout(done, 50));
    const answer = await fetch("/offer", { method: "POST", body: JSON.stringify(wires.localDescription) });
    await wires.setRemoteDescription(await answer.json());
    window.wires = wires;
})()
"""


class Figures:
    """Delays of the pictures that arrive in `seconds`, in each round after a warm-up."""

    def __init__(self, seconds: float) -> None:
        self.seconds, self.rounds = seconds, 0
        self.delays: list[float] = []
        self.sizes: set[tuple[int, ...]] = set()
        self.bytes: list[int] = []

    def begin(self) -> None:
        """A round begins."""
        self.rounds += 1
        self._from = time.monotonic() + WARM_UP

    def note(self, image: Any) -> bool:
        """Note a picture, grey; true until the round is over."""
        now = time.monotonic()
        if now > self._from:
            self.delays.append(1000.0 * (time.time() - drawn_at(image, time.time())))
            self.sizes.add(image.shape)
        return now < self._from + self.seconds

    def shown(self) -> dict[str, Any]:
        late = np.array(self.delays or [np.nan])
        figures = {f"delay_{share}_ms": round(float(np.percentile(late, share)), 1) for share in (50, 95, 99)}
        size = {"kb": round(float(np.median(self.bytes)) / 1000)} if self.bytes else {}
        return {"rate": round(len(late) / self.seconds / self.rounds, 1), **figures, **size, "sizes": [*self.sizes]}


def picture() -> str:
    """A mat with noise, as a data URL."""
    mat = cv2.resize(BOARD.picture(), (1280, 720)).astype(np.int16) // 2 + 60
    noisy = np.clip(mat + np.random.default_rng(1).normal(0, 4, mat.shape), 0, 255).astype(np.uint8)
    return "data:image/jpeg;base64," + base64.b64encode(cv2.imencode(".jpg", noisy)[1].tobytes()).decode()


async def jpeg(address: str, figures: Figures) -> None:
    feed = PhoneFeed()
    setattr(discovery, "FEED", feed)  # noqa: B010
    PhoneCapture.__init__.__defaults__ = (False, False, feed)
    with tempfile.TemporaryDirectory() as folder:
        host = PhoneCameraHost(lambda: Path(folder), feed, unused_port())
        host.follow(True, "127.0.0.1", english())
        try:
            async with browsing(address) as browser:
                await browser.phone(host.url, source=film_of(picture()))
                figures.begin()
                with Camera(PHONE) as camera:
                    while not (frame := camera.newest()) or figures.note(frame.image):
                        await asyncio.sleep(0.001)
                        figures.bytes += [len(feed.seen.jpeg)] if frame and feed.seen else []
        finally:
            host.close()


async def webrtc(address: str, figures: Figures) -> None:
    from aiortc import RTCPeerConnection, RTCSessionDescription

    wires, arrived = RTCPeerConnection(), asyncio.Event()
    tracks: list[Any] = []

    @wires.on("track")  # type: ignore[untyped-decorator]
    def begin(track: Any) -> None:
        tracks.append(track)
        arrived.set()

    async def offer(request: web.Request) -> web.Response:
        await wires.setRemoteDescription(RTCSessionDescription(**await request.json()))
        await wires.setLocalDescription(await wires.createAnswer())
        local = wires.localDescription
        return web.json_response({"sdp": local.sdp, "type": local.type})

    async def page(request: web.Request) -> web.Response:
        return web.Response(text="<!doctype html>", content_type="text/html")

    app, port = web.Application(), unused_port()
    app.router.add_post("/offer", offer)
    app.router.add_get("/", page)
    runner = web.AppRunner(app)
    await runner.setup()
    await web.TCPSite(runner, "127.0.0.1", port).start()
    try:
        async with browsing(address) as browser:
            one = await browser.phone(f"http://127.0.0.1:{port}/", source=film_of(picture()))
            await one.until("document.readyState === 'complete' && location.port !== ''")
            await one.value(OFFER + " && 1")
            await arrived.wait()
            figures.begin()
            while figures.note((await tracks[0].recv()).to_ndarray(format="gray")):
                pass
    finally:
        await wires.close()
        await runner.cleanup()


def main() -> None:
    seconds, rounds = ([float(word) for word in sys.argv[1:]] + [10.0, 3.0][len(sys.argv) - 1 :])[:2]
    ways: dict[str, Callable[[str, Figures], Any]] = {"jpeg": jpeg, "webrtc": webrtc}
    figures = {name: Figures(seconds) for name in ways}
    for _ in range(round(rounds)):
        for name, way in ways.items():
            with running_browser(*BROWSER) as address:
                asyncio.run(way(address, figures[name]))
    machine = {"machine": platform.machine(), "cores": os.cpu_count(), "load": os.getloadavg()[0]}
    print(json.dumps({**machine, **{name: one.shown() for name, one in figures.items()}}))


if __name__ == "__main__":
    main()
