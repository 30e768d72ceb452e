"""The robots of a job: the real ones of the settings, or the emulated arena in simulated time."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from pigaming_app.hardware.drivers.driver import RobotDriver
from pigaming_app.hardware.drivers.ours import UDP
from pigaming_app.hardware.drivers.registry import DRIVERS
from pigaming_app.hardware.session.real import RealSession
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.hardware.session.robot_session import settings_problem as settings_problem
from pigaming_app.jobs.terminal.options import RigOptions
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.storage.parsing import quote
from pigaming_app.storage.settings import PHONE, Settings, folders
from pigaming_app.ui.i18n import english

PATIENCE = 20.0  # s for a phone to send its first image
EXPOSURE_JITTER = 0.15  # size of the exposure steps of the emulated camera, as a share


def emulated_session(seed: int, wifi: bool = False) -> RobotSession:
    """A session with the emulated arena of a seed, with all robots found. Raises RobotsUnavailable.

    `wifi`: its robots are boards with Wi-Fi that run their own program, else they have XBees.
    """
    from pigaming_app.hardware.emulator.wifi.air import WifiChannel
    from pigaming_app.hardware.session.emulated import EmulatedSession

    session = EmulatedSession(seed, live=False, exposure_jitter=EXPOSURE_JITTER, wifi=WifiChannel() if wifi else None)
    session.open()  # raises RobotsUnavailable without OpenCV, before Lighting needs it
    from pigaming_app.hardware.session.lighting import Lighting

    session.lighting = Lighting(seed)
    session.find()
    return session


def real_session(camera: int | str | None = None, port: str | None = None, radio: str | None = None) -> RobotSession:
    """A session with the robots of the settings, not yet open; `camera`, `port` and `radio` override the settings."""
    settings, _ = Settings.load(folders().config)
    settings.camera = settings.camera if camera is None else camera
    settings.port = port or settings.port
    settings.radio = radio or settings.radio
    return RealSession(settings)


def new_session(
    emulate: int | None, camera: int | str | None, port: str | None, radio: str | None = None
) -> RobotSession:
    """The emulated session of a seed, or the real one. Raises RobotsUnavailable."""
    if emulate is None:
        return real_session(camera, port, radio)
    return emulated_session(emulate, (radio or Settings.load(folders().config)[0].radio) == UDP)


@contextmanager
def robots_of(options: RigOptions, radio: str | None = None) -> Iterator[RobotSession]:
    """The emulated session of a seed, or the real one, until its end. Raises Refusal."""
    with refused(RobotsUnavailable):
        session = new_session(options.emulate, options.camera, options.port, radio)
    with phone_camera(session):
        try:
            yield session
        finally:
            session.end()


@contextmanager
def phone_camera(session: RobotSession) -> Iterator[None]:
    """Serve the page for the phone that is the camera of a session, if it is one. Raises Refusal."""
    if not isinstance(session, RealSession) or session.settings.camera != PHONE:
        yield
        return
    from pigaming_app.scenes.mat.phone_camera.host import PhoneCameraHost

    host = PhoneCameraHost(lambda: folders().data)
    host.follow(True, session.settings.phones_network, english())
    try:
        if host.trouble:
            raise Refusal(english()(f"phones.{host.trouble.key}", **host.trouble.values))
        print(f"PiGaming: open {host.url} on the phone above the mat.", file=sys.stderr)
        end = time.monotonic() + PATIENCE
        while not host.feed.live and time.monotonic() < end:
            time.sleep(0.1)
        yield
    finally:
        host.close()


def require_driver(name: str, asked: str = "--radio") -> RobotDriver:
    """The driver of a name. Raises Refusal. `asked`: what it was given to."""
    if name not in DRIVERS:
        raise Refusal(f"{asked}: no driver {quote(name)}; there are {', '.join(DRIVERS)}")
    return DRIVERS[name]


def require_deadman(options: RigOptions) -> None:
    """Raises Refusal if the settings are those of real robots that would drive on."""
    if options.emulate is None and (problem := settings_problem(Settings.load(folders().config)[0])):
        raise Refusal(english().long_sentence(problem))
