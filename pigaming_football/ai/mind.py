"""Memory and senses of the hand-written footballer, and its prediction of the ball."""

from math import sqrt

from pigaming_app.api.brains import Route
from pigaming_app.api.rules import HEIGHT, RADIUS, WIDTH, kernel, record, uniform

from ..observation import Observation
from ..state import Rules

PERIOD = 5  # ticks between decisions: 10 Hz
NEW_ERROR = 30  # ticks between draws of the aiming error
FRICTION, BALL = Rules().friction, Rules().radius  # px/s^2, px: of the standard ball, for predictions
FULL_SPEED, TURN_RATE = 260.0, 3.0  # px/s, rad/s
MOMENTS, MOMENT = 16, 0.15  # points in time to which the ball is predicted, and s between them
CHASER, KEEPER, SUPPORTER = range(3)


@record
class Mind:
    """Memory, and the handicaps of its level."""

    obs: Observation
    route: Route
    speed: float  # share of the full stick, 0..1
    reaction: float  # ticks between looks at the ball
    error: float  # standard deviation of its aim, rad
    turbo: int  # 1: it uses the turbo
    plays: int  # 1: it plays together: passes, and one stays back
    haste: float  # share of the time in which it is hasty: goes straight at the ball, and shoots wherever it looks
    hasty: int  # 1: now
    random: int
    phase: int  # tick of its decisions, of PERIOD
    role: int
    look: int  # ticks until the next look
    seen_x: float  # where it believes the ball to be: px and px/s, in its team's frame
    seen_y: float
    seen_vx: float
    seen_vy: float
    meet_x: float  # where it can meet the ball
    meet_y: float
    side: float  # on which it goes round the ball, 1 or -1; 0: it does not
    held: int  # ticks for which it has held the ball
    bias: float  # present aiming error, rad
    bias_left: int  # ticks until the next draw
    anchor_x: float  # for `unstick`
    anchor_y: float
    stuck_ticks: int
    escape: float
    escape_turn: float
    since: int
    freeing: int  # 1: it is backing out
    touch: float = RADIUS + BALL  # px between the centres of a robot and the ball that it touches


@kernel
def notice(mind: Mind) -> None:
    """Look at the ball every `reaction` ticks, and believe that it rolls on in between; draw aiming errors."""
    obs, step = mind.obs, PERIOD / 50.0
    mind.look -= PERIOD
    if mind.look <= 0 or obs.ball_out > 0.0 or obs.held:
        mind.look = int(mind.reaction)
        mind.seen_x, mind.seen_y, mind.seen_vx, mind.seen_vy = obs.ball_x, obs.ball_y, obs.ball_vx, obs.ball_vy
    else:
        mind.seen_x = min(max(mind.seen_x + mind.seen_vx * step, BALL), WIDTH - BALL)
        mind.seen_y = min(max(mind.seen_y + mind.seen_vy * step, BALL), HEIGHT - BALL)
    mind.bias_left -= PERIOD
    if mind.bias_left <= 0:
        mind.bias_left = NEW_ERROR
        mind.bias = 2.0 * mind.error * (uniform(mind) + uniform(mind) + uniform(mind) - 1.5)
        mind.hasty = 1 if mind.haste > 0.0 and uniform(mind) < mind.haste and is_opposed(obs) else 0
    mind.held = mind.held + PERIOD if obs.held == 1 else 0


@kernel
def is_opposed(obs: Observation) -> bool:
    """True with an opponent on the pitch: without one nobody is in a hurry."""
    opponents = 0
    for i in range(3):
        opponents += 1 if obs.others[i].present and not obs.others[i].mate else 0
    return opponents > 0


@kernel
def time_to_meet(mind: Mind, x: float, y: float, turn: float) -> float:
    """Seconds until a robot at (x, y), `turn` rad off the ball, can touch the rolling ball; sets where.

    The first of MOMENTS at which it is there no later than the ball; the ball is reflected by the rim.
    """
    speed = sqrt(mind.seen_vx * mind.seen_vx + mind.seen_vy * mind.seen_vy)
    after, turning, rest = 0.0, 0.5 * abs(turn) / TURN_RATE, speed / FRICTION
    for i in range(MOMENTS + 1):
        t = i * MOMENT
        rolled = t if t < rest else rest
        share = rolled - 0.5 * FRICTION * rolled * rolled / speed if speed > 0.0 else 0.0
        ball_x, ball_y = mind.seen_x + mind.seen_vx * share, mind.seen_y + mind.seen_vy * share
        if not BALL <= ball_x <= WIDTH - BALL:
            ball_x = folded(ball_x, WIDTH)
        if not BALL <= ball_y <= HEIGHT - BALL:
            ball_y = folded(ball_y, HEIGHT)
        dx, dy = ball_x - x, ball_y - y
        gap = sqrt(dx * dx + dy * dy) - mind.touch
        after = (gap if gap > 0.0 else 0.0) / FULL_SPEED + turning
        if after <= t or rolled < t or i == MOMENTS:
            mind.meet_x, mind.meet_y = ball_x, ball_y
            return max(after, t) if after <= t or rolled < t else after
    return after


@kernel
def folded(at: float, size: float) -> float:
    """A coordinate of the ball, reflected once by the rim and kept within it."""
    if at < BALL:
        at = 2.0 * BALL - at
    elif at > size - BALL:
        at = 2.0 * (size - BALL) - at
    return min(max(at, BALL), size - BALL)


@kernel
def clearance(obs: Observation, x: float, y: float, to_x: float, to_y: float, mates: bool) -> float:
    """Least distance in px of an opponent, or of a mate too, from the segment between two points; at most 999."""
    ex, ey = to_x - x, to_y - y
    length2 = ex * ex + ey * ey + 1e-9
    least = 999.0
    for i in range(3):
        other = obs.others[i]
        if other.present and (mates or not other.mate):
            t = min(max(((other.x - x) * ex + (other.y - y) * ey) / length2, 0.0), 1.0)
            dx, dy = other.x - x - t * ex, other.y - y - t * ey
            distance = sqrt(dx * dx + dy * dy)
            if distance < least:
                least = distance
    return least
