"""A server for a phone that is the camera, and stories in a browser that knows its certificate."""

import asyncio
import base64
import hashlib
import time
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

from cryptography import x509
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat

from pigaming_app.hardware.vision.phone import PhoneFeed
from pigaming_app.scenes.mat.phone_camera.host import CERTIFICATE, PhoneCameraHost
from pigaming_app.ui.i18n import english
from tests.scenes.phones.browser import Browser, browsing
from tests.scenes.phones.touch_page import LONG


def data_folder(folder: Path) -> Path:
    """A data folder, with the certificate."""
    host = PhoneCameraHost(lambda: folder, PhoneFeed(), 0)
    host.follow(True, "127.0.0.1", english())
    host.close()
    return folder


def trusting(kept: Path) -> str:
    """The option by which Chromium accepts the certificate of a data folder, and no other."""
    key = x509.load_pem_x509_certificate((kept / CERTIFICATE).read_bytes()).public_key()
    spki = hashlib.sha256(key.public_bytes(Encoding.DER, PublicFormat.SubjectPublicKeyInfo)).digest()
    return f"--ignore-certificate-errors-spki-list={base64.b64encode(spki).decode()}"


class Served:
    """A server for a phone that is the camera, and stories in the browser."""

    def __init__(self, kept: Path, browser: str, clock: Callable[[], float] = time.monotonic) -> None:
        self.feed = PhoneFeed(clock)
        self.host = PhoneCameraHost(lambda: kept, self.feed, 0)
        self.host.follow(True, "127.0.0.1", english())
        self.browser = browser

    def play(self, story: Callable[[Browser], Coroutine[Any, Any, None]]) -> None:
        async def run() -> None:
            async with browsing(self.browser) as browser:
                await story(browser)
                assert browser.errors == []

        asyncio.run(run())


async def until(condition: Callable[[], Any]) -> Any:
    end = time.monotonic() + LONG
    while not (found := condition()):
        assert time.monotonic() < end
        await asyncio.sleep(0.005)
    return found
