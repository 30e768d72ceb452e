"""Preloader: imports modules, loads arenas, solves racing lines and hashes the engine in a thread, below the title.

No frame waits for it. The compiler of the Lab is started afterwards.
"""

import logging
import threading
from collections.abc import Callable, Sequence
from importlib import import_module

from pigaming_app.storage.plugins.parts import LOADING
from pigaming_app.storage.plugins.time_limit import time_limit

log = logging.getLogger("pigaming")


class Preloader:
    """The preloader thread. Before the start, set `modules` (names to import) and `then`, which it calls at the end."""

    def __init__(self) -> None:
        self.modules: Sequence[str] = ()
        self.on_done: Callable[[], None] = lambda: None
        self._thread: threading.Thread | None = None
        self._ended = False
        self._ready: set[tuple[str, str]] = set()

    def start(self) -> None:
        """Start the thread, once."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="preloader", daemon=True)
            self._thread.start()

    def end(self) -> None:
        """Stop after the current step; waits at most 2 s."""
        self._ended = True
        if self._thread:
            self._thread.join(2.0)

    @property
    def begun(self) -> bool:
        """True once it has been started."""
        return self._thread is not None

    @property
    def busy(self) -> bool:
        """True while the thread runs."""
        return self._thread is not None and self._thread.is_alive()

    def ready(self, game: str, arena: str) -> bool:
        """True if a match there can start at once, as far as it depends on this thread."""
        return (game, arena) in self._ready or not self.busy

    def _work(self) -> None:
        try:
            self._do()
        except Exception:
            log.exception("preloading failed")

    def _do(self) -> None:
        """All steps, in the order in which they are likely to be needed."""
        from pigaming_app.games.engine_hash import engine_hash  # late: the title does not wait for these
        from pigaming_app.games.registry import games
        from pigaming_app.scenes.flow import arena_preload

        all_arenas = arena_preload.every_arena()
        for arena in all_arenas:
            self._try(arena_preload.read, *arena)
        for module in self.modules:
            if not self._ended:
                import_module(module)
        for arena in all_arenas:
            self._try(arena_preload.prepare, *arena)
            self._ready.add(arena)
        for game in games():  # 0.4 s each; cached for the first saved robot, ghost or replay
            self._try(lambda game, _: engine_hash(game), game, "rules")
        if not self._ended:
            self.on_done()

    def _try(self, step: Callable[[str, str], object], game: str, part: str) -> None:
        """A step in which code of a game may fail or never end, except after the end."""
        if self._ended:
            return
        try:
            with time_limit(LOADING):
                step(game, part)
        except (Exception, SystemExit):
            log.exception("preloading %s of %s failed", part, game)
