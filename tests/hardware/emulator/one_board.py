"""An arcade made of a UDP socket, and one emulated board with the robots' own program, in time of its own."""

import socket

from pigaming_app.hardware.emulator.wifi.boards import WIRING, BoardConfig, Boards
from pigaming_app.hardware.radio.envelope import DRIVE, REPORT, announcement_from, seal, unseal
from pigaming_app.hardware.radio.packets import drive_packet
from pigaming_app.hardware.signals import WheelCommand

ARENA, KEY = 1234, bytes(range(16))
GO = [WheelCommand(1.0, -0.5), WheelCommand(-1.0, 0.5)]
ON, BACK = (1.0, -32 / 63), (-1.0, 32 / 63)


class Arcade:
    """A UDP socket that drives one board in steps of 2 ms. `text`: a board file of another kind; `wheels`: its pins."""

    def __init__(self, text="", wheels=(), **about):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(2.0)
        self.config = BoardConfig(1, ARENA, KEY, self.socket.getsockname()[1], "Ruby")._replace(**about)
        wiring = WIRING
        if text:
            self.config = self.config._replace(changed={"board.py": text.encode()})
            wiring = {self.config.board: wheels}
        self.boards = Boards([self.config], paced=True, wiring=wiring)
        self.to, self.now, self.delivered = ("127.0.0.1", self.boards.ports[0]), 0.0, 0
        self.counter = self.seq = 0
        self.nonce = b""

    def run(self, seconds):
        for _ in range(round(seconds / 0.002)):
            self.now += 0.002
            self.boards.advance(self.now, [self.delivered])

    def drive(self, seconds):
        """Send a command each 20 ms."""
        for _ in range(round(seconds / 0.02)):
            self.send(self.sealed())
            self.run(0.02)

    def meet(self):
        """Wait for an announcement."""
        self.run(1.5)
        datagram = self.received(b"PG2A")[-1]
        found = announcement_from(datagram)
        assert found is not None
        assert unseal(KEY, found.nonce, b"A", datagram) is not None
        self.nonce = found.nonce
        return found

    def reports(self):
        """Counters and bodies of the reports that came."""
        return [unseal(KEY, self.nonce, REPORT, datagram) for datagram in self.received(b"PG2T")]

    def received(self, head):
        found = []
        self.socket.settimeout(0.05)
        try:
            while True:
                found.append(self.socket.recv(256))
        except TimeoutError:
            return [datagram for datagram in found if datagram.startswith(head)]

    def packet(self, arena=ARENA):
        self.seq += 1
        return drive_packet(arena, self.seq, GO)

    def sealed(self, packet=None, key=KEY, nonce=None, kind=DRIVE, counter=None):
        self.counter += 1
        counter = self.counter if counter is None else counter
        return seal(key, self.nonce if nonce is None else nonce, kind, counter, packet or self.packet())

    def send(self, datagram, by=None):
        (by or self.socket).sendto(datagram, self.to)
        self.delivered += 1

    def moves(self, datagram, by=None):
        """True if the datagram sets a standing robot in motion; it stands again after."""
        assert not any(self.motors)
        self.send(datagram, by)
        self.run(0.004)
        moving = any(self.motors)
        self.run(0.22)
        return moving

    @property
    def motors(self):
        return self.boards.motors(0)

    def close(self):
        self.boards.close()
        self.socket.close()
