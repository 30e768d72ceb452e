"""Robot Factory: records of a match, and the parameters of the rules.

A pallet keeps its identity for the whole match; its `place` and `at` are its location. `slot.pallet`, `load.pallet` and
the like are the inverse of that relation; only `pallets.move` writes either.
"""

from typing import Annotated

from pigaming_app.games.simple import MatchRules, MatchState
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, RADIUS, ROBOTS

ICE, FIRE = 0, 1  # the teams
TEAMS = 2
MAX_PALLETS = 8  # per team
PALLETS = TEAMS * MAX_PALLETS  # those of team t begin at index t * MAX_PALLETS
SHELVES = 4  # slots of a warehouse
MACHINES = 4
WORKERS = 3

RAW, HALF, DONE, DAMAGED, DELIVERED = range(5)  # state of a pallet
IN_SLOT, ON_ROBOT, IN_MACHINE, BY_WORKER, WAITING, SHIPPED = range(1, 7)  # place of a pallet; 0: it does not exist
ENTRY, EXIT, INPUT, OUTPUT, SHARED = range(5)  # kinds of slots; SHARED: on the floor, for both teams, in party
A, B = range(2)  # kinds of machines: A makes raw pallets half done, B finishes them
RESTING, GOING, WORKING, FETCHING, CARRYING = range(5)  # task of a worker

# Slot indices: team t's entry from t * 2 * SHELVES, then its exit; machine m's INPUT, OUTPUT from MACHINE_SLOTS + 2 m;
# the shared slots from SHARED_SLOTS. A match has the first `slot_count` of them.
MACHINE_SLOTS = TEAMS * 2 * SHELVES
SHARED_SLOTS = MACHINE_SLOTS + 2 * MACHINES
MAX_SHARED = 4
SLOTS = SHARED_SLOTS + MAX_SHARED
NOBODY = -1  # team of a loose pallet, and of a slot that belongs to neither team
HOLD, REACH = 28.0, 40.0  # px from a robot's hull to its fork, and from there to a slot
FORK = RADIUS + HOLD  # px from a robot's centre to its fork


@record
class FactoryRules(MatchRules):
    """Tunable parameters. Distances in px, speeds in px/s and rad/s, times in ticks."""

    pallets: int = 4  # per team
    speed: float = 260.0
    turn_rate: float = 3.0
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)
    fork: float = FORK  # from a robot's centre to the centre of its pallet
    reach: float = REACH  # from the fork to the centre of a slot, within which it lifts and sets down
    process: int = 6 * HZ
    replace: int = 10 * HZ  # from the damage to the replacement
    freeze: int = 3 * HZ
    patience: int = 3 * HZ  # without progress towards a machine before another worker is sent
    collect: int = 20 * HZ  # in which the owner may collect a processed pallet before a worker carries it away
    walk: float = 130.0  # speed of workers
    worker_radius: float = 20.0
    driving: float = 20.0  # slower robots do not drive over anybody
    party: int  # 1: endless orders, rush orders, loose pallets, a fast machine; points decide
    allies: int  # 1: one team, for which both warehouses work; stars by time
    orders: int  # party: pallets of a team that are under way at once
    loose: int  # party: loose pallets on the floor, at most
    rush_every: int  # party: each team's every so many-th order is a rush
    rush: int  # party: ticks from the arrival of a rush order to its deadline
    rush_points: int  # party: for a rush delivered in time; any other delivery is one point
    claim: int  # party: ticks in an output after which anybody may take a processed pallet
    renew: int  # party: ticks from a delivery to the next order, or to the next loose pallet
    fast_every: int  # party: ticks for which one machine is the fast one
    fast_process: int  # party: ticks of processing on the fast machine, which needs no worker
    overtime: int  # party: ticks at most, after level points, in which the next point wins
    three_stars: int  # allies: ticks within which everything is delivered for three stars
    two_stars: int  # and for two; one star for everything within the time limit


