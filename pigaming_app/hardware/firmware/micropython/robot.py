"""Program of a PiGaming robot in stock MicroPython: obeys drive packets, reports, and stops by itself.

On the robot: this file as `main.py`, `config.py`, `motors.py`, the board file and the radio file that `config` names.
A hardware timer stops the motors 200 ms after the last new command, whatever the main loop does; the watchdog restarts
a robot whose main loop or timer hangs. docs/hardware.md, section Protocol, has the packets.
"""

import time
from binascii import crc32

import config
from machine import ADC, WDT, WDT_RESET, Pin, Timer, reset_cause

DRIVE, REPORT, VERSION = 0xD1, 0xD5, 2
BODY = 13  # bytes of a drive packet before its check
MIDDLE = 63  # speed code of a wheel at rest
DEADMAN, LOW, EMPTY, RESTARTED, PARKED = 1, 2, 4, 8, 16  # flags of a report
DEADMAN_MS, TIMER_MS, REPORT_MS, SLOT_MS, BATTERY_MS = 200, 10, 200, 10, 20
LONELY_MS = 3000  # ms without a command after which the reports end


def checked(packet):
    """The packet and its CRC-32 in five bytes of 7 bits, low first."""
    crc = crc32(packet) & 0xFFFFFFFF
    return packet + bytes([crc >> shift & 0x7F for shift in (0, 7, 14, 21, 28)])


class Robot:
    """Motors, battery and lamp of a board, and the rules for when the motors may run."""

    def __init__(self, board, restarted=False):
        self.board, self.restarted = board, restarted
        self.arena, self.address = config.ARENA, config.ROBOT
        self.seq = -1  # sequence number of the last command
        self.driven = self.ticked = self.measured = time.ticks_ms()  # ms: last command, last tick of the timer, battery
        self.report_at = self.driven  # ms
        self.stopped = True  # by the deadman; True until the first command
        self.empty = False
        self.parked = self.down = False  # stopped by the button; whether that is down
        self.button = Pin(board.BUTTON, Pin.IN, Pin.PULL_UP) if board.BUTTON is not None else None
        self.lamp = Pin(board.LED, Pin.OUT) if board.LED is not None else None
        self.sensor = ADC(Pin(board.BATTERY_PIN)) if board.BATTERY_PIN is not None else None
        self.millivolts = self.read_battery()  # 0 without a divider
        self.halt()
        self.timer = Timer(board.TIMER)
        self.timer.init(mode=Timer.PERIODIC, period=TIMER_MS, callback=self.watch)

    def watch(self, timer):
        """Deadman, called by the timer; allocates no memory."""
        self.ticked = time.ticks_ms()
        if not self.stopped and time.ticks_diff(self.ticked, self.driven) >= DEADMAN_MS:
            self.halt()

    def halt(self):
        """Brake both wheels until the next command."""
        self.stopped = True
        self.brake()

    def brake(self):
        self.board.left.drive(0)
        self.board.right.drive(0)

    def obey(self, packet, now):
        """Carry out a drive packet; True if it is a new command of this arena."""
        if len(packet) != BODY + 5 or packet[0] != DRIVE or checked(packet[:BODY]) != packet:
            return False
        if not self.arena or packet[1] | packet[2] << 7 != self.arena or packet[3] == self.seq:
            return False
        self.seq, self.driven, self.stopped = packet[3], now, False
        if self.seq % 10 == 0:  # robots report one after the other
            self.report_at = time.ticks_add(now, SLOT_MS * (self.address - 1))
        enabled = packet[4] >> self.address - 1 & 1 and not self.empty and not self.parked
        left, right = packet[3 + 2 * self.address], packet[4 + 2 * self.address]
        self.board.left.drive(left - MIDDLE if enabled and left <= 2 * MIDDLE else 0)
        self.board.right.drive(right - MIDDLE if enabled and right <= 2 * MIDDLE else 0)
        return True

    def work(self, now):
        """Read button and battery, regulate the wheels, light the lamp."""
        if time.ticks_diff(now, self.measured) < BATTERY_MS:
            return
        self.measured = now
        before, self.down = self.down, self.button is not None and not self.button.value()
        if self.down and not before:
            self.parked = not self.parked
        if self.sensor is not None:
            self.millivolts += (self.read_battery() - self.millivolts) // 4
            self.empty = self.millivolts < (self.board.LOW_MV if self.empty else self.board.EMPTY_MV)
        if self.empty or self.parked:
            self.brake()
        self.board.left.regulate()
        self.board.right.regulate()
        if self.lamp is not None:
            self.lamp.value(now % 200 < 100 if self.parked else not self.stopped or now % 1000 < 100)

    def read_battery(self):
        """Voltage of the battery in mV, 0 without a divider."""
        if self.sensor is None:
            return 0
        return int(self.sensor.read_u16() * self.board.BATTERY_FULL_MV) >> 16

    def flags(self):
        low = self.sensor is not None and self.millivolts < self.board.LOW_MV
        parts = (DEADMAN * self.stopped, LOW * low, EMPTY * self.empty, RESTARTED * self.restarted)
        return sum(parts) + PARKED * self.parked

    def report(self, now):
        """The report packet if it is due, else None."""
        since = time.ticks_diff(now, self.driven)
        if self.seq < 0 or since > LONELY_MS or time.ticks_diff(now, self.report_at) < 0:
            return None
        self.report_at = time.ticks_add(now, REPORT_MS)
        arena, mv = self.arena, self.millivolts
        head = bytes([REPORT, arena & 127, arena >> 7, self.address, VERSION, self.seq, self.flags()])
        return checked(head + bytes([mv & 127, mv >> 7 & 127]))


def main():
    """Run until the power is switched off."""
    board = __import__(config.BOARD)
    robot = Robot(board, reset_cause() == WDT_RESET)
    radio = __import__(config.RADIO).Radio(robot)
    watchdog = WDT(timeout=board.WATCHDOG_MS)
    while True:
        now = time.ticks_ms()
        packet = radio.receive()
        while packet is not None:
            robot.obey(packet, time.ticks_ms())
            packet = radio.receive()
        robot.work(now)
        report = robot.report(now)
        if report is not None:
            radio.send(report)
        radio.work(now)
        if time.ticks_diff(now, robot.ticked) < 10 * TIMER_MS:
            watchdog.feed()
        time.sleep_ms(2)


if __name__ == "__main__":
    main()
