"""Motor drivers and encoders of the board files, and errors in the robots' program: no motor runs on by itself."""

import re
from itertools import pairwise
from random import Random

import pytest

from pigaming_app.hardware.emulator.wifi.boards import BoardConfig, Boards, WheelPins
from pigaming_app.hardware.radio.packets import RESTARTED, drive_packet
from pigaming_app.hardware.robot_kinds import PROGRAM
from pigaming_app.hardware.signals import WheelCommand
from tests.cases import repeated
from tests.hardware.emulator.one_board import ARENA, BACK, GO, ON

DRIVERS = ("DRV8833", "TB6612", "L298N")
IN_IN = {"board_esp32": (WheelPins(25, 26), WheelPins(32, 33)), "board_pico_w": (WheelPins(10, 11), WheelPins(12, 13))}
ENABLE = {
    "board_esp32": (WheelPins(26, 27, 25), WheelPins(32, 33, 14)),
    "board_pico_w": (WheelPins(11, 12, 10), WheelPins(14, 15, 13)),
}
HERTZ = {"DRV8833": 20000, "TB6612": 20000, "L298N": 2000}
TOP = 1200  # pulses a second of the board files' encoders
STALLS = """
import time
from motors import InIn

class Stalls(InIn):
    stalled = False
    def set(self, duty):
        if duty and not self.stalled:
            self.stalled = True
            time.sleep_ms(300)
        super().set(duty)

KIND, TIMER, WATCHDOG_MS, LED, BATTERY_PIN, BUTTON = 1, 0, 1000, None, None, None
left, right = Stalls(25, 26), InIn(32, 33)
"""


def board_file(board, choice):
    """A board file with a line of its comments in force: that of another driver, or that of the encoders."""
    text = (PROGRAM / f"{board}.py").read_text("utf-8")
    if choice != "encoders":
        text = re.sub("^left, right = .*$", "", text, flags=re.MULTILINE)
    return "from motors import Enable, Regulated\n" + text.replace(f"# {choice}: ", "")


def of(board, driver):
    """A robot with this driver on a board."""
    if driver == "DRV8833":
        return {"board": board}
    return {"board": f"{board}_{driver.lower()}", "text": board_file(board, driver), "wheels": ENABLE[board]}


@pytest.mark.long
@pytest.mark.parametrize(
    ("arcade", "driver"),
    [value for driver in DRIVERS for value in repeated((of(board, driver), driver) for board in IN_IN)],
    indirect=["arcade"],
    ids=[f"{driver}-{board}" for driver in DRIVERS for board in IN_IN],
)
def test_every_driver_in_a_board_file_turns_ahead_and_back_and_brakes(arcade, driver):
    arcade.meet()
    arcade.send(arcade.sealed())
    arcade.run(0.004)
    assert arcade.motors == pytest.approx(ON, abs=1e-3)
    arcade.send(arcade.sealed(drive_packet(ARENA, 77, GO[1:])))
    arcade.run(0.004)
    assert arcade.motors == pytest.approx(BACK, abs=1e-3)
    arcade.run(0.3)
    assert arcade.motors == (0.0, 0.0)
    brake = [value for name, value in arcade.boards.pins[0].items() if name.isdigit() and int(name) not in (2, 34)]
    assert {bool(value) for value in brake} == {True}, "all inputs of a driver that brakes are high"
    assert {value for name, value in arcade.boards.pins[0].items() if "hertz" in name} == {HERTZ[driver]}


class Wheels:
    """Two motors that lag, each with an encoder whose pulses a board counts; `gains`: speed at full voltage."""

    def __init__(self, arcade, gains):
        self.arcade, self.gains = arcade, gains
        self.speeds, self.pulses, self.counted = [0.0, 0.0], [0.0, 0.0], [1.0, 1.0]

    def drive(self, seconds, command):
        """Drive for a while; returns the voltages at the motors meanwhile."""
        shares = []
        for step in range(round(seconds / 0.002)):
            if step % 10 == 0:
                self.arcade.seq += 1
                self.arcade.send(self.arcade.sealed(drive_packet(ARENA, self.arcade.seq, [command])))
            self.arcade.run(0.002)
            shares.append(self.arcade.motors)
            for i, gain in enumerate(self.gains):
                self.speeds[i] += (gain * shares[-1][i] - self.speeds[i]) * 0.002 / 0.08
                self.pulses[i] += abs(self.speeds[i]) * TOP * 0.002 * self.counted[i]
            self.arcade.boards.disturb(0, pulses=[int(total) for total in self.pulses])
        return shares


