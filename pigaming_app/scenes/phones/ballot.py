"""What those who wait vote for: the next game, and its next arena. One vote a phone, until the next match begins."""

from collections import Counter
from collections.abc import Collection, Iterable

from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.sim.arena import ArenaError
from pigaming_app.ui.i18n import Words

MAX_GAMES, MAX_ARENAS = 6, 8  # on the page of a phone


class Ballot:
    """The votes. `game`: whose arenas are offered."""

    def __init__(self) -> None:
        self.game = ""
        self.games: tuple[str, ...] = ()
        self.arenas: tuple[str, ...] = ()
        self._games: dict[int, str] = {}  # by phone
        self._arenas: dict[int, str] = {}

    def offer(self, game: str) -> None:
        """Offer the games, and the arenas of one. Votes for the arenas of another are void."""
        self.games = tuple(shown_games())[:MAX_GAMES]
        if game != self.game:
            self.game, self._arenas = game, {}
            self.arenas = tuple(shipped_arenas(game))[:MAX_ARENAS] if game else ()

    def vote_game(self, phone: int, place: int) -> None:
        """Count a vote for the game at a place of the list; a vote for none there is void."""
        if place < len(self.games):
            self._games[phone] = self.games[place]

    def vote_arena(self, phone: int, place: int) -> None:
        """Count a vote for the arena at a place of the list; a vote for none there is void."""
        if place < len(self.arenas):
            self._arenas[phone] = self.arenas[place]

    def keep(self, phones: Collection[int]) -> None:
        """Only the votes of these phones count."""
        self._games = {phone: game for phone, game in self._games.items() if phone in phones}
        self._arenas = {phone: arena for phone, arena in self._arenas.items() if phone in phones}

    def clear(self) -> None:
        """A match begins: the votes have been used."""
        self._games, self._arenas = {}, {}

    @property
    def next_game(self) -> tuple[str, int]:
        """The game with the most votes, and their number; of equal ones the one that got its votes first."""
        return _first(self._games.values())

    @property
    def next_arena(self) -> tuple[str, int]:
        """The arena with the most votes, and their number."""
        return _first(self._arenas.values())


def title(game: str, arena: str, words: Words) -> str:
    """The title of an arena; its name if it cannot be loaded."""
    try:
        return arena_title(load_cached(game, arena), words.language)
    except ArenaError:
        return arena


def _first(votes: Iterable[str]) -> tuple[str, int]:
    counted = Counter(votes).most_common(1)
    return counted[0] if counted else ("", 0)
