"""A second window beside the arcade: what the camera over the emulated mat sees."""

import logging
import sys
import warnings

import pygame

from pigaming_app.hardware.session.emulated import EmulatedSession

SIZE = (960, 540)
EVERY = 1.0 / 15.0  # s between two pictures

log = logging.getLogger("pigaming")


class CameraWindow:
    """The window; where the system gives no second one, the log says so and the arcade goes on."""

    def __init__(self, session: EmulatedSession) -> None:
        self.session = session
        self.window: pygame.Window | None = None
        self._shown, self._age = -1, 0.0
        try:
            self.window = pygame.Window("PiGaming: what the camera sees", SIZE, position=(24, 24), resizable=True)
            self.window.get_surface()
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", DeprecationWarning)  # there is no other way to name the first window
                pygame.Window.from_display_module().focus()  # the keys belong to the arcade
        except pygame.error as reason:
            sentence = f"There is no second window for the camera's view: {reason}."
            log.warning("%s", sentence)
            print(f"PiGaming: {sentence}", file=sys.stderr)
            self.close()

    def update(self, seconds: float) -> None:
        """Show the newest picture, if there is a new one and it is time to."""
        self._age += seconds
        frame = self.session.newest
        if self.window is None or self._age < EVERY or frame is None or frame.number == self._shown:
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

    def asked(self, event: pygame.Event) -> bool:
        """Whether an event asks for this window to be closed; then it is."""
        mine = event.type == pygame.WINDOWCLOSE and self.window is not None and event.window == self.window
        if mine:
            self.close()
        return mine

    def close(self) -> None:
        """Take the window away."""
        window, self.window = self.window, None
        if window is not None:
            window.destroy()
