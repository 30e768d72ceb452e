"""Busy match of Robot Factory: full of pallets, and every countdown runs."""

from pigaming_app.games.factory.state import OUTPUT
from pigaming_app.scenes.bench.busy_drivers import BusyDrivers
from pigaming_app.sim.world import HZ


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


BUSY = BusyFactory