@pytest.mark.long
@pytest.mark.parametrize(
    "arcade",
    repeated(
        {"board": f"{board}_encoders", "text": board_file(board, "encoders"), "wheels": IN_IN[board]}
        for board in reversed(IN_IN)
    ),
    indirect=True,
)
def test_encoders_hold_the_speed_and_never_run_away(arcade):
    arcade.meet()
    wheels = Wheels(arcade, (0.8, 1.1))
    code = 32 / 63
    for command in (WheelCommand(0.5, -0.5), WheelCommand(-0.5, 0.5)):
        wheels.drive(3.0, command)
        assert [abs(speed) for speed in wheels.speeds] == pytest.approx([code, code], rel=0.03)
    wheels.counted = [0.0, 30.0]  # a dead encoder, and one that counts noise
    shares = wheels.drive(3.0, WheelCommand(-0.5, 0.5))
    assert all(-code - 0.2501 <= left <= -code and 0.0 <= right <= code for left, right in shares[200:])
    assert shares[-1] == pytest.approx((-code - 0.25, code - 0.25), abs=0.01)
    wheels.drive(0.1, WheelCommand(0.0, 0.0))
    assert arcade.motors == (0.0, 0.0)
    wheels.drive(0.1, WheelCommand(0.5, 0.5))
    arcade.run(0.21)
    for _ in range(50):
        assert arcade.motors == (0.0, 0.0)
        arcade.run(0.01)


@pytest.mark.long
@pytest.mark.parametrize("arcade", repeated([{"board": "board_pico_w"}, {"board": "board_esp32"}]), indirect=True)
def test_an_error_in_the_program_stops_the_motors_and_restarts_the_robot(arcade):
    arcade.meet()
    lamp, lit = "LED" if "pico" in arcade.config.board else "2", []
    for _ in range(100):
        arcade.run(0.02)
        lit.append(arcade.boards.pins[0][lamp])
    assert sum(before < after for before, after in pairwise(lit)) == 2, "it blinks once a second"
    arcade.drive(0.2)
    assert any(arcade.motors)
    assert arcade.boards.pins[0][lamp] == 1
    began = arcade.now
    arcade.boards.disturb(0, do="error")
    arcade.run(1.2)
    assert arcade.boards.powered_until[0] - began <= 0.01
    assert arcade.boards.resets == [(0, 3)]
    assert arcade.meet().flags & RESTARTED
    arcade.drive(0.1)
    assert any(arcade.motors)


@pytest.mark.long
def test_an_error_before_the_first_command_restarts_the_robot_too(arcade):
    arcade.meet()
    arcade.boards.disturb(0, do="error")
    arcade.run(3.5)
    assert arcade.boards.resets == [(0, 2)]
    assert arcade.meet()


@pytest.mark.long
def test_a_robot_without_commands_can_be_interrupted_to_change_its_files(arcade):
    arcade.meet()
    arcade.boards.disturb(0, do="interrupt")
    arcade.run(4.0)
    assert not arcade.boards.resets
    assert not arcade.received(b"PG2A")[4:], "the program has ended"


@pytest.mark.long
def test_ctrl_c_during_a_drive_stops_the_motors(arcade):
    arcade.meet()
    arcade.drive(0.1)
    began = arcade.now
    arcade.boards.disturb(0, do="interrupt")
    arcade.run(0.05)
    assert arcade.motors == (0.0, 0.0)
    assert arcade.boards.powered_until[0] - began <= 0.01


@pytest.mark.long
@pytest.mark.parametrize(
    "arcade", [{"board": "board_esp32_stalls", "text": STALLS, "wheels": IN_IN["board_esp32"]}], indirect=True
)
def test_a_command_that_stalls_until_after_the_deadman_is_braked(arcade):
    arcade.meet()
    arcade.send(arcade.sealed())
    arcade.run(0.32)
    for _ in range(20):
        assert arcade.motors == (0.0, 0.0)
        arcade.run(0.02)


@pytest.mark.long
@pytest.mark.parametrize("arcade", repeated({"board": board} for board in IN_IN), indirect=True)
def test_a_robot_switched_on_before_its_network_joins_it_later(arcade):
    arcade.boards.disturb(0, offline=1)
    arcade.run(20.0)
    assert not arcade.received(b"PG2A")
    assert not arcade.boards.resets
    arcade.boards.disturb(0, offline=0)
    arcade.meet()
    arcade.drive(0.1)
    assert any(arcade.motors)


