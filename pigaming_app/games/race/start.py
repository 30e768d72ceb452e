"""Robot Race: parsing of tracks, initial state of a match, and its statistics.

A track file has, besides its title:

[track]
lines = [0.2, 0.46, 0.71, 0.97]  # the four lines, in driving order, as fractions of a lap
laps = 4                 # optional, of a match unless others are chosen

[[corner]]               # of the centre line, in driving order; a lap begins at the start of the first arc
at = [112, 116]          # px
radius = 215             # px, of the arc that rounds it
width = 200              # px, of the course

Robots start beside the things that stand on the course. Tape that is a line, and lies across the course, moves the
nearest of the four lines to it.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from pigaming_app.games.game import ALONE, Setup, Variant
from pigaming_app.games.race.circuit import examined, read_corners, read_course, width_faults
from pigaming_app.games.race.course import POINTS, Course, half_width_at, locate, point_at, segment_at
from pigaming_app.games.race.furniture import (
    BEHIND,
    clear_pose,
    common_line,
    grid,
    pad_aside,
    place_boxes,
    place_pads,
    pose_at,
    separation,
    taped,
)
from pigaming_app.games.race.laps import progress
from pigaming_app.games.race.passages import Span, passages
from pigaming_app.games.race.racing_line import Line, line_round
from pigaming_app.games.race.state import LINES, MAX_LAPS, Race, RaceRules, TimingLine
from pigaming_app.games.starts import dealt, dealt_to_all
from pigaming_app.sim.arena import Arena, Layout, StartPose, build, raise_first, read_radius, start_faults
from pigaming_app.sim.record import copy
from pigaming_app.sim.rng import seeded
from pigaming_app.sim.things.cover import CoverPart
from pigaming_app.sim.things.spec import ThingSpec, read_things, wall_capsules
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import DT, HZ, WALLS

LAPS = RaceRules().laps  # the default goal
GOALS = tuple(range(1, MAX_LAPS + 1))
PARTY_LAPS = 5
PARTY_MUD = 0.5
VARIANTS = Variant.by_name(
    Variant("standard", (10,), 10, GOALS, LAPS, ALONE),
    Variant("draft", (10,), 10, GOALS, LAPS, ALONE),
    Variant("party", (10,), 10, GOALS, PARTY_LAPS, ALONE),
)
APART = 300.0  # px, least distance between two lines
LEEWAY = 400.0  # px by which tape moves a line, at most


@dataclass(frozen=True)
class TrackPlan:
    """A track: its course, and the positions of its lines, px along it; for `party` the common line and the rest."""

    course: Course
    lines: tuple[float, ...]
    common: int  # index of the line that is everybody's start and finish
    grid: tuple[StartPose, ...]
    pads: tuple[float, ...]  # px along the course
    boxes: tuple[tuple[float, float], ...]  # (along, aside) px
    solid: tuple[CoverPart, ...] = ()  # things that are walls


def read(table: TomlTable) -> Layout:
    """Parse a track: a course and four lines. Raises FieldError."""
    table.only("title", "track", "corner", "thing", "robots")
    course, things, radius = read_course(table), read_things(table), read_radius(table)
    raise_first(width_faults(course, radius))
    laps_of(table)
    lines = _lines(table.table("track"), course, taped(course, things))
    solid = tuple(wall_capsules(things, WALLS))
    spans = line_round(course, RaceRules().speed, RaceRules().turn_rate, solid, lines, radius)[1]
    starts = tuple(clear_pose(course, line - BEHIND, 0.0, spans) for line in lines)
    common, pads = common_line(course, lines), place_pads(course, lines)
    boxes = place_boxes(course, lines, pads, spans)
    plan = TrackPlan(course, lines, common, grid(course, lines[common], spans, radius), pads, boxes, solid)
    return Layout((), starts, plan, things, radius=radius)


def laps_of(table: TomlTable) -> int:
    """The laps of a match on a track unless others are chosen; 0: those of its rules. Raises FieldError."""
    return round(table.table("track").number("laps", 0.0, 0.0, float(MAX_LAPS)))


def _lines(table: TomlTable, course: Course, tapes: Sequence[float]) -> tuple[float, ...]:
    """Positions of the lines, px along the course, after each tape has moved the nearest one. Raises FieldError."""
    table.only("lines", "laps")
    shares = table.numbers("lines", LINES, 0.0, 1.0)
    gaps = [(shares[(i + 1) % LINES] - shares[i]) % 1.0 for i in range(LINES)]
    if 1.0 in shares:
        raise table.error("lines", "1 is the same place as 0, write 0")
    if abs(sum(gaps) - 1.0) > 1e-9:
        stray = next(
            (i for i in range(1, LINES) if (shares[i] - shares[0]) % 1.0 < (shares[i - 1] - shares[0]) % 1.0), 0
        )
        reason = "must lie in the order of the way round"
        raise FieldError("track.lines", reason, _line_place(course, shares[stray]))
    for i, gap in enumerate(gaps):
        if gap * course.length < APART:
            reason = f"{gap * course.length:.0f} px to the next, but at least {APART:g} px are needed"
            raise FieldError(f"track.lines[{i + 1}]", reason, _line_place(course, shares[i]))
    lines = [share * course.length for share in shares]
    for tape in tapes:
        moved = min(range(LINES), key=lambda i: separation(course, lines[i], tape))
        others = [line for i, line in enumerate(lines) if i != moved]
        if separation(course, lines[moved], tape) < LEEWAY and all(
            separation(course, other, tape) >= APART for other in others
        ):
            lines[moved] = tape
    return tuple(lines)


def _line_place(course: Course, share: float) -> tuple[float, float, float]:
    """Middle and half the width of a line across the course, px; `share`: of a lap."""
    along = share * course.length
    return *point_at(course, along, 0.0), half_width_at(course, *segment_at(course, along))


def faults(table: TomlTable) -> Iterator[FieldError]:
    """All that makes a track unplayable, as far as it can be found without the fastest line, which takes a second."""
    try:
        table.only("title", "track", "corner", "thing", "robots")
        laps_of(table)
        (course, found), things, radius = examined(read_corners(table)), read_things(table), read_radius(table)
        yield from found
        yield from width_faults(course, radius)
        lines = _lines(table.table("track"), course, taped(course, things) if not found else ())
        if solid := tuple(wall_capsules(things, WALLS)):
            passages(course, solid, [0.0] * POINTS, lines, radius)
        elif not found:
            starts = tuple(pose_at(course, line - BEHIND) for line in lines)
            yield from start_faults(Layout((), starts, radius=radius))
            grid(course, lines[common_line(course, lines)], (), radius)
    except FieldError as fault:
        yield fault


def start(match: Race, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match: course, lines, robots on the starts that the seed deals them, rules."""
    build(match, arena)
    track: TrackPlan = arena.plan
    match.course = copy(track.course)
    match.random = seeded(setup.seed)
    set_rules(match.rules, setup)
    _set_line(match, _line_of(arena, match.rules, track.solid))
    for line, along in zip(match.lines, track.lines, strict=True):
        _place_line(line, match.course, along)
    for robot, seat in zip(match.robots, setup.seats, strict=True):
        robot.present, robot.team = int(seat.brain != "off"), seat.team
    party = bool(match.rules.party)
    match.starts[:] = dealt(match) if party else dealt_to_all(match)
    for i, place in enumerate(match.starts):
        robot, racer, pose = match.robots[i], match.racers[i], (track.grid if party else arena.starts)[place]
        robot.x, robot.y, robot.heading = pose.x, pose.y, pose.heading
        racer.line = track.common if party else place
        locate(match.course, robot.x, robot.y, racer.place)
        racer.last_x, racer.last_y, racer.rank = robot.x, robot.y, (place if party else i) + 1
        racer.left = racer.place.along
        racer.progress = progress(match, i)
    if party or match.rules.draft:
        _place_pads(match, track)
    if party:
        _place_boxes(match, track)


