"""Robot Football as a network sees it: 92 inputs, and four heads of choices.

Directions are a cosine and a sine relative to the own heading; places, and `lead`, are those of the own team, which
defends the left goal in its own frame. So one network plays for either side.
"""

from collections.abc import Iterator, Sequence
from math import cos, sin, sqrt
from typing import Any

from pigaming_app.api.brains import set_action
from pigaming_app.api.networks import Encoding, NetworkSenses, Sight, Subject, encode_room, nearest_robot, whole
from pigaming_app.api.rules import HEIGHT, HZ, ROBOTS, WIDTH, kernel, record

from .physics import can_catch
from .rules import charge_of, lead_of, side_of
from .state import DT, LEFT, MIDDLE, Football

GROUPS = (
    ("motion", 5),
    ("feet", 4),
    ("place", 4),
    ("ball", 15),
    ("goals", 9),
    ("mate", 12),
    ("first", 12),
    ("second", 12),
    ("room", 8),
    ("match", 7),
    ("company", 4),
)
MOTION, FEET, PLACE, BALL, GOALS, OTHERS, ROOM, MATCH, COMPANY, SIZE = (
    0, 5, 9, 13, 28, 37, 73, 81, 88, 92
)  # first input of each group  # fmt: skip
OTHER = 12  # inputs for each of the others
HEADS = (("drive", 5), ("turn", 7), ("fire", 2), ("turbo", 2))
DRIVES = (-1.0, -0.4, 0.0, 0.5, 1.0)  # positions of the stick
TURNS = (-1.0, -0.36, -0.11, 0.0, 0.11, 0.36, 1.0)  # a full turn is 17 degrees a decision

FAST = 600.0  # px/s, of a ball
NEAR, FAR = 200.0, 920.0  # px: at which nearness is 1/2; half of the longest distance
SOON, LATER = 0.35, 0.8  # s ahead of the ball
RAYS, STEPS = 8, 6  # directions in which it looks for room, and steps in each
COS45 = 0.7071067811865476
LANE = 150.0  # px of clearance from which on a way counts as open


@record
class FootballSenses(NetworkSenses):
    """Parameters of the observation, and scratch space."""

    x: float  # of the ball, px from the robot, as it appears
    y: float


@kernel
def encode(match: Football, seat: int, senses: Any, inputs: Any) -> None:
    """Fill in the inputs of one seat."""
    for i in range(SIZE):
        inputs[i] = 0.0
    me = match.robots[seat]
    ahead_x, ahead_y = cos(me.heading), sin(me.heading)
    sign = 1.0 if side_of(me) == LEFT else -1.0
    encode_self(match, seat, sign, ahead_x, ahead_y, inputs)
    encode_ball(match, seat, senses, sign, ahead_x, ahead_y, inputs)
    encode_goals(match, seat, senses, sign, ahead_x, ahead_y, inputs)
    encode_others(match, seat, senses, ahead_x, ahead_y, inputs)
    encode_room(match, me, ahead_x, ahead_y, RAYS, STEPS, COS45, COS45, ROOM, inputs)


@kernel
def encode_self(match: Football, seat: int, sign: float, ahead_x: float, ahead_y: float, inputs: Any) -> None:
    """The own robot, score and rules."""
    me, player, rules = match.robots[seat], match.players[seat], match.rules
    inputs[MOTION], inputs[MOTION + 1] = whole(me.linear / 340.0), whole(me.angular / rules.turn_rate)
    inputs[MOTION + 2], inputs[MOTION + 3] = whole(me.turbo), whole(me.boosting)
    inputs[MOTION + 4] = whole(10.0 * me.turbo)
    if match.ball.holder == seat + 1:
        inputs[FEET] = whole(1.0)
        inputs[FEET + 1] = whole(charge_of(match))
        inputs[FEET + 2] = whole((rules.hold - match.ball.charge) / rules.hold)
    inputs[FEET + 3] = whole(1.0 if player.armed and not player.cooldown else 0.0)
    inputs[PLACE] = whole(sign * (2.0 * me.x / WIDTH - 1.0))
    inputs[PLACE + 1] = whole(sign * (2.0 * me.y / HEIGHT - 1.0))
    inputs[PLACE + 2], inputs[PLACE + 3] = whole(sign * ahead_x), whole(sign * ahead_y)
    lead = lead_of(match, side_of(me))
    inputs[MATCH], inputs[MATCH + 1] = whole(lead / (1.0 + abs(lead))), whole(lead / 4.0)
    inputs[MATCH + 2] = whole((rules.ticks - match.tick) / (60.0 * HZ))
    inputs[MATCH + 3] = whole(match.golden_goal)
    inputs[MATCH + 4] = whole(match.ball.worth - 1.0)
    inputs[MATCH + 5] = whole(5.0 * (rules.robot_bounce - 0.5))
    inputs[MATCH + 6] = whole(match.mouth / 150.0)


