"""Robot Factory: the records of a match and the numbers of its rules.

A pallet is one thing from the beginning to the end of a match, and its `place` and `at` say where it is. `slot.pallet`,
`load.pallet` and the like are the same knowledge seen from the other side; only `place.move` writes either.
"""

from typing import Annotated

from pigaming_app.games.factory.pedestrians import Motion
from pigaming_app.sim.flow_field import Route
from pigaming_app.sim.record import record
from pigaming_app.sim.world import HZ, ROBOTS, World

ICE, FIRE = 0, 1  # the teams
TEAMS = 2
MOST_PALLETS = 8  # a team
PALLETS = TEAMS * MOST_PALLETS  # team t has the places t * MOST_PALLETS onwards
SHELVES = 4  # slots of a warehouse
MACHINES = 4
WORKERS = 3

RAW, HALF, DONE, DAMAGED, DELIVERED = range(5)  # state of a pallet
IN_SLOT, ON_ROBOT, IN_MACHINE, BY_WORKER, WAITING, SHIPPED = range(1, 7)  # its place; 0: it does not exist
ENTRY, EXIT, INPUT, OUTPUT = range(4)  # kinds of slots
A, B = range(2)  # kinds of machines: A makes raw pallets half done, B finishes them
RESTING, GOING, WORKING, FETCHING, CARRYING = range(5)  # what a worker does

# Slots: of team t the entry from t * 2 * SHELVES, then its exit; of machine m INPUT, OUTPUT from MACHINE_SLOTS + 2 m.
MACHINE_SLOTS = TEAMS * 2 * SHELVES
SLOTS = MACHINE_SLOTS + 2 * MACHINES
FORK, REACH = 64.0, 40.0  # px from a robot's centre to its fork, and from there to a slot


@record
class Rules:
    """Every number of the game that can be tuned. Distances in px, speeds in px/s and rad/s, times in ticks."""

    ticks: int  # of the match
    pallets: int = 4  # a team
    speed: float = 260.0
    turn_rate: float = 3.0
    turbo_factor: float = 1.3
    turbo_drain: float = 1.0 / (2 * HZ)  # of the meter, per tick
    turbo_refill: float = 1.0 / (4 * HZ)
    fork: float = FORK  # from a robot's centre to the middle of what it carries
    reach: float = REACH  # from the fork to the middle of a slot within which it lifts and sets down
    process: int = 6 * HZ
    replace: int = 10 * HZ  # from the damage to the replacement
    freeze: int = 3 * HZ
    patience: int = 3 * HZ  # for which a worker tries to get nearer to a machine before another is sent
    collect: int = 20 * HZ  # for which a processed pallet waits for its owner before a worker carries it away
    walk: float = 130.0  # speed of workers
    worker_radius: float = 20.0
    driving: float = 20.0  # a robot slower than this does not drive over anybody


@record
class Pallet:
    """One pallet of a team, from its entry to its exit."""

    exists: int  # 0: this match has fewer
    team: int
    state: int
    place: int
    at: int  # which slot, robot, machine or worker
    waited: int  # ticks in an output slot, or ticks since it was damaged
    steps: int  # machines that have worked on it
    fed: int  # 1 + the robot that put it into the machine


@record
class Slot:
    """A place for one pallet."""

    kind: int
    team: int  # -1: of a machine
    machine: int  # -1: of a warehouse
    x: float
    y: float
    pallet: int  # 1 + which; 0: empty


@record
class Machine:
    """A machine: it works while a worker stands at it."""

    kind: int
    x: float
    y: float
    spot_x: float  # where its worker stands
    spot_y: float
    pallet: int  # 1 + which is being processed; 0: none
    left: int  # ticks until it is done
    worker: int  # 1 + who works, or is on the way; 0: nobody
    keeps: int  # 1 + the pallet for which the output slot is kept; 0: free
    stalled: int  # ticks for which work has waited; without work it goes back to 0 as fast
    refused: int  # 1 + the worker who last could not get there, until one could; 0: none
    refused_at: int  # the tick of that


@record
class Worker:
    """A person on the floor. Robots must not drive over them."""

    x: float
    y: float
    heading: float
    walking: int  # 1: on the move
    side: int  # on which it goes round somebody: -1, 0 or 1
    task: int
    machine: int  # which it goes to, works at or fetches from; -1: none
    pallet: int  # 1 + what it carries; 0: nothing
    shelf: int  # the slot it carries that to
    route: Route
    least: float  # px, the shortest way that was left on this route
    held_up: int  # ticks since that was reached
    home_x: float  # where it rests
    home_y: float
    touched: Annotated[list[int], ROBOTS]  # 1: the robot is still touching it, so that it counts once


@record
class Load:
    """What Robot Factory adds to a robot."""

    pallet: int  # 1 + what it carries; 0: nothing
    frozen: int  # ticks left
    pressed: int  # 1: fire was down on the tick before: each press acts once
    refused: int  # ticks since a press could do nothing; for the picture
    delivered: int
    steps: int  # done by machines on what this robot has put into them
    spoiled: int  # pallets put into a wrong machine
    hits: int  # workers driven over
    aim: int  # 1 + the slot that an AI is making for, shown to its mate; 0: none, or a person


@record
class Factory(World):
    """A match of Robot Factory, whole."""

    rules: Rules
    pallets: Annotated[list[Pallet], PALLETS]
    slots: Annotated[list[Slot], SLOTS]
    machines: Annotated[list[Machine], MACHINES]
    workers: Annotated[list[Worker], WORKERS]
    loads: Annotated[list[Load], ROBOTS]
    motions: Annotated[list[Motion], ROBOTS]
    aisle: Annotated[list[float], 4]  # left, top, width, height of the walkway
    delivered: Annotated[list[int], TEAMS]
    winner: int  # 1 + the team that has delivered everything; 0: none