@record
class Pallet:
    """One pallet of a team, from its entry to its exit."""

    exists: int  # 0: not used in this match
    team: int  # its owner; in party the team that last lifted it, NOBODY until then if it is loose
    state: int
    place: int
    at: int  # index of its slot, robot, machine or worker
    waited: int  # ticks in its slot (a machine's, or the exit), or since it was damaged
    steps: int  # machines that have processed it
    fed: int  # 1 + the robot that put it into the machine
    loose: int  # 1: comes back to a shared slot, half done, and belongs to the team that lifts it
    rush: int  # ticks left to its deadline as a rush order; 0: an ordinary order, or too late


@record
class Slot:
    """A place for one pallet."""

    kind: int
    team: int  # -1: a machine's slot
    machine: int  # -1: a warehouse slot
    x: float
    y: float
    pallet: int  # 1 + index; 0: empty


@record
class Machine:
    """A machine. It needs a worker to start processing."""

    kind: int
    x: float
    y: float
    spot_x: float  # position of its worker
    spot_y: float
    pallet: int  # 1 + the pallet in process; 0: none
    left: int  # ticks until it is done
    worker: int  # 1 + the worker at it, or on the way; 0: none
    reserved: int  # 1 + the pallet for which the output slot is reserved; 0: free
    stalled: int  # ticks for which work has waited; counts down without work
    failed_worker: int  # 1 + the worker who last failed to reach it, until one succeeds; 0: none
    failed_at: int  # tick of that failure
    fast: int  # 1: the fast machine of the moment, in party
    quick: int  # 1: the pallet in process takes only FactoryRules.fast_process


@record
class Motion:
    """A robot's velocity, measured from successive positions."""

    x: float  # px, on the previous tick
    y: float
    vx: float  # px/s
    vy: float


@record
class Worker:
    """A person on the floor. Robots must not drive over them."""

    x: float
    y: float
    heading: float
    walking: int  # 1: moving
    side: int  # on which it avoids an obstacle: -1, 0 or 1
    task: int
    machine: int  # target or workplace; -1: none
    pallet: int  # 1 + the pallet it carries; 0: none
    shelf: int  # the slot it carries that to
    route: Route
    closest: float  # px, shortest distance to the goal reached on this route
    stuck_ticks: int  # ticks since then
    home_x: float  # resting place
    home_y: float
    touched: Annotated[list[int], ROBOTS]  # 1: the robot still touches it, so that a touch counts once


@record
class Load:
    """State of a robot that only Robot Factory has."""

    pallet: int  # 1 + the pallet it carries; 0: none
    frozen: int  # ticks left
    pressed: int  # 1: fire was pressed on the previous tick; each press acts once
    refused: int  # ticks since a press without effect, 0: none; for the display
    delivered: int
    steps: int  # of processing on pallets that this robot fed to machines
    spoiled: int  # pallets put into a wrong machine
    hits: int  # workers driven over
    aim: int  # 1 + the target slot of an AI, visible to its team mate; 0: none, or a human player
    stolen: int  # pallets of the other team that this robot has taken


@record
class Factory(MatchState):
    """The complete state of a match of Robot Factory."""

    rules: FactoryRules
    pallets: Annotated[list[Pallet], PALLETS]
    slots: Annotated[list[Slot], SLOTS]
    machines: Annotated[list[Machine], MACHINES]
    workers: Annotated[list[Worker], WORKERS]
    loads: Annotated[list[Load], ROBOTS]
    motions: Annotated[list[Motion], ROBOTS]
    aisle: Annotated[list[float], 4]  # left, top, width, height of the walkway
    delivered: Annotated[list[int], TEAMS]
    winner: int  # 1 + the team that has delivered everything; 0: none
    slot_count: int = SHARED_SLOTS  # slots that exist, from the first
    points: Annotated[list[int], TEAMS]  # in party
    ordered: Annotated[list[int], TEAMS]  # in party: orders that have arrived so far
    turns: Annotated[list[int], MACHINES]  # in party: machines in the order in which they are the fast one
    stars: int  # of allies, once everything is delivered: 1 to 3
