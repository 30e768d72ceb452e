"""The packet decoder of the firmware, compiled for this computer, and the arguments that `make flash` hands on."""

import re
import shutil
import subprocess
from random import Random

import pytest

from pigaming_app.hardware.radio.packets import drive_packet
from tests.hardware.corruption import corrupt_packets
from tests.hardware.firmware.board import AHEAD, FIRMWARE, HERE
from tests.hardware.wire import ARENA

PACKETS = 3_000_000
needs_gcc = pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc: apt-get install gcc")
needs_make = pytest.mark.skipif(shutil.which("make") is None, reason="no make: apt-get install make")


@pytest.fixture(scope="module")
def count(tmp_path_factory):
    """Function: the number of commands that the firmware accepts in these bytes."""
    program = tmp_path_factory.mktemp("commands") / "commands"
    sources = [HERE / "commands.c", FIRMWARE / "packets.c"]
    checks = ["-Wall", "-Werror", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    subprocess.run(["gcc", "-O2", *checks, f"-I{FIRMWARE}", "-o", program, *sources], check=True)
    return lambda data: int(subprocess.run([program], input=data, capture_output=True, check=True).stdout)


@needs_gcc
def test_of_corrupt_packets_none_becomes_a_command(count):
    good = drive_packet(ARENA, 1, [AHEAD] * 4)
    assert count(good * 20) == 20
    assert count(corrupt_packets(20_000).tobytes()) == 0


@needs_gcc
def test_no_stream_of_bytes_leaves_the_buffer(count):
    """The sanitizers end the program at the first access beyond it."""
    good, random = drive_packet(ARENA, 1, [AHEAD] * 4), Random(1)
    assert count(good + bytes(1000) + good) == 2
    assert count((good[:1] + bytes(100)) * 100 + good) == 1
    assert count(random.randbytes(300_000) + good) >= 1
    assert count(b"".join(good[: random.randrange(18)] + good for _ in range(1000))) == 1000


@needs_gcc
@pytest.mark.long
def test_of_three_million_corrupt_packets_none_becomes_a_command(count):
    assert sum(count(corrupt_packets(PACKETS // 10, seed).tobytes()) for seed in range(10)) == 0


@needs_make
@pytest.mark.parametrize(
    ("arguments", "written"),
    [
        ("ADDRESS=2 ARENA=4711", "eeprom:w:0x02,103,18:m"),
        ("ADDRESS=4 ARENA=16383", "eeprom:w:0x04,255,63:m"),
        ("ADDRESS=5 ARENA=1", "ADDRESS is the robot's number"),
        ("ADDRESS=2", "ARENA is the arcade's arena number"),
        ("ADDRESS=2 ARENA=16384", "ARENA is the arcade's arena number"),
        ("ADDRESS=2 ARENA=x", "ARENA is the arcade's arena number"),
    ],
)
def test_flashing_writes_number_arena_and_brown_out_fuse(arguments, written, tmp_path):
    """4711 is 18 * 256 + 103. Only the extended fuse is written: the others set the clock.

    Its bits 2 to 0, BODLEVEL, are 100 for 4.3 V; bits 7 to 3 are unused and read as 1 (data sheet of the ATmega328P:
    extended fuse byte, BODLEVEL fuse coding).
    """
    (tmp_path / "robot.hex").touch()
    make = ["make", "-s", "-C", FIRMWARE, "flash", f"BUILD={tmp_path}", "AVRDUDE=echo", *arguments.split()]
    hex_is_new = ["-o", str(tmp_path / "robot.elf"), "-o", str(tmp_path / "robot.hex")]
    result = subprocess.run([*make, *hex_is_new], capture_output=True, text=True)
    assert written in result.stdout
    memories = re.findall(r"-U (\S+?):", result.stdout)
    assert memories == (["flash", "eeprom", "efuse"] if result.returncode == 0 else [])
    assert ("efuse:w:0xFC:m" in result.stdout) == (result.returncode == 0)
    assert 0xFC == 0b11111_100
