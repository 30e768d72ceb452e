"""The firmware on a simulated ATmega328P, controlled over a pseudo-terminal.

All times are simulated; the processor stands still unless a test advances it, see board.c.
"""

import random

import pytest

from pigaming_app.hardware.radio import packets
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, LOW, RESTARTED, PacketDecoder, drive_packet
from pigaming_app.hardware.radio.xbee_protocol import XBeeMode, XBeeProtocol
from pigaming_app.hardware.signals import WheelCommand
from tests.hardware.firmware.board import AHEAD, BYTE, DRIVE_BYTES, REPORT_BYTES, Board, build, missing
from tests.hardware.wire import ARENA, drive_from, report_packet

pytestmark = pytest.mark.skipif(
    bool(missing()),
    reason=f"no {', '.join(missing())}: apt-get install gcc-avr avr-libc libsimavr-dev libelf-dev gcc make",
)
FULL = (256, 256)


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Executable of the board and ELF file of the firmware."""
    return build(tmp_path_factory.mktemp("firmware"))


@pytest.fixture
def make_board(built):
    boards = []

    def make(address=1, arena=ARENA):
        boards.append(Board(built, address, arena))
        return boards[-1]

    yield make
    for board in boards:
        board.close()


@pytest.fixture
def board(make_board):
    return make_board()


def duty(speed):
    """Duty of 256 for a speed from -63 to 63, after rounding to the eight-bit timer's 255 steps."""
    share = (abs(speed) * 255 + 31) // 63
    return 0 if speed == 0 else (share + 1) * (1 if speed > 0 else -1)


def test_thirty_of_thirty_commands_reach_the_motors(board):
    chance = random.Random(5)
    for seq in range(30):
        left, right = chance.randint(-63, 63), chance.randint(-63, 63)
        sent = board.at
        board.drive(seq, [WheelCommand(left / 63, right / 63)])
        happened = [event for event in board.run(20) if event.kind == "motors"]
        assert board.motors == (duty(left), duty(right))
        assert all(event.at - sent < DRIVE_BYTES * BYTE + 2000 for event in happened)


@pytest.mark.parametrize("address", [1, 2, 3, 4])
def test_every_robot_takes_its_own_wheels(make_board, address):
    board = make_board(address)
    board.keep([1], [WheelCommand(n / 63, -n / 63) for n in (10, 20, 30, 40)])
    assert board.motors == (duty(10 * address), duty(-10 * address))


def test_a_robot_that_is_off_brakes_and_others_do_not_move_it(board):
    board.keep([1])
    assert board.motors == FULL
    board.keep([2], [None, AHEAD, AHEAD, AHEAD])
    assert board.motors == (0, 0)


@pytest.mark.parametrize("address", [0, 5, 255])
def test_a_robot_without_an_address_neither_drives_nor_speaks(make_board, address):
    board = make_board(address)
    board.drive(10)
    board.run(400)
    assert {event.kind for event in board.events if event.at > 1000} == set()


def test_another_arena_neither_drives_a_robot_nor_feeds_its_deadman(board):
    """Its stop does not brake, its drive does not keep motors on; nor do such packets take part in the time slots."""
    sent = board.at
    board.keep([1])
    for seq in range(2, 20):
        board.drive(seq, [None] * 4 if seq < 5 else [AHEAD], arena=ARENA + 1)
        board.run(20)
        assert seq > 5 or board.motors == FULL
    (stop,) = [event for event in board.events if event.kind == "motors" and event.at > sent + 10_000]
    assert stop.motors == (0, 0)
    assert stop.at - sent < 255_000


def test_a_repeated_packet_neither_drives_nor_feeds_the_deadman(board):
    sent = board.at
    board.keep(7 for _ in range(30))
    start, stop = [event for event in board.events if event.kind == "motors" and event.at > sent]
    assert (start.motors, stop.motors) == (FULL, (0, 0))
    assert stop.at - sent < 256_000
    board.keep([8])
    assert board.motors == FULL


