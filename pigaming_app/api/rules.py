"""Rules of a game: records, kernels, driving, contact, random numbers. Runs plain and compiled; no pygame."""

from pigaming_app.games.game import Setup
from pigaming_app.games.simple import OTHERS, Rules, SimpleMatch, seat_robots, steer
from pigaming_app.sim.angles import turn_to, wrap
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.flow_field import free_node
from pigaming_app.sim.grid import NEAR_UNIT, node_at
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.robot import RADIUS, stop_all
from pigaming_app.sim.sweep import FAR, disc_contact, is_clear, offset_from_wall, wall_contact
from pigaming_app.sim.world import CELL, COLUMNS, DT, HEIGHT, HZ, ROBOTS, SOLID, WIDTH, Wall, World

__all__ = [
    "CELL",
    "COLUMNS",
    "DT",
    "FAR",
    "HEIGHT",
    "HZ",
    "NEAR_UNIT",
    "OTHERS",
    "RADIUS",
    "ROBOTS",
    "SOLID",
    "WIDTH",
    "Arena",
    "Rules",
    "Setup",
    "SimpleMatch",
    "Wall",
    "World",
    "bell",
    "disc_contact",
    "free_node",
    "is_clear",
    "kernel",
    "node_at",
    "offset_from_wall",
    "record",
    "seat_robots",
    "seeded",
    "steer",
    "stop_all",
    "turn_to",
    "uniform",
    "wall_contact",
    "wrap",
]
