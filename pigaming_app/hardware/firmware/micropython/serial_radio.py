"""Radio on a serial line: an XBee in transparent mode (AP=0) on the UART of the board file, 57600 baud."""

from machine import UART, Pin

DRIVE, LENGTH = 0xD1, 18  # head and bytes of a drive packet


class Radio:
    """Packets in a stream of bytes; a byte from 80 (hex) on starts one."""

    def __init__(self, robot):
        uart, tx, rx = robot.board.UART
        self.line = UART(uart, baudrate=57600, tx=Pin(tx), rx=Pin(rx, Pin.IN, Pin.PULL_UP), rxbuf=256)
        self.buffer = bytearray()

    def receive(self):
        """The next complete drive packet, not yet checked, or None."""
        waiting = self.line.any()
        for byte in self.line.read(waiting) if waiting else b"":
            if byte >= 0x80:
                self.buffer = bytearray()
            if byte == DRIVE or (byte < 0x80 and self.buffer):
                self.buffer.append(byte)
            if len(self.buffer) == LENGTH:
                packet, self.buffer = bytes(self.buffer), bytearray()
                return packet  # at most one is under way: the line carries 50 of them a second
        return None

    def send(self, report):
        self.line.write(report)

    def work(self, now):
        """Nothing to do between packets."""