def reroute(arena: Arena, rules: RaceRules, things: tuple[ThingSpec, ...]) -> Callable[[Race], None]:
    """The fastest line round things that were moved; see `games.game.Reroute`. Raises FieldError."""
    found = _line_of(arena, rules, tuple(wall_capsules(things, WALLS)))
    return lambda match: _set_line(match, found)


def _line_of(arena: Arena, rules: RaceRules, solid: tuple[CoverPart, ...]) -> tuple[Line, Sequence[Span]]:
    """The fastest line on an arena, round things, and the passages beside them. Raises FieldError."""
    track: TrackPlan = arena.plan
    return line_round(track.course, rules.speed, rules.turn_rate, solid, track.lines, arena.radius)


def _set_line(match: Race, found: tuple[Line, Sequence[Span]]) -> None:
    """Set the fastest line, and the passages beside things."""
    (ideal, pace), spans = found
    match.ideal[:], match.pace[:] = ideal, pace
    match.narrow = int(bool(spans))
    match.low[:], match.high[:] = zip(*spans, strict=True) if spans else ([0.0] * POINTS,) * 2


def _place_pads(match: Race, track: TrackPlan) -> None:
    """Put boost pads on the course."""
    for pad, along in zip(match.pads, track.pads, strict=True):
        k, _ = segment_at(track.course, along)
        aside = pad_aside(track.course, along, match.ideal[k])
        aside = min(max(aside, match.low[k]), match.high[k]) if match.narrow else aside
        pose = pose_at(track.course, along, aside)
        pad.x, pad.y, pad.heading, pad.along, pad.aside = pose.x, pose.y, pose.heading, along, aside


