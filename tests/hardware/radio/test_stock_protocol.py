"""The protocol of a 3pi with factory firmware, byte for byte, against a simulated robot."""

import pytest

from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.stock_protocol import StockProtocol, motors
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.sentences import key_of, sentence
from tests.hardware.wire import Time, Wire, run


class Robot(Wire):
    """A 3pi with the serial-slave program: it implements Pololu's commands and has no deadman."""

    def __init__(self, time, name=b"3pi1.1"):
        super().__init__(time)
        self.name = name
        self.left = self.right = 0  # of 255
        self.log = []  # (left, right) after every write

    def write(self, data):
        super().write(data)
        waiting = list(data)
        while waiting:
            match waiting:
                case [0x81, *waiting]:
                    self.left = self.right = 0
                    self.coming += self.name
                case [0xB1, *waiting]:
                    self.coming += (4750).to_bytes(2, "little")
                case [0xC1 | 0xC2 as command, n, *waiting]:
                    self.left = (255 if n == 127 else 2 * n) * (1 if command == 0xC1 else -1)
                case [0xC5 | 0xC6 as command, n, *waiting]:
                    self.right = (255 if n == 127 else 2 * n) * (1 if command == 0xC5 else -1)
                case _:
                    pytest.fail(f"no such command: {waiting}")
        self.log.append((self.left, self.right))
        return len(data)


@pytest.mark.parametrize(
    ("wheels", "line"),
    [
        (WheelCommand(1.0, 1.0), "C1 7F C5 7F"),
        (WheelCommand(-1.0, 1.0), "C2 7F C5 7F"),
        (WheelCommand(0.5, -0.5), "C1 40 C6 40"),
        (WheelCommand(9.0, float("nan")), "C1 7F C5 00"),
        (None, "C1 00 C5 00"),
    ],
)
def test_motor_commands_by_hand(wheels, line):
    """Half of full speed is 128 of 255, which is sent as 64."""
    assert motors(wheels) == bytes.fromhex(line)


@pytest.fixture
def time():
    return Time()


def test_the_robot_drives_tells_its_battery_and_stops_at_the_end(time):
    robot = Robot(time)
    with Link(lambda: robot, time, StockProtocol(2)) as link:
        run(link, time, 1.0, lambda: link.send([None, None, WheelCommand(0.5, -1.0)]))
        assert (robot.left, robot.right) == (128, -255)
        assert link.fault is None
        assert link.telemetry[2][:3] == (2, 4.75, 0)
        assert link.telemetry[2].received == pytest.approx(time(), abs=0.25)
        assert link.quality(2).share > 0.7
        assert link.quality(0).share == 0.0
    assert robot.log[-5:] == [(0, 0)] * 5


def test_once_known_the_robot_is_not_stopped_by_questions(time):
    robot = Robot(time)
    link = Link(lambda: robot, time, StockProtocol())
    run(link, time, 2.0, lambda: link.send([WheelCommand(1.0, 1.0)]))
    assert set(robot.log[1:]) == {(255, 255)}
    assert b"".join(data for _, data in robot.written).count(0x81) == 1


def test_nobody_commanding_stops_it(time):
    robot = Robot(time)
    link = Link(lambda: robot, time, StockProtocol())
    link.send([WheelCommand(1.0, 1.0)])
    run(link, time, 0.15)
    assert (robot.left, robot.right) == (0, 0)


def test_something_else_at_the_line_is_named(time):
    robot = Robot(time, b"v2.041")
    link = Link(lambda: robot, time, StockProtocol(), name="COM3")
    run(link, time, 0.1)
    assert sentence(link.fault) == "No 3pi with the stock program at COM3, which sends 'v2.041': choose another port."


def test_nobody_at_the_line_is_named(time):
    link = Link(lambda: Wire(time), time, StockProtocol(), name="COM3")
    run(link, time, 1.2)
    assert key_of(link.fault) == "radio_mute"


def test_noise_that_nobody_asked_for_is_no_battery(time):
    robot = Robot(time)
    link = Link(lambda: robot, time, StockProtocol())
    run(link, time, 0.1)
    robot.coming += b"\x01\x02\x03\x04\x05\x06\x07"
    run(link, time, 0.5)
    assert link.telemetry[0].battery == 4.75
