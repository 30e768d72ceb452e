"""Program of a PiGaming robot in stock MicroPython: obeys drive packets, reports, and stops by itself.

On the robot: this file, `start.py` as `main.py`, the board file as `board.py`, `motors.py`, `config.py`, the radio file
that `config` names, for Wi-Fi `update.py`. A hardware timer stops the motors 200 ms after the last new command; the
watchdog restarts a robot whose main loop or timer hangs. An error stops the motors, is printed, and restarts the robot
after a moment; one in its files keeps it from starting. docs/hardware.md, section Protocol, has the packets.
"""

import io
import sys
import time
from binascii import crc32

from machine import ADC, WDT, WDT_RESET, Pin, Timer, reset, reset_cause

DRIVE, REPORT, VERSION = 0xD1, 0xD5, 2
BODY = 13  # bytes of a drive packet before its check
MIDDLE = 63  # speed code of a wheel at rest
DEADMAN_MS, TIMER_MS, REPORT_MS, SLOT_MS, BATTERY_MS = 200, 10, 200, 10, 20
LONELY_MS = 3000  # ms without a command after which the reports end
TRIAL_MS = 60000  # ms for which a program on trial feeds its watchdog, see start.py
RESTART_MS = 3000  # until a restart after an error, unless the watchdog is earlier
SUPPLY_MV = 3300  # 65535 of an ADC without calibration


def checked(packet):
    """The packet and its CRC-32 in five bytes of 7 bits, low first."""
    crc = crc32(packet) & 0xFFFFFFFF
    return packet + bytes([crc >> shift & 0x7F for shift in (0, 7, 14, 21, 28)])


def brake(board):
    try:
        board.left.drive(0)
    finally:
        board.right.drive(0)


class Robot:
    """Motors, battery and lamp of a board, and the rules for when the motors may run."""

    def __init__(self, board, config, lamp, restarted):
        if not 1 <= config.ROBOT <= 4 or not 0 <= config.ARENA < 1 << 14:
            raise ValueError("config.py: ROBOT is 1 to 4, ARENA 0 to 16383")
        self.board, self.lamp, self.restarted = board, lamp, restarted
        self.arena, self.address = config.ARENA, config.ROBOT
        self.seq = -1  # sequence number of the last command
        self.driven = self.ticked = self.measured = time.ticks_ms()  # ms: last command, last tick of the timer, battery
        self.report_at = self.driven  # ms
        self.stopped = True  # by the deadman; True until the first command
        self.empty = self.parked = self.down = False  # the battery; stopped by the button; whether that is down
        self.button = Pin(board.BUTTON, Pin.IN, Pin.PULL_UP) if board.BUTTON is not None else None
        options = {"atten": ADC.ATTN_11DB} if hasattr(ADC, "ATTN_11DB") else {}  # ESP32: 0.15 to 2.45 V
        self.sensor = ADC(Pin(board.BATTERY_PIN), **options) if board.BATTERY_PIN is not None else None
        self.millivolts = self.read_battery()  # 0 without a divider
        self.timer = Timer(board.TIMER)
        try:
            self.timer.init(mode=Timer.PERIODIC, period=TIMER_MS, callback=self.watch, hard=True)
        except (TypeError, ValueError):  # ESP32 and older MicroPython: between two steps of the program
            self.timer.init(mode=Timer.PERIODIC, period=TIMER_MS, callback=self.watch)

    def watch(self, timer):
        """Deadman, called by the timer; allocates no memory. It repeats itself: it may have interrupted a command."""
        self.ticked = time.ticks_ms()
        if time.ticks_diff(self.ticked, self.driven) >= DEADMAN_MS:
            self.halt()

    def halt(self):
        """Brake both wheels until the next command."""
        self.stopped = True
        brake(self.board)

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
        since = time.ticks_diff(now, self.measured)
        if since < BATTERY_MS:
            return
        self.measured = now
        before, self.down = self.down, self.button is not None and not self.button.value()
        if self.down and not before:
            self.parked = not self.parked
        if self.sensor is not None:
            self.millivolts += (self.read_battery() - self.millivolts) // 4
            self.empty = self.millivolts < (self.board.LOW_MV if self.empty else self.board.EMPTY_MV)
        if self.empty or self.parked:
            brake(self.board)
        self.board.left.regulate(since)
        self.board.right.regulate(since)
        if self.lamp is not None:
            self.lamp.value(now % 200 < 100 if self.parked else not self.stopped or now % 1000 < 100)

    def read_battery(self):
        """Voltage of the battery in mV, 0 without a divider."""
        if self.sensor is None:
            return 0
        calibrated = hasattr(self.sensor, "read_uv")  # an ESP32: its reference varies, and 0 is not 0 V
        mv = self.sensor.read_uv() / 1000 if calibrated else self.sensor.read_u16() * SUPPLY_MV / 65535
        return round(mv * self.board.DIVIDER)

    def flags(self):
        """Flags of a report, from bit 0: stopped by the deadman, battery low, empty, restarted, parked."""
        low = self.sensor is not None and self.millivolts < self.board.LOW_MV
        states = (self.stopped, low, self.empty, self.restarted, self.parked)
        return sum(1 << bit for bit, state in enumerate(states) if state)

    def report(self, now):
        """The report packet if it is due, else None."""
        since = time.ticks_diff(now, self.driven)
        if self.seq < 0 or since > LONELY_MS or time.ticks_diff(now, self.report_at) < 0:
            return None
        self.report_at = time.ticks_add(now, REPORT_MS)
        arena, mv = self.arena, self.millivolts
        head = bytes([REPORT, arena & 127, arena >> 7, self.address, VERSION, self.seq, self.flags()])
        return checked(head + bytes([mv & 127, mv >> 7 & 127]))


