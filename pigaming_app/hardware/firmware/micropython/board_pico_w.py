"""Raspberry Pi Pico W or Pico 2 W with a DRV8833 and four rechargeable AA cells."""

from motors import InIn

KIND = 2
TIMER = -1  # of the chip's alarm pool
WATCHDOG_MS = 500
LED, BATTERY_PIN = "LED", 26
BUTTON = 22  # to ground; stops the robot; again: it may drive
DIVIDER = 3  # the ADC measures a third of the battery: 200 kOhm and 100 kOhm
LOW_MV, EMPTY_MV = 4400, 4000
UART = (0, 0, 1)  # for RADIO = "serial_radio"

left, right = InIn(10, 11), InIn(12, 13)
# TB6612: left, right = Enable(10, 11, 12), Enable(13, 14, 15)
# L298N: left, right = Enable(10, 11, 12, hertz=2000), Enable(13, 14, 15, hertz=2000)
# encoders: left, right = Regulated(left, 18, 1200), Regulated(right, 19, 1200)
