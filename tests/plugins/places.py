"""A walk through all places at which a game appears, with a plug-in: `python3 -m tests.plugins.places GAME FOLDER`.

In a process of its own, since games are found once. FOLDER takes the files that it makes.
"""

import contextlib
import io
import json
import sys
from pathlib import Path
from typing import Any

from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.jobs.cli import main


def job(*words: object) -> str:
    """Run a job in this process. Returns what it prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        code = main([str(word) for word in words])
    assert code == 0, (words, out.getvalue())
    return out.getvalue()


def matches(game: str, folder: Path) -> None:
    """Duel, league, replay, event, and real robots in an emulated arena."""
    few = ("--matches", 2, "--minutes", 0.05)
    assert json.loads(job("duel", game, "level5", "idle", *few, "--json"))["game"] == game
    assert "random" in job("league", game, "level5", "random", *few)
    job("play", game, "--headless", "--minutes", 0.1, "--seats", "level5,level1", "--record", folder / "one.replay")
    assert "plays out the same" in job("replay", folder / "one.replay", "--verify")
    entrants = ("--entrants", "A=level5,B=level1,C=idle", "--format", "roundrobin", "--minutes", 0.05)
    job("event", "new", folder / "one.event", "--game", f"{game},race", *entrants)
    assert "A" in job("event", "run", folder / "one.event", "--headless")
    robots = ("--emulate", 1, "--real", "1,2", "--seats", "level5,level1", "--minutes", 0.05)
    assert json.loads(job("play", game, "--headless", *robots, "--json"))["game"] == game


def learning(game: str) -> None:
    """Environments of Gymnasium and PettingZoo, and a task for `train ppo`."""
    import gymnasium

    import pigaming_app.gym
    from pigaming_app.ai.networks.registry import ENCODINGS
    from pigaming_app.ai.ppo.registry import TASKS

    assert TASKS[game].encoding is ENCODINGS[game]
    one: Any = gymnasium.make(f"{game.title()}-v0", compiled=False)
    seen, _ = one.reset(seed=1)
    assert seen.shape == (ENCODINGS[game].size,)
    one.step(one.action_space.sample())
    many = pigaming_app.gym.parallel_env(game, compiled=False)
    many.reset(seed=1)
    many.step({agent: many.action_space(agent).sample() for agent in many.agents})


def screens(game: str) -> None:
    """Title, lobby, match with thoughts, how to play, attract mode, options, editor, events."""
    import pygame

    pygame.display.init()
    pygame.display.set_mode((1920, 1080))
    from pigaming_app.scenes.attract.scene import Attract
    from pigaming_app.scenes.editor.gallery.page import Gallery
    from pigaming_app.scenes.events.setup.draft import Draft
    from pigaming_app.scenes.ladder.strengths import Strengths
    from pigaming_app.scenes.lobby.scene import Lobby
    from pigaming_app.scenes.options.games_page import GamesPage
    from pigaming_app.scenes.play.scene import MatchScene
    from pigaming_app.scenes.title.scene import Title
    from pigaming_app.ui.input.controls import Controls
    from pigaming_app.ui.input.events import Button
    from tests.scenes.arcade import KEYS, Arcade

    arcade = Arcade(Controls())
    arcade.stack.scenes[:] = []
    arcade.open(Title(arcade.context))
    for _ in games():
        if arcade.shown(Title).focus.name != game:
            arcade.press(Button.RIGHT)
            arcade.wait(0.4)
    arcade.press(Button.FIRE)
    assert arcade.shown(Lobby).game == game
    one, two, three, four = (Seat("level5" if seat else "human", seat) for seat in range(4))
    setup = Setup(game, "classic", (one, two, three, four), 1.0, 3, games()[game].default.name)
    arcade.open(MatchScene(arcade.context, setup, [KEYS[0], None, None, None]))
    for _ in range(3):
        arcade.press(Button.BRAIN)
        arcade.wait(2.0, draw=True)
    assert game in Draft().options("game")
    assert Gallery(arcade.context, game).game == game
    for scene in (Strengths(arcade.context, game), GamesPage(arcade.context), Gallery(arcade.context, game)):
        arcade.open(scene)
        arcade.wait(0.2, draw=True)
    arcade.open(Attract(arcade.context))
    show = arcade.shown(Attract)
    for _ in range(3 * len(games())):
        show._next()
        arcade.wait(0.3, draw=True)


if __name__ == "__main__":
    from pigaming_app.ui.draw import glow

    glow.add_glow = lambda *_: (None for _ in "")  # it takes most of the time
    name, place = sys.argv[1], Path(sys.argv[2])
    matches(name, place)
    learning(name)
    screens(name)
    print("all places")
