"""Watch over the things during a match: the pictures on the screen are compared with the camera's, once a second."""

import pygame

from pigaming_app.hardware.control.rig import Rig
from pigaming_app.hardware.scan.watch import AT_ONCE, PATIENCE, PERIOD, ThingsWatch
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.hardware.signals import CameraFrame
from pigaming_app.ui.draw.pixels import pixels_of

FARTHEST = 5000.0  # px; positions beyond are those of robots that were never seen


class MatchWatch:
    """The watch of one match, if the mat was scanned in this session with the present calibration.

    It looks only while `note` and `look` are called with every picture. `places`: where things have moved, arena px.
    """

    def __init__(self, session: RobotSession, rig: Rig) -> None:
        self.session, self.rig = session, rig
        self._watch: ThingsWatch | None = None
        self._brief = False
        self._drawn: tuple[pygame.Surface, float] | None = None
        self._viewer = self._view

    @property
    def places(self) -> list[tuple[float, float]]:
        """Empty as long as nothing has moved."""
        return self._watch.places if self._watch and self._watch.changed else []

    @property
    def ended(self) -> bool:
        """True while it does not look: paused, dismissed, or after an examination that found nothing."""
        return self._watch is None

    def resume(self) -> None:
        """Begin anew: what happened before does not count."""
        self._begin(PERIOD)

    def examine(self) -> None:
        """Compare a still picture at once, within about a second, and stop before anybody can reach onto the mat."""
        self._begin(AT_ONCE)
        self._brief = True

    def pause(self) -> None:
        """Stop looking. Idempotent."""
        self._watch = self._drawn = None
        self._brief = False
        if self._viewer in self.rig.viewers:
            self.rig.viewers.remove(self._viewer)

    def dismiss(self) -> None:
        """Never look again, until the next scan: the things stay where they are now."""
        self.pause()
        self.session.expected = None

    def note(self, screen: pygame.Surface) -> None:
        """Remember the picture that is about to be shown; notices may still be drawn on it."""
        self._drawn = screen, self.rig.clock()

    def look(self) -> None:
        """Take the picture that was shown last, if one is needed; call it before the next one is drawn."""
        watch, looking = self._watch, self._viewer in self.rig.viewers
        if watch is None:
            return
        if self._brief and watch.checks >= PATIENCE and not watch.changed:
            return self.pause()
        if watch.looks != looking:
            (self.rig.viewers.append if watch.looks else self.rig.viewers.remove)(self._viewer)
        if watch.wants and self._drawn is not None:
            screen, drawn = self._drawn
            watch.note_canvas(lambda: pixels_of(screen), drawn)
        self._drawn = None

    def _begin(self, period: float) -> None:
        self.pause()
        expected = self.session.expected
        if expected is not None and expected.ground == self.session.ground:
            self._watch = ThingsWatch(expected, self.rig.clock, period)

    def _view(self, frame: CameraFrame) -> None:
        if watch := self._watch:
            seen = self.rig.sense(frame.captured - self.rig.clock())
            watch.process(frame, [(one.x, one.y) for one in seen if abs(one.x) + abs(one.y) < FARTHEST])
