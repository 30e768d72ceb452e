"""ESP32 (DevKit, 30 or 38 pins) with a DRV8833 and four rechargeable AA cells."""

from motors import InIn

KIND = 1
TIMER = 0  # a hardware timer
WATCHDOG_MS = 1000  # the least that an ESP32 allows
LED, BATTERY_PIN = 2, 34
BUTTON = 0  # BOOT: stops the robot; again: it may drive
DIVIDER = 3  # the ADC measures a third of the battery: 200 kOhm and 100 kOhm
LOW_MV, EMPTY_MV = 4400, 4000
UART = (2, 17, 16)  # for RADIO = "serial_radio"

left, right = InIn(25, 26), InIn(32, 33)
# TB6612: left, right = Enable(25, 26, 27), Enable(14, 32, 33)
# L298N: left, right = Enable(25, 26, 27, hertz=2000), Enable(14, 32, 33, hertz=2000)
# encoders: left, right = Regulated(left, 18, 1200), Regulated(right, 19, 1200)
