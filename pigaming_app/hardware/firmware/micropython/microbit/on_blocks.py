"""Test of a micro:bit on blocks: sent by USB, and not kept. A turn ends by itself, whatever becomes of the cable."""

import time

from microbit import display, sleep

import main

robot = main.Robot()  # its timer brakes 200 ms after the last command


def turn(left, right, ms):
    """Turn the wheels, at speed codes from -63 to 63."""
    end = time.ticks_add(time.ticks_ms(), ms)
    try:
        while time.ticks_diff(end, time.ticks_ms()) > 0:
            robot.driven, robot.stopped = time.ticks_ms(), False
            main.drive(main.LEFT, left)
            main.drive(main.RIGHT, right)
            sleep(20)
    finally:
        robot.stopped = True
        robot.brake()


def light(ms):
    """Show the robot's number."""
    display.show(str(main.ROBOT), wait=False)
    sleep(ms)


def battery():
    """Voltage of the battery in mV, 0 without a divider."""
    return robot.read_battery()