WRONG: dict[str, tuple[dict[str, bytes | None], str]] = {  # what is wrong in the files of a robot, and what it prints
    "no config": ({"config.py": None}, "no module named 'config'"),
    "a syntax error": ({"config.py": b'ROBOT = 1\nNETWORK = "at home\n'}, 'config.py", line 2: SyntaxError'),
    "as by PowerShell's >": ({"config.py": "ROBOT = 2\r\n".encode("utf-16")}, 'config.py", line 1: SyntaxError'),
    "a line is missing": ({"config.py": b"ROBOT, ARENA, RADIO = 1, 77, 'wifi'"}, "'NETWORK'"),
    "no such robot": ({"config.py": b"ROBOT, ARENA = 5, 77"}, "ROBOT is 1 to 4"),
    "no such arena": ({"config.py": b"ROBOT, ARENA = 1, 16384"}, "ARENA 0 to 16383"),
    "no number": ({"config.py": b"ROBOT, ARENA = '1', 77"}, "TypeError"),
    "no radio file": ({"wifi.py": None}, "no module named 'wifi'"),
    "no board file": ({"board.py": None}, "no module named 'board'"),
}


@pytest.mark.long
@pytest.mark.usefixtures("micropython")
def test_a_robot_with_a_wrong_file_brakes_and_tells_why_in_one_line_while_its_lamp_flashes():
    configs = [BoardConfig(1, 77, bytes(16), 0, changed=changed) for changed, _ in WRONG.values()]
    lamps = [""] * len(configs)
    with Boards(configs, paced=True) as boards:
        for step in range(80):
            boards.advance(0.05 * step)
            lamps = [lamp + str(pins.get("2")) for lamp, pins in zip(lamps, boards.pins, strict=True)]
        for robot, (changed, words) in enumerate(WRONG.values()):
            printed = list(boards.printed[robot])
            assert printed == ["The robot cannot start. " + printed[0].partition(". ")[2]] * 2, "every 3 s"
            assert words in printed[0]
            assert "Traceback" not in printed[0]
            if "board.py" not in changed:
                assert [boards.pins[robot][pin] for pin in ("25", "26", "32", "33")] == [65535] * 4, "it brakes"
                assert lamps[robot].count("01") >= 8
            boards.disturb(robot, do="interrupt")
        for step in range(80, 160):
            boards.advance(0.05 * step)
        assert not boards.resets
        assert [len(lines) for lines in boards.printed] == [3] * len(configs), "Ctrl-C ends it, for repair by USB"


@pytest.mark.long
def test_no_datagram_ends_the_program_or_moves_a_motor(arcade):
    """Rubbish of strangers, and what whoever has the key could send by mistake; then the last counter that there is."""
    arcade.meet()
    chance = Random(1)
    sizes = [*range(1, 64, 3), 127, 128, 129, 1400]
    for size in sizes:
        for head in (b"PG2D", b"PG2T", b"PG2A", b""):
            arcade.send((head + chance.randbytes(size))[: max(size, len(head))])
        arcade.send(arcade.sealed(chance.randbytes(size)))
        arcade.run(0.006)
        assert arcade.motors == (0.0, 0.0), size
    packet = bytearray(arcade.packet())
    for place in range(len(packet)):
        for bit in range(8):
            broken = bytes(packet[:place]) + bytes([packet[place] ^ 1 << bit]) + bytes(packet[place + 1 :])
            arcade.send(arcade.sealed(broken))
            arcade.run(0.002)
            assert arcade.motors == (0.0, 0.0), place
    arcade.drive(0.1)
    assert any(arcade.motors)
    arcade.run(0.3)
    last = arcade.sealed(drive_packet(ARENA, arcade.seq + 1, GO), counter=(1 << 64) - 1)
    assert arcade.moves(last)
    assert not arcade.moves(last)
    assert arcade.meet().counter == (1 << 64) - 1
    assert not arcade.boards.resets


@pytest.mark.long
def test_a_flood_of_forged_commands_leaves_the_deadman_and_the_arcade_alone(arcade):
    arcade.meet()
    forged = [arcade.sealed(key=bytes(16)) for _ in range(100)]
    for _ in range(20):
        for datagram in forged:
            arcade.send(datagram)
        arcade.drive(0.02)
        assert any(arcade.motors)
    ended = arcade.now - 0.02
    for _ in range(20):
        for datagram in forged:
            arcade.send(datagram)
        arcade.run(0.02)
    assert 0.2 <= arcade.boards.powered_until[0] - ended <= 0.22
    assert arcade.motors == (0.0, 0.0)
    assert not arcade.boards.resets


def test_the_program_of_a_robot_has_at_most_400_lines():
    boards = [path.name for path in PROGRAM.glob("board_*.py")]
    for board in boards:
        for radio in ("wifi.py", "serial_radio.py"):
            files = ("robot.py", "motors.py", "config_example.py", board, radio)
            assert sum(len((PROGRAM / file).read_text("utf-8").splitlines()) for file in files) <= 400
    assert sum(len((PROGRAM / file).read_text("utf-8").splitlines()) for file in ("start.py", "update.py")) <= 170
