"""The parts of a game with walls, robots and points, which other games replace by their own."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import atan2, sqrt
from typing import TYPE_CHECKING, Annotated, Any

from pigaming_app.games.starts import clear_starts, dealt, take_starts
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.arena import Arena, Layout, build, read_floor, read_radius, read_starts, read_walls
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import seeded
from pigaming_app.sim.robot import use_turbo
from pigaming_app.sim.things.mud import SLOW, in_mud
from pigaming_app.sim.things.spec import read_things
from pigaming_app.sim.toml_table import TomlTable
from pigaming_app.sim.world import HZ, ROBOTS, SOLID, World

OTHERS = ROBOTS - 1


@record
class MatchRules:
    """The rules of any match."""

    ticks: int  # of the regular time
    if TYPE_CHECKING:
        turn_rate: float  # rad/s; each game has its own place for it


@record
class Rules(MatchRules):
    """The rules of a simple game. Distances in px, times in ticks."""

    speed: float = 260.0
    turn_rate: float = 3.0  # rad/s
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)


@record
class MatchState(World):
    """A match of any game, up to the fields that a game adds."""

    rules: MatchRules
    starts: Annotated[list[int], ROBOTS]  # index of the start on which each seat began


@record
class SimpleMatch(MatchState):
    """A match with the rules of a simple game, or with ones derived from them."""

    rules: Rules


@record
class Senses:
    """Parameters of an observation: none."""

    nothing: int


@record
class Other:
    """Another robot, in seat order after the own seat."""

    present: int
    mate: int
    x: float
    y: float
    distance: float
    bearing: float  # relative to the own heading, rad, clockwise positive


@record
class Observation:
    """The observation of one seat: the own pose and the other robots, px and rad."""

    x: float
    y: float
    heading: float
    others: Annotated[list[Other], OTHERS]


def read(table: TomlTable) -> Layout:
    """Parse an arena: walls and starts. Raises FieldError."""
    return read_layout(table)


def read_layout(table: TomlTable, *own: str, solid: bool = False) -> Layout:
    """Walls, starts, things and floor of an arena file, no plan. Raises FieldError, and for a table of another name.

    `own`: names of the game's own tables. `solid`: no wall can be broken. Starts that things cover move beside them.
    """
    table.only("title", "floor", "start", "wall", "thing", "robots", *own)
    walls = tuple(replace(wall, health=SOLID) if solid else wall for wall in read_walls(table))
    layout = Layout(walls, read_starts(table), None, read_things(table), read_floor(table), read_radius(table))
    return replace(layout, starts=clear_starts(layout))


def rules_of(setup: Any) -> Rules:
    """The rules of a match: its time limit."""
    rules = Rules()
    rules.ticks = round(setup.minutes * 60 * HZ)
    return rules


def seat_robots(
    match: MatchState, arena: Arena, setup: Any, deal: Callable[[MatchState], Sequence[int]] = dealt
) -> None:
    """Fill a fresh match: arena, robots on their starts, the generator's seed, the time limit.

    `deal`: the start of each seat: `dealt` at random, or `dealt_to_teams`.
    """
    match.random, match.rules.ticks = seeded(setup.seed), round(setup.minutes * 60 * HZ)
    build(match, arena)
    for robot, seat in zip(match.robots, setup.seats, strict=True):
        robot.present = int(seat.brain != "off")
        robot.team = seat.team
    take_starts(match, arena, deal(match))


@kernel
def steer(match: SimpleMatch, k: int, factor: float) -> None:
    """Request the speeds of robot k from its stick and turbo; `factor`: of its speed."""
    rules, robot, action = match.rules, match.robots[k], match.actions[k]
    use_turbo(robot, action.turbo, rules.turbo_drain, rules.turbo_refill)
    speed = rules.speed * factor * (rules.turbo_factor if robot.boosting else 1.0)
    if match.mud_count and in_mud(match, robot.x, robot.y):
        speed *= SLOW
    robot.requested_linear = action.linear * speed
    robot.requested_angular = action.angular * rules.turn_rate


@kernel
def observe(match: MatchState, seat: int, senses: Senses, obs: Observation) -> None:
    """Fill in the observation of one seat."""
    robot = match.robots[seat]
    obs.x, obs.y, obs.heading = robot.x, robot.y, robot.heading
    for i in range(OTHERS):
        seen, other = match.robots[(seat + 1 + i) % ROBOTS], obs.others[i]
        other.present, other.mate = seen.present, 1 if seen.team == robot.team else 0
        other.x, other.y = seen.x, seen.y
        dx, dy = seen.x - robot.x, seen.y - robot.y
        other.distance, other.bearing = sqrt(dx * dx + dy * dy), turn_to(atan2(dy, dx) - robot.heading)


def team_points(match: MatchState, seat: int) -> float:
    """Ranking key: the points of a seat's team."""
    team = match.robots[seat].team
    return float(sum(robot.score for robot in match.robots if robot.present and robot.team == team))


def no_stats(match: MatchState, seat: int) -> Mapping[str, float]:
    """No statistics."""
    return {}


def own_points(match: MatchState, seat: int) -> Mapping[str, int]:
    """The record `points`: the seat's own."""
    return {"points": match.robots[seat].score}


def no_times(match: MatchState, seat: int) -> tuple[float, ...]:
    """No times: the game has no stages."""
    return ()
