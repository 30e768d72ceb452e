"""The arcade itself: open everything, then events, presses, scenes, pictures, until somebody closes it.

A mistake in a scene is written to the log and the title comes back: a child never sees a traceback.
"""

import faulthandler
import logging
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from time import perf_counter
from typing import IO, Any

import pygame

from pigaming_app.keeping import NotSaved
from pigaming_app.scenes.canvas import Canvas
from pigaming_app.scenes.controls import Controls
from pigaming_app.scenes.house import House
from pigaming_app.scenes.plate import plate
from pigaming_app.scenes.press import Act
from pigaming_app.scenes.sounds import Sounds
from pigaming_app.scenes.stack import Push, Scene, Stack
from pigaming_app.scenes.words import Words
from pigaming_app.scores import Scores
from pigaming_app.settings import Settings, folders

FRAMES = 60  # a second
SLOWEST = 0.1  # s; whatever took longer (a dragged window, a machine asleep) did not happen
SAID = 4.0  # s for which a notice stays
SETTLING = 1.0  # s after the start in which a pointer that merely lies there does not take the focus
TROUBLES = 5  # in a row, after which the arcade gives up

log = logging.getLogger("pigaming")


@dataclass(frozen=True)
class Options:
    """What the command line may ask of the arcade. `frames`: close after so many; `shot`: a picture to take."""

    first: Callable[[House], Scene] | None = None  # a scene on top of the title
    alone: bool = False  # close when that scene has gone
    kiosk: bool = False
    display: int | None = None
    headless: bool = False
    frames: int | None = None
    shot: Path | None = None
    shot_at: float = 0.0
    step: float | None = None  # s of made-up time for each frame, instead of real time


@dataclass
class App:
    """A running arcade."""

    options: Options
    house: House
    stack: Stack
    notices: list[str] = field(default_factory=list)
    said_for: float = 0.0
    troubles: int = 0
    frames: int = 0
    seconds: float = 0.0
    overlay: bool = False
    tick_ms: float = 0.0
    fps: float = 0.0


def run(options: Options) -> int:
    """Open the arcade and stay until it is closed; the exit code. Raises NoDisplay."""
    where = folders()
    settings, said = Settings.load(where.config)
    scores, more = Scores.load(where.data)
    canvas = Canvas.open(settings, options.display, False if options.headless else None, options.headless)
    crash_file = _keep_log(where.data)
    pygame.font.init()
    pygame.display.set_caption("PiGaming")
    house = House(settings, scores, Words(settings.language), Controls(canvas.at), Sounds(), canvas, options.kiosk)
    house.sounds.volume(settings.music, settings.sounds)
    app = App(options, house, Stack(_first(house, options)), [*said, *more])
    if options.first and not options.alone:
        app.stack.turn(Push(options.first(house)))
    for line in app.notices:
        log.warning(line)
    try:
        _loop(app)
    finally:
        house.sounds.close()
        try:
            settings.save(where.config)
        except NotSaved as trouble:
            log.warning("%s", trouble)
        canvas.close()
        for handler in log.handlers:
            handler.close()
        log.handlers.clear()
        if crash_file:
            faulthandler.disable()
            crash_file.close()
    return 0


def _first(house: House, options: Options) -> Scene:
    if options.first and options.alone:
        return options.first(house)
    from pigaming_app.scenes.title import Title

    return Title(house)


def _loop(app: App) -> None:
    clock = pygame.time.Clock()
    last = perf_counter()
    while app.stack.scenes:
        now = perf_counter()
        seconds = app.options.step or min(now - last, SLOWEST)
        last = now
        try:
            _frame(app, seconds)
            app.troubles = 0
        except Exception:
            _recover(app)
        app.frames += 1
        app.seconds += seconds
        if app.frames == 1 and not app.options.headless:
            app.house.sounds.open()
        if app.options.frames is not None and app.frames >= app.options.frames:
            return
        app.fps = clock.get_fps()
        if app.options.step is None:
            clock.tick(FRAMES)


def _frame(app: App, seconds: float) -> None:
    """One picture: hear, move, paint."""
    house, stack = app.house, app.stack
    events = pygame.event.get()
    if any(event.type == pygame.QUIT for event in events) and not house.kiosk:
        stack.scenes.clear()
        return
    presses = [*house.controls.presses(events), *house.controls.repeats(seconds)]
    if app.seconds < SETTLING:
        presses = [press for press in presses if press.act is not Act.POINT]
    for event in events:
        if event.type == pygame.KEYDOWN:
            _function_key(app, event.key)
    house.idle = 0.0 if presses else house.idle + seconds
    began = perf_counter()
    for press in presses:
        if stack.scenes:
            stack.turn(stack.top.on(press))
    if stack.scenes:
        stack.turn(stack.top.update(seconds))
    if not stack.scenes:
        return
    app.tick_ms = 1000.0 * (perf_counter() - began)
    stack.top.draw(house.canvas.screen)
    _say(app, seconds)
    shot = app.options.shot
    if shot and app.seconds >= app.options.shot_at:
        house.canvas.screenshot(shot)
        stack.scenes.clear()
        return
    house.canvas.flip()


def _recover(app: App) -> None:
    """A scene has failed: write it down, say so in one sentence, begin again at the title."""
    log.exception("a scene failed")
    app.troubles += 1
    if app.troubles >= TROUBLES or app.options.alone or not app.stack.scenes:
        raise RuntimeError("the arcade cannot go on; the log says why")
    from pigaming_app.scenes.title import Title

    app.stack = Stack(Title(app.house))
    app.notices.append(app.house.words("app.error"))


def _function_key(app: App, key: int) -> None:
    house = app.house
    if key == pygame.K_F3:
        app.overlay = not app.overlay
    elif key == pygame.K_F11:
        house.settings.fullscreen = house.canvas.toggle_fullscreen()
    elif key == pygame.K_F12:
        name = f"pigaming-{datetime.now():%Y%m%d-%H%M%S}.png"
        try:
            house.canvas.screenshot(folders().data / "pictures" / name)
            app.notices.append(house.words("app.picture") + f": {name}")
        except OSError as trouble:
            log.warning("%s", trouble)
            app.notices.append(house.words("app.unsaved"))


def _say(app: App, seconds: float) -> None:
    """One notice after the other at the top edge, and the overlay of F3."""
    screen = app.house.canvas.screen
    app.notices += app.house.canvas.notices
    app.house.canvas.notices.clear()
    if app.notices:
        plate(app.notices[0][:90], size=30).draw(screen, 960, 40)
        app.said_for += seconds
        if app.said_for > SAID:
            app.said_for = 0.0
            app.notices.pop(0)
    if app.overlay:
        text = f"{app.fps:5.1f} fps   scene {app.tick_ms:4.1f} ms"
        font = pygame.font.Font(None, 32)
        screen.blit(font.render(text, True, (226, 238, 255), (0, 0, 0)), (12, 1048))


def _keep_log(data: Path) -> "IO[Any] | None":
    """Write a log into the data folder, and where the interpreter itself crashes, where it was; none if that fails."""
    try:
        data.mkdir(parents=True, exist_ok=True)
        from logging.handlers import RotatingFileHandler

        handler = RotatingFileHandler(data / "pigaming.log", maxBytes=500_000, backupCount=1, encoding="utf-8")
        handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(message)s"))
        log.handlers[:] = [handler]
        log.propagate = False
        crash_file = (data / "crash.log").open("a", encoding="utf-8")
    except OSError:
        return None
    faulthandler.enable(crash_file)
    return crash_file
