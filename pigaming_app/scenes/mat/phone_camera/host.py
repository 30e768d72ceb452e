"""The server for the phone that is the camera, while the settings say so."""

import logging
import secrets
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from pigaming_app.hardware.vision.phone import FEED, PhoneFeed
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.storage.parsing import ParseError, read_text
from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.storage.schema import from_json, to_json
from pigaming_app.storage.settings import folders
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.web.network import ServerUnavailable, chosen, networks

if TYPE_CHECKING:
    from pigaming_app.ui.web.phone_camera import PhoneCameraServer

FILE, CERTIFICATE = "phone-camera.json", "phone-camera.pem"  # in the data folder
MAX_BYTES = 1000
PORT = 8790  # TCP; 8787 to 8789 are those of phones, desk and programs
MODULES = ("aiohttp", "segno", "ifaddr", "cryptography")  # of the extra `phones`
ALPHABET = "abcdefghjkmnpqrstuvwxyz23456789"  # without signs that look alike
TOKEN_LENGTH = 10
CHECK_SECONDS = 3.0  # between two looks at the network, and two attempts to start
PAGE_TEXTS = (
    "running", "starting", "connecting", "lost", "untrusted", "certificate", "frozen", "slow", "refused", "elsewhere",
    "take", "again", "old", "denied", "none", "small", "taken", "ended", "unable",
)  # fmt: skip

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class KnownCamera:
    """What is kept: the token in the address, so that the phone returns by itself, and the phone of the calibration."""

    token: Annotated[str, Meta(pattern=r"^[a-z2-9]{10}\Z")]
    phone: Annotated[str, Meta(pattern=r"^([0-9a-f]{32})?\Z")] = ""


class PhoneCameraHost:
    """`trouble`: why no phone can connect, or None; `data`: the folder for what is kept."""

    def __init__(self, data: Callable[[], Path], feed: PhoneFeed = FEED, port: int = PORT) -> None:
        self.data, self.feed, self.port = data, feed, port
        self.server: PhoneCameraServer | None = None
        self.trouble: ServerUnavailable | None = None
        self._known: KnownCamera | None = None
        self._checked_at = -CHECK_SECONDS

    @property
    def url(self) -> str:
        """The address for phones; empty if none can connect."""
        return self.server.url if self.server and not self.trouble else ""

    def follow(self, on: bool, network: str, words: Words) -> None:
        """Serve on a network, whose address may change, as long as the phone is the camera (`on`)."""
        if not on:
            self.close()
            return
        if self.server:
            self.server.texts = page_texts(words)
        self._keep()
        now = time.monotonic()
        if now - self._checked_at >= CHECK_SECONDS:
            self._checked_at = now
            self._check(network, words)

    def close(self) -> None:
        """End the connection."""
        if self.server:
            self.server.stop()
        self.server = self.trouble = None
        self._checked_at = -CHECK_SECONDS

    def _check(self, network: str, words: Words) -> None:
        try:
            if not all(find_spec(module) for module in MODULES):
                raise ServerUnavailable("missing")
            address = chosen(network, networks()).address
            self.trouble = None
            if self.server and self.server.address != address:
                self.server.stop()
                self.server = None
            if self.server is None:
                self._start(address, page_texts(words))
        except ServerUnavailable as trouble:
            self.trouble = trouble
        except OSError as trouble:
            log.warning("phone as camera: %s", trouble)
            self.trouble = ServerUnavailable("no_certificate")

    def _start(self, address: str, texts: Mapping[str, str]) -> None:
        from pigaming_app.ui.web.certificate import Certificate
        from pigaming_app.ui.web.phone_camera import PhoneCameraServer

        certificate = Certificate(self.data() / CERTIFICATE, address)
        known = self._remembered()
        server = PhoneCameraServer(address, self.port, known.token, certificate, texts, self.feed.join)
        server.start()
        self.server = server

    def _remembered(self) -> KnownCamera:
        """What was kept, or a new token."""
        if self._known is None:
            try:
                self._known = from_json(read_text(self.data() / FILE, MAX_BYTES), KnownCamera)
                self.feed.trusted = self._known.phone
            except FileNotFoundError:
                pass
            except (OSError, ParseError) as trouble:
                log.warning("the phone that was the camera is forgotten: %s: %s", FILE, trouble)
        if self._known is None:
            self._save(KnownCamera("".join(secrets.choice(ALPHABET) for _ in range(TOKEN_LENGTH))))
            assert self._known
        return self._known

    def _keep(self) -> None:
        """Keep which phone was calibrated."""
        if self._known and self._known.phone != self.feed.trusted:
            self._save(KnownCamera(self._known.token, self.feed.trusted))

    def _save(self, known: KnownCamera) -> None:
        self._known = known
        try:
            write_atomic(self.data() / FILE, to_json(known).encode())
        except OSError as trouble:
            log.warning("the phone that is the camera is not kept for a restart: %s", trouble)


def page_texts(words: Words) -> dict[str, str]:
    """The texts of the phone's page."""
    return {key: words(f"phone_camera.page_{key}") for key in PAGE_TEXTS}


def phone_camera_host(context: Context) -> PhoneCameraHost:
    """The server of a context, made at first use: `context.shared(phone_camera_host)`."""
    return PhoneCameraHost(lambda: folders().data)
