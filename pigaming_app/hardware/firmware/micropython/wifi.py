"""Radio by Wi-Fi: drive packets and reports in UDP datagrams with a message code.

A datagram is `PG2`, kind, counter (8 bytes), body, code (8 bytes). The code is the start of HMAC-SHA-256 over the nonce
of this boot and all bytes before it, so a datagram from before the boot is void; a counter that does not grow is, too.
While commands of one sender arrive, those of others are ignored.
"""

import os
import socket
import struct
import time
from binascii import unhexlify
from hashlib import sha256

import config
import network

DRIVE, REPORT, ANNOUNCE, UPDATE, ANSWER = b"PG2D", b"PG2T", b"PG2A", b"PG2U", b"PG2V"
HEAD, CODE = 12, 8  # bytes
ANNOUNCE_MS, RECONNECT_MS = 1000, 8000
MOST = 64  # datagrams of strangers in one turn: a flood leaves time for the rest of the program


class Radio:
    """The network of `config`; announces the robot each second while nobody drives it."""

    def __init__(self, robot):
        self.robot = robot
        self.home, self.name = (config.NETWORK, config.PASSWORD), config.NAME.encode()[:16]
        self.everybody = config.HOST, config.PORT
        key = unhexlify(config.KEY) + bytes(48)
        self.inner, self.outer = bytes([b ^ 0x36 for b in key]), bytes([b ^ 0x5C for b in key])
        self.received = self.sent = 0  # counters of the newest datagrams
        self.owner = None  # address of the arcade whose command came last
        self.announced = self.tried = time.ticks_add(time.ticks_ms(), -RECONNECT_MS)
        self.station = network.WLAN(network.STA_IF)
        self.station.active(True)
        self.nonce = os.urandom(8)  # an ESP32 has true random numbers only while its radio is on
        try:
            self.station.config(pm=self.station.PM_NONE)  # no naps: they delay commands by 100 ms and more
        except (AttributeError, ValueError):
            print("power saving of the radio stays on: use a newer MicroPython")
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, getattr(socket, "SO_BROADCAST", 0x20), 1)
        self.socket.bind(("0.0.0.0", config.PORT))
        self.socket.setblocking(False)

    def code(self, data):
        return sha256(self.outer + sha256(self.inner + self.nonce + data).digest()).digest()[:CODE]

    def receive(self):
        """The next valid drive packet, or None. Other datagrams are dropped."""
        for _ in range(MOST):
            try:
                data, sender = self.socket.recvfrom(128)
            except OSError:
                return None
            kind, body = data[:4], data[HEAD:-CODE]
            if len(data) < HEAD + CODE or kind not in (DRIVE, UPDATE) or self.code(data[:-CODE]) != data[-CODE:]:
                continue
            counter = int.from_bytes(data[4:HEAD], "big")
            if counter > self.received and (sender == self.owner or self.robot.stopped):
                self.received, self.owner = counter, sender
                if kind == DRIVE:
                    return body
                self._send(ANSWER, __import__("update").answer(body, self.robot), sender)

    def send(self, report):
        """Send a report to the arcade that drives."""
        self._send(REPORT, report, self.owner)

    def work(self, now):
        """Join the network, announce the robot."""
        if not self.station.isconnected():
            if time.ticks_diff(now, self.tried) >= RECONNECT_MS:
                self.tried = now
                try:
                    self.station.connect(*self.home)
                except OSError as error:
                    print("an ESP32 goes on trying by itself:", error)
        elif self.robot.stopped and time.ticks_diff(now, self.announced) >= ANNOUNCE_MS:
            self.announced, robot = now, self.robot
            numbers = struct.pack(">HBBB", robot.arena, robot.address, robot.board.KIND, 2)
            state = struct.pack(">QHB", self.received, robot.millivolts, robot.flags())
            self._send(ANNOUNCE, numbers + self.nonce + state + self.name, self.everybody)

    def _send(self, kind, body, address):
        self.sent += 1
        data = kind + struct.pack(">Q", self.sent) + body
        try:
            self.socket.sendto(data + self.code(data), address)
        except OSError:
            return  # no network at present; the next one will do
