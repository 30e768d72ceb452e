"""`robots setup`: a board on USB becomes a robot; and the robot then drives in the emulated network."""

import os
import re
import shlex
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

from pigaming_app.hardware.commissioning import board_setup
from pigaming_app.hardware.commissioning.boards.usb import BoardOnUsb
from pigaming_app.hardware.emulator.wifi.boards import NoMicroPython, interpreter
from pigaming_app.hardware.emulator.wifi.usb import UsbBoard
from pigaming_app.hardware.radio.xbee_setup import MODES
from pigaming_app.hardware.robot_kinds import KINDS, robot_kind
from pigaming_app.jobs.cli import Parser
from pigaming_app.jobs.mat import robots
from pigaming_app.jobs.mat.robots import RobotsOptions, usb_setup
from pigaming_app.jobs.mat.sessions import require_driver
from pigaming_app.jobs.terminal.options import declare_job
from pigaming_app.jobs.terminal.refusal import Refusal
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.web import wifi

XBEES = {"3pi_2040", "zumo_2040"}
ROOT = Path(__file__).resolve().parents[3]


def kinds(home: Path) -> list[str]:
    """Those of the settings in this folder."""
    return Settings.load(home / "config")[0].kinds


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
        (
            ("--board", "zumo"),
            "choose from 'pico_w', 'kit', 'esp32', '3pi_2040', 'zumo_2040', 'microbit'",
        ),
        (("a", "b", "--network", "x"), "one word more"),
        (("/dev/nothing", "--network", "x"), "/dev/nothing is gone or in use"),
        (("--network", "x", "--robot", "5"), "is more than 4"),
        (("/dev/nothing", "--network", 33 * "x"), "a name has at most 32 letters"),
    ],
)
def test_what_cannot_be_set_up_is_refused_in_one_line(tmp_path: Path, words: tuple[str, ...], said: str) -> None:
    done = setup(tmp_path, *words)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_a_device_that_never_stops_sending_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line each 20 ms, for 20 s."""
    pytest.importorskip("mpremote", reason="the extra `hardware` is not installed")
    pty = pytest.importorskip("pty", reason="no pseudo-terminals here")
    monkeypatch.setattr(board_setup, "AGAIN", 0.0)
    monkeypatch.setattr("pigaming_app.hardware.commissioning.boards.usb.ENTERS", 0.5)
    master, slave = pty.openpty()
    ends = threading.Event()

    def talk() -> None:
        for _ in range(1000):
            os.write(master, b"Hello\n")
            if ends.wait(0.02):
                return

    talker = threading.Thread(target=talk)
    talker.start()
    began = time.monotonic()
    with pytest.raises(Refusal, match="No MicroPython answers at"):
        usb_setup.set_up(RobotsOptions(), ["setup", os.ttyname(slave)])
    assert time.monotonic() - began < 5.0
    ends.set()
    talker.join()
    os.close(master)
    os.close(slave)


@pytest.mark.long
def test_a_board_at_a_port_becomes_robot_three(tmp_path: Path) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard() as usb:
        nameless = setup(tmp_path, usb.port, "--board", "pico_w", "--no-wait")
        assert nameless.returncode == 2
        assert "joins a Wi-Fi" in nameless.stderr
        usb.plug()
        unknown = setup(tmp_path, usb.port, "--network", "Schule", "--no-wait")
        assert unknown.returncode == 2
        assert "is unknown: choose pico_w, kit, esp32, 3pi_2040" in unknown.stderr
        assert f"as plain text in {tmp_path}" in unknown.stdout
        usb.plug()
        words = (usb.port, "--network", "Schule", "--robot", "3", "--board", "kit", "--no-wait")
        done = setup(tmp_path, *words, typed="")
        assert done.returncode == 0, done.stderr
        assert done.stdout.count("written") == 7
        assert "main.py robots --radio udp --wheels 3" in done.stdout
        assert "geheim" not in done.stdout + done.stderr
        usb.plug()
        with BoardOnUsb(usb.port) as board:
            told = board.ask("import config\nprint(config.ROBOT, config.NETWORK, config.PASSWORD, len(config.KEY))")
    assert told == "3 Schule geheim 32"
    assert kinds(tmp_path) == ["", "", "kit", ""]


def test_a_robot_counts_as_wide_as_its_board_says(home: Path) -> None:
    """Half the diagonal of Pololu's 99 mm square; docs/kit.md: a diameter of 95 mm. Any Pico W may be a kit's."""

    def after(robot: int, board: str) -> float:
        usb_setup.save_kind(robot, board)
        kept = Settings.load(folders().config)[0].kinds
        assert all(kind in (*(one.key for one in KINDS), "") for kind in kept)
        return robot_kind(kept[robot - 1]).radius_mm

    assert after(2, "zumo_2040") == pytest.approx(99 / 2**0.5, abs=0.1)
    assert after(2, "pico_w") == 60.0
    assert after(2, "kit") == 95 / 2
    assert after(2, "pico_w") == 95 / 2
    assert after(2, "esp32") == 60.0
    assert after(3, "cutebot") == 75.0
    assert Settings.load(folders().config)[0].kinds == ["", "esp32", "cutebot", ""]
    assert {*board_setup.KINDS} - {"relay"} <= {kind.key for kind in KINDS}


@pytest.mark.parametrize("radio", ["api2", "transparent", "udp"])
@pytest.mark.parametrize("board", board_setup.KINDS)
def test_what_is_printed_as_the_next_step_is_a_command(
    home: Path, capsys: pytest.CaptureFixture[str], board: str, radio: str
) -> None:
    settings = Settings(radio=radio)
    settings.save(folders().config)
    usb_setup._print_next(RobotsOptions(robot=3, no_wait=True), board)
    commands = re.findall(r": python3 main\.py robots (.*)", capsys.readouterr().out)
    assert len(commands) == (2 if board in XBEES else 1)
    for command in commands:
        parser = Parser(allow_abbrev=False)
        declare_job(parser, robots)
        asked = parser.parse_args(shlex.split(command))
        if asked.check != ["setup"]:
            driver = require_driver(asked.radio)
            assert asked.radio_setup is None or driver.name in MODES
            assert 3 in (asked.wheels, asked.radio_setup)


@pytest.mark.long
def test_a_pololu_becomes_robot_two_without_a_network(tmp_path: Path) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard() as usb:
        done = setup(tmp_path, usb.port, "--robot", "2", "--board", "zumo_2040", typed="")
        assert done.returncode == 0, done.stderr
        assert [line.split()[0] for line in done.stdout.splitlines() if "written" in line] == [
            *("motors.py", "serial_radio.py", "robot.py", "board.py", "config.py", "main.py")
        ]
        assert "python3 main.py robots --radio api2 --radio-setup 2" in done.stdout
        usb.plug()
        with BoardOnUsb(usb.port) as board:
            told = board.ask("import config\nprint(config.ROBOT, config.RADIO, config.ARENA > 0)")
    assert told == "2 serial_radio True"
    assert kinds(tmp_path) == ["", "zumo_2040", "", ""]


@pytest.mark.parametrize("keyring", ["Drawer", "Locked"])
def test_the_password_is_typed_once_and_where_it_is_kept_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], keyring: str
) -> None:
    """The port is none, which is found out only after the Wi-Fi was typed."""
    pytest.importorskip("keyring", reason="the extra `keyring` is not installed")
    pytest.importorskip("mpremote", reason="the extra `hardware` is not installed")
    monkeypatch.setenv("PIGAMING_HOME", str(tmp_path))
    monkeypatch.setenv("PYTHON_KEYRING_BACKEND", f"tests.ui.web.keyrings.{keyring}")
    monkeypatch.setenv("KEYRING_DRAWER", str(tmp_path / "drawer"))
    monkeypatch.setattr(board_setup, "AGAIN", 0.0)
    prompts: list[str] = []

    def told(types: str, **options: Any) -> str:
        """What is printed when somebody is there who types."""

        def typed(prompt: str, job: str) -> str:
            prompts.append(prompt)
            return types

        monkeypatch.setattr(usb_setup, "typed", typed)
        wifi._keyring.cache_clear()
        wifi._found.clear()
        wifi._asked.clear()
        with pytest.raises(Refusal, match="gone or in use"):
            usb_setup.set_up(RobotsOptions(**options), ["setup", "/dev/nothing"])
        return capsys.readouterr().out

    first = told("geheim", network="Schule")
    again = told("falsch", network="Schule") + told("falsch")
    assert prompts == ["Password of Schule: "], "it is not asked for a second time"
    assert "falsch" not in again
    settings = tmp_path / "config" / "settings.toml"
    if keyring == "Drawer":
        assert "The password is in the system's keyring." in first
        assert "geheim" not in settings.read_text()
        assert "geheim" in (tmp_path / "drawer").read_text()
    else:
        assert f"No keyring: the password is saved as plain text in {settings}." in first
        assert 'phones_wifi_key = "geheim"' in settings.read_text()
    told("anders", password=True)
    assert "anders" in (tmp_path / "drawer" if keyring == "Drawer" else settings).read_text()
    wifi._keyring.cache_clear()


@pytest.mark.long
@pytest.mark.again
def test_a_microbit_becomes_robot_two_and_is_tried_on_blocks(tmp_path: Path) -> None:
    try:
        interpreter()
    except NoMicroPython as reason:
        pytest.skip(str(reason))
    with UsbBoard("microbit") as usb:
        done = setup(tmp_path, usb.port, "--robot", "2", "--on-blocks", typed="")
        assert done.returncode == 0, done.stderr
        assert usb.motors[-1] == (0.0, 0.0)
    assert [line.strip() for line in done.stdout.splitlines()[1:]] == [
        "main.py      written",
        "microbit is robot 2",
        *("left wheel ahead", "right wheel ahead", "both wheels back", "lamp", "battery not measured"),
        "Then, on blocks: python3 main.py robots --radio relay --wheels 2",
    ]
