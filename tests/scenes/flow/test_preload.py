"""The preloader: arenas, racing lines, and the Lab's compiler, once per run."""

import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from pigaming_app.ai.learning.compiler import Compiler
from pigaming_app.games import engine_hash
from pigaming_app.games.game import Setup
from pigaming_app.games.registry import games
from pigaming_app.scenes.flow import arena_preload as arena_jobs
from pigaming_app.scenes.flow import preload
from pigaming_app.scenes.flow.preload import Preloader
from pigaming_app.scenes.lab.background import LabBackground
from pigaming_app.scenes.launch import Options
from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
from pigaming_app.scenes.lobby.seats import LobbySeats
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.start import opened
from pigaming_app.sim.kernel import can_compile
from pigaming_app.ui.input.events import Button
from tests.scenes.arcade import KEYS, Arcade

ENDLESS = (sys.executable, "-c", "import sys; sys.stdin.read()")
MOST = 60.0  # s


def until(true: Callable[[], bool]) -> None:
    end = time.monotonic() + MOST
    while not true():
        assert time.monotonic() < end
        time.sleep(0.01)


def loaded(preloader: Preloader) -> Preloader:
    """The preloader after all of its work."""
    preloader.start()
    until(lambda: not preloader.busy)
    return preloader


@pytest.fixture
def prepared(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, str]]:
    """The arenas in the order of preparation, without the work."""
    done: list[tuple[str, str]] = []
    monkeypatch.setattr(arena_jobs, "read", lambda game, name: None)
    monkeypatch.setattr(arena_jobs, "prepare", lambda game, name: done.append((game, name)))
    return done


def test_every_arena_gets_ready_and_then_the_next_thing_begins(prepared: list[tuple[str, str]]) -> None:
    preloader, after = Preloader(), list[int]()
    preloader.on_done = lambda: after.append(len(prepared))
    assert preloader.ready("race", "classic"), "without the thread nothing is waited for"
    preloader.start()
    loaded(preloader)
    assert prepared == arena_jobs.every_arena()
    assert after == [len(prepared)]
    assert all(preloader.ready(*one) for one in prepared)


def test_the_engine_is_hashed_for_every_game_before_the_first_replay_is_saved(prepared: list[tuple[str, str]]) -> None:
    """Football has rules outside the engine, whose hash took 0.3 s at the end of the first match."""
    engine_hash._hash.cache_clear()
    loaded(Preloader())
    hashed = engine_hash._hash.cache_info().misses
    assert "football" in games()
    assert len({engine_hash.engine_hash(game) for game in games()}) == hashed == 2


def test_a_failing_preload_does_not_block_matches(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> list[tuple[str, str]]:
        raise MemoryError("no more")

    monkeypatch.setattr(arena_jobs, "every_arena", broken)
    preloader = loaded(Preloader())
    assert preloader.ready("race", "classic")


@pytest.mark.parametrize("error", [KeyError, SystemExit])
def test_a_game_that_fails_does_not_keep_the_others_waiting(
    prepared: list[tuple[str, str]], monkeypatch: pytest.MonkeyPatch, error: type[BaseException]
) -> None:
    def prepare(game: str, name: str) -> None:
        if game == "factory":
            raise error("a start")
        prepared.append((game, name))

    monkeypatch.setattr(arena_jobs, "prepare", prepare)
    preloader, after = Preloader(), list[int]()
    preloader.on_done = lambda: after.append(1)
    loaded(preloader)
    assert {"pitanks", "race"} <= {game for game, _ in prepared}
    assert after


def test_a_game_that_never_starts_does_not_keep_the_others_waiting(
    prepared: list[tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    def prepare(game: str, name: str) -> None:
        while game == "pitanks":
            pass
        prepared.append((game, name))

    monkeypatch.setattr(preload, "LOADING", 0.02)
    monkeypatch.setattr(arena_jobs, "every_arena", lambda: [("pitanks", "classic"), ("race", "classic")])
    monkeypatch.setattr(arena_jobs, "prepare", prepare)
    loaded(Preloader())
    assert prepared == [("race", "classic")]


def test_a_match_waits_on_its_page_until_its_arena_is_ready(arcade: Arcade) -> None:
    seats = LobbySeats("level3")
    seats.join(KEYS[0])
    seats.add_opponents()
    page = arcade.open(MatchSetupPage(arcade.context, "pitanks", seats))
    arcade.wait(1.0)

    class Busy(Preloader):
        done = False

        def ready(self, game: str, arena: str) -> bool:
            return self.done

    arcade.context.preloader = busy = Busy()
    arcade.press(Button.FIRE, Button.RIGHT)
    arcade.wait(0.5)
    assert arcade.stack.top is page, "nothing else can be chosen meanwhile"
    busy.done = True
    arcade.frame()
    assert isinstance(arcade.stack.top, MatchScene)
    assert isinstance(arcade.stack.top.setup, Setup)


@pytest.mark.skipif(not can_compile(), reason="numba is not installed")
@pytest.mark.parametrize("name", ["compiler", "network_compiler"])
def test_the_compilers_run_once_from_the_title_on_and_end_with_the_arcade(
    home: Path, prepared: list[tuple[str, str]], name: str
) -> None:
    with opened(Options(headless=True)) as app:
        background = app.context.shared(LabBackground)
        compiler: Compiler = getattr(background, name)
        background.compiler._command = background.network_compiler._command = ENDLESS
        app.compose(1 / 60)
        assert compiler.code is None
        assert compiler._process is None, "the first picture comes first"

        def started() -> bool:
            app.compose(1 / 60)
            return compiler._process is not None

        until(started)
        process = compiler._process
        assert process
        for _ in range(60):
            app.compose(1 / 60)
        assert compiler._process is process
        assert process.poll() is None
    assert process.poll() is not None


@pytest.mark.parametrize("simulated", [True, False], ids=["in simulated time", "with a match on top"])
def test_nothing_is_prepared_where_no_title_is_shown(home: Path, simulated: bool) -> None:
    def first(context: object) -> MatchSetupPage:
        seats = LobbySeats("level3")
        seats.join(KEYS[0])
        return MatchSetupPage(context, "pitanks", seats)  # type: ignore[arg-type]

    options = Options(headless=True, step=1 / 60) if simulated else Options(headless=True, first_scene=first)
    with opened(options) as app:
        for _ in range(30):
            app.compose(1 / 60)
        assert not app.context.preloader.busy
        assert app.context.shared(LabBackground).compiler._process is None


def test_a_compiler_that_was_ended_before_it_began_never_begins() -> None:
    compiler = Compiler(ENDLESS)
    compiler.end()
    compiler.start()
    assert compiler._process is None
