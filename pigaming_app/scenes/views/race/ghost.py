"""Ghosts: the best lap by a person on each track, replayed beside the first person without collisions.

Only laps driven entirely by a person count, from their own line back to it; a faster one replaces the ghost.

A ghost is valid only if its lap is possible for the current robots: one recorded with another engine version is checked
against the rules, and dropped if it violates them. One file per track, named after it with a hash of its source, in
`ghosts` of the data folder:
{"engine": "…", "line": 0, "seconds": 11.32, "crossed": [0, 2.9, 5.6, 8.5], "poses": [[x, y, heading], …]}.
"""

import hashlib
import logging
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from threading import Thread
from typing import Annotated

from msgspec import Meta

from pigaming_app.games.engine_hash import engine_hash
from pigaming_app.games.race.course import CoursePosition, locate
from pigaming_app.games.race.state import LINES, Race, RaceRules
from pigaming_app.scenes.views.race.events import RaceEvent
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import DT
from pigaming_app.storage.parsing import parse_json
from pigaming_app.storage.safe_files import NotSaved, read_or_restore, write_with_backup
from pigaming_app.storage.schema import Line, between, to_json, to_plain, typed

RATE = 10.0  # poses per second
FOLDER = "ghosts"
LONGEST = 600.0  # s
FARTHEST = 10_000.0  # px from the centre, or rad
SLACK = 1.1  # tolerance: real robots may be slightly faster than the rules, and tracked poses jitter
NEAR = 50.0  # px along the track between a robot and the line it crosses
Coordinate = Annotated[float, between(-FARTHEST, FARTHEST)]
Pose = tuple[Coordinate, Coordinate, Coordinate]  # px, px, rad
log = logging.getLogger(__name__)
Delta = tuple[float, int]  # ticks, and the tick of measurement


@dataclass(frozen=True)
class Ghost:
    """A lap from line `line` to itself, RATE poses/s; `crossed`: time at each line in s, starting with 0."""

    line: Annotated[int, between(0, LINES - 1)]
    seconds: Annotated[float, between(1.0, LONGEST)]
    crossed: Annotated[tuple[float, ...], Meta(min_length=LINES, max_length=LINES)]
    poses: tuple[Pose, ...]

    def since(self, line: int, later: int) -> float:
        """Time in s between one line and the one `later` lines on, 0..LINES; LINES is a full lap."""
        if later == LINES:
            return self.seconds
        first, second = (line - self.line) % LINES, (line + later - self.line) % LINES
        return (self.crossed[second] - self.crossed[first]) % self.seconds

    def pose(self, line: int, seconds: float) -> Pose | None:
        """Pose `seconds` after crossing a line; None before the crossing and after the lap."""
        if not 0.0 <= seconds <= self.seconds:
            return None
        at = (self.crossed[(line - self.line) % LINES] + seconds) % self.seconds * RATE
        k = min(int(at), len(self.poses) - 1)
        after = k + 1 if k + 1 < len(self.poses) else 0
        return pose_between(self.poses[k], self.poses[after], min(1.0, at - k))


@dataclass(frozen=True)
class GhostFile:
    """What a file has beside the ghost."""

    engine: Line


def pose_between(a: Pose, b: Pose, share: float) -> Pose:
    """Interpolated pose, turning the short way."""
    turn = (b[2] - a[2] + math.pi) % math.tau - math.pi
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * turn


def ghost_of(line: int, seconds: float, crossed: Sequence[float], track: Sequence[tuple[float, Pose]]) -> Ghost:
    """Ghost from a recorded lap: samples (s since its start, pose) in order, from before its start to after its end."""
    poses, k = [], 0
    for i in range(int(seconds * RATE) + 1):
        at = i / RATE
        while k + 2 < len(track) and track[k + 1][0] < at:
            k += 1
        (before, a), (after, b) = track[k], track[k + 1]
        x, y, heading = pose_between(a, b, max(0.0, min(1.0, (at - before) / (after - before))))
        poses.append((round(x, 1), round(y, 1), round(heading, 3)))
    return Ghost(line, round(seconds, 4), tuple(round(time, 4) for time in crossed), tuple(poses))


# ---- files


def file_of(folder: Path, arena: Arena) -> Path:
    """File of a track's ghost; a different track of the same name has a different file, however many its laps."""
    track = re.sub(r"(?m)^laps = .*\n", "", arena.source)
    digest = hashlib.sha256(track.encode()).hexdigest()[:8]
    return folder / FOLDER / f"{arena.name}-{digest}.json"


def load_ghost(folder: Path, arena: Arena) -> tuple[Ghost | None, str]:
    """The ghost of a track, if any, and the reason if one was dropped: "old", "lost", else ""."""
    parsed, warnings = read_or_restore(file_of(folder, arena), _parsed)
    for line in warnings:
        log.warning("%s", line)
    if parsed is None:
        return None, "lost" if warnings else ""
    engine, ghost = parsed
    if drivable(ghost, arena) or engine == engine_hash():  # hashing the engine takes a tenth of a second
        return ghost, ""
    log.warning("%s: dropped; under the current rules no robot can drive this lap", file_of(folder, arena))
    return None, "old"


def drivable(ghost: Ghost, arena: Arena) -> bool:
    """True if a lap is no faster than the rules allow and crosses each line at the recorded time."""
    rules, course, place = RaceRules(), arena.plan.course, CoursePosition()
    length = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(ghost.poses))
    if length > SLACK * rules.speed * rules.turbo_factor * ghost.seconds:
        return False
    for later in range(LINES):
        line = (ghost.line + later) % LINES
        x, y, _ = ghost.pose(line, 0.0) or ghost.poses[0]
        locate(course, x, y, place)
        off = abs(place.along - arena.plan.lines[line])
        if min(off, course.length - off) > NEAR:
            return False
    return True


def save_ghost(folder: Path, arena: Arena, ghost: Ghost) -> Thread:
    """Save a ghost in the background, since an SD card may take a tenth of a second. Errors are logged."""
    text = to_json({"engine": engine_hash(), **to_plain(ghost)})

    def save() -> None:
        try:
            write_with_backup(file_of(folder, arena), text)
        except NotSaved as error:
            log.warning("%s", error)

    thread = Thread(target=save, name="ghost")
    thread.start()
    return thread


def delete_ghosts(folder: Path) -> None:
    """Delete all ghosts, together with the high scores. Raises OSError."""
    for path in (folder / FOLDER).glob("*.json*"):
        path.unlink(missing_ok=True)


def _parsed(text: str) -> tuple[str, Ghost]:
    """Parse a ghost file into engine hash and ghost. Raises ValueError."""
    plain = parse_json(text)
    engine, ghost = typed(plain, GhostFile).engine, typed(plain, Ghost)
    if len(ghost.poses) != int(ghost.seconds * RATE) + 1:
        raise ValueError("the lap is incomplete")
    if ghost.crossed[0] != 0.0 or any(not a < b for a, b in pairwise((*ghost.crossed, ghost.seconds))):
        raise ValueError("the lap does not cross the lines in order")
    return engine, ghost


class GhostRecorder:
    """The ghost of one track during a race. `drop_reason`: why the saved one was dropped, or ""."""

    def __init__(self, folder: Path, arena: Arena, players: Sequence[str]) -> None:
        self.folder, self.arena, self.players = folder, arena, players
        self.ghost, self.drop_reason = load_ghost(folder, arena)
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
        self.ghost = ghost_of(racer.line, racer.last_lap * DT, crossed, track)
        if self.writer:
            self.writer.join()
        self.writer = save_ghost(self.folder, self.arena, self.ghost)
        return True
