"""A second window with the view of the emulated camera."""

import logging
import sys
import warnings

import pygame

from pigaming_app.hardware.session.emulated import EmulatedSession

SIZE = (960, 540)
PERIOD = 1.0 / 15.0  # s between two pictures

log = logging.getLogger("pigaming")


class CameraWindow:
    """The window; if the system supports only one window, this is logged and the arcade runs on."""

    def __init__(self, session: EmulatedSession) -> None:
        self.session = session
        self.window: pygame.Window | None = None
        self._shown, self._age = -1, 0.0
        try:
            self.window = pygame.Window("PiGaming: what the camera sees", SIZE, position=(24, 24), resizable=True)
            self.window.get_surface()
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)  # there is no other way to access the first window
                pygame.Window.from_display_module().focus()  # the arcade's window gets the keys
        except pygame.error as reason:
            sentence = f"There is no second window for the camera's view: {reason}."
            log.warning("%s", sentence)
            print(f"PiGaming: {sentence}", file=sys.stderr)
            self.close()

    def update(self, seconds: float) -> None:
        """Show the newest picture, if it is new and due."""
        self._age += seconds
        frame = self.session.newest
        if self.window is None or self._age < PERIOD or frame is None or frame.number == self._shown:
            return
        from pigaming_app.ui.draw.pixels import grey_surface

        self._shown, self._age = frame.number, 0.0
        try:
            surface = self.window.get_surface()
            surface.blit(pygame.transform.scale(grey_surface(frame.image[::2, ::2]), surface.get_size()), (0, 0))
            self.window.flip()
        except pygame.error as reason:
            log.warning("The window with the camera's view was lost: %s.", reason)
            self.close()

    def close_if_requested(self, event: pygame.Event) -> bool:
        """Close this window if an event requests it; true if so."""
        mine = event.type == pygame.WINDOWCLOSE and self.window is not None and event.window == self.window
        if mine:
            self.close()
        return mine

    def close(self) -> None:
        window, self.window = self.window, None
        if window is not None:
            window.destroy()
