"""Ghost of a race: replays the best lap alongside the first person; a faster lap by any person replaces it.

Only laps driven entirely by a person count, from their own line back to it.
"""

from collections.abc import Sequence
from pathlib import Path
from threading import Thread

from pigaming_app.games.race.state import LINES, Race
from pigaming_app.scenes.views.race import ghost_files as ghosts
from pigaming_app.scenes.views.race.events import RaceEvent
from pigaming_app.scenes.views.race.ghost_files import Pose
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT

Delta = tuple[float, int]  # ticks, and the tick of measurement


class GhostRecorder:
    """The ghost of one track during a race. `drop_reason`: why the saved one was dropped, or ""."""

    def __init__(self, folder: Path, arena: Arena, players: Sequence[str]) -> None:
        self.folder, self.arena, self.players = folder, arena, players
        self.ghost, self.drop_reason = ghosts.load_ghost(folder, arena)
        self.samples: list[list[tuple[int, Pose]]] = [[] for _ in players]  # tick and pose, for each seat's current lap
        self.ghost_deltas: dict[int, Delta] = {}
        self.writer: Thread | None = None

    def watch(self, state: Race, events: Sequence[RaceEvent]) -> list[int]:
        """Record people's laps and compare them with the ghost; returns the seats with a new best lap ever."""
        new = []
        for seat in (event.seat for event in events if event.kind == "line" and self._person(event.seat)):
            self._compare(state, seat)
            if state.racers[seat].passed % LINES == 1:
                if self._best_ever(state, seat):
                    new.append(seat)
                del self.samples[seat][:-2]  # keep the two samples on either side of the line
        for seat, notes in enumerate(self.samples):
            robot = state.robots[seat]
            if not self._person(seat):
                notes.clear()
            elif robot.present and not state.racers[seat].finished:
                notes.append((state.tick, (robot.x, robot.y, robot.heading)))
        return new

    def pose(self, state: Race, blend: float) -> Pose | None:
        """Pose of the ghost, interpolated by `blend` between the last two ticks."""
        first = next((seat for seat in range(LINES) if self._person(seat) and state.robots[seat].present), None)
        if self.ghost is None or first is None or state.over:
            return None
        racer = state.racers[first]
        if not racer.passed or racer.finished:
            return None
        return self.ghost.pose(racer.line, (state.tick - 1 + blend - racer.lap_start) * DT)

    def _person(self, seat: int) -> bool:
        return self.players[seat] == "human"

    def _compare(self, state: Race, seat: int) -> None:
        """Compare the time since the racer's own line with the ghost's."""
        racer = state.racers[seat]
        later = (racer.passed - 1) % LINES
        if self.ghost and racer.passed > 1:
            ticks = racer.splits[later] if later else racer.last_lap
            self.ghost_deltas[seat] = ticks - self.ghost.since(racer.line, later or LINES) / DT, state.tick

    def _best_ever(self, state: Race, seat: int) -> bool:
        """Replace the ghost if the lap just completed is the best ever."""
        racer, notes = state.racers[seat], self.samples[seat]
        began = racer.lap_start - racer.last_lap
        whole = len(notes) > 1 and racer.last_lap == racer.best_lap > 0.0 and notes[0][0] <= began
        if not whole or (self.ghost and racer.last_lap * DT >= self.ghost.seconds):
            return False
        crossed = [split * DT for split in racer.best_splits]
        track = [((tick - began) * DT, pose) for tick, pose in notes]
        self.ghost = ghosts.ghost_of(racer.line, racer.last_lap * DT, crossed, track)
        if self.writer:
            self.writer.join()
        self.writer = ghosts.save_ghost(self.folder, self.arena, self.ghost)
        return True
