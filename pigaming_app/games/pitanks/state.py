"""PiTanks: the records of a match and the numbers of its rules."""

from typing import Annotated

from pigaming_app.sim.record import record
from pigaming_app.sim.world import ROBOTS, World

SHIELD, SPEED, RAPID, TRIPLE, RICOCHET, MINE = range(6)
POWERS = ("shield", "speed", "rapid", "triple", "ricochet", "mine")
OWN_BULLETS = 8  # places for each robot's bullets
OUTER = 100
BULLETS = ROBOTS * OWN_BULLETS
PICKUPS = 3
OWN_MINES = 2
MINES = ROBOTS * OWN_MINES


@record
class Rules:
    """Every number of the game that can be tuned. Distances in px, times in ticks, speeds in px/s and rad/s."""

    ticks: int
    speed: float
    turn_rate: float
    turbo: int  # 0: there is none
    turbo_factor: float
    turbo_drain: float  # of the meter, per tick
    turbo_refill: float
    bullet_speed: float
    bullet_radius: float
    muzzle: float  # from the robot's centre
    cooldown: int
    bullets_alive: int
    protection: int
    pickups: int  # 0: there are none
    pickup_every: int
    pickup_life: int
    pickup_reach: float
    power_life: int
    speed_factor: float
    rapid_cooldown: int
    boosted_alive: int  # bullets alive with rapid or triple
    triple_spread: float  # rad
    bounces: int  # of a ricochet bullet
    mine_radius: float
    mine_arming: int
    mine_life: int


@record
class Tank:
    """What PiTanks adds to a robot."""

    cooldown: int
    protected: int
    shots: int  # bullets fired
    landed: int  # of them, how many scored
    hits: int  # made, by bullet or mine
    taken: int
    powers: Annotated[list[int], 6]  # ticks left of each; 0: not held


@record
class Bullet:
    """Owner k has the places k * OWN_BULLETS onwards. A dead bullet stays where it died."""

    alive: int
    x: float
    y: float
    vx: float
    vy: float
    bounces: int  # left
    fresh: int  # 1 until it has left the barrel: it is then still at the robot's centre
    struck: int  # in this tick: 0 nothing, 1.. a robot, -1.. a wall, OUTER an outer wall
    when: float  # the share of the tick's way after which it struck


@record
class Pickup:
    """Something lying on the floor."""

    alive: int  # ticks left
    kind: int
    x: float
    y: float


@record
class Mine:
    """Owner k has the places k * OWN_MINES onwards."""

    alive: int  # ticks left
    age: int
    x: float
    y: float


@record
class PiTanks(World):
    """A match of PiTanks, whole."""

    rules: Rules
    tanks: Annotated[list[Tank], ROBOTS]
    bullets: Annotated[list[Bullet], BULLETS]
    next_pickup: int  # ticks until one appears
    pickups: Annotated[list[Pickup], PICKUPS]
    mines: Annotated[list[Mine], MINES]
