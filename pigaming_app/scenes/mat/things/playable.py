"""Which arenas the things on a mat leave playable; all are tried in a thread, the shipped ones of every game."""

import logging
import threading
from collections.abc import Sequence

from pigaming_app.games.arenas import has_room, on_mat
from pigaming_app.games.registry import games
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import playable_arenas
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.sim.world import RADIUS

REST = 0.005  # s between two arenas, for the thread that draws

log = logging.getLogger("pigaming")


class PlayableArenas:
    """Tries the arenas that robots of a `radius`, px, fit into, with some things.

    `blocked`: names of those that cannot be played, by game; `done`: all tried; `culprits`: indices of the
    things that are in the way in one of them; found last.
    """

    def __init__(self, things: Sequence[ThingSpec], radius: float = RADIUS) -> None:
        self.things, self.radius = tuple(things), radius
        self.blocked: dict[str, list[str]] = {}
        self.culprits: set[int] = set()
        self.done = False
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._try, name="arenas", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Stop after the current arena."""
        self._ended.set()

    def _try(self) -> None:
        for game in games():
            for name in playable_arenas(game):
                if not has_room(game, load_cached(game, name).source, self.radius, SPARE):
                    continue
                if self._ended.is_set():
                    return
                if reason := self._refusal(game, name, self.things):
                    log.info("%s", reason)
                    self.blocked = {**self.blocked, game: [*self.blocked.get(game, ()), name]}
                self._rest()
        for game, names in self.blocked.items():
            for name in names:
                self._find_culprits(game, name)
        self.done = not self._ended.is_set()

    def _find_culprits(self, game: str, name: str) -> None:
        """Add the things that block an arena alone; else those without which it can be played."""
        count = len(self.things)
        alone = {i for i in range(count) if self._rest() and self._refusal(game, name, self.things[i : i + 1])}
        if not alone and count > 1:
            without = (self.things[:i] + self.things[i + 1 :] for i in range(count))
            alone = {i for i, others in enumerate(without) if self._rest() and not self._refusal(game, name, others)}
        self.culprits = self.culprits | alone

    def _rest(self) -> bool:
        """Leave time to the thread that draws; false at the end."""
        return not self._ended.wait(REST)

    def _refusal(self, game: str, name: str, things: Sequence[ThingSpec]) -> str:
        """The reason why an arena cannot be played with some things; empty if it can."""
        try:
            on_mat(game, load_cached(game, name), things, self.radius)
        except ArenaError as error:
            return str(error)
        return ""
