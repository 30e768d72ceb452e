"""Pictures of a match in an environment, drawn without a window by the game's own view."""

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from pigaming_app.games.match import Match
from pigaming_app.gym.matches import Matches
from pigaming_app.gym.options import OptionError
from pigaming_app.sim.world import DT

WIDTH, HEIGHT = 1920, 1080

if TYPE_CHECKING:
    from pigaming_app.scenes.views.screenshot import Screenshot


def checked_mode(mode: str | None) -> str | None:
    """A render mode. Raises OptionError."""
    if mode not in (None, "rgb_array"):
        raise OptionError(f"no render mode '{mode}'; there is rgb_array")
    return mode


class MatchCamera:
    """Draws match i of an environment; until its first picture it does nothing."""

    def __init__(self, matches: Matches, i: int) -> None:
        self.matches, self.i = matches, i
        self._shot: Screenshot | None = None
        self._episode = 0  # that the shot shows
        self._drawn = 0  # tick of the last picture

    def watch(self) -> None:
        """Take note of the decision just played, so that its shots and tracks appear."""
        if self._shot and self._episode == self.matches.episodes[self.i]:
            self._shot.match.state = self.matches.state(self.i)
            self._shot.view.watch(self._shot.match.state)

    def picture(self) -> Any:
        """The present picture, (1080, 1920, 3) uint8. Raises ResetNeeded before the first episode."""
        self.matches.require_begun("render")
        if self._shot is None or self._episode != self.matches.episodes[self.i]:
            self._shot = self._new_shot()
            self._shot.match.state = self.matches.state(self.i)
            self._episode, self._drawn = self.matches.episodes[self.i], self._shot.match.state.tick
        tick = self._shot.match.state.tick
        seconds, self._drawn = (tick - self._drawn) * DT, tick
        return np.frombuffer(bytearray(self._shot.pixels(seconds)), np.uint8).reshape(HEIGHT, WIDTH, 3)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_shot": None}

    def close(self) -> None:
        """Forget the picture."""
        self._shot = None

    def _new_shot(self) -> "Screenshot":
        os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
        os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
        from pigaming_app.scenes.views.screenshot import Screenshot

        return Screenshot(Match(self.matches.task.setup_of(int(self.matches.start_of[self.i]))))
