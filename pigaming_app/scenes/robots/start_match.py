"""Match factory: simulated robots, real robots among the things on the mat, or a page with the reason why not."""

import logging
from collections.abc import Callable, Collection, Sequence
from functools import partial

from pigaming_app.games.arenas import load, with_things
from pigaming_app.games.game import Setup
from pigaming_app.games.rounds import Rounds
from pigaming_app.hardware.session.robot_session import RobotsUnavailable
from pigaming_app.scenes.flow.context import Context
from pigaming_app.scenes.flow.stack import Scene
from pigaming_app.scenes.play.scene import MatchScene
from pigaming_app.scenes.results.scene import SceneFactory
from pigaming_app.scenes.results.winner import AfterMatch
from pigaming_app.sim.arena import ArenaError
from pigaming_app.sim.things.spec import ThingSpec
from pigaming_app.ui.i18n import english
from pigaming_app.ui.input.events import Device

log = logging.getLogger("pigaming")


def match_of(
    context: Context,
    setup: Setup,
    devices: Sequence[Device | None],
    real: Collection[int],
    speed: float = 1.0,
    game_choice: SceneFactory | None = None,
    rounds: Rounds | None = None,
    things: Sequence[ThingSpec] | None = None,
    after: Callable[[MatchScene], AfterMatch] | None = None,
) -> Scene:
    """The match, or the page with the reason why the robots of the seats `real`, or the arena, are unavailable.

    `things`: those on the mat, for a match with real robots; None: as they were scanned last, unless they are blocks.
    `speed`: times real time, for a match without real robots. `game_choice`: see `Results`; `rounds` and `after`: see
    `MatchScene`.
    """
    real = [seat for seat in real if setup.seats[seat].brain != "off"]
    if not real or context.session is None:
        return MatchScene(context, setup, devices, speed, game_choice=game_choice, rounds=rounds, after=after)
    from pigaming_app.hardware.session.things_on_mat import things_in_play
    from pigaming_app.scenes.robots.match_scene import RealMatch
    from pigaming_app.scenes.robots.unavailable import UnavailablePage
    from pigaming_app.scenes.things.unplayable_page import UnplayablePage

    again = partial(match_of, context, game_choice=game_choice, after=after)
    try:
        if things is None:
            things = () if context.settings.blocks else things_in_play(context.session)
        arena = with_things(setup.game, load(setup.game, setup.arena), things) if things else None
        return RealMatch(context, setup, devices, real, context.session, again, game_choice, rounds, arena, after)
    except ArenaError as error:
        log.warning("%s", error)
        anew = partial(again, setup, devices, real, rounds=rounds)
        return UnplayablePage(context, setup, devices, anew, partial(anew, things=()))
    except RobotsUnavailable as error:
        log.warning("%s", english().long_sentence(error.message))
        return UnavailablePage(context, setup, devices, real, error.message, partial(again, rounds=rounds))
