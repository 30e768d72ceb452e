"""Relay of PiGaming's micro:bit robots: passes drive packets from USB to the radio, and reports back.

For a micro:bit V2 on the computer's USB port, as its only file: `main.py robots setup --board relay` writes it,
`main.py robots --microbit 0` prints it with the number of the arena. To the arcade it is a transparent radio at 57600
baud. Bytes 03 end it, for another program: so many in a row as two packets without their heads would not be.
"""

import micropython
import radio
from microbit import display, sleep, uart

ARENA = 0  # id of the arena, 1 to 16383: the radio's channel and group follow from it
DRIVE, LENGTH, REPORT_LENGTH = 0xD1, 18, 14  # head and bytes of the packets
END = 3  # byte, Ctrl-C


class Packets:
    """Drive packets in a stream of bytes; a byte from 80 (hex) on starts one."""

    def __init__(self):
        self.buffer = bytearray(LENGTH)
        self.filled = self.ends = 0
        self.ended = False

    def feed(self, data):
        """The newest packet that these bytes complete, not yet checked, or None."""
        packet = None
        for byte in data:
            self.ends = self.ends + 1 if byte == END else 0
            self.ended = self.ended or self.ends > 2 * LENGTH
            if byte >= 0x80:
                self.filled = 0
            if byte == DRIVE or (byte < 0x80 and self.filled):
                self.buffer[self.filled] = byte
                self.filled += 1
            if self.filled == LENGTH:
                packet, self.filled = bytes(self.buffer), 0
        return packet


def main():
    """Run until the power is switched off, or until it is ended."""
    micropython.kbd_intr(-1)  # a byte 03 is data here, not Ctrl-C
    uart.init(baudrate=57600)
    radio.config(channel=ARENA % 84, group=ARENA // 84, length=32, queue=8, power=7)
    radio.on()
    packets, count = Packets(), 0
    display.show("R")
    while not packets.ended:
        if uart.any():
            packet = packets.feed(uart.read(64))
            if packet is not None:
                radio.send_bytes(packet)
                count = (count + 1) % 50
                display.set_pixel(4, 4, 9 if count < 25 else 0)  # blinks while the arcade sends
        report = radio.receive_bytes()
        if report is not None and len(report) == REPORT_LENGTH:
            uart.write(report)
        sleep(1)
    uart.init(baudrate=115200)  # of the prompt


if __name__ == "__main__":
    main()
