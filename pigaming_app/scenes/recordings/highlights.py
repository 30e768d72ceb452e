"""Highlights for attract mode: moments of the matches just played, kept in memory, and of saved replays."""

import secrets
from collections import deque

from pigaming_app.games.moments import CLOSE, KINDS, Moment
from pigaming_app.games.replay import Replay
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.recordings import store

KEPT = 8  # matches in memory
Highlight = tuple[Replay, Moment]


class Highlights:
    """The pool. Kinds of moments take turns; of close finishes the closest is chosen, else one at random."""

    def __init__(self) -> None:
        self.played: deque[Replay] = deque(maxlen=KEPT)
        self._turn = 0

    def add(self, replay: Replay) -> None:
        """Keep a match that has just been played, if it has moments."""
        if replay.moments:
            self.played.append(replay)

    def next(self) -> Highlight | None:
        """The next highlight, with one saved replay chosen at random among the candidates; None if there is none."""
        replays = [*self.played, *self._saved()]
        for _ in KINDS:
            kind = KINDS[self._turn % len(KINDS)]
            self._turn += 1
            found = [(replay, one) for replay in replays for one in replay.moments if one.kind == kind]
            if found:
                closest = min(found, key=lambda highlight: highlight[1].lead)
                return closest if kind == CLOSE else secrets.choice(found)
        return None

    def _saved(self) -> list[Replay]:
        """One saved replay, if there is any that plays out as recorded."""
        paths = store.paths()
        replay = store.load(secrets.choice(paths)) if paths else None
        return [replay] if replay and not replay.other_engine else []


def highlights(context: Context) -> Highlights:
    """Those of a context, for attract mode: `context.shared(highlights)`."""
    return Highlights()