@pytest.mark.parametrize("arena", [0, 16384, 0xFFFF])
def test_a_robot_without_an_arena_does_not_drive_but_says_so(make_board, arena):
    board = make_board(2, arena)
    board.keep(range(30), arena=max(1, arena & 0x3FFF))
    assert board.motors == (0, 0)
    reports = [report for _, report in board.reports()]
    assert {(report.arena, report.address, report.version) for report in reports} == {(0, 2, 2)}


def test_the_receiving_line_is_pulled_up(board):
    assert board.do("rx")[-1].motors == (1,)


def test_the_motors_stop_250_ms_after_the_last_packet(board):
    for seq in range(1, 10):
        sent = board.at
        board.drive(seq)
        board.run(20)
    (stop,) = [event for event in board.run(400) if event.kind == "motors"]
    assert stop.motors == (0, 0)
    assert stop.at - (sent + DRIVE_BYTES * BYTE) == pytest.approx(250_000, abs=1500)


def test_noise_and_broken_packets_do_not_keep_it_going(board):
    chance = random.Random(5)
    sent = board.at
    board.keep([1])
    broken = bytearray(drive_packet(ARENA, 2, [AHEAD]))
    broken[6] ^= 1
    for _ in range(20):
        board.say(bytes(broken) + chance.randbytes(20))
        board.run(20)
    (stop,) = [event for event in board.events if event.kind == "motors" and event.at > sent + 10_000]
    assert stop.at - sent < 255_000
    assert board.motors == (0, 0)


def scraps(chance):
    """Bytes between packets: noise, a truncated packet, a packet with a bit error, a report, or nothing."""
    packet = bytearray(drive_packet(ARENA, chance.randrange(128), [AHEAD]))
    wrong = bytearray(packet)
    wrong[chance.randrange(DRIVE_BYTES)] ^= 1 << chance.randrange(8)
    report = report_packet(packets.RobotReport(ARENA, 2, packets.VERSION, 1, 0, 5000))
    return chance.choice((chance.randbytes(9), packet[: chance.randrange(DRIVE_BYTES)], wrong, report, b""))


@pytest.mark.parametrize("seed", range(4))
def test_of_a_torn_stream_robot_and_computer_understand_the_same(board, seed):
    chance, decoder = random.Random(seed), PacketDecoder()
    expected = (0, 0)
    for seq in range(50):
        wheels = WheelCommand(chance.randint(-63, 63) / 63, chance.randint(-63, 63) / 63)
        stream = scraps(chance) + drive_packet(ARENA, seq, [wheels]) + scraps(chance)
        board.say(stream)
        board.run(len(stream) * BYTE / 1000 + 3)
        for packet in decoder.feed(stream):
            if packet[0] == packets.DRIVE:
                first = drive_from(packet).wheels[0] or WheelCommand(0.0, 0.0)
                expected = tuple(duty(round(63 * share)) for share in first)
        assert board.motors == expected


def test_the_speed_that_nobody_sends_is_a_stop(board):
    packet = bytes((packets.DRIVE, *packets.in_7_bits(ARENA, 2), 1, 1, 0x7F, 0x7E)) + b"\x3f" * 6
    board.say(packets.with_crc(packet))
    board.run(20)
    assert board.motors == (0, 256)


def test_when_the_program_hangs_the_watchdog_stops_the_motors(board):
    """The timer interrupt runs and packets arrive, but the main loop hangs."""
    board.keep([1])
    hung = board.at
    board.do("hang")
    board.keep(2 + seq for seq in range(15))
    (reset,) = [event for event in board.events if event.kind == "reset" and event.at]
    assert reset.at - hung < 140_000
    board.run(1000)
    stop = next(event for event in board.events if event.kind == "motors" and event.at >= reset.at)
    assert stop.motors == (0, 0)
    assert stop.at - hung < 140_000
    assert board.reports()[-1][1].flags == DEADMAN | RESTARTED