def run(robot, radio, watchdog):
    """Drive and report until the power is switched off. The watchdog, unless given, starts with the first command.

    Until then nothing turns, and the robot's files can be changed by USB. A given one is that of a program on trial.
    """
    end = watchdog and time.ticks_add(time.ticks_ms(), TRIAL_MS)
    while True:
        now = time.ticks_ms()
        while (packet := radio.receive()) is not None:
            robot.obey(packet, time.ticks_ms())
        robot.work(now)
        report = robot.report(now)
        if report is not None:
            radio.send(report)
        radio.work(now)
        if watchdog is None and not robot.stopped:
            watchdog = WDT(timeout=robot.board.WATCHDOG_MS)
        patient = end is None or time.ticks_diff(end, now) > 0
        if watchdog is not None and patient and time.ticks_diff(now, robot.ticked) < 10 * TIMER_MS:
            watchdog.feed()
        time.sleep_ms(2)


def reason(error):
    """An error and its place in one line."""
    text = io.StringIO()
    sys.print_exception(error, text)
    return ": ".join([line.strip() for line in text.getvalue().strip().split("\n")[-2:]])


def await_repair(lamp, why):
    """Repeat why the robot cannot start, and let the lamp flash twice and twice again, until Ctrl-C."""
    while True:
        print("The robot cannot start.", why)
        for step in range(20):
            if lamp is not None:
                lamp.value(step % 5 in (0, 2))
            time.sleep_ms(RESTART_MS // 20)


def main(watchdog):
    """Start and run; after an error, but not after Ctrl-C, restart. `watchdog`: of a program on trial, see `run`."""
    lamp = None
    try:
        import board

        brake(board)
        lamp = Pin(board.LED, Pin.OUT) if board.LED is not None else None
        import config

        robot = Robot(board, config, lamp, reset_cause() == WDT_RESET)
        radio = __import__(config.RADIO).Radio(robot)
    except Exception as error:
        await_repair(lamp, reason(error))
    try:
        run(robot, radio, watchdog)
    except Exception as error:
        print("The robot restarts.", reason(error))
    finally:
        robot.halt()
    time.sleep_ms(RESTART_MS)
    reset()
