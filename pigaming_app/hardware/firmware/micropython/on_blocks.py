"""Test of a robot on blocks: sent by USB, and not kept. A turn ends by itself, whatever becomes of the cable."""

import time

import board
import config
from machine import Pin
from robot import Robot

lamp = Pin(board.LED, Pin.OUT) if board.LED is not None else None
robot = Robot(board, config, lamp, False)  # its timer brakes 200 ms after the last command


def turn(left, right, ms):
    """Turn the wheels, at speed codes from -63 to 63."""
    end = time.ticks_add(time.ticks_ms(), ms)
    try:
        while time.ticks_diff(end, time.ticks_ms()) > 0:
            robot.driven = time.ticks_ms()
            board.left.drive(left)
            board.right.drive(right)
            time.sleep_ms(20)
    finally:
        robot.halt()


def light(ms):
    """Let the lamp blink."""
    for step in range(6):
        if lamp is not None:
            lamp.value(step % 2 == 0)
        time.sleep_ms(ms // 6)


def battery():
    """Voltage of the battery in mV, 0 without a divider."""
    return robot.read_battery()
