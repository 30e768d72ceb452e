"""Pololu 3pi+ 2040 and Zumo 2040: RP2040 without Wi-Fi, so an XBee (AP=0) on GP28 and GP29; four AAA or AA cells.

Pins: Pololu's library pololu_3pi_2040_robot; the Zumo's are the same by imrclab.github.io/pololu-rs/hardware.
"""

from motors import Phase

KIND = 3
TIMER = -1
WATCHDOG_MS = 500
LED, BATTERY_PIN = 25, 26
BUTTON = 0  # C: stops the robot; again: it may drive
DIVIDER = 11  # the ADC measures an eleventh of the battery
LOW_MV, EMPTY_MV = 4400, 4000
UART = (0, 28, 29)

left, right = Phase(15, 11), Phase(14, 10)
