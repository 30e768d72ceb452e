"""Busy matches of four AIs, for games whose numbers all change by themselves."""

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games


class BusyDrivers:
    """A match of frantic drivers with the highest goal."""

    def __init__(self, game: str, variant: str) -> None:
        rules = games()[game].variants[variant]
        one, two, three, four = (Seat("level5", team) for team in rules.teams)
        goal = max(rules.goals, default=0)
        setup = Setup(game, arenas(game)[0], (one, two, three, four), 8.0, 1, variant, goal)
        self.match = new_match(setup)
        self.arena, self.state = self.match.arena, self.match.state

    def tick(self) -> None:
        self.match.tick()
