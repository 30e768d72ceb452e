"""Rules of New Game: the coin lies somewhere on the floor. Who drives over it scores a point, and it lies elsewhere."""

from pigaming_app.api.rules import (
    ROBOTS,
    Arena,
    Setup,
    SimpleMatch,
    kernel,
    random_place,
    record,
    seat_robots,
    steer,
    stop_all,
)

REACH = 60.0  # px from the coin at which a robot takes it


@record
class NewGame(SimpleMatch):
    """The state of a match. Every number of it is compared, copied and replayed for you."""

    coin_x: float  # px
    coin_y: float


def start(match: NewGame, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match."""
    seat_robots(match, arena, setup)
    drop_coin(match)


@kernel
def judge(match: NewGame) -> None:
    """One tick: who is at the coin scores; everybody drives."""
    if match.over:
        stop_all(match)
        return
    for k in range(ROBOTS):
        robot = match.robots[k]
        if robot.present:
            dx, dy = robot.x - match.coin_x, robot.y - match.coin_y
            if dx * dx + dy * dy < REACH * REACH:
                robot.score += 1
                drop_coin(match)
            steer(match, k, 1.0)
    match.tick += 1
    if match.tick >= match.rules.ticks:
        match.over = 1


@kernel
def drop_coin(match: NewGame) -> None:
    """Put the coin where a robot can drive."""
    match.coin_x, match.coin_y = random_place(match)
