"""Robot of PiGaming on a micro:bit V2: obeys drive packets, reports, and stops by itself.

It is the only file on the micro:bit: `main.py robots setup` writes it, `main.py robots --microbit 2` prints it with the
numbers of robot 2, and with `--chassis cutebot` or `maqueen` for one of these instead of a DRV8833. A scheduled
function stops the motors 200 ms after the last new command; the chip's watchdog restarts a program that hangs. Its last
line starts it, so that a part of the file does nothing.
docs/hardware.md, section Protocol, has the packets.
"""

import time

import radio
from machine import mem32
from microbit import button_a, display, i2c, pin0, pin8, pin12, pin16, run_every, sleep

ROBOT, ARENA = 1, 0  # number of the robot, 1 to 4; id of the arena, 1 to 16383: with 0 the motors never run

CHASSIS = None  # or "cutebot" or "maqueen": their motors obey messages by I2C, and keep the last speed
MOTOR_CHIP = 0x10  # I2C address on both

# Kitronik's motor driver board 5620 (DRV8833, four AA cells): pins ahead and back of each motor
LEFT, RIGHT = (pin8, pin12), (pin0, pin16)
BATTERY = None  # or pin2, also in the line with `import`: with a divider of 200 kOhm and 100 kOhm at the cells
DIVIDER, SUPPLY_MV = 3, 3300
LOW_MV, EMPTY_MV = 4600, 4400  # the board needs 4.5 V

DRIVE, REPORT, VERSION = 0xD1, 0xD5, 2
LENGTH, BODY = 18, 13  # bytes of a drive packet, and of it without the check
MIDDLE = 63  # speed code of a wheel at rest
DEADMAN, LOW, EMPTY, RESTARTED, PARKED = 1, 2, 4, 8, 16  # flags of a report
DEADMAN_MS, TIMER_MS, REPORT_MS, SLOT_MS, BATTERY_MS = 200, 10, 200, 10, 20
CLEAR_MS = 5  # reports keep clear of drive packets, which come every 20 ms: this radio sends without listening
LONELY_MS = 3000  # ms without a command after which the reports end
TOP = 1023  # duty of a pin
PWM_US = 256

WATCHDOG_MS = 500
START, RELOAD_VALUE, RELOAD = 0x40010000, 0x40010504, 0x40010600  # registers of the nRF52833's watchdog
KEY = 0x6E524635  # value that feeds it
RESET_REASON = 0x40000400  # register; its bit 1: watchdog

LOW_HALVES, HIGH_HALVES = [], []  # CRC-32 of the 16 values of 4 bits, in halves: integers of 32 bits need memory
for _value in range(16):
    for _ in range(4):
        _value = _value >> 1 ^ (0xEDB88320 if _value & 1 else 0)
    LOW_HALVES.append(_value & 0xFFFF)
    HIGH_HALVES.append(_value >> 16)


def check_of(data, size):
    """CRC-32 (IEEE) of the first `size` bytes, in five bytes of 7 bits, low first."""
    low = high = 0xFFFF
    for place in range(size):
        low ^= data[place]
        for _ in (0, 1):
            nibble = low & 15
            low = (low >> 4 | (high & 15) << 12) ^ LOW_HALVES[nibble]
            high = high >> 4 ^ HIGH_HALVES[nibble]
    low, high = low ^ 0xFFFF, high ^ 0xFFFF
    return bytes([low & 127, low >> 7 & 127, (low >> 14 | high << 2) & 127, high >> 5 & 127, high >> 12])


