"""Match factory: simulated robots, or real ones on a mat."""

from collections.abc import Callable, Collection, Sequence

from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.ui.input.events import Device


def match_of(
    context: Context,
    setup: Setup,
    devices: Sequence[Device | None],
    real: Collection[int],
    speed: float = 1.0,
    game_choice: SceneFactory | None = None,
    rounds: Rounds | None = None,
    after: Callable[[MatchScene], AfterMatch] | None = None,
) -> Scene:
    """The match, or the page with the reason why the robots of the seats `real` are unavailable.

    `speed`: times real time, for a match without real robots. `game_choice`: see `Results`; `rounds` and `after`: see
    `MatchScene`.
    """
    real = [seat for seat in real if setup.seats[seat].brain != "off"]
    if real and context.mat:
        return context.mat.match(setup, devices, real, game_choice, rounds, after=after)
    return MatchScene(context, setup, devices, speed, game_choice=game_choice, rounds=rounds, after=after)
