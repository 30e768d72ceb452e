"""A match of Robot Factory whose robots are placed by a test, with helpers for forks and pallets."""

from math import cos, sin

from pigaming_app.games.factory.state import IN_SLOT, INPUT, MAX_PALLETS, OUTPUT
from pigaming_app.games.match import Match
from tests.games.rails import Rails
from tests.matches import setup_of

OUT_OF_THE_WAY = (800.0, 450.0)


class Shop:
    """A match of Robot Factory on rails. Seats 0 and 2 are ICE's, 1 and 3 FIRE's; among allies all are ICE's."""

    def __init__(self, arena="hall", pallets=4, present=(0, 1, 2, 3), minutes=5.0, seed=1, variant="standard"):
        seats = ["idle" if i in present else "off" for i in range(4)]
        self.rails = Rails()
        self.match = Match(setup_of("factory", seats, arena, minutes, seed, variant, pallets), self.rails)
        for seat in range(4):
            self.match.sit(seat, Fire())
        self.state = self.match.state
        self.loads, self.slots, self.pallets = self.state.loads, self.state.slots, self.state.pallets

    def tick(self, times=1):
        for _ in range(times):
            self.match.tick()

    def own(self, team):
        """The pallets of a team that exist in the match."""
        return [p for p in range(team * MAX_PALLETS, (team + 1) * MAX_PALLETS) if self.pallets[p].exists]

    def slot(self, kind, team=-1, machine=-1, which=0):
        """Index of a slot: of a team's entry or exit, or of a machine's input or output."""
        them = [s for s, one in enumerate(self.slots) if (one.kind, one.team, one.machine) == (kind, team, machine)]
        return them[which]

    def input_of(self, makes, which=0):
        """The input slot of a machine of a kind."""
        them = [m for m, machine in enumerate(self.state.machines) if machine.kind == makes]
        return self.slot(INPUT, machine=them[which])

    def output_of(self, makes, which=0):
        """The output slot of a machine of a kind."""
        them = [m for m, machine in enumerate(self.state.machines) if machine.kind == makes]
        return self.slot(OUTPUT, machine=them[which])

    def stand(self, seat, s, off=0.0, heading=0.0):
        """Put the robot so that its fork is `off` px from slot s, from the next tick on."""
        fork, slot = self.state.rules.fork, self.slots[s]
        x, y = slot.x - fork * cos(heading), slot.y + off - fork * sin(heading)
        self.rails.poses[seat] = (x, y, heading)

    def press(self, seat, s, off=0.0):
        """Go to a slot, press fire for two ticks, release. True if that had an effect."""
        before = self.loads[seat].pallet
        self.stand(seat, s, off)
        self.match.brains[seat].fire = 1
        self.tick(2)
        self.match.brains[seat].fire = 0
        self.tick()
        return self.loads[seat].pallet != before

    def carry(self, seat, s, t):
        """Lift the pallet in slot s and put it into slot t; returns its index."""
        p = self.slots[s].pallet - 1
        assert self.press(seat, s), f"nothing to lift in slot {s}"
        assert self.press(seat, t), f"slot {t} does not take it"
        return p

    def give(self, p, state, s):
        """Put pallet p into slot s, in a state, as if it had been brought there."""
        pallet = self.pallets[p]
        if pallet.place == IN_SLOT:
            self.slots[pallet.at].pallet = 0
        pallet.state, pallet.place, pallet.at, pallet.waited = state, IN_SLOT, s, 0
        self.slots[s].pallet = p + 1

    def until(self, happened, seconds=60.0):
        """Tick until a condition holds; returns the number of ticks."""
        for k in range(round(seconds * 50)):
            if happened():
                return k
            self.tick()
        raise AssertionError("it did not happen")


class Fire:
    """A brain that stands still, with or without fire pressed."""

    fire = 0

    def think(self, state, seat):
        action = state.actions[seat]
        action.linear, action.angular, action.fire, action.turbo = 0.0, 0.0, self.fire, 0