def message(motor, speed):
    """Message to the motor chip: wheel, direction, speed, in percent on a Cutebot, up to 255 on a Maqueen."""
    size = speed if speed >= 0 else -speed
    if CHASSIS == "cutebot":
        return bytes([1 if motor is LEFT else 2, 1 if speed < 0 else 2, size * 100 // MIDDLE, 0])
    return bytes([0 if motor is LEFT else 2, 1 if speed < 0 else 0, size * 255 // MIDDLE])


def drive(motor, speed):
    """Speed of a motor, -63 to 63; with a DRV8833 slow decay, 0 brakes."""
    if CHASSIS:
        i2c.write(MOTOR_CHIP, message(motor, speed))
        return
    ahead, back = motor
    duty = speed * TOP // MIDDLE
    ahead.write_analog(TOP if duty >= 0 else TOP + duty)
    back.write_analog(TOP if duty <= 0 else TOP - duty)


class Robot:
    """Motors, battery and button, and the rules for when the motors may run."""

    def __init__(self, restarted=False):
        self.restarted = restarted
        self.seq = -1  # sequence number of the last command
        self.driven = self.ticked = self.measured = time.ticks_ms()  # ms: last command, last tick of the timer, battery
        self.report_at = self.driven  # ms
        self.stopped = True  # by the deadman; True until the first command
        self.parked = False  # by the button
        self.empty = False
        self.millivolts = self.read_battery()  # 0 without a divider
        for pin in () if CHASSIS else LEFT + RIGHT:
            pin.set_analog_period_microseconds(PWM_US)
        self.brake()
        run_every(self.watch, ms=TIMER_MS)

    def watch(self):
        """Deadman, called by the timer."""
        self.ticked = time.ticks_ms()
        if not self.stopped and time.ticks_diff(self.ticked, self.driven) >= DEADMAN_MS:
            self.stopped = True
            self.brake()

    def brake(self):
        drive(LEFT, 0)
        drive(RIGHT, 0)

    def obey(self, packet, now):
        """Carry out a drive packet; True if it is a new command of this arena."""
        if len(packet) != LENGTH or packet[0] != DRIVE or packet[3] == self.seq:
            return False
        if not ARENA or packet[1] | packet[2] << 7 != ARENA or check_of(packet, BODY) != packet[BODY:]:
            return False
        self.seq, self.driven, self.stopped = packet[3], now, False
        if self.seq % 10 == 0:  # robots report one after the other
            self.report_at = time.ticks_add(now, SLOT_MS * (ROBOT - 1) + CLEAR_MS)
        enabled = packet[4] >> ROBOT - 1 & 1 and not self.empty and not self.parked
        left, right = packet[3 + 2 * ROBOT], packet[4 + 2 * ROBOT]
        drive(LEFT, left - MIDDLE if enabled and left <= 2 * MIDDLE else 0)
        drive(RIGHT, right - MIDDLE if enabled and right <= 2 * MIDDLE else 0)
        if self.stopped:  # the timer has stopped it between two of these lines
            self.brake()
        return True

    def work(self, now):
        """Read button and battery."""
        if button_a.was_pressed():
            self.parked = not self.parked
        if BATTERY is not None and time.ticks_diff(now, self.measured) >= BATTERY_MS:
            self.measured = now
            self.millivolts += (self.read_battery() - self.millivolts) // 4
            self.empty = self.millivolts < (LOW_MV if self.empty else EMPTY_MV)
        if self.empty or self.parked:
            self.brake()

    def read_battery(self):
        """Voltage of the battery in mV, 0 without a divider."""
        return BATTERY.read_analog() * SUPPLY_MV * DIVIDER // TOP if BATTERY is not None else 0

    def flags(self):
        low = BATTERY is not None and self.millivolts < LOW_MV
        parts = (DEADMAN * self.stopped, LOW * low, EMPTY * self.empty, RESTARTED * self.restarted)
        return sum(parts) + PARKED * self.parked

    def report(self, now):
        """The report packet if it is due, else None."""
        since = time.ticks_diff(now, self.driven)
        if self.seq < 0 or since > LONELY_MS or time.ticks_diff(now, self.report_at) < 0:
            return None
        self.report_at = time.ticks_add(now, REPORT_MS)
        mv = self.millivolts
        body = bytes([REPORT, ARENA & 127, ARENA >> 7, ROBOT, VERSION, self.seq, self.flags(), mv & 127, mv >> 7 & 127])
        return body + check_of(body, len(body))


def main():
    """Run until the power is switched off; an error brakes, and the watchdog restarts."""
    robot = Robot(mem32[RESET_REASON] & 2 != 0)
    mem32[RESET_REASON] = 0xFFFFFFFF  # clears it
    try:
        run(robot)
    finally:
        robot.brake()


def run(robot):
    """Drive and report. The watchdog, which nothing stops, starts with the first command; USB may interrupt before."""
    radio.config(channel=ARENA % 84, group=ARENA // 84, length=32, queue=8, power=7)
    radio.on()
    shown, watched = None, False
    while True:
        packet = radio.receive_bytes()
        while packet is not None:
            robot.obey(packet, time.ticks_ms())
            packet = radio.receive_bytes()
        if not watched and not robot.stopped:
            mem32[RELOAD_VALUE], watched = WATCHDOG_MS * 32768 // 1000, True
            mem32[START] = 1
        now = time.ticks_ms()
        robot.work(now)
        report = robot.report(now)
        if report is not None:
            radio.send_bytes(report)
        symbol = "X" if robot.parked else "-" if robot.stopped else str(ROBOT)
        if symbol != shown:
            shown = symbol
            display.show(symbol, wait=False)
        if time.ticks_diff(now, robot.ticked) < 10 * TIMER_MS:
            mem32[RELOAD] = KEY
        sleep(1)


if __name__ == "__main__":
    main()
