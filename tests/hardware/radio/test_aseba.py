"""The driver of Thymios against Aseba itself: its machine, compiler, switch and simulated robots, all of Debian."""

import time
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from pigaming_app.hardware.drivers.conformance import Conformance
from pigaming_app.hardware.drivers.driver import LinkSite
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.emulator.thymio import Dongle, EmulatedThymio
from pigaming_app.hardware.proof.stands import NODES, ThymioStand
from pigaming_app.hardware.radio.aseba import AsebaDecoder, drive, message
from pigaming_app.hardware.radio.link import CommandLink
from pigaming_app.hardware.radio.packets import PARKED
from pigaming_app.hardware.radio.serial_line import serial_port
from pigaming_app.hardware.radio.thymio_program import linked
from pigaming_app.hardware.robot_kinds import PROGRAM
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.radio.thymios import (
    AsebaThymio,
    compiled,
    free_ports,
    needs_aseba,
    playground,
    running,
)

DRIVER = OURS["thymio"]
SOURCE = PROGRAM.parent / "thymio" / "robot.aesl"
ARENA = 4711
AHEAD = WheelCommand(0.5, 0.2)
PAUSE, SET_BYTECODE, RUN = 0xA004, 0xA001, 0xA003


@pytest.fixture
def stand() -> Iterator[ThymioStand]:
    """Emulated robots that have just stood for a while, with our program."""
    stand = ThymioStand(DRIVER, 3)
    passed(stand, 6.0, WheelCommand(0.0, 0.0))
    yield stand
    stand.close()


def passed(stand: ThymioStand, seconds: float, wheels: WheelCommand) -> None:
    for _ in range(round(seconds / 0.01)):
        stand.link.send([wheels] * stand.robots)
        stand.link.pump()
        stand.advance(0.01)


def driven(stand: ThymioStand) -> list[bool]:
    return [stand.powered(robot) for robot in range(stand.robots)]


@needs_aseba
def test_every_promise_is_kept_on_aseba_s_own_machine() -> None:
    stand = ThymioStand(DRIVER, 2, Dongle(NODES, 2, AsebaThymio))
    found = [*Conformance(DRIVER, stand).run()]
    assert [finding for finding in found if not finding.holds] == []
    assert len(found) == 9


class Shuffled(EmulatedThymio):
    """A firmware with its variables and events in another order."""

    layout = tuple(sorted(EmulatedThymio.layout, key=lambda one: (one[0][:1] != "e", one[0][::-1])))
    events = tuple(sorted(EmulatedThymio.events))


@needs_aseba
def test_the_program_is_what_aseba_compiles_from_its_source(tmp_path: Path) -> None:
    robot = 2
    numbers = {"ARENA": ARENA, "ROBOT": robot, "LEFT": 3 + 2 * robot, "RIGHT": 4 + 2 * robot}
    source = SOURCE.read_text("utf-8")
    for name, value in numbers.items():
        before = next(line for line in source.splitlines() if f'name="{name}"' in line)
        source = source.replace(before, f'<constant value="{value}" name="{name}"/>')
    dongle = Dongle((1,), 1, Shuffled)
    thymio = dongle.robots[0]
    end = sum(size for _, size in thymio.layout)
    ours = linked(thymio.places, end, thymio.events, ARENA, robot)
    table, theirs = ours[0], compiled(source, dongle, tmp_path)
    assert ours[table:] == theirs[table:]
    assert entries(ours) == entries(theirs)  # in any order


def entries(program: list[int]) -> set[tuple[int, int]]:
    return {*zip(program[1 : program[0] : 2], program[2 : program[0] : 2], strict=True)}


@needs_aseba
def test_the_emulated_machine_acts_as_aseba_s_own() -> None:
    random = Random(5)
    sent: tuple[list[tuple[int, bytes]], list[tuple[int, bytes]]] = ([], [])
    both = (
        EmulatedThymio(7, lambda kind, data: sent[0].append((kind, data))),
        AsebaThymio(7, lambda kind, data: sent[1].append((kind, data))),
    )
    places = both[0].places
    motors = places["motor.left.target"], places["motor.right.target"]
    words = linked(places, 90, EmulatedThymio.events, ARENA, 1)
    commands = [message(SET_BYTECODE, 7, 0, *words), message(RUN, 7)]
    for _ in range(3000):
        arena = ARENA if random.random() < 0.9 else 12
        wheels = [WheelCommand(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2))] * 4
        commands.append(drive(arena, random.randrange(4), random.randrange(-1, 4), wheels))
    for number, command in enumerate(commands):
        for one in both:
            one.receive(0, int.from_bytes(command[4:6], "little"), command[6:])
        pressed, ticks = number % 97 == 1 and random.randrange(2), random.choice((0, 0, 1, 7, 8, 9))
        for one in both:
            if number % 97 == 1:
                one["button.center"] = pressed
                one.event("button.center")
            for _ in range(ticks):
                one.event("timer0")
        used = [*range(places["event.args"], 34), *motors, *range(places["timer.period"], 95)]
        assert [both[0].variables[place] for place in used] == [both[1].variables[place] for place in used]
    reports = [[one for one in each if one[0] < 0x8000] for each in sent]
    assert reports[0] == reports[1]
    assert len(reports[0]) > 100


def test_reports_carry_battery_and_the_button(stand: ThymioStand) -> None:
    stand.dongle.robots[1]["button.center"] = 1
    stand.dongle.robots[1].event("button.center")
    passed(stand, 1.0, AHEAD)
    assert driven(stand) == [True, False, True, True]
    assert [stand.link.telemetry[robot].flags for robot in range(4)] == [0, PARKED, 0, 0]
    assert stand.link.telemetry[2].battery == pytest.approx(
        3.92, abs=0.01
    )  # 2 * 780 / 397.8, by the firmware's own sum


