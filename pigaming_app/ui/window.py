"""The window: scenes always paint 1920 x 1080, and the canvas shows that on whatever window or display there is.

Where the window is exactly that large, scenes paint straight on it; else the picture is scaled with black bars, never
distorted. Nothing that happens to a window or a display at run time raises: the picture falls back to what works.
"""

import os
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import pygame

from pigaming_app.storage.safe_files import write
from pigaming_app.ui.png import png_of

if TYPE_CHECKING:
    from pigaming_app.hardware.calibration.corner_pin import Warp

SIZE = (1920, 1080)
CURSOR_SECONDS = 3.0  # the mouse pointer hides after so long without motion
_UNSEEN = ("dummy", "offscreen")  # SDL's drivers that paint into memory only


class NoDisplay(Exception):
    """There is no display to open a window on; the text is one plain sentence."""


class NoPin(Exception):
    """The picture cannot be drawn into these corners; the text is one plain sentence."""


class WindowSettings(Protocol):
    """What the settings say about the window."""

    display: int
    fullscreen: bool


class Canvas:
    """The one window of the arcade. `notices` collects plain sentences about what could not be done as asked.

    Each of `watchers` sees every picture as it is shown in the window.
    """

    def __init__(self, display: int, fullscreen: bool, headless: bool) -> None:
        self.headless = headless
        self.fullscreen = fullscreen and not headless
        self.display = display
        self.notices: list[str] = []
        self.watchers: list[Callable[[pygame.Surface], None]] = []
        self.corners: tuple[float, ...] = ()  # of the corner pin, if there is one
        self._warp: Warp | None = None
        self._picture: pygame.Surface | None = None
        self._pointer = (0, 0)
        self._pointer_moved = 0.0
        self._show()

    @classmethod
    def open(
        cls,
        settings: WindowSettings,
        display: int | None = None,
        fullscreen: bool | None = None,
        headless: bool = False,
    ) -> "Canvas":
        """Open the window as the settings or the arguments (which win) say. Raises NoDisplay.

        Call it before `pygame.init`, because SDL reads some of its wishes only once.
        """
        _tell_sdl(headless)
        wanted = os.environ.get("SDL_VIDEODRIVER")
        if not wanted and sys.platform.startswith("linux") and not {"DISPLAY", "WAYLAND_DISPLAY"} & set(os.environ):
            raise NoDisplay(_no_display("none was found"))  # asked, SDL would look for one and complain itself
        try:
            pygame.display.init()
            driver = pygame.display.get_driver()
            if not wanted and driver in _UNSEEN:
                raise NoDisplay(_no_display("none was found"))
            if driver == "x11":  # it shares memory: 2 ms a frame, against 11 in software OpenGL
                os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")
            return cls(
                settings.display if display is None else display,
                settings.fullscreen if fullscreen is None else fullscreen,
                headless or driver in _UNSEEN,
            )
        except pygame.error as reason:
            pygame.display.quit()
            raise NoDisplay(_no_display(str(reason))) from reason

    @property
    def screen(self) -> pygame.Surface:
        """The surface to paint the next frame on, always 1920 x 1080. Ask for it in every frame."""
        window = pygame.display.get_surface()
        if window is not None and window.get_size() == SIZE and self._warp is None:
            return window
        if self._picture is None:
            self._picture = pygame.Surface(SIZE, depth=32)
        return self._picture

    def flip(self) -> None:
        """Show what was painted on `screen`."""
        window, picture = pygame.display.get_surface(), self.screen
        if window is None:
            return
        if picture is not window:
            area = _fitted(window.get_size())
            if area.w and area.h:
                _paint_bars(window, area)
                if self._warp is None:
                    factor = area.w / SIZE[0]
                    scale = pygame.transform.scale if factor == int(factor) else pygame.transform.smoothscale
                    scale(picture, area.size, window.subsurface(area))
                else:
                    self._draw_warped(picture, window, area)
        for watch in self.watchers:
            watch(window)
        pygame.display.flip()
        self._hide_pointer()

    def restore(self) -> None:
        """Undo what a scene that failed may have done to the surface that it painted on, and to the pointer."""
        self._picture = None
        pygame.event.set_grab(False)
        window = pygame.display.get_surface()
        if window is None:
            return
        for holder in window.get_locks():
            if holder is window:
                window.unlock()
        window.set_clip(None)
        window.set_alpha(None)
        window.set_colorkey(None)

    def at(self, mouse: tuple[float, float]) -> tuple[float, float]:
        """Where on the 1920 x 1080 canvas a position in the window lies; in a black bar, that is outside of it."""
        window = pygame.display.get_surface()
        area = _fitted(window.get_size()) if window else pygame.Rect((0, 0), SIZE)
        if not area.w or not area.h:
            return (-1.0, -1.0)
        if self._warp is not None and self._warp.size == area.size:
            return self._warp.back((mouse[0] - area.x, mouse[1] - area.y))
        return ((mouse[0] - area.x) * SIZE[0] / area.w, (mouse[1] - area.y) * SIZE[1] / area.h)

    def pin(self, corners: Sequence[float]) -> None:
        """Draw the picture into these corners, px of the canvas, see hardware/warp.py; none: straight again.

        Raises NoPin where OpenCV is missing or nothing fits into the corners; then all stays as it is.
        """
        if not corners:
            self.corners, self._warp = (), None
            return
        from pigaming_app.hardware.calibration.corner_pin import Warp
        from pigaming_app.hardware.messages import said
        from pigaming_app.hardware.vision.markers import NoVision

        try:
            self._warp = Warp(corners)
        except (NoVision, ValueError) as trouble:
            raise NoPin(said(trouble)) from trouble
        self.corners = tuple(corners)

    @property
    def projection(self) -> str:
        """The name of how the picture comes onto the mat: which display, all of it or a window, pinned where."""
        name = self.displays()[self.display] if self.display < len(self.displays()) else str(self.display + 1)
        window = "" if self.fullscreen or self.headless else ", in a window"
        return name + window + (f", pinned {' '.join(f'{value:g}' for value in self.corners)}" if self.corners else "")

    def toggle_fullscreen(self) -> bool:
        """Change between window and full screen; true when it is full screen now."""
        self.show(self.display, not self.fullscreen)
        return self.fullscreen

    def show(self, display: int, fullscreen: bool) -> None:
        """Move to a display, as a window or filling it; where that fails, stay, or be a window on the first display."""
        before = (self.display, self.fullscreen)
        for place in ((display, fullscreen and not self.headless), before, (0, False)):
            self.display, self.fullscreen = place
            try:
                self._show()
                return
            except pygame.error as reason:
                self.notices.append(f"The picture could not be moved: {reason}.")

    def displays(self) -> list[str]:
        """The displays that are there now: their place in the list is their number."""
        return [f"{number}: {w} × {h}" for number, (w, h) in enumerate(pygame.display.get_desktop_sizes(), 1)]

    def screenshot(self, path: Path) -> None:
        """Save what was painted last as a PNG file; missing folders are made. Raises NotSaved."""
        write(path, png_of(self.screen))

    def close(self) -> None:
        """Take the window away."""
        pygame.display.quit()

    def _show(self) -> None:
        sizes = pygame.display.get_desktop_sizes()
        if not 0 <= self.display < len(sizes):
            notice = f"Display {self.display + 1} is not there, so the picture is on display 1."
            self.notices += [notice] if notice not in self.notices else []
            self.display = 0
        pygame.display.set_caption("PiGaming")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # window managers that tile choose the size themselves
            if self.headless:
                pygame.display.set_mode(SIZE)
            elif self.fullscreen:
                pygame.display.set_mode(sizes[self.display], pygame.FULLSCREEN, display=self.display)
            else:
                size = _window_size(sizes[self.display])
                pygame.display.set_mode(size, pygame.RESIZABLE, display=self.display)
        self._pointer_moved = time.monotonic()

    def _draw_warped(self, picture: pygame.Surface, window: pygame.Surface, area: pygame.Rect) -> None:
        from pigaming_app.hardware.calibration.corner_pin import Warp
        from pigaming_app.ui.draw.pixels import pixels_of

        if self._warp is None or self._warp.size != area.size:
            self._warp = Warp(self.corners, area.size)
        self._warp.draw(pixels_of(picture), pixels_of(window)[area.top : area.bottom, area.left : area.right])

    def _hide_pointer(self) -> None:
        now, pointer = time.monotonic(), pygame.mouse.get_pos()
        if pointer != self._pointer:
            self._pointer, self._pointer_moved = pointer, now
        seen = now - self._pointer_moved < CURSOR_SECONDS
        if seen != pygame.mouse.get_visible():
            pygame.mouse.set_visible(seen)