def test_without_a_hang_there_is_no_restart(board):
    board.run(2000)
    assert [event for event in board.events if event.kind == "reset" and event.at] == []
    assert {report.flags for _, report in board.reports()} == {DEADMAN}


@pytest.mark.parametrize("address", [1, 2, 3, 4])
def test_reports_come_five_times_a_second_each_robot_in_its_slot(make_board, address):
    """Counted from the end of a packet whose number is divisible by 10. Two in five of these are lost."""
    board = make_board(address)
    begun = {}
    board.run(33)
    board.reports()
    for seq in range(100):
        begun[seq] = board.at + DRIVE_BYTES * BYTE
        if seq % 10 or seq in (0, 30, 50, 80, 90):
            board.drive(seq)
        board.run(20)
    reports = [(at, report) for at, report in board.reports() if at > begun[10]]
    assert len(reports) == 9
    for at, report in reports:
        slot = min(abs(at - begun[seq] - REPORT_BYTES * BYTE - 10_000 * (address - 1)) for seq in range(0, 100, 10))
        assert slot < 2500
        assert report.address == address
        assert report.flags == 0


@pytest.mark.parametrize("millivolts", [4450, 4800, 5500])
def test_the_battery_is_reported(board, millivolts):
    board.do(f"battery {millivolts}")
    board.run(3000)
    report = board.reports()[-1][1]
    assert report.millivolts == pytest.approx(millivolts, abs=8)  # a step of the converter is 7.3 mV
    assert report.flags == DEADMAN


def test_a_low_battery_is_told_and_an_empty_one_stops_the_motors(board):
    def drive(milliseconds):
        board.keep(seq % 128 for seq in range(milliseconds // 20))
        return board.motors, board.reports()[-1][1].flags

    board.do("battery 4300")
    assert drive(2000) == (FULL, LOW)
    board.do("battery 3900")
    assert drive(2000) == ((0, 0), LOW | EMPTY)
    board.do("battery 4200")  # it recovers without load
    assert drive(2000) == ((0, 0), LOW | EMPTY)
    board.do("battery 5200")
    assert drive(2000) == (FULL, 0)


def test_a_short_sag_of_the_battery_is_no_reason_to_stop(board):
    board.do("battery 3500")
    board.keep(range(5))
    board.do("battery 5000")
    assert board.motors == FULL


class Terminal:
    """The board's serial port for a Link; every byte is delivered before time advances."""

    def __init__(self, board):
        self.board = board

    @property
    def in_waiting(self):
        return self.board.port.in_waiting

    def read(self, size=1):
        return self.board.port.read(size)

    def write(self, data):
        self.board.say(data)

    def close(self):
        pass


@pytest.mark.parametrize("end", ["closed", "silent", "killed"])
def test_the_whole_way_from_the_link_to_the_motors(make_board, end):
    """Closed: the link sends stop. Silent: no more commands. Killed: the link ends at once, as with kill -9, and only
    the robot's deadman is left."""
    board = make_board(3)
    link = Link(lambda: Terminal(board), lambda: board.at / 1e6, XBeeProtocol(ARENA, XBeeMode.TRANSPARENT))
    for _ in range(50):
        link.send([None, AHEAD, WheelCommand(0.5, -1.0)])
        link.pump()
        board.run(10)
    assert board.motors == (duty(32), -256)
    assert link.telemetry[2].battery == pytest.approx(5.0, abs=0.01)
    assert (echo := link.quality(2).echo) is not None
    assert echo < 0.05
    assert link.fault is None
    ended = board.at
    if end == "closed":
        link.close()
    for _ in range(40):
        if end == "silent":
            link.pump()
        board.run(10)
    (stop,) = [event for event in board.events if event.kind == "motors" and event.at >= ended]
    assert stop.motors == (0, 0)
    assert stop.at - ended < {"closed": 5_000, "silent": 130_000, "killed": 260_000}[end]
