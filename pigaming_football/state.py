"""Robot Football: records of a match, and the parameters of the rules."""

from typing import Annotated

from pigaming_app.api.rules import HEIGHT, HZ, ROBOTS, SimpleMatch, record
from pigaming_app.api.rules import Rules as SimpleRules

LEFT, RIGHT = 0, 1  # sides, which are also the numbers of the teams that defend them
MIDDLE = HEIGHT / 2  # px, height of both goals' centres
DT = 1.0 / HZ  # s
MAX_DROPS = 12
NOBODY = 0  # `Ball.holder` and `Ball.touched` are 1 + the seat


@record
class Rules(SimpleRules):
    """Tunable parameters. Distances in px, speeds in px/s, times in ticks, masses in those of the standard ball.

    Robots are driven by their motors, whatever the ball does, so that its mass counts in shots alone.
    """

    overtime: int  # of a level match, at most; the first goal ends it
    radius: float = 22.0  # of the ball
    mass: float = 1.0
    friction: float = 200.0  # px/s^2, deceleration of the rolling ball
    bounce: float = 0.75  # coefficient of restitution between ball and walls
    robot_bounce: float = 0.5  # between ball and robots
    catch_reach: float = 12.0  # between robot and ball
    catch_angle: float = 0.7  # rad to either side of straight ahead
    held_speed: float = 0.8  # factor of a robot's speed while it holds the ball
    hold: int = 2 * HZ  # after which the ball is shot by itself
    charge: int = round(0.8 * HZ)  # until a shot has its full strength
    weakest: float = 380.0  # momentum of a shot
    strongest: float = 850.0
    cooldown: int = round(0.4 * HZ)  # after a shot or a lost ball
    celebration: int = round(2.5 * HZ)  # from a goal to the kick-off
    kick_off: float = 220.0  # speed at which the ball rolls to the team that conceded
    warning: int = HZ  # from the decision to drop the ball anew to the drop
    near: float = 60.0  # between robot and ball: the ball is in reach
    lonely: int = 5 * HZ  # of rest in reach of nobody, after which the ball is dropped anew
    jammed: int = 9 * HZ  # without getting anywhere, after which it is dropped anew elsewhere
    catch_up: int = 2  # points of a goal of the team that is behind
    golden: float = 0.0  # probability that a ball counts two points for either team


@record
class Spot:
    """A point of the pitch, px."""

    x: float
    y: float


@record
class Ball:
    """The ball; px, px/s, ticks."""

    x: float
    y: float
    vx: float
    vy: float
    out: int  # ticks until it is dropped at (x, y); 0: in play
    roll: float  # px/s, along x, when it is dropped
    holder: int  # 1 + seat; NOBODY
    grip: float  # rad, bearing of the held ball from its holder's heading
    charge: int  # ticks for which it has been held
    touched: int  # 1 + seat of the last robot to touch it since it was dropped; NOBODY
    before: int  # the last one before, of either team
    worth: int  # points of a goal with it, unless the team is behind
    anchor_x: float  # where it was when it last got anywhere
    anchor_y: float
    still: int  # ticks since then
    alone: int  # ticks of rest in reach of nobody


@record
class Footballer:
    """State of a robot that only Robot Football has."""

    last_x: float  # position on the previous tick
    last_y: float
    dx: float  # displacement since then; 0 if it was carried
    dy: float
    armed: int  # 1: FIRE was up since the last shot or lost ball
    cooldown: int  # ticks until it can hold the ball again
    goals: int
    assists: int
    own_goals: int
    shots: int


@record
class Football(SimpleMatch):
    """The complete state of a match of Robot Football."""

    rules: Rules
    ball: Ball
    players: Annotated[list[Footballer], ROBOTS]
    mouth: float  # px, half the width of both goals
    drop_count: int
    drops: Annotated[list[Spot], MAX_DROPS]  # the first is the middle
    goals: int  # events so far
    goal_side: int  # of the last goal: LEFT or RIGHT
    goal_y: float  # px, where it crossed the line
    golden_goal: int  # 1: the match is in overtime, or was decided in it
