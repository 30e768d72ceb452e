"""Which arenas the things on a mat leave playable; all are tried in a thread, the shipped ones of every game."""

import logging
import re
import threading
from collections.abc import Sequence
from time import sleep

from pigaming_app.games.arenas import with_things
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.match_choice import load_cached, playable_arenas
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.things.spec import ThingSpec

REST = 0.005  # s between two arenas, for the thread that draws
NAMED = re.compile(r"thing\[(\d+)\]")  # in the line of an ArenaError

log = logging.getLogger("pigaming")


class PlayableArenas:
    """Tries the arenas with some things. `blocked`: names of those that cannot be played, by game; `done`: all tried.

    `culprits`: indices of the things for which an arena was refused, as far as one was.
    """

    def __init__(self, things: Sequence[ThingSpec]) -> None:
        self.things = tuple(things)
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
                if self._ended.is_set():
                    return
                try:
                    with_things(game, load_cached(game, name), self.things)
                except ArenaError as error:
                    log.info("%s", error)
                    self.blocked = {**self.blocked, game: [*self.blocked.get(game, ()), name]}
                    self.culprits |= culprits(error, len(self.things))
                sleep(REST)
        self.done = True


def culprits(error: ArenaError, count: int) -> set[int]:
    """Indices of the things that the line of an error names, of `count` at the end of an arena's."""
    return {int(number) - 1 for number in NAMED.findall(str(error)) if int(number) <= count}
