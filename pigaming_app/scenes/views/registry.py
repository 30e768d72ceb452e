"""View class of each game."""

from collections.abc import Callable
from typing import Any

from pigaming_app.scenes.views.factory.view import FactoryView
from pigaming_app.scenes.views.pitanks.view import PiTanksView
from pigaming_app.scenes.views.race.view import RaceView
from pigaming_app.scenes.views.view import MatchView, ViewOptions
from pigaming_app.sim.arena import Arena
from pigaming_app.ui.i18n import Words

View = Callable[[Arena, Any, list[str], ViewOptions, Words | None], MatchView]

VIEWS: dict[str, View] = {"pitanks": PiTanksView, "factory": FactoryView, "race": RaceView}
