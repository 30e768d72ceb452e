"""What the hand-written footballer thinks, for display."""

from collections.abc import Iterator
from typing import Any

from pigaming_app.api.brains import Percept, Thoughts
from pigaming_app.api.rules import HEIGHT, WIDTH

from ..observation import OWN, from_left, polar
from ..rules import side_of
from ..state import LEFT, MIDDLE, Football
from .footballer import STUCK_TICKS
from .mind import CHASER, KEEPER, SUPPORTER, Mind

FAR = 1200.0  # px
BEHAVIOURS = ("football_chase", "football_keep", "football_support")  # by role
REASONS = ("football_nearest", "football_goal", "football_open")


def explain(match: Football, seat: int, mind: Mind, weights: Any) -> Thoughts:
    """Its role and reason, the ball as it believes it to be, and where it can meet it."""
    obs = mind.obs
    if not obs.turn_rate:
        return Thoughts("starts")
    behaviour, reason = BEHAVIOURS[mind.role], REASONS[mind.role]
    if mind.freeing:
        behaviour, reason = "free", "stuck"
    elif obs.held == OWN:
        behaviour, reason = "football_aim", "football_has_it"
    return Thoughts(
        behaviour,
        reason,
        facts={
            "role": mind.role,
            "ball_distance": obs.ball_distance,
            "charge": obs.charge,
            "lead": obs.lead,
            "stuck_ticks": mind.stuck_ticks,
        },
        percepts=tuple(_percepts(match, seat, mind)),
        bearing=obs.goal_bearing if obs.held == OWN else polar(obs, mind.meet_x, mind.meet_y)[1],
        utilities={
            "football_chase": max(0.0, 1.0 - obs.ball_distance / FAR) if mind.role != CHASER else 1.0,
            "football_keep": max(0.0, 1.0 - mind.seen_x / WIDTH) if mind.role != KEEPER else 1.0,
            "football_support": 1.0 if mind.role == SUPPORTER else 0.0,
            "football_aim": 1.0 if obs.held == OWN else 0.0,
            "free": 1.0 if mind.freeing else min(1.0, mind.stuck_ticks / STUCK_TICKS),
        },
        chosen=behaviour,
    )


def _percepts(match: Football, seat: int, mind: Mind) -> Iterator[Percept]:
    """The ball, where it will be met, the goal, and the other robots."""
    sign = 1.0 if side_of(match.robots[seat]) == LEFT else -1.0

    def at(x: float, y: float) -> tuple[float, float]:
        return from_left(x, WIDTH, sign), from_left(y, HEIGHT, sign)

    for other in mind.obs.others:
        if other.present:
            yield Percept("mate" if other.mate else "opponent", *at(other.x, other.y))
    if mind.obs.held == OWN:
        yield Percept("goal", *at(WIDTH, MIDDLE))
    else:
        yield Percept("goal", *at(mind.meet_x, mind.meet_y))
