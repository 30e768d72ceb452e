"""Updates over the air in MicroPython's own interpreter: losses, forgeries, cuts of the power, programs that fail."""

from contextlib import suppress
from random import Random

import pytest

from pigaming_app.hardware.commissioning.air_update import AirUpdate, UpdateFailed, program
from pigaming_app.hardware.emulator.wifi.boards import BoardConfig, Boards
from pigaming_app.hardware.radio.envelope import DRIVE, UPDATE, seal
from pigaming_app.hardware.radio.packets import drive_packet
from pigaming_app.hardware.radio.wifi import WifiNetwork
from tests.hardware.emulator.one_board import ARENA, GO, KEY

pytestmark = [pytest.mark.long, pytest.mark.usefixtures("micropython")]

NEW = {**program(), "motors.py": program()["motors.py"] + b"\nNEWER = 1\n"}


class Desk(WifiNetwork):
    """The network of one board, in time of its own. `loss`: share of messages that get lost, either way."""

    def __init__(self, loss=0.0):
        self.now, self.delivered, self.loss, self.random = 0.0, 0, loss, Random(3)
        super().__init__(ARENA, KEY, lambda: self.now, 0, "127.0.0.1")
        self.open()
        self.board = Boards([BoardConfig(1, ARENA, KEY, self.bound, "Ruby")], paced=True)
        self.steps, self.printed = [], self.board.printed[0]
        self.call()

    def ask(self, address, body):
        self.delivered += 1
        if self.random.random() < self.loss:
            self.delivered -= 1
            self._sessions[address].sent += 1
            return
        super().ask(address, body)

    def answer(self, address):
        answer = super().answer(address)
        if answer is not None and self.random.random() < self.loss:
            self._answers.clear()
            return None
        return answer

    def pause(self, seconds):
        for _ in range(max(1, round(seconds / 0.02))):
            self.now += 0.02
            self.board.advance(self.now, [self.delivered])

    def call(self):
        """Wait until the robot calls."""
        for _ in range(5000):
            self.pause(0.02)
            assert self.in_waiting >= 0
            if self.robots and self.now - self._sessions[1].heard < 0.1:
                return
        raise AssertionError("the robot does not call")

    def reboot(self):
        """Power off and on again."""
        self.board.disturb(0, do="reboot", cut=0)
        self.pause(5.0)
        self.call()

    def update(self, files):
        return AirUpdate(self, 1, self.pause, self.steps.append).run(files)

    def raw(self, kind, body, key=KEY, counter=None, nonce=None):
        """Send a datagram of any kind; what the robot answers."""
        session = self._sessions[1]
        session.sent += 1
        self._answers.clear()
        sealed = seal(key, nonce or session.announced.nonce, kind, counter or session.sent, body)
        assert self._socket is not None
        self._socket.sendto(sealed, session.address)
        self.delivered += 1
        self.pause(0.04)
        return super().answer(1)

    def drives(self):
        """True if a command turns the motors."""
        self.raw(DRIVE, drive_packet(ARENA, int(self.now * 50) % 100, GO))
        moving = any(self.board.motors(0))
        self.pause(4.0)
        self.call()
        return moving

    def end(self):
        self.board.close()
        self.close()


@pytest.fixture
def desk(request):
    desk = Desk(**getattr(request, "param", {}))
    yield desk
    desk.end()


@pytest.mark.parametrize("desk", [{}, {"loss": 0.2}], indirect=True)
def test_a_robot_gets_the_program_keeps_it_and_drives(desk):
    assert desk.drives()
    assert desk.update(NEW)
    assert desk.steps == ["robot.py", "motors.py", "wifi.py", "update.py", "restart", "keep"]
    assert len(desk.board.resets) == 2
    assert desk.drives()
    assert not desk.update(NEW)
    desk.reboot()
    assert not desk.update(NEW), "it stays"
    assert desk.update(program()), "and the next one goes into the other folder"
    assert desk.drives()
    assert desk.raw(UPDATE, b"Q")[1:3] == b"\1b"


BROKEN = {
    "a syntax error": {**program(), "robot.py": b"def main(watchdog:\n"},
    "no radio": {**program(), "wifi.py": b"class Radio:\n    pass\n"},
    "it hangs at its start": {**program(), "motors.py": b"import time\nwhile True:\n    time.sleep_ms(10)\n"},
    "it ends": {**program(), "robot.py": b"def main(watchdog):\n    pass\n"},
    "it never calls": {
        **program(),
        "wifi.py": program()["wifi.py"]
        .replace(b"ANNOUNCE_MS, R", b"_, R", 1)
        .replace(b"= 1000, 8000", b"= 0, 8000\nANNOUNCE_MS = 1 << 28"),
    },
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_program_that_does_not_call_is_left_for_the_one_before(desk, fault):
    with pytest.raises(UpdateFailed) as failed:
        desk.update(BROKEN[fault])
    assert failed.value.message.key == "air_returned"
    assert len(desk.board.resets) == 2, "once for the trial, once to come back"
    assert desk.drives()
    assert desk.update(NEW)


def test_nothing_forged_repeated_or_damaged_is_written(desk):
    assert desk.raw(UPDATE, b"Q")[:3] == b"Q\1-"
    assert desk.raw(UPDATE, b"Nmotors.py", key=bytes(16)) is None
    assert desk.raw(UPDATE, b"Nmotors.py", counter=1) is None
    assert desk.raw(UPDATE, b"Nmotors.py", nonce=bytes(8)) is None
    for name in (b"config.py", b"main.py", b"board.py", b"../main.py", b"kept", b"\xff"):
        assert desk.raw(UPDATE, b"N" + name) == b"N\0", name
    for word in (b"T", b"K", b"X", b"", b"E" + bytes(32)):
        assert desk.raw(UPDATE, word)[-1:] == b"\0", word
    assert desk.raw(UPDATE, b"Nmotors.py") == b"N\1"
    assert desk.raw(UPDATE, b"D\0\0\0\5abc") == b"D\1\0\0\0\0"
    assert desk.raw(UPDATE, b"D\0\0\0\0abc") == b"D\1\0\0\0\3"
    assert desk.raw(UPDATE, b"D\0\0\0\0abc") == b"D\1\0\0\0\3"
    assert desk.raw(UPDATE, b"E" + bytes(32)) == b"E\0", "another hash"
    assert desk.raw(UPDATE, b"T") == b"T\0"
    assert not desk.board.resets
    assert desk.drives()


def test_a_robot_that_is_driven_or_was_lately_refuses(desk):
    for _ in range(10):
        desk.raw(DRIVE, drive_packet(ARENA, int(desk.now * 50) % 100, GO))
        assert desk.raw(UPDATE, b"Q") == b"Q\0"
        assert any(desk.board.motors(0))
    desk.pause(2.0)
    assert desk.raw(UPDATE, b"Nmotors.py") == b"N\0"
    desk.pause(1.5)
    assert desk.raw(UPDATE, b"Nmotors.py") == b"N\1"


@pytest.mark.again
def test_a_cut_of_the_power_after_any_change_of_the_disk_leaves_a_robot_that_drives(desk):
    """Each time the next attempt succeeds; between them the other program is given, so that all is written anew."""
    for turn in range(40):
        wanted = program() if turn % 2 else NEW
        desk.board.disturb(0, cut=turn + 1)
        with suppress(UpdateFailed):
            desk.update(wanted)
            break
        desk.reboot()
        if turn % 4 == 0:
            assert desk.drives(), turn
        desk.update(wanted)
        assert not desk.update(wanted)
    assert turn > 12, "each change has had its cut"
    assert desk.drives()
