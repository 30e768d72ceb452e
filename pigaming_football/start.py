"""Robot Football: initial state of a match, its variants, and its statistics."""

from collections.abc import Mapping

from pigaming_app.api import Variant
from pigaming_app.api.arenas import FieldError
from pigaming_app.api.rules import HZ, WIDTH, Arena, Setup, dealt_to_teams, seat_robots

from .pitch import Pitch
from .rules import take_out
from .state import MIDDLE, Football, Rules

OVERTIME = 60.0  # s, at most
VARIANTS = Variant.by_name(
    *(
        Variant(name, (2, 3, 5), minutes, team_mode="pairs", teams=(0, 1, 0, 1), overtime=OVERTIME)
        for name, minutes in (("standard", 3), ("cup", 3), ("party", 2))
    )
)


def start(match: Football, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match: walls, goals, robots on their team's starts, rules, random seed, the ball in the middle."""
    seat_robots(match, arena, setup, dealt_to_teams)
    pitch = arena.plan
    if not isinstance(pitch, Pitch):
        raise FieldError("goal", "a table is missing")
    match.rules, match.mouth = rules_of(setup), pitch.mouth
    match.drop_count = len(pitch.drops)
    for spot, (x, y) in zip(match.drops, pitch.drops, strict=False):
        spot.x, spot.y = x, y
    for robot, player in zip(match.robots, match.players, strict=True):
        player.last_x, player.last_y, player.armed = robot.x, robot.y, 1
    take_out(match, WIDTH / 2, MIDDLE, match.rules.warning, 0.0)


def rules_of(setup: Setup) -> Rules:
    """The rules of a match."""
    rules = Rules()
    rules.ticks = round(setup.minutes * 60 * HZ)
    rules.overtime = round(VARIANTS[setup.variant].overtime * HZ)
    if setup.variant == "cup":
        rules.catch_up = 1
    elif setup.variant == "party":
        rules.mass, rules.friction, rules.bounce, rules.robot_bounce = 0.85, 140.0, 0.9, 0.7
        rules.golden = 0.25
    return rules


def stats(match: Football, seat: int) -> Mapping[str, float]:
    """Statistics of a seat."""
    player = match.players[seat]
    return {"goals": player.goals, "assists": player.assists, "own_goals": player.own_goals, "shots": player.shots}
