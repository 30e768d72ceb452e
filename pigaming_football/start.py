"""Robot Football: arena files, initial state of a match, its variants, and its statistics.

Besides walls, which are all solid, and starts (the 1st and 3rd of the left team, the others of the right), an arena has

[goal]
width = 260              # px, of both goals, in the middle of the left and right rim

[[drop]]                 # points at which the ball is dropped anew, the middle first; real things may cover some
at = [800, 450]
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import dist

from pigaming_app.games.game import PAIRS, Setup, Variant, named
from pigaming_app.games.simple import seat_robots
from pigaming_app.games.starts import clear_starts
from pigaming_app.sim.arena import Arena, Layout, build, read_starts, read_walls
from pigaming_app.sim.rng import seeded
from pigaming_app.sim.robot import RADIUS
from pigaming_app.sim.sweep import offset_from_wall
from pigaming_app.sim.things.spec import read_things
from pigaming_app.sim.toml_table import FieldError, TomlTable
from pigaming_app.sim.world import HEIGHT, HZ, ROBOTS, SOLID, WIDTH, World

from .rules import take_out
from .state import LEFT, MAX_DROPS, MIDDLE, RIGHT, Football, Rules

OVERTIME = 60.0  # s, at most
NARROWEST, WIDEST = 120.0, 500.0  # px, of a goal
FEWEST = ROBOTS + 2  # drop points: every robot covers at most one, and one is where the ball lies
APART = 2.0 * (RADIUS + Rules().radius) + 4.0  # px between drop points
VARIANTS = named(
    *(
        Variant(name, (2, 3, 5), minutes, team_mode=PAIRS, teams=(0, 1, 0, 1), overtime=overtime)
        for name, minutes, overtime in (("standard", 3, 0.0), ("cup", 3, OVERTIME), ("party", 2, OVERTIME))
    )
)


@dataclass(frozen=True)
class Pitch:
    """Goals and drop points of an arena: px."""

    mouth: float  # half the width of the goals
    drops: tuple[tuple[float, float], ...]


def read(table: TomlTable) -> Layout:
    """Parse an arena. Raises FieldError."""
    table.only("title", "start", "wall", "thing", "goal", "drop")
    walls = tuple(replace(wall, health=SOLID) for wall in read_walls(table))
    layout = Layout(walls, read_starts(table), things=read_things(table))
    goal = table.table("goal")
    goal.only("width")
    mouth = goal.number("width", None, NARROWEST, WIDEST, " px") / 2
    return replace(layout, starts=clear_starts(layout), plan=Pitch(mouth, _drops(table, layout)))


def _drops(table: TomlTable, layout: Layout) -> tuple[tuple[float, float], ...]:
    """The drop points that nothing covers. Raises FieldError."""
    points: list[tuple[float, float]] = []
    for entry in table.tables("drop"):
        entry.only("at")
        point = entry.point("at")
        if not _is_free(layout, *point, things=False):
            raise entry.error("at", f"a ball at ({point[0]:g}, {point[1]:g}) would lie in a wall")
        if any(dist(point, other) < APART for other in points):
            raise entry.error("at", f"nearer than {APART:g} px to another drop point")
        points.append(point)
    if not points or points[0] != (WIDTH / 2, MIDDLE):
        raise table.error("drop", f"the first must be at [{WIDTH / 2:g}, {MIDDLE:g}], the middle")
    free = tuple(point for point in points if _is_free(layout, *point, things=True))
    if not FEWEST <= len(free) <= len(points) <= MAX_DROPS:
        raise table.error("drop", f"{len(free)} free points, but {FEWEST} to {MAX_DROPS} are needed")
    return free


def _is_free(layout: Layout, x: float, y: float, things: bool) -> bool:
    """True if a ball lies free at (x, y)."""
    world, radius = World(), Rules().radius
    build(world, Arena("", {}, layout.walls, layout.starts, "", things=layout.things if things else ()))
    offsets = [(*offset_from_wall(wall, x, y), wall.half) for wall in world.walls[: world.wall_count]]
    return (
        radius <= x <= WIDTH - radius
        and radius <= y <= HEIGHT - radius
        and all(dx * dx + dy * dy >= (half + radius) ** 2 for dx, dy, half in offsets)
    )


def start(match: Football, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match: walls, goals, robots on their team's starts, rules, random seed, the ball in the middle."""
    seat_robots(match, arena, setup)
    pitch = arena.plan
    if not isinstance(pitch, Pitch):
        raise FieldError("goal", "a table is missing")
    match.random, match.rules, match.mouth = seeded(setup.seed), rules_of(setup), pitch.mouth
    match.drop_count = len(pitch.drops)
    for spot, (x, y) in zip(match.drops, pitch.drops, strict=False):
        spot.x, spot.y = x, y
    teams = [seat.team for seat in setup.seats]
    for i, k in enumerate(start_indices(teams, [bool(robot.present) for robot in match.robots])):
        robot, player, pose = match.robots[i], match.players[i], arena.starts[k]
        robot.x, robot.y, robot.heading = pose.x, pose.y, pose.heading
        player.last_x, player.last_y, player.armed = pose.x, pose.y, 1
    take_out(match, WIDTH / 2, MIDDLE, match.rules.warning, 0.0)


def start_indices(teams: Sequence[int], plays: Sequence[bool]) -> list[int]:
    """The start of each seat: 1st and 3rd for the left team, the others for the right; empty seats take the rest."""
    free = {LEFT: [0, 2], RIGHT: [1, 3]}
    sides = [LEFT if team % 2 == 0 else RIGHT for team in teams]
    taken = [free[side].pop(0) if on and free[side] else -1 for side, on in zip(sides, plays, strict=True)]
    left = sorted(free[LEFT] + free[RIGHT])
    return [k if k >= 0 else left.pop(0) for k in taken]


def rules_of(setup: Setup) -> Rules:
    """The rules of a match."""
    rules = Rules()
    rules.ticks = round(setup.minutes * 60 * HZ)
    rules.overtime = round(VARIANTS[setup.variant].overtime * HZ)
    if setup.variant == "party":
        rules.mass, rules.friction, rules.bounce, rules.robot_bounce = 0.85, 140.0, 0.9, 0.7
        rules.golden = 0.25
    return rules


def stats(match: Football, seat: int) -> Mapping[str, float]:
    """Statistics of a seat."""
    player = match.players[seat]
    return {"goals": player.goals, "assists": player.assists, "own_goals": player.own_goals, "shots": player.shots}
