"""Busy matches of four AIs, for games whose numbers all change by themselves."""

from pigaming_app.ai.registry import new_match
from pigaming_app.games.arenas import arenas
from pigaming_app.games.factory.state import OUTPUT
from pigaming_app.games.game import Seat, Setup
from pigaming_app.games.registry import games
from pigaming_app.sim.world import HZ


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


class BusyFactory(BusyDrivers):
    """Factory match with as many pallets as possible. One robot is always frozen, every output counts down, and in
    party every second order is a rush order.
    """

    def __init__(self, variant: str) -> None:
        super().__init__("factory", variant)

    def tick(self) -> None:
        super().tick()
        state = self.state
        frozen = state.loads[3]
        frozen.frozen = frozen.frozen or state.rules.freeze
        for slot in state.slots[: state.slot_count]:
            if slot.pallet and slot.kind == OUTPUT:
                pallet = state.pallets[slot.pallet - 1]
                pallet.waited = max(pallet.waited, state.rules.collect - 10 * HZ)
        if state.rules.party:
            for pallet in state.pallets[::2]:
                pallet.rush = pallet.rush or int(pallet.exists) * state.rules.rush
