"""Rules of a game: records, kernels, driving, contact, random numbers. Runs plain and compiled; no pygame."""

from pigaming_app.games.game import Setup
from pigaming_app.games.simple import Rules, SimpleMatch, seat_robots, steer
from pigaming_app.games.starts import dealt_to_teams
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.contact import first_wall
from pigaming_app.sim.flow_field import random_place
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.robot import put_back, stop_all
from pigaming_app.sim.sweep import disc_contact, is_clear, offset_from_wall
from pigaming_app.sim.world import HEIGHT, HZ, RADIUS, ROBOTS, WIDTH, Wall

__all__ = [
    "HEIGHT",
    "HZ",
    "RADIUS",
    "ROBOTS",
    "WIDTH",
    "Arena",
    "Rules",
    "Setup",
    "SimpleMatch",
    "Wall",
    "dealt_to_teams",
    "disc_contact",
    "first_wall",
    "is_clear",
    "kernel",
    "offset_from_wall",
    "put_back",
    "random_place",
    "record",
    "seat_robots",
    "steer",
    "stop_all",
    "turn_to",
    "uniform",
]
