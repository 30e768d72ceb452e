"""Cheers and votes of those who wait."""

from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from pigaming_app.games.arenas import shipped_arenas
from pigaming_app.scenes.flow.match_choice import change_arena, last_choice
from pigaming_app.scenes.lobby.game_choice import GameChoice
from pigaming_app.scenes.lobby.scene import Lobby
from pigaming_app.scenes.phones.audience import Ballot, shows_cheers
from pigaming_app.scenes.phones.cheers import MOST, SECONDS, Cheers
from pigaming_app.scenes.phones.host import phone_host
from pigaming_app.scenes.phones.link import PhoneLink
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import Results
from pigaming_app.scenes.views.registry import shown_games
from pigaming_app.ui.draw.pixels import pixels_of
from pigaming_app.ui.input.events import Device
from pigaming_app.ui.input.phone_messages import Wish, WishKind
from pigaming_app.ui.input.phones.guest import CHEER_SECONDS
from tests.matches import setup_of
from tests.scenes.arcade import KEYS, Arcade

pytestmark = pytest.mark.usefixtures("_nothing_prewarmed")


class Fans:
    """Eight phones, four of which may act; time stands still but for `pass_time`."""

    def __init__(self, arcade: Arcade) -> None:
        self.arcade, self.now = arcade, 100.0
        settings = arcade.context.settings
        settings.phones, settings.phones_network, settings.phones_port = True, "127.0.0.1", 0
        self.link = PhoneLink(arcade.context)
        self.link.update(arcade.stack.scenes)
        self.host = arcade.context.shared(phone_host)
        self.host.roster.clock = lambda: self.now
        for i in range(8):
            self.host.roster.admit("", f"10.0.0.{i}")
        self.update()

    def wish(self, number: int, kind: WishKind, value: int) -> None:
        self.host.roster.wish(number, Wish(kind, value))

    def update(self) -> None:
        self.arcade.frame()
        self.link.update(self.arcade.stack.scenes)

    @property
    def waves(self) -> int:
        return len(self.link.audience.cheers.waves)

    def match(self) -> MatchScene:
        devices = [Device("phone", number) for number in range(4)]
        match = self.arcade.open(
            MatchScene(self.arcade.context, setup_of("pitanks", ["human"] * 4, "classic", 2), devices)
        )
        self.update()
        return match


@pytest.fixture
def fans(arcade: Arcade) -> Iterator[Fans]:
    fans = Fans(arcade)
    yield fans
    fans.host.close()


def test_a_cheer_is_a_wave_and_comes_from_those_who_watch(fans: Fans) -> None:
    fans.match()
    fans.wish(5, WishKind.CHEER, 0)
    fans.wish(0, WishKind.CHEER, 0)
    fans.update()
    assert fans.waves == 1, "who drives does not cheer"
    for _ in range(50):
        fans.wish(5, WishKind.CHEER, 1)
    fans.update()
    assert fans.waves == 1, "one at a time"
    fans.now += CHEER_SECONDS
    for number in (4, 5, 6, 7):
        fans.wish(number, WishKind.CHEER, 200 + number)
    fans.update()
    assert fans.waves == 5
    fans.link.audience.advance(SECONDS + 0.1)
    assert fans.waves == 0


def test_a_wave_is_at_the_foot_of_the_screen_only(fans: Fans) -> None:
    fans.match()
    before = pixels_of(fans.arcade.screen).copy()
    fans.wish(5, WishKind.CHEER, 0)
    fans.update()
    fans.link.audience.advance(SECONDS / 2)
    before = pixels_of(fans.arcade.screen).copy()
    fans.link.audience.draw(fans.arcade.screen)
    changed = np.nonzero((pixels_of(fans.arcade.screen) != before).any(axis=2))
    assert len(changed[0]) > 500
    assert changed[0].min() > 900


def test_many_cheers_are_a_few_waves() -> None:
    cheers = Cheers()
    for _ in range(1000):
        cheers.add(7, (255, 0, 0), "")
    assert len(cheers.waves) == MOST


