"""The opening and closing of the arcade: settings, window, devices, robot session, log."""

import faulthandler
import gc
import logging
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import date
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import pygame

from pigaming_app.hardware.session.real import UDP, RealSession
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.hardware.session.ros import RosSession
from pigaming_app.scenes.app import App
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.match_choice import choose_kiosk_rules
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.preloaded import modules
from pigaming_app.storage.day_log import DayLog
from pigaming_app.storage.log import CRASH_FILE, log_file, require_file
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.safe_mode import DEFAULTS, is_safe
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import FILE, Settings, folders
from pigaming_app.ui import memory as heap
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.i18n import Words, english, system_language
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.input.events import StickState
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas

if TYPE_CHECKING:
    from pigaming_app.hardware.session.emulated import EmulatedSession

SWITCH_INTERVAL = 0.001  # s for which a thread in the background may hold up the one that draws

log = logging.getLogger("pigaming")


def run(options: Options) -> int:
    """Run the arcade until it is closed. Returns the exit code. Raises NoDisplay."""
    with opened(options) as app:
        try:
            return app.loop()
        except KeyboardInterrupt:
            return 0


@contextmanager
def opened(options: Options) -> "Iterator[App]":
    """The arcade with window and devices; closes all and saves the settings on exit. Raises NoDisplay."""
    heap.return_large_blocks()
    data_folders = folders()
    first_start = not any(os.path.exists(data_folders.config / name) for name in (FILE, f"{FILE}.bak"))
    settings, damaged = Settings.load(data_folders.config)
    if is_safe():
        settings.use_defaults(DEFAULTS)
    if first_start:
        settings.language = system_language()
    scores, damaged_scores = Scores.load(data_folders.data)
    for name, value in options.changed_settings.items():
        settings.choose(name, value)
    if options.kiosk:
        choose_kiosk_rules(settings)
    settings.settle()
    windowed = options.headless or options.emulator_seed is not None  # next to the emulated camera's window
    canvas = Canvas.open(settings, options.display, False if windowed else None, options.headless)
    crash_file = _open_log(data_folders.data)
    pygame.font.init()
    read_large(settings.large_text)
    context = Context(
        settings, scores, Words(settings.language), Controls(canvas.to_canvas), Sounds(), canvas, options.kiosk
    )
    context.sounds.volume(*settings.loudness)
    context.day_log = DayLog(data_folders.data)
    context.day_log.delete_old(date.today())
    context.day_log.note("start")
    context.controls.remap(settings.controls)
    context.controls.has_keypad = settings.keypad
    context.session = session = _session(options, settings, canvas)
    context.emergency_stops.append(session.close)
    if isinstance(session, RosSession):
        context.sticks = _sticks(session)
        context.match_watchers.append(session.publish)
    context.preloader.modules = modules()
    old_interval = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL)
    old_handler = signal.signal(signal.SIGTERM, signal.default_int_handler)  # SIGTERM ends it like Ctrl+C
    app: App | None = None
    try:
        app = App(options, context, [*damaged, *damaged_scores])
        yield app
    finally:
        signal.signal(signal.SIGTERM, old_handler)
        sys.setswitchinterval(old_interval)
        context.stop_all_robots()
        context.preloader.end()
        for service in app.services if app else ():
            service.close()
        gc.unfreeze()
        session.end()
        context.day_log.note("end")
        context.sounds.close()
        _save(settings, data_folders.config)
        if scores.unsaved:
            _save(scores, data_folders.data)
        canvas.close()
        _close_log(crash_file)


def _session(options: Options, settings: Settings, canvas: Canvas) -> "EmulatedSession | RealSession | RosSession":
    """The robot session: real or emulated. The emulator is imported late, so that the title appears at once."""
    if options.ros_width is not None:
        network = RosSession(options.ros_width)
        _make_ready(network, settings)
        return network
    if options.emulator_seed is None:
        return RealSession(settings, lambda: canvas.projection)
    from pigaming_app.hardware.emulator.wifi.air import WifiChannel
    from pigaming_app.hardware.session.emulated import EmulatedSession

    wifi = WifiChannel() if settings.radio == UDP else None
    live, things = options.step is None, options.emulated_things
    session = EmulatedSession(options.emulator_seed, live, lambda: canvas.projection, wifi=wifi, things=things)
    canvas.watchers.append(lambda window: session.show(lambda: _projected(canvas, window)))
    print("PiGaming: the emulated arena is being set up.", file=sys.stderr)
    _make_ready(session, settings)
    return session


def _make_ready(session: "EmulatedSession | RosSession", settings: Settings) -> None:
    """Open a session whose robots every lobby offers, while no picture is waiting; the first match reopens it."""
    settings.real = settings.real or [1, 2, 3, 4]
    try:
        session.open()
        session.close()
    except RobotsUnavailable as trouble:
        print(f"PiGaming: {english().long_sentence(trouble.message)}", file=sys.stderr)


def _sticks(session: RosSession) -> Callable[[int, bool], StickState | None]:
    """The joysticks of a session, by seat."""

    def stick(seat: int, first: bool) -> StickState | None:
        found = session.stick(seat, first)
        return StickState(*found) if found else None

    return stick


def _projected(canvas: Canvas, window: pygame.Surface) -> object:
    """The pixels projected onto the emulated mat: with bars cropped, or the whole window of a pinned picture.

    A copy: a view that somebody keeps would lock the surface.
    """
    from pigaming_app.ui.draw.pixels import pixels_of

    return pixels_of(window if canvas.corners else canvas.screen).copy()


def _save(record: Settings | Scores, folder: Path) -> None:
    try:
        record.save(folder)
    except NotSaved as trouble:
        log.warning("%s", trouble)
        print(f"PiGaming: {trouble}", file=sys.stderr)


def _open_log(data: Path) -> "IO[Any] | None":
    """Open the log file and the crash log of the interpreter. Returns the latter, None on failure."""
    try:
        log.handlers[:] = [log_file(data)]
        log.propagate = False
        require_file(data / CRASH_FILE)
        crash_file = (data / CRASH_FILE).open("a", encoding="utf-8")
    except OSError as trouble:
        print(f"PiGaming: {data} cannot be written: {describe_error(trouble)}. There is no log.", file=sys.stderr)
        return None
    faulthandler.enable(crash_file)
    if hasattr(signal, "SIGUSR1"):  # not on Windows
        faulthandler.register(signal.SIGUSR1, crash_file)  # the supervisor asks where a hung arcade is
    return crash_file


def _close_log(crash_file: "IO[Any] | None") -> None:
    for handler in log.handlers:
        handler.close()
    log.handlers.clear()
    log.propagate = True
    if crash_file:
        faulthandler.disable()
        if hasattr(signal, "SIGUSR1"):
            faulthandler.unregister(signal.SIGUSR1)
        crash_file.close()
