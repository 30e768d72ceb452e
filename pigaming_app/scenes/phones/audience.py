"""Those who wait: their cheers are a wave along the foot of the screen, their votes choose what comes next.

Votes for an arena apply in the lobby until somebody chooses another one, and to a rematch; votes for a game put the
focus on it where the next game is chosen.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import pygame

from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.games.game import FREE
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow.arena_cache import load_cached
from pigaming_app.scenes.flow.match_choice import arena_title, change_arena, last_choice
from pigaming_app.scenes.flow.match_words import game_title
from pigaming_app.scenes.flow.scene import Context, Scene
from pigaming_app.scenes.phones.cheers import COLORS, Cheers, votes_line
from pigaming_app.scenes.phones.seating import Driven, Ended, Seating
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.sim.arena import ArenaError
from pigaming_app.ui.draw import Color
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.input.phone_messages import WishKind, ballot_text
from pigaming_app.ui.input.phones.roster import Roster

MAX_GAMES, MAX_ARENAS = 6, 8  # on the page of a phone


if TYPE_CHECKING:
    from pigaming_app.scenes.lobby.scene import Lobby


class Audience:
    """Call `update` once a frame, and `draw` over the scene on top."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.ballot, self.cheers = Ballot(), Cheers()
        self._titled = "", ""  # game and language of the titles
        self._titles: list[str] = []  # of the arenas of the ballot
        self._applied = "", ""  # the game in whose choice the arena of the votes is
        self._focused: Scene | None = None  # a choice of games whose focus was set
        self._lobby: Lobby | None = None  # on the stack
        self._line = ""  # about the votes
        self._match = self._shows_cheers = self._in_match = False

    @staticmethod
    def color(number: int) -> Color:
        """The colour that a phone has chosen."""
        return COLORS[number % len(COLORS)]

    def update(self, roster: Roster, now: Seating, scenes: Sequence[Scene], phones: Collection[int]) -> None:
        """Take cheers and votes, tell the phones what they may vote for, and apply what was voted."""
        top = scenes[-1] if scenes else None
        self.ballot.offer(game_of(scenes))
        if now.match and not self._match:
            self.ballot.clear()
        self._match, self._shows_cheers, self._in_match = now.match, shows_cheers(top), isinstance(top, Driven)
        self.ballot.keep(phones)
        for number, wish in roster.wishes():
            guest = roster.guest(number)
            if guest is None or number not in phones:
                continue
            if wish.kind is WishKind.GAME:
                self.ballot.vote_game(number, wish.number)
            elif wish.kind is WishKind.ARENA:
                self.ballot.vote_arena(number, wish.number)
            elif self._shows_cheers and not (now.match and number in now.phones):
                self.cheers.add(wish.number, self.color(guest.colour), guest.name)
        if phones and scenes:
            self._tell(phones)
            self._apply(scenes)
        self._line = self._votes() if next_is_chosen(top) else ""

    def advance(self, seconds: float) -> None:
        """Move the waves on."""
        self.cheers.advance(seconds)

    def draw(self, screen: pygame.Surface) -> None:
        """Draw waves and votes over the scene."""
        if self._shows_cheers:
            self.cheers.draw(screen, self._in_match)
        if self._line:
            votes_line(self._line).draw(screen)

    def _tell(self, phones: Collection[int]) -> None:
        """Offer the phones the ballot. One arena a frame gets its title: it may be loaded."""
        words, ballot = self.context.words, self.ballot
        if self._titled != (ballot.game, words.language):
            self._titled, self._titles = (ballot.game, words.language), []
        if len(self._titles) < len(ballot.arenas):
            self._titles.append(title(ballot.game, ballot.arenas[len(self._titles)], words))
            return
        text = ballot_text([game_title(words, game) for game in ballot.games], self._titles)
        for number in phones:
            self.context.controls.phones.offer(number, text)

    def _apply(self, scenes: Sequence[Scene]) -> None:
        """Use the votes where nobody has chosen, and begin a lobby with teams if the operator likes."""
        from pigaming_app.scenes.lobby.game_choice import GameChoice  # late: the title does not wait for these
        from pigaming_app.scenes.results.scene import Results

        top, (game, _), (arena, _) = scenes[-1], self.ballot.next_game, self.ballot.next_arena
        choice = top if isinstance(top, GameChoice) else None
        if choice and choice is not self._focused and game:
            choice.focus.move_to(game)
        self._focused = choice
        if arena and isinstance(top, Results) and top.setup.arena != arena:
            top.setup = replace(top.setup, arena=arena)
        lobby = lobby_of(scenes)
        if lobby is not self._lobby and lobby and self.context.settings.phones_teams:
            lobby.seats.teams = lobby.seats.teams or lobby.seats.team_mode == FREE
        self._lobby = lobby
        if lobby and lobby.now.starting is None and arena and (lobby.game, arena) != self._applied:
            self._applied = lobby.game, arena
            last = last_choice(self.context, lobby.game)
            change_arena(games()[lobby.game], last, arena)
            self.context.settings.games[lobby.game] = last
        elif not arena:
            self._applied = "", ""

    def _votes(self) -> str:
        """What leads, in one line."""
        words, (game, for_game), (arena, for_arena) = self.context.words, self.ballot.next_game, self.ballot.next_arena
        parts = [f"{game_title(words, game)} × {for_game}"] if game else []
        if arena:
            parts.append(f"{title(self.ballot.game, arena, words)} × {for_arena}")
        return words("phones.votes", names="  ·  ".join(parts)) if parts else ""


def lobby_of(scenes: Sequence[Scene]) -> "Lobby | None":
    """The lobby on the stack, if there is one."""
    from pigaming_app.scenes.lobby.scene import Lobby  # late: the title does not wait for it

    return next((scene for scene in scenes if isinstance(scene, Lobby)), None)


def next_is_chosen(top: Scene | None) -> bool:
    """True on the pages on which people choose what comes next."""
    if top is None:
        return False
    from pigaming_app.scenes.lobby.game_choice import GameChoice  # late: the title does not wait for it
    from pigaming_app.scenes.phones.join import JoinByPhone

    return isinstance(top, (GameChoice, JoinByPhone, Ended)) or lobby_of([top]) is not None


def game_of(scenes: Sequence[Scene]) -> str:
    """The game of the uppermost scene that has one; empty: none."""
    for scene in reversed(scenes):
        name = getattr(getattr(scene, "setup", scene), "game", "")
        if isinstance(name, str) and name in games():
            return name
    return ""


def shows_cheers(top: Scene | None) -> bool:
    """True over a match in simulation, and over its results: on the mat no light may fall on a marker."""
    robots = getattr(top, "robots", None)
    return (isinstance(top, Driven) and getattr(robots, "kind", "simulated") == "simulated") or isinstance(top, Ended)


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
