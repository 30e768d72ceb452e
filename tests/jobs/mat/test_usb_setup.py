"""`robots setup`: a board on USB becomes a robot; and the robot then drives in the emulated network."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pigaming_app.hardware.commissioning.board_setup import BoardOnUsb
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard

ROOT = Path(__file__).resolve().parents[3]


def setup(home: Path, *words: str, typed: str = "geheim\n") -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pigaming_app", "robots", "setup", *words]
    environment = {**os.environ, "PIGAMING_HOME": str(home)}
    return subprocess.run(
        command, cwd=ROOT, env=environment, input=typed, capture_output=True, text=True, check=False, timeout=120
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("/dev/nothing",), "/dev/nothing is gone or in use"),
        (("--board", "zumo"), "choose from 'pico_w', 'esp32', 'pololu_2040'"),
        (("a", "b", "--network", "x"), "one word more"),
        (("/dev/nothing", "--network", "x"), "/dev/nothing is gone or in use"),
        (("--network", "x", "--robot", "5"), "is more than 4"),
    ],
)
def test_what_cannot_be_set_up_is_refused_in_one_line(tmp_path: Path, words: tuple[str, ...], said: str) -> None:
    done = setup(tmp_path, *words)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.long
def test_a_board_at_a_port_becomes_robot_three(tmp_path: Path) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard() as usb:
        unknown = setup(tmp_path, usb.port, "--network", "Schule", "--no-wait")
        assert unknown.returncode == 2
        assert "is unknown: choose pico_w, esp32, pololu_2040" in unknown.stderr
        usb.plug()
        nameless = setup(tmp_path, usb.port, "--board", "pico_w", "--no-wait")
        assert nameless.returncode == 2
        assert "joins a Wi-Fi" in nameless.stderr
        usb.plug()
        words = (usb.port, "--network", "Schule", "--robot", "3", "--board", "pico_w", "--no-wait")
        done = setup(tmp_path, *words)
        assert done.returncode == 0, done.stderr
        assert done.stdout.count("written") == 7
        assert "main.py robots --radio udp --wheels 3" in done.stdout
        assert "geheim" not in done.stdout + done.stderr
        usb.plug()
        with BoardOnUsb(usb.port) as board:
            told = board.ask("import config\nprint(config.ROBOT, config.NETWORK, config.PASSWORD, len(config.KEY))")
    assert told == "3 Schule geheim 32"


@pytest.mark.long
def test_a_pololu_becomes_robot_two_without_a_network(tmp_path: Path) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard() as usb:
        done = setup(tmp_path, usb.port, "--robot", "2", "--board", "pololu_2040", typed="")
        assert done.returncode == 0, done.stderr
        assert [line.split()[0] for line in done.stdout.splitlines() if "written" in line] == [
            *("motors.py", "serial_radio.py", "robot.py", "board.py", "config.py", "main.py")
        ]
        assert "main.py robots --radio-setup 2" in done.stdout
        usb.plug()
        with BoardOnUsb(usb.port) as board:
            told = board.ask("import config\nprint(config.ROBOT, config.RADIO, config.ARENA > 0)")
    assert told == "2 serial_radio True"
