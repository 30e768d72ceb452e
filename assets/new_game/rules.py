"""Rules of New Game: the coin lies somewhere on the floor. Who drives over it scores a point, and it lies elsewhere."""

from typing import Any

from pigaming_app.api.rules import (
    CELL,
    COLUMNS,
    HEIGHT,
    HZ,
    ROBOTS,
    WIDTH,
    Arena,
    Rules,
    Setup,
    World,
    free_node,
    kernel,
    record,
    seat_robots,
    seeded,
    steer,
    stop_all,
    uniform,
)

REACH = 60.0  # px from the coin at which a robot takes it


@record
class NewGame(World):
    """The state of a match. Every number of it is compared, copied and replayed for you."""

    rules: Rules
    coin_x: float  # px
    coin_y: float


def rules_of(setup: Setup) -> Rules:
    """The rules of a match."""
    rules = Rules()
    rules.ticks = round(setup.minutes * 60 * HZ)
    return rules


def start(match: NewGame, arena: Arena, setup: Setup) -> None:
    """Fill a fresh match."""
    seat_robots(match, arena, setup)
    match.rules, match.random = rules_of(setup), seeded(setup.seed)
    drop_coin(match)


@kernel
def judge(match: Any) -> None:
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
def drop_coin(match: Any) -> None:
    """Put the coin where a robot can drive."""
    node = 0
    while node == 0:
        node = free_node(match, uniform(match) * WIDTH, uniform(match) * HEIGHT)
    match.coin_x, match.coin_y = node % COLUMNS * CELL, node // COLUMNS * CELL
