"""Runs the arcade without some packages: `python -m tests.features.without ROOM… -- WHAT…`.

The packages are refused by an import hook, as if their folders were not there. WHAT: a tour through the screens of the
core with the games whose matches are played, or jobs that end with the same exit code, each with its words.
"""

import importlib.abc
import os
import sys
from collections.abc import Callable, Sequence
from typing import Any


class Missing(importlib.abc.MetaPathFinder):
    """Refuses modules of these packages, by their full names."""

    def __init__(self, packages: Sequence[str]) -> None:
        self.packages = tuple(packages)

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> None:
        if any(f"{name}.".startswith(f"{package}.") for package in self.packages):
            raise ModuleNotFoundError(f"No module named '{name}'", name=name)


def tour(played: Sequence[str]) -> None:
    """Title with every tile, lobby and match to the results of some games, every row of the options, attract mode."""
    from pigaming_app.games.registry import games
    from pigaming_app.scenes.app import App
    from pigaming_app.scenes.features.registry import idle_page
    from pigaming_app.scenes.launch import Options
    from pigaming_app.scenes.lobby.match_setup import MatchSetupPage
    from pigaming_app.scenes.lobby.scene import Lobby
    from pigaming_app.scenes.options.page import SECTIONS, OptionsPage, added_rows, options_of
    from pigaming_app.scenes.play.scene import MatchScene
    from pigaming_app.scenes.results.scene import Results
    from pigaming_app.scenes.start import opened
    from pigaming_app.scenes.title.scene import Title
    from pigaming_app.ui.draw import glow
    from pigaming_app.ui.input.events import Button, Device, InputEvent

    glow.add_glow = lambda *_: (None for _ in "")  # it takes most of the time
    keys = Device("keys", 0)

    def top(app: App, kind: type) -> Any:
        """The scene on top, of this class, drawn once."""
        frames(app, 2)
        assert isinstance(app.stack.top, kind), type(app.stack.top)
        return app.stack.top

    def frames(app: App, count: int) -> None:
        for _ in range(count):
            app.compose(1 / 30)

    def until(app: App, reached: Callable[[], bool], most: int) -> None:
        while not reached():
            frames(app, 1)
            most -= 1
            assert most, type(app.stack.top)

    def press(app: App, button: Button, device: Device = keys) -> None:
        app.stack.apply(app.stack.top.handle(InputEvent(button, device)))

    def home(app: App) -> Any:
        app.stack.scenes[1:] = []
        app.stack.top.on_enter()
        return app.stack.top

    def open_tile(app: App, name: str) -> None:
        title = top(app, Title)
        title.focus.move_to(name)
        press(app, Button.FIRE)
        assert app.stack.top is not title, f"the tile {name} is dead"

    def play(app: App, game: str) -> None:
        open_tile(app, game)
        lobby = top(app, Lobby)
        press(app, Button.FIRE)
        press(app, Button.Y)
        press(app, Button.START)
        until(app, lambda: app.stack.top is not lobby, 300)
        top(app, MatchSetupPage)
        frames(app, 30)
        press(app, Button.FIRE)
        until(app, lambda: isinstance(app.stack.top, MatchScene), 300)
        match = top(app, MatchScene)
        until(app, lambda: match.match.state.tick > 30, 300)
        press(app, Button.START)
        frames(app, 2)
        assert app.stack.top is not match, "no pause"
        press(app, Button.START)
        match.stop()
        until(app, lambda: isinstance(app.stack.top, Results), 900)

    with opened(Options(headless=True, step=1 / 30)) as app:
        items = [spot.name for spot in top(app, Title).focus.spots if spot.name not in ("quit", "language")]
        print("tiles:", *items)
        for name in items:
            if name in played:
                play(app, name)
            else:
                open_tile(app, name)
                frames(app, 5)
            home(app)
        for section in ("", *SECTIONS):
            page = OptionsPage(app.context, section=section)
            for name in options_of(section):
                page.value(name)
                if name in added_rows():
                    app.stack.scenes.append(added_rows()[name].page(app.context))
                    app.stack.top.on_enter()
                    frames(app, 3)
                    home(app)
        cleared = OptionsPage(app.context, section="games")
        cleared.held()
        assert cleared.cleared
        attract: Any = idle_page(app.context)
        for make in [next(attract.shows) for _ in range(len(games()) * 3)] if attract else ():
            if show := make():
                show.on_enter()
                show.draw(app.context.canvas.screen)
    print("done")


def main() -> int:
    cut = sys.argv.index("--")
    sys.meta_path.insert(0, Missing([f"pigaming_app.{room}" for room in sys.argv[1:cut]]))
    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
    os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    what, *words = sys.argv[cut + 1 :]
    if what == "tour":
        tour(words)
        return 0
    from pigaming_app.jobs import cli

    (code,) = {cli.main(job.split()) for job in (what, *words)}
    return code


if __name__ == "__main__":
    sys.exit(main())