def _place_boxes(match: Race, track: TrackPlan) -> None:
    """Put item boxes on the course."""
    for box, (along, aside) in zip(match.boxes, track.boxes, strict=True):
        box.x, box.y = point_at(track.course, along, aside)
        box.along, box.aside = along, aside


def _place_line(line: TimingLine, course: Course, along: float) -> None:
    """Place a line across the course at `along` px, from edge to edge."""
    half = half_width_at(course, *segment_at(course, along))
    line.along = along
    line.ax, line.ay = point_at(course, along, -half)
    line.bx, line.by = point_at(course, along, half)


def rules_of(setup: Setup) -> RaceRules:
    """The rules of a match."""
    rules = RaceRules()
    set_rules(rules, setup)
    return rules


def set_rules(rules: RaceRules, setup: Setup) -> None:
    """Adapt fresh rules to a setup. `party`: a common start, and half the speed in mud instead of a third."""
    rules.ticks = round(setup.minutes * 60 * HZ)
    rules.laps = setup.goal or rules.laps
    rules.draft = int(setup.variant == "draft")
    if setup.variant == "party":
        rules.party, rules.mud = 1, PARTY_MUD


def ranking_key(match: Race, seat: int) -> float:
    """Finishers first, by time; then by progress."""
    racer = match.racers[seat]
    return 1e9 - racer.finish if racer.finished else racer.progress


def stats(match: Race, seat: int) -> Mapping[str, float]:
    """Statistics of a seat: laps, best lap and whole race in s, 0 if there is none."""
    racer = match.racers[seat]
    return {"laps": match.robots[seat].score, "best": racer.best_lap * DT, "total": racer.finish * DT}


def records(match: Race, seat: int) -> Mapping[str, int]:
    """Best lap, and the race if finished, in ms."""
    racer = match.racers[seat]
    done = {"lap": racer.best_lap, "race": racer.finish}
    return {name: round(1000 * DT * ticks) for name, ticks in done.items() if ticks > 0.0}


def times(match: Race, seat: int) -> tuple[float, ...]:
    """Lap times, in s."""
    return tuple(lap * DT for lap in match.racers[seat].laps[: match.robots[seat].score])