@kernel
def encode_ball(
    match: Football, seat: int, senses: Any, sign: float, ahead_x: float, ahead_y: float, inputs: Any
) -> None:
    """The ball: where it is and will be, its velocity, who holds it, and whether it is in play."""
    me, ball = match.robots[seat], match.ball
    vx, vy = ball.vx, ball.vy
    late_x, late_y = ball.x - me.x, ball.y - me.y
    error = 0.0
    if ball.holder != seat + 1:
        late_x -= senses.delay * vx
        late_y -= senses.delay * vy
        error = senses.error
    dx, dy = late_x - error * late_y, late_y + error * late_x
    senses.x, senses.y = dx, dy
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    along, across = ahead_x * dx + ahead_y * dy, ahead_x * dy - ahead_y * dx
    inputs[BALL], inputs[BALL + 1] = whole(along / distance), whole(across / distance)
    inputs[BALL + 2] = whole(NEAR / (NEAR + distance))
    inputs[BALL + 3] = whole((distance - match.radius - match.rules.radius) / 100.0 - 1.0)
    inputs[BALL + 4] = whole((ahead_x * vx + ahead_y * vy) / FAST)
    inputs[BALL + 5] = whole((ahead_x * vy - ahead_y * vx) / FAST)
    loss = match.rules.friction / (sqrt(vx * vx + vy * vy) + 1e-9)
    for k in range(2):
        t = SOON if k == 0 else LATER
        rolled = t - 0.5 * loss * t * t if loss * t < 1.0 else 0.5 / loss
        inputs[BALL + 6 + 2 * k] = whole((along + rolled * (ahead_x * vx + ahead_y * vy)) / 500.0)
        inputs[BALL + 7 + 2 * k] = whole((across + rolled * (ahead_x * vy - ahead_y * vx)) / 500.0)
    inputs[BALL + 10] = whole(sign * (2.0 * (me.x + dx) / WIDTH - 1.0))
    inputs[BALL + 11] = whole(sign * (2.0 * (me.y + dy) / HEIGHT - 1.0))
    if ball.holder and ball.holder != seat + 1:
        holder = match.robots[ball.holder - 1]
        inputs[BALL + 12] = whole(1.0 if side_of(holder) == side_of(me) else -1.0)
    if ball.out:
        inputs[BALL + 13] = whole(1.0 - 0.5 * ball.out * DT)
        inputs[BALL + 14] = whole(sign * ball.roll / match.rules.kick_off)


@kernel
def encode_goals(
    match: Football, seat: int, senses: Any, sign: float, ahead_x: float, ahead_y: float, inputs: Any
) -> None:
    """Both goals as seen from the robot, the other one from the ball, and how open a shot straight ahead is."""
    me = match.robots[seat]
    for k in range(2):
        goal_x = (WIDTH if sign > 0.0 else 0.0) if k == 0 else (0.0 if sign > 0.0 else WIDTH)
        dx, dy = goal_x - me.x, MIDDLE - me.y
        distance = sqrt(dx * dx + dy * dy) + 1e-9
        inputs[GOALS + 3 * k] = whole((ahead_x * dx + ahead_y * dy) / distance)
        inputs[GOALS + 3 * k + 1] = whole((ahead_x * dy - ahead_y * dx) / distance)
        inputs[GOALS + 3 * k + 2] = whole(1.0 - distance / 800.0)
    if sign * ahead_x > 0.1:
        reach = ((WIDTH if sign > 0.0 else 0.0) - me.x) / ahead_x
        aside = me.y + reach * ahead_y - MIDDLE
        inputs[GOALS + 6] = whole(sign * aside / (2.0 * match.mouth))
        inputs[GOALS + 7] = whole(1.0 if abs(aside) < match.mouth - match.rules.radius else -1.0)
        inputs[GOALS + 8] = whole(clearance(match, seat, reach * ahead_x, reach * ahead_y) / LANE)


@kernel
def clearance(match: Football, seat: int, ex: float, ey: float) -> float:
    """Least distance in px of an opponent from the segment that leads from a robot (ex, ey) px away; at most LANE."""
    me, least = match.robots[seat], LANE
    length2 = ex * ex + ey * ey + 1e-9
    for other in match.robots:
        if other.present and side_of(other) != side_of(me):
            dx, dy = other.x - me.x, other.y - me.y
            t = min(max((dx * ex + dy * ey) / length2, 0.0), 1.0)
            dx, dy = dx - t * ex, dy - t * ey
            distance = sqrt(dx * dx + dy * dy)
            if distance < least:
                least = distance
    return least


