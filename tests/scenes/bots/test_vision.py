"""Poses as the Small Size League sends them, read by the schema that the league's own client library ships."""

import ast
import math
import socket
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from hypothesis import given
from hypothesis import strategies as st

from pigaming_app.scenes.bots import vision
from pigaming_app.scenes.bots.vision import VisionSender, detection, geometry
from pigaming_app.sim.world import World
from tests.matches import match_of

MM = 1.32  # of a px, docs/hardware.md
MAT = 2112.0, 1188.0  # mm, docs/hardware.md
CORNERS = {(0.0, 0.0): (-1056, 594), (1600.0, 0.0): (1056, 594), (0.0, 900.0): (-1056, -594), (800.0, 450.0): (0, 0)}
TURNS = {0.0: 0.0, math.pi / 2: -math.pi / 2, -math.pi / 2: math.pi / 2, 3 * math.pi: math.pi, 7.0: 2 * math.pi - 7.0}


@cache
def packets() -> Any:
    """The league's class of packets, made from the schemas in the package `sslclient`."""
    spec, pool = find_spec("sslclient"), descriptor_pool.DescriptorPool()
    assert spec
    assert spec.submodule_search_locations
    folder = Path(spec.submodule_search_locations[0])
    for part in ("detection", "geometry", "wrapper"):
        tree = ast.parse((folder / f"messages_robocup_ssl_{part}_pb2.py").read_text(encoding="utf-8"))
        found = [node.value for node in ast.walk(tree) if isinstance(node, ast.keyword) and node.arg == "serialized_pb"]
        assert isinstance(found[0], ast.Call)
        schema = ast.literal_eval(found[0].args[0]).encode("latin1")
        pool.Add(descriptor_pb2.FileDescriptorProto.FromString(schema))
    return message_factory.GetMessageClass(pool.FindMessageTypeByName("SSL_WrapperPacket"))


@pytest.fixture
def packet() -> Any:
    return packets()


def state(*robots: tuple[float, float, float, int]) -> World:
    """Robots at x, y, heading, of a team."""
    world = World()
    for robot, (x, y, heading, team) in zip(world.robots, robots, strict=False):
        robot.present, robot.x, robot.y, robot.heading, robot.team = 1, x, y, heading, team
    return world


def test_a_frame_has_all_that_the_league_requires(packet: Any) -> None:
    frame = packet.FromString(detection(state((800.0, 450.0, 0.0, 0)), MM, 300, 12.25, 12.5)).detection
    assert frame.IsInitialized()
    assert (frame.frame_number, frame.t_capture, frame.t_sent, frame.camera_id) == (300, 12.25, 12.5, 0)
    assert packet.FromString(geometry(MM)).geometry.field.field_length == MAT[0]
    assert packet.FromString(geometry(MM)).geometry.field.field_width == MAT[1]
    assert packet.FromString(geometry(MM)).IsInitialized()


@pytest.mark.parametrize("place", CORNERS)
def test_places_are_from_the_middle_and_up(packet: Any, place: tuple[float, float]) -> None:
    robot = packet.FromString(detection(state((*place, 0.0, 0)), MM, 0, 0.0, 0.0)).detection.robots_yellow[0]
    assert (robot.x, robot.y) == pytest.approx(CORNERS[place], abs=0.01)
    assert (robot.pixel_x, robot.pixel_y) == pytest.approx(place)


@pytest.mark.parametrize("heading", TURNS)
def test_angles_are_counter_clockwise(packet: Any, heading: float) -> None:
    robot = packet.FromString(detection(state((0.0, 0.0, heading, 0)), MM, 0, 0.0, 0.0)).detection.robots_yellow[0]
    assert math.remainder(robot.orientation - TURNS[heading], math.tau) == pytest.approx(0.0, abs=1e-5)
    assert abs(robot.orientation) <= math.pi + 1e-6


def test_teams_have_their_colours_and_robots_the_numbers_of_their_seats(packet: Any) -> None:
    frame = packet.FromString(
        detection(state(*((0.0, 0.0, 0.0, team) for team in (0, 1, 0, 3))), MM, 0, 0.0, 0.0)
    ).detection
    assert [robot.robot_id for robot in frame.robots_yellow] == [0, 2]
    assert [robot.robot_id for robot in frame.robots_blue] == [1, 3]
    assert len(frame.balls) == 0


@given(st.integers(0, 2**32 - 1), st.floats(0.0, 4e9), st.floats(-1e5, 1e5), st.floats(-1e3, 1e3))
def test_every_number_arrives(number: int, seconds: float, place: float, heading: float) -> None:
    raw = detection(state((place, -place, heading, 1)), MM, number, seconds, seconds)
    frame = packets().FromString(raw).detection
    assert frame.frame_number == number
    assert frame.t_sent == seconds
    assert frame.robots_blue[0].x == pytest.approx((place - 800.0) * 1.32, rel=1e-5, abs=1e-2)


def test_the_ball_of_football_is_a_ball_and_others_receive_it_by_multicast(packet: Any) -> None:
    match = match_of("football", ["level1", "level1", "level1", "level1"])
    for _ in range(200):
        match.tick()
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind((vision.GROUP, vision.PORT))
    member = socket.inet_aton("224.5.23.2") + socket.inet_aton("127.0.0.1")
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    receiver.settimeout(5.0)
    sender = VisionSender("127.0.0.1")
    try:
        sender.send(match.state, match.plant.mm, 1.0, 2.0)
        frame = packet.FromString(receiver.recv(65_536)).detection
        size = packet.FromString(receiver.recv(65_536)).geometry
    finally:
        sender.close()
        receiver.close()
    ball = match.state.ball
    assert (frame.balls[0].x, frame.balls[0].y) == pytest.approx(
        ((ball.x - 800) * 1.32, (450 - ball.y) * 1.32), abs=0.1
    )
    assert len(frame.robots_yellow) == len(frame.robots_blue) == 2
    assert size.field.field_length == 2112
