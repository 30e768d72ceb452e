"""PiTanks: records of a match, and the parameters of the rules."""

from typing import Annotated

from pigaming_app.games.simple import MatchRules, MatchState
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS

SHIELD, SPEED, RAPID, TRIPLE, RICOCHET, MINE = range(6)
POWERS = ("shield", "speed", "rapid", "triple", "ricochet", "mine")
OWN_BULLETS = 8  # capacity for each robot's bullets
OUTER = 100  # `Bullet.struck` at an outer wall
BULLETS = ROBOTS * OWN_BULLETS
PICKUPS = 3
OWN_MINES = 2
MINES = ROBOTS * OWN_MINES


@record
class PiTanksRules(MatchRules):
    """Tunable parameters. Distances in px, times in ticks, speeds in px/s and rad/s."""

    speed: float = 260.0
    turn_rate: float = 3.0
    turbo: int = 1  # 0: disabled
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)
    bullet_speed: float = 560.0
    bullet_radius: float = 6.0
    muzzle: float = 64.0  # from the robot's centre
    cooldown: int = HZ // 2
    bullets_alive: int = 5
    magazine: int  # shots; 0: endless
    loading: int = 8 * HZ // 5  # of one shot
    protection: int = round(0.75 * HZ)
    pickups: int = 1  # 0: disabled
    pickup_every: int = 7 * HZ
    pickup_life: int = 12 * HZ
    pickup_reach: float = 40.0
    power_life: int = 8 * HZ
    speed_factor: float = 1.25
    rapid_cooldown: int = HZ // 5
    rapid_loading: int = 3  # times as fast
    boosted_alive: int = 8  # bullets alive with rapid or triple
    triple_spread: float = 0.21  # rad
    bounces: int = 2  # of a ricochet bullet
    mine_radius: float = 22.0
    mine_arming: int = HZ
    mine_life: int = 30 * HZ
    penalty: int = 1  # points that a hit costs the robot that is hit
    knockout: int  # time that a hit knocks out; 0: disabled
    recoil: float = 176.0  # speed backwards at the hit, which falls evenly to 0 during the knock-out
    camping: int  # time within `camp_radius` after which a robot is lit; 0: disabled
    camp_radius: float = 72.0
    lit_distance: float = 500.0  # between a lit robot and a pick-up that appears
    bounty_lead: int  # a hit on a robot whose team leads by more counts one more; 0: disabled
    finale: int  # time before the end in which hits count double
    overtime: int  # at most, if two teams are level at the top when `ticks` are over


@record
class Tank:
    """State of a robot that only PiTanks has."""

    cooldown: int
    spent: int  # ticks until its magazine is full
    protected: int
    shots: int  # bullets fired
    landed: int  # bullets that scored
    hits: int  # hits made, by bullet or mine
    taken: int  # hits taken
    powers: Annotated[list[int], 6]  # ticks left of each; 0: inactive
    knocked_out: int  # ticks left in which it reverses and obeys no input
    camp_x: float  # centre of the circle that it has not left
    camp_y: float
    camped: int  # ticks in that circle
    lit: int  # 1: it has been there for `PiTanksRules.camping`
    bounty: int  # points that a hit on it is worth in addition
    barred: int  # 1: its hits score nothing, since its team is not level at the top in overtime


@record
class Bullet:
    """A bullet; those of robot k begin at index k * OWN_BULLETS. A dead bullet keeps its last position."""

    alive: int
    x: float
    y: float
    vx: float
    vy: float
    bounces: int  # remaining
    fresh: int  # 1 before its first tick, while it is still at the robot's centre
    struck: int  # hit in this tick: 0 nothing, 1.. a robot, -1.. a wall, OUTER an outer wall
    when: float  # time of the hit, as a fraction of the tick's displacement


@record
class Pickup:
    """A pick-up on the floor."""

    alive: int  # ticks left
    kind: int
    x: float
    y: float


@record
class Mine:
    """A mine; those of robot k begin at index k * OWN_MINES."""

    alive: int  # ticks left
    age: int
    x: float
    y: float


@record
class PiTanks(MatchState):
    """The complete state of a match of PiTanks."""

    rules: PiTanksRules
    tanks: Annotated[list[Tank], ROBOTS]
    bullets: Annotated[list[Bullet], BULLETS]
    next_pickup: int  # ticks until the next one appears
    pickups: Annotated[list[Pickup], PICKUPS]
    mines: Annotated[list[Mine], MINES]
    last_hit: int  # ticks from the start to the last hit that knocked out; 0: none
    last_shooter: int  # seats of that hit
    last_victim: int
    last_points: int  # that it scored
