"""The opening and closing of the arcade: settings, window, devices, robot session, log."""

import faulthandler
import gc
import logging
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import date, datetime
from pathlib import Path
from threading import Timer
from typing import IO, Any

import pygame

from pigaming_app.scenes.app import App
from pigaming_app.scenes.features.registry import mat_of
from pigaming_app.scenes.flow.match_choice import choose_kiosk_rules
from pigaming_app.scenes.flow.scene import Context
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.preloaded import modules
from pigaming_app.storage import trash
from pigaming_app.storage.day_log import DayLog
from pigaming_app.storage.log import CRASH_FILE, log_file, require_file
from pigaming_app.storage.parsing import describe_error
from pigaming_app.storage.safe_files import NotSaved
from pigaming_app.storage.safe_mode import DEFAULTS, is_safe
from pigaming_app.storage.scores import Scores
from pigaming_app.storage.settings import FILE, Settings, folders
from pigaming_app.ui import memory as heap
from pigaming_app.ui.draw import read_large
from pigaming_app.ui.i18n import Words, system_language
from pigaming_app.ui.input.controls import Controls
from pigaming_app.ui.sounds import Sounds
from pigaming_app.ui.window import Canvas

CLOSING = 4.0  # s for devices and window to close; a supervisor waits 5 s for a sign of life
SWITCH_INTERVAL = 0.001  # s for which a thread in the background may hold up the one that draws

log = logging.getLogger("pigaming")


def run(options: Options) -> int:
    """Run the arcade until it is closed. Returns the exit code. Raises NoDisplay."""
    with opened(options) as app:
        try:
            code = app.loop()
        except KeyboardInterrupt:
            code = 0
        end = Timer(CLOSING, _end_hanging, (code,))
        end.daemon = True
        end.start()
    end.cancel()
    return code


def _end_hanging(code: int) -> None:
    """End a program that does not close, such as in a driver: a kiosk that was closed must not be started again."""
    log.warning("closing took longer than %g s; the crash log has the stacks", CLOSING)
    with suppress(OSError, RuntimeError), (folders().data / CRASH_FILE).open("a", encoding="utf-8") as file:
        faulthandler.dump_traceback(file)
    os._exit(code)


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
    canvas = Canvas.open(settings, options.display, False if windowed else None, options.headless, options.kiosk)
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
    trash.empty(datetime.now())
    context.controls.remap(settings.controls)
    context.controls.has_keypad = settings.keypad
    context.mat = mat_of(context, options)
    if context.mat:
        context.emergency_stops.append(context.mat.stop)
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
        if context.mat:
            context.mat.end()
        context.day_log.note("end")
        _save(settings, data_folders.config)
        if scores.unsaved:
            _save(scores, data_folders.data)
        context.sounds.close()
        canvas.close()
        _close_log(crash_file)


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