@pytest.mark.parametrize("kind", [AsebaThymio, EmulatedThymio])
def test_a_robot_that_somebody_halts_stands_and_gets_its_program_again(kind: type[EmulatedThymio]) -> None:
    if kind is AsebaThymio and needs_aseba.args[0]:
        pytest.skip(str(needs_aseba.kwargs["reason"]))
    stand = ThymioStand(DRIVER, 3, Dongle(NODES, 3, kind))
    passed(stand, 6.0, AHEAD)
    stand.dongle.put(message(PAUSE, sorted(NODES)[1]))
    passed(stand, 0.1, AHEAD)
    standing = False
    for _ in range(60):
        passed(stand, 0.01, AHEAD)
        standing |= driven(stand) == [True, False, True, True]
    assert standing
    assert all(driven(stand))


def test_robots_of_another_arcade_keep_their_program() -> None:
    dongle = Dongle(NODES, 4)
    theirs = linked(dongle.robots[0].places, 90, EmulatedThymio.events, 99, 3)
    for command in (message(SET_BYTECODE, dongle.robots[2].number, 0, *theirs), message(RUN, dongle.robots[2].number)):
        dongle.put(command)
    stand = ThymioStand(DRIVER, 4, dongle)
    for number in range(400):
        dongle.put(drive(99, number, 3, [AHEAD] * 4))
        passed(stand, 0.02, AHEAD)
    assert driven(stand)[2]
    assert dongle.robots[2].program[: len(theirs)] == theirs
    misfit = stand.link.misfit(3)
    assert misfit is not None
    assert misfit.arena == 99
    assert {*stand.link.telemetry} == {0, 1, 2}  # three robots are ours


def test_robots_keep_their_numbers_when_the_link_is_lost(stand: ThymioStand) -> None:
    stand.dongle.switch(0, False)
    stand.link._line._lose()  # type: ignore[attr-defined]
    passed(stand, 6.0, WheelCommand(0.0, 0.0))
    passed(stand, 0.5, AHEAD)
    assert driven(stand) == [False, True, True, True]


def test_the_decoder_survives_noise_between_messages() -> None:
    random = Random(8)
    for _ in range(200):
        decoder, sent = (
            AsebaDecoder(),
            [message(random.randrange(0x8000), *range(random.randrange(20))) for _ in range(5)],
        )
        stream = b"\xff\xff\xff" + b"".join(sent)
        cut = random.randrange(len(stream))
        received = [*decoder.feed(stream[:cut]), *decoder.feed(stream[cut:])]
        assert [one.encoded() for one in received] == sent
        assert decoder.garbage == 3


def paced(link: CommandLink, seconds: float, wheels: WheelCommand) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        link.send([wheels] * 4)
        link.pump()
        time.sleep(0.005)


@needs_aseba
@pytest.mark.long
def test_simulated_thymios_obey_through_aseba_s_switch(tmp_path: Path) -> None:
    """Aseba's playground, its switch over TCP, our driver; a second client reads the targets of the motors."""
    *robots, switch = free_ports(5)
    targets = [f"tcp:localhost;{port}" for port in robots]
    hub = ("asebaswitch", "-p", str(switch), *targets)
    with (
        running(*playground(robots, tmp_path), ports=robots, scratch=tmp_path),
        running(*hub, ports=[switch], scratch=tmp_path),
    ):
        port = serial_port(f"tcp:127.0.0.1:{switch}")
        link = DRIVER.open(LinkSite(ARENA, time.monotonic, "the switch", open_port=lambda _: port))
        watcher = port()
        paced(link, 5.0, AHEAD)
        assert {*link.telemetry} == {0, 1, 2, 3}
        assert link.fault is None
        stops = [stopped_after(link, watcher) for _ in range(4)]
        assert min(stops) <= 0.3  # a busy computer only makes it look later
        watcher.close()
        link.close()


def stopped_after(link: CommandLink, watcher: object) -> float:
    """Seconds of silence until all four motors' targets, which were 250 and 100, are 0."""
    paced(link, 1.0, AHEAD)
    assert targets(watcher) == {11 + i: (250, 100) for i in range(4)}
    began = time.monotonic()
    while any(map(any, targets(watcher).values())):
        assert time.monotonic() < began + 5.0
    return time.monotonic() - began


def targets(watcher: object) -> dict[int, tuple[int, int]]:
    """Targets of the motors by node: the words at 57 and 58 of the simulated firmware 11."""
    for node in range(11, 15):
        watcher.write(message(0xA00B, node, 57, 2))  # type: ignore[attr-defined]
    found: dict[int, tuple[int, int]] = {}
    decoder = AsebaDecoder()
    while len(found) < 4:
        for one in decoder.feed(watcher.read(watcher.in_waiting)):  # type: ignore[attr-defined]
            if one.kind == 0x9005:
                left, right = (int.from_bytes(one.data[i : i + 2], "little", signed=True) for i in (2, 4))
                found[one.node] = left, right
        time.sleep(0.001)
    return found


@pytest.mark.again
@needs_aseba
@pytest.mark.long
def test_a_simulated_thymio_that_restarts_gets_its_program_again(tmp_path: Path) -> None:
    [port] = free_ports(1)
    name = f"tcp:127.0.0.1:{port}"
    link = DRIVER.open(LinkSite(ARENA, time.monotonic, name, open_port=lambda _: serial_port(name)))
    for _ in range(2):
        with running(*playground([port], tmp_path), ports=[port], scratch=tmp_path):
            paced(link, 8.0, AHEAD)
            assert time.monotonic() - link.telemetry[0].received < 1.0
        paced(link, 1.0, AHEAD)
        assert link.fault is not None
    link.close()
