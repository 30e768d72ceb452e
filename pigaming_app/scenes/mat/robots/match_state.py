"""The state of a match as plain values, for programs that watch it."""

from collections.abc import Sequence
from typing import Any

from pigaming_app.games.match import Match
from pigaming_app.hardware.control.safety import Fault


def match_state(match: Match, faults: Sequence[Fault], waiting: bool) -> dict[str, Any]:
    """Values for JSON. Lengths are arena px, y down; headings rad, clockwise; robots and seats count from 1."""
    state, setup = match.state, match.setup
    return {
        "game": setup.game,
        "variant": setup.variant,
        "arena": setup.arena,
        "tick": int(state.tick),
        "seconds": round(match.seconds, 2),
        "seconds_left": round(match.seconds_left, 2),
        "waiting": waiting,
        "over": match.over,
        "faults": [{"name": one.name, "robot": None if one.robot is None else one.robot + 1} for one in faults],
        "robots": [
            {
                "robot": seat + 1,
                "brain": setup.seats[seat].brain,
                "team": int(robot.team),
                "score": int(robot.score),
                "x": round(robot.x, 2),
                "y": round(robot.y, 2),
                "heading": round(robot.heading, 4),
            }
            for seat, robot in enumerate(state.robots)
            if robot.present
        ],
        "walls": [
            [round(number, 1) for number in (wall.ax, wall.ay, wall.bx, wall.by, wall.half)]
            for wall in state.walls[: state.wall_count]
            if wall.health
        ],
    }
