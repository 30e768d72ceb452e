"""Events that only `party` has, by comparing a race with its previous tick; read-only."""

from pigaming_app.games.race.state import NO_ITEM, Race
from pigaming_app.scenes.views.race.events import RaceEvent
from pigaming_app.sim.world import DT, HZ

AGAIN = HZ  # ticks out of a slipstream until a new one is reported
CLOSE = 0.5  # s between two finishes, up to which they are close


class PartyEventDetector:
    """Keeps the previous tick of one race."""

    def __init__(self, state: Race) -> None:
        self.seats = [i for i, robot in enumerate(state.robots) if robot.present]
        self.slipped = [-AGAIN] * len(state.racers)  # tick of the last slipstream of each seat
        self.final = False  # the leader's last lap was reported
        self._store(state)

    def detect(self, state: Race) -> list[RaceEvent]:
        """Events since the last call."""
        found = [event for seat in self.seats for event in self._racer(state, seat)]
        found += self._final_lap(state) + self._close_finish(state)
        self._store(state)
        return found

    def _store(self, state: Race) -> None:
        self.racers = [(r.item, r.shield, r.surge, r.spin, r.finished) for r in state.racers]

    def _racer(self, state: Race, seat: int) -> list[RaceEvent]:
        item, shield, surge, spin, _ = self.racers[seat]
        racer, found = state.racers[seat], []
        if racer.item != item:
            found.append(RaceEvent("item" if racer.item != NO_ITEM else "used", seat, racer.item or item))
        if racer.surge > surge:
            found.append(RaceEvent("boost", seat))
        if racer.spin > spin:
            found.append(RaceEvent("spin", seat))
        if shield > 1 and not racer.shield:
            found.append(RaceEvent("resisted", seat))
        if racer.slip:
            if state.tick - self.slipped[seat] >= AGAIN:
                found.append(RaceEvent("slip", seat))
            self.slipped[seat] = state.tick
        return found

    def _final_lap(self, state: Race) -> list[RaceEvent]:
        """The first robot to begin its last lap."""
        if self.final:
            return []
        laps = state.rules.laps - 1
        first = [seat for seat in self.seats if laps and state.robots[seat].score >= laps]
        self.final = bool(first)
        return [RaceEvent("final_lap", first[0])] if first else []

    def _close_finish(self, state: Race) -> list[RaceEvent]:
        """Each finisher close behind the one before it; the number is the difference, s."""
        found = []
        for seat in (seat for seat in self.seats if state.racers[seat].finished and not self.racers[seat][4]):
            time = state.racers[seat].finish
            earlier = [r.finish for i, r in enumerate(state.racers) if i != seat and r.finished and r.finish <= time]
            if earlier and (time - max(earlier)) * DT <= CLOSE:
                found.append(RaceEvent("close", seat, (time - max(earlier)) * DT))
        return found
