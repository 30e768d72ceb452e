"""The window. Scenes always draw 1920 x 1080 px; the canvas scales that to any window or display.

If the window is exactly that size, scenes draw on it directly; else the picture is scaled with black bars, never
distorted. Window and display errors at run time never raise: the window falls back to a mode that works.
"""

import os
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import pygame

from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.ui.png import png_of

SIZE = (1920, 1080)
CURSOR_SECONDS = 3.0  # seconds without motion until the mouse pointer hides
_MEMORY_DRIVERS = ("dummy", "offscreen")  # SDL drivers that render into memory only


class NoDisplay(Exception):
    """No display to open a window on; the text is one plain sentence."""


class WindowSettings(Protocol):
    """The settings of the window."""

    display: int
    fullscreen: bool


class Warp(Protocol):
    """Warps the canvas into a quadrilateral of a window of `size` px."""

    size: tuple[int, int]

    def apply(self, picture: Any) -> Any:
        """The whole window with the canvas in it; both are pixels, (height, width, 4)."""

    def to_canvas(self, at: tuple[float, float]) -> tuple[float, float]:
        """The canvas position, px, shown at a window position."""


class Pin(Protocol):
    """The corners of the quadrilateral, canvas px, clockwise from the upper left; `fit` builds a window's warp."""

    corners: tuple[float, ...]

    def fit(self, size: tuple[int, int]) -> Warp: ...


class Canvas:
    """The arcade's window. `notices` collects plain sentences about requests that failed.

    Each of `watchers` is called with every picture shown in the window.
    """

    def __init__(self, display: int, fullscreen: bool, headless: bool, grabs: bool = False) -> None:
        self.headless, self.grabs = headless, grabs and not headless
        self.fullscreen = fullscreen and not headless
        self.display = display
        self.notices: list[str] = []
        self.watchers: list[Callable[[pygame.Surface], None]] = []
        self._pin: Pin | None = None
        self._warp: Warp | None = None  # of the pin, for the last window size
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
        grabs: bool = False,
    ) -> "Canvas":
        """Open the window as given by the arguments, else by the settings. Raises NoDisplay.

        `grabs`: in full screen, keyboard and pointer stay with it as far as the system allows, with Alt+Tab and the
        keys of the desktop.

        Call it before `pygame.init`, because SDL reads some hints only once.
        """
        _set_sdl_hints(headless)
        requested = os.environ.get("SDL_VIDEODRIVER")
        if not requested and sys.platform.startswith("linux") and not {"DISPLAY", "WAYLAND_DISPLAY"} & set(os.environ):
            raise NoDisplay(_no_display("none was found"))  # else SDL would print an error of its own
        try:
            pygame.display.init()
            driver = pygame.display.get_driver()
            if not requested and driver in _MEMORY_DRIVERS:
                raise NoDisplay(_no_display("none was found"))
            if driver == "x11":  # shared memory: 2 ms a frame, against 11 ms in software OpenGL
                os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")
            return cls(
                settings.display if display is None else display,
                settings.fullscreen if fullscreen is None else fullscreen,
                headless or driver in _MEMORY_DRIVERS,
                grabs,
            )
        except pygame.error as reason:
            pygame.display.quit()
            raise NoDisplay(_no_display(str(reason))) from reason

    @property
    def screen(self) -> pygame.Surface:
        """The surface to draw the next frame on, always 1920 x 1080. It may change every frame."""
        window = pygame.display.get_surface()
        if window is not None and window.get_size() == SIZE and self._warp is None:
            return window
        if self._picture is None:
            self._picture = pygame.Surface(SIZE, depth=32)
        return self._picture

    def flip(self) -> None:
        """Show the contents of `screen`."""
        window, picture = pygame.display.get_surface(), self.screen
        if window is None:
            return
        if picture is not window:
            area = _fit_canvas(window.get_size())
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
        """Undo what a failed scene may have done to the surface and the pointer."""
        self._picture = None
        self._grab()
        window = pygame.display.get_surface()
        if window is None:
            return
        for holder in window.get_locks():
            if holder is window:
                window.unlock()
        window.set_clip(None)
        window.set_alpha(None)
        window.set_colorkey(None)

    def to_canvas(self, mouse: tuple[float, float]) -> tuple[float, float]:
        """Window coordinates as canvas coordinates, 1920 x 1080; outside of the canvas for a black bar."""
        window = pygame.display.get_surface()
        area = _fit_canvas(window.get_size()) if window else pygame.Rect((0, 0), SIZE)
        if not area.w or not area.h:
            return (-1.0, -1.0)
        if self._warp is not None and self._warp.size == area.size:
            return self._warp.to_canvas((mouse[0] - area.x, mouse[1] - area.y))
        return ((mouse[0] - area.x) * SIZE[0] / area.w, (mouse[1] - area.y) * SIZE[1] / area.h)

    def pin(self, pin: Pin | None) -> None:
        """Warp the picture into the corners of a pin; None: unwarped."""
        self._pin, self._warp = pin, pin.fit(SIZE) if pin else None

    @property
    def corners(self) -> tuple[float, ...]:
        """The corners of the pin; empty if there is none."""
        return self._pin.corners if self._pin else ()

    @property
    def projection(self) -> str:
        """A name for the projection: which display, full screen or window, pinned corners."""
        name = self.displays()[self.display] if self.display < len(self.displays()) else str(self.display + 1)
        window = "" if self.fullscreen or self.headless else ", in a window"
        return name + window + (f", pinned {' '.join(f'{value:g}' for value in self.corners)}" if self.corners else "")

    def toggle_fullscreen(self) -> bool:
        """Change between window and full screen; true if full screen now."""
        self.show(self.display, not self.fullscreen)
        return self.fullscreen

    def show(self, display: int, fullscreen: bool) -> None:
        """Move to a display, windowed or full screen. Falls back to the old mode, then to a window on display 1."""
        before = (self.display, self.fullscreen)
        for mode in ((display, fullscreen and not self.headless), before, (0, False)):
            self.display, self.fullscreen = mode
            try:
                self._show()
                return
            except pygame.error as reason:
                self.notices.append(f"The picture could not be moved: {reason}.")

    def displays(self) -> list[str]:
        """The connected displays; their index is the display number."""
        return [f"{number}: {w} × {h}" for number, (w, h) in enumerate(pygame.display.get_desktop_sizes(), 1)]

    def screenshot(self, path: Path) -> None:
        """Save the last picture as a PNG file; missing folders are created. Raises NotSaved."""
        write_atomic(path, png_of(self.screen))

    def close(self) -> None:
        pygame.display.quit()

    def _show(self) -> None:
        sizes = pygame.display.get_desktop_sizes()
        if not 0 <= self.display < len(sizes):
            notice = f"Display {self.display + 1} is not there, so the picture is on display 1."
            self.notices += [notice] if notice not in self.notices else []
            self.display = 0
        pygame.display.set_caption("PiGaming")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # tiling window managers choose the size themselves
            if self.headless:
                pygame.display.set_mode(SIZE)
            elif self.fullscreen:
                pygame.display.set_mode(sizes[self.display], pygame.FULLSCREEN, display=self.display)
            else:
                size = _window_size(sizes[self.display])
                pygame.display.set_mode(size, pygame.RESIZABLE, display=self.display)
        self._grab()
        self._pointer_moved = time.monotonic()

    def _grab(self) -> None:
        pygame.event.set_grab(self.grabs and self.fullscreen)

    def _draw_warped(self, picture: pygame.Surface, window: pygame.Surface, area: pygame.Rect) -> None:
        from pigaming_app.ui.draw.pixels import bgra_surface, pixels_of

        if self._warp is None or self._warp.size != area.size:
            assert self._pin is not None
            self._warp = self._pin.fit(area.size)
        window.blit(bgra_surface(self._warp.apply(pixels_of(picture))), area)

    def _hide_pointer(self) -> None:
        now, pointer = time.monotonic(), pygame.mouse.get_pos()
        if pointer != self._pointer:
            self._pointer, self._pointer_moved = pointer, now
        visible = now - self._pointer_moved < CURSOR_SECONDS
        if visible != pygame.mouse.get_visible():
            pygame.mouse.set_visible(visible)