def test_no_light_falls_on_the_mat() -> None:
    for kind, shown in (("simulated", True), ("emulated", False), ("real", False)):
        scene: Any = SimpleNamespace(drivers=None, robots=SimpleNamespace(kind=kind))
        assert shows_cheers(scene) is shown
    assert not shows_cheers(None)


def test_one_phone_has_one_vote_and_nonsense_has_none() -> None:
    ballot = Ballot()
    ballot.offer("pitanks")
    games, arenas = ballot.games, ballot.arenas
    assert (games, arenas[0]) == (tuple(shown_games())[:6], shipped_arenas("pitanks")[0])
    for place in (1, 0, 1):
        ballot.vote_game(7, place)
    ballot.vote_game(8, 255)
    assert ballot.next_game == (games[1], 1)
    ballot.vote_game(9, 0)
    assert ballot.next_game == (games[1], 1), "the first of equals"
    ballot.vote_game(10, 0)
    assert ballot.next_game == (games[0], 2)
    ballot.vote_arena(7, 1)
    ballot.vote_arena(7, 99)
    assert ballot.next_arena == (arenas[1], 1)
    ballot.offer("race")
    assert ballot.next_arena == ("", 0), "another game, other arenas"
    ballot.keep([9])
    assert ballot.next_game == (games[0], 1)
    ballot.clear()
    assert ballot.next_game == ("", 0)


def test_a_reloaded_page_gets_the_ballot_again(fans: Fans, monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[int] = []
    fans.arcade.context.controls.phones.send = lambda number, text: sent.append(number) if "ballot" in text else None
    fans.arcade.open(Lobby(fans.arcade.context, "race"))
    for _ in range(20):
        fans.update()
    assert sorted(sent) == list(range(8))
    admitted = fans.host.roster.admit("", "10.0.0.9")
    assert not isinstance(admitted, str)
    fans.update()
    fans.update()
    assert sent[8:] == [8]
    fans.host.roster.admit(admitted[1], "10.0.0.9")  # before it was missed
    fans.update()
    fans.update()
    assert sent[8:] == [8, 8]


def test_votes_choose_the_arena_of_a_lobby_until_somebody_chooses(fans: Fans) -> None:
    context = fans.arcade.context
    lobby = fans.arcade.open(Lobby(context, "pitanks"))
    fans.update()
    names = shipped_arenas("pitanks")
    fans.wish(5, WishKind.ARENA, 2)
    fans.update()
    fans.update()
    assert last_choice(context, "pitanks").arena == names[2]
    assert "× 1" in fans.link.audience._line
    chosen = last_choice(context, "pitanks")
    from pigaming_app.games.registry import games

    change_arena(games()["pitanks"], chosen, names[1])
    context.settings.games["pitanks"] = chosen
    fans.wish(6, WishKind.ARENA, 2)
    fans.update()
    assert last_choice(context, "pitanks").arena == names[1], "the same votes do not overrule a choice"
    assert lobby in fans.arcade.stack.scenes


def test_votes_count_for_a_rematch_and_put_the_focus_on_the_next_game(fans: Fans) -> None:
    context = fans.arcade.context
    fans.wish(4, WishKind.GAME, 0)
    fans.update()
    match = fans.match()
    assert fans.link.audience.ballot.next_game == ("", 0), "votes before a match were for that one"
    fans.wish(5, WishKind.ARENA, 1)
    fans.wish(5, WishKind.GAME, 2)
    fans.update()
    fans.update()
    assert fans.link.audience.ballot.next_arena[1] == 1
    assert not fans.link.audience._line, "it is not shown over a match"
    page = Results(context, match.match.outcome(), match.setup, match.devices, match.sequel.rematch)
    page.claims = []
    fans.arcade.open(page)
    fans.wish(6, WishKind.ARENA, 1)
    fans.wish(6, WishKind.GAME, 2)
    fans.update()
    fans.update()
    assert page.setup.arena == shipped_arenas("pitanks")[1]
    choice = fans.arcade.open(GameChoice(context, match.setup, [KEYS[0], None, None, None], Lobby))
    fans.update()
    assert choice.focus.name == shown_games()[2]
    choice.focus.move_to(shown_games()[0])
    fans.update()
    assert choice.focus.name == shown_games()[0], "once"