@kernel
def encode_others(match: Football, seat: int, senses: Any, ahead_x: float, ahead_y: float, inputs: Any) -> None:
    """The nearest mate, the two nearest opponents, and who is nearer to the ball."""
    me, ball, told = match.robots[seat], match.ball, 0
    mates, opponents = 0, 0
    own = sqrt(senses.x * senses.x + senses.y * senses.y)
    for _ in range(ROBOTS - 1):
        j = nearest_robot(match, seat, told)
        if j < 0:
            break
        told |= 1 << j
        if side_of(match.robots[j]) == side_of(me):
            k = OTHERS if mates == 0 else -1
            mates += 1
        else:
            k = OTHERS + OTHER * (1 + opponents) if opponents < 2 else -1
            opponents += 1
        if k >= 0:
            encode_other(match, seat, j, senses, ahead_x, ahead_y, own, k, inputs)
    inputs[COMPANY], inputs[COMPANY + 1] = whole(0.5 * mates), whole(0.5 * opponents)
    inputs[COMPANY + 2] = whole(1.0 if ball.holder == seat + 1 and inputs[OTHERS] > 0.0 else 0.0)
    inputs[COMPANY + 3] = whole(1.0 if can_catch(match, seat) else 0.0)


@kernel
def encode_other(
    match: Football, seat: int, j: int, senses: Any, ahead_x: float, ahead_y: float, own: float, k: int, inputs: Any
) -> None:
    """Robot j, from input k on. `own`: px from the own robot to the ball."""
    me, robot, player = match.robots[seat], match.robots[j], match.players[j]
    vx, vy = player.dx / DT, player.dy / DT
    late_x, late_y = robot.x - me.x - senses.delay * vx, robot.y - me.y - senses.delay * vy
    dx, dy = late_x - senses.error * late_y, late_y + senses.error * late_x
    distance = sqrt(dx * dx + dy * dy) + 1e-9
    inputs[k] = whole(1.0)
    inputs[k + 1] = whole((ahead_x * dx + ahead_y * dy) / distance)
    inputs[k + 2] = whole((ahead_x * dy - ahead_y * dx) / distance)
    inputs[k + 3] = whole(NEAR / (NEAR + distance))
    inputs[k + 4] = whole(1.0 - distance / FAR)
    inputs[k + 5] = whole((ahead_x * vx + ahead_y * vy) / 340.0)
    inputs[k + 6] = whole((ahead_x * vy - ahead_y * vx) / 340.0)
    turn_cos, turn_sin = cos(robot.heading), sin(robot.heading)
    inputs[k + 7] = whole(ahead_x * turn_cos + ahead_y * turn_sin)
    inputs[k + 8] = whole(ahead_x * turn_sin - ahead_y * turn_cos)
    bx, by = senses.x - dx, senses.y - dy
    away = sqrt(bx * bx + by * by)
    inputs[k + 9] = whole(NEAR / (NEAR + away))
    inputs[k + 10] = whole((away - own) / 300.0)
    inputs[k + 11] = whole(clearance(match, seat, dx, dy) / LANE if k == OTHERS else facing(match, j))


@kernel
def facing(match: Football, j: int) -> float:
    """1 if robot j holds the ball, else the cosine between its heading and the way to the ball, halved."""
    if match.ball.holder == j + 1:
        return 1.0
    robot = match.robots[j]
    dx, dy = match.ball.x - robot.x, match.ball.y - robot.y
    along: float = cos(robot.heading) * dx + sin(robot.heading) * dy
    return 0.5 * along / (sqrt(dx * dx + dy * dy) + 1e-9)


@kernel
def act(match: Football, seat: int, choices: Any) -> None:
    """Stick and buttons from the choices of the four heads."""
    set_action(match.actions[seat], DRIVES[choices[0]], TURNS[choices[1]], choices[2], choices[3])


ENCODING = Encoding("football", GROUPS, HEADS, encode, act, FootballSenses)


def percepts(match: Football, inputs: Sequence[float]) -> Iterator[Sight]:
    """Ball, mate and opponents."""
    yield Sight("ball", "prize", NEAR / max(inputs[BALL + 2], 1.0 / 256) - NEAR, inputs[BALL], inputs[BALL + 1])
    for k, topic, kind in (
        (OTHERS, "mate", "mate"),
        (OTHERS + OTHER, "near", "opponent"),
        (OTHERS + 2 * OTHER, "others", "opponent"),
    ):
        if inputs[k]:
            yield Sight(topic, kind, FAR * (1.0 - inputs[k + 4]), inputs[k + 1], inputs[k + 2])


SUBJECT = Subject(
    {
        "ball": ("ball",),
        "goal": ("goals",),
        "mate": ("mate",),
        "near": ("first",),
        "others": ("second", "company"),
        "walls": ("place", "room"),
        "feet": ("motion", "feet"),
        "score": ("match",),
    },
    DRIVES,
    TURNS,
    "kick",
    percepts,
    PLACE,
    lambda match, seat: side_of(match.robots[seat]) != LEFT,
)