def _set_sdl_hints(headless: bool) -> None:
    hints = {
        "SDL_WINDOWS_DPI_AWARENESS": "permonitorv2",
        "SDL_VIDEO_MINIMIZE_ON_FOCUS_LOSS": "0",
        "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
        "SDL_GRAB_KEYBOARD": "1",  # with the pointer, see `grabs`
        "SDL_ALLOW_ALT_TAB_WHILE_GRABBED": "0",
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    }
    for name, value in hints.items():
        os.environ.setdefault(name, value)
    if headless and os.environ.get("SDL_VIDEODRIVER") not in _MEMORY_DRIVERS:
        os.environ["SDL_VIDEODRIVER"] = "dummy"


def _no_display(reason: str) -> str:
    where = " (are you logged in over a network?)" if sys.platform.startswith("linux") else ""
    return f"There is no display to show the arcade on{where}: {reason}; play without one with --headless."


def _window_size(desktop: tuple[int, int]) -> tuple[int, int]:
    """The canvas size if the desktop is larger, else the largest of that shape that leaves a margin."""
    if desktop[0] > SIZE[0] and desktop[1] > SIZE[1]:
        return SIZE
    return _fit_canvas((int(desktop[0] * 0.85), int(desktop[1] * 0.85))).size


def _fit_canvas(area_size: tuple[int, int]) -> pygame.Rect:
    """The largest rectangle of the canvas's shape, centred in an area."""
    factor = min(area_size[0] / SIZE[0], area_size[1] / SIZE[1])
    w, h = round(SIZE[0] * factor), round(SIZE[1] * factor)
    return pygame.Rect((area_size[0] - w) // 2, (area_size[1] - h) // 2, w, h)


def _paint_bars(window: pygame.Surface, area: pygame.Rect) -> None:
    w, h = window.get_size()
    for bar in ((0, 0, w, area.top), (0, area.bottom, w, h), (0, 0, area.left, h), (area.right, 0, w, h)):
        window.fill("black", bar)
