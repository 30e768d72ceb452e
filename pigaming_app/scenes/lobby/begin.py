"""From the seats of a lobby to the match."""

from pigaming_app.games.game import Game, Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.auto import AutoStrengths
from pigaming_app.scenes.flow.scene import Context, Push, StackOperation
from pigaming_app.scenes.lobby.seats import LobbySeats
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.storage.settings import Choice


def chosen_setup(context: Context, game: Game, chosen: Choice, seats: LobbySeats, seed: int) -> Setup:
    """The match of these seats with the chosen arena and rules; Auto has the strength that suits the people."""
    minutes = float(minutes_of(game, chosen))
    setup = Setup(game.name, chosen.arena, seats.seats(), minutes, seed, chosen.variant, chosen.goal)
    return context.shared(AutoStrengths).resolved(setup, seats.devices())


def minutes_of(game: Game, chosen: Choice) -> int:
    """The minutes of the match, or of one of its rounds."""
    return chosen.minutes if chosen.rounds == 1 else game.round_minutes


def begin(
    context: Context, setup: Setup, rounds: int, seats: LobbySeats, game_choice: SceneFactory | None = None
) -> StackOperation:
    """Push the match of `rounds` rounds, or return None while the preloader is busy. `game_choice`: see `Results`."""
    from pigaming_app.scenes.play.scene import match_of

    if not context.preloader.ready(setup.game, setup.arena):
        return None
    several = Rounds(rounds) if rounds > 1 else None
    return Push(match_of(context, setup, seats.devices(), seats.real(), game_choice=game_choice, rounds=several))