def _tell_sdl(headless: bool) -> None:
    hints = {
        "SDL_WINDOWS_DPI_AWARENESS": "permonitorv2",
        "SDL_VIDEO_MINIMIZE_ON_FOCUS_LOSS": "0",
        "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    }
    for name, value in hints.items():
        os.environ.setdefault(name, value)
    if headless and os.environ.get("SDL_VIDEODRIVER") not in _UNSEEN:
        os.environ["SDL_VIDEODRIVER"] = "dummy"


def _no_display(reason: str) -> str:
    where = " (are you logged in over a network?)" if sys.platform.startswith("linux") else ""
    return f"There is no display to show the arcade on{where}: {reason}; play without one with --headless."


def _window_size(desktop: tuple[int, int]) -> tuple[int, int]:
    """The canvas itself where the desktop has room for it, else the largest of its shape that leaves a margin."""
    if desktop[0] > SIZE[0] and desktop[1] > SIZE[1]:
        return SIZE
    return _fitted((int(desktop[0] * 0.85), int(desktop[1] * 0.85))).size


def _fitted(room: tuple[int, int]) -> pygame.Rect:
    """The largest area of the canvas's shape in the middle of a room."""
    factor = min(room[0] / SIZE[0], room[1] / SIZE[1])
    w, h = round(SIZE[0] * factor), round(SIZE[1] * factor)
    return pygame.Rect((room[0] - w) // 2, (room[1] - h) // 2, w, h)


def _paint_bars(window: pygame.Surface, area: pygame.Rect) -> None:
    w, h = window.get_size()
    for bar in ((0, 0, w, area.top), (0, area.bottom, w, h), (0, 0, area.left, h), (area.right, 0, w, h)):
        window.fill("black", bar)
