"""Stand-in of the micro:bit's module `microbit`: pins, button A, display, USB serial line, scheduled functions, I2C.

Behind I2C are the motor chips of Cutebot and Maqueen, as their makers' blocks for MakeCode address them (motors,
MotorRun); the outputs of the chips count as pins 100 to 103: left ahead and back, right ahead and back.
"""

import time

import js
import lines
import machine
import standins


class Pin:
    def __init__(self, name):
        self.name = str(name)

    def set_analog_period_microseconds(self, period):
        if period < 256:
            raise ValueError(period)

    def write_analog(self, duty):
        if not 0 <= duty <= 1023:
            raise ValueError(duty)
        js.bridge.pin(self.name, duty * 65535 // 1023)

    def read_analog(self):
        return js.bridge.battery() * 1023 // 9900  # a divider by 3, on 3.3 V


WHEELS = {"cutebot": {1: 100, 2: 102}, "maqueen": {0: 100, 2: 102}}  # outputs by the first byte of a message
WAYS = {"cutebot": {2: 0, 1: 1}, "maqueen": {0: 0, 1: 1}}  # ahead or back, by the second
LONG, FULL = {"cutebot": 4, "maqueen": 3}, {"cutebot": 100, "maqueen": 255}  # bytes; full speed, the third


class MotorChip:
    """The motor chip of this board's chassis."""

    def write(self, address, data):
        board = js.bridge.board()
        if address != 0x10 or board not in WHEELS:
            raise OSError(19)  # nobody answers
        wheel, way, speed = data[0], data[1], data[2]
        if len(data) != LONG[board] or speed > FULL[board]:
            raise ValueError(data)
        pins, way = WHEELS[board][wheel], WAYS[board][way]
        for each in (0, 1):
            js.bridge.pin(str(pins + each), speed * 65535 // FULL[board] if each == way else 0)


class Uart:
    baudrate = 115200

    def init(self, baudrate):
        self.baudrate = baudrate

    def any(self):
        lines.poll()
        return bool(lines.waiting["usb"])

    def read(self, size):
        data = b"".join(lines.waiting["usb"])
        if standins.micropython.interrupt in data:
            raise KeyboardInterrupt
        if self.baudrate != 57600:
            data = bytes(byte ^ 0x55 for byte in data)
        lines.waiting["usb"] = [data[size:]] if data[size:] else []
        return data[:size]

    def write(self, data):
        lines.send("usb", data)


class Button:
    def __init__(self):
        self.down = False

    def was_pressed(self):
        before, self.down = self.down, bool(js.bridge.button())
        return self.down and not before


class Display:
    def show(self, symbol, wait=True):
        js.bridge.pin("display", ord(symbol))

    def set_pixel(self, x, y, brightness):
        pass


def run_every(callback, ms):
    machine.Timer(-1).init(machine.Timer.PERIODIC, ms, lambda timer: callback())


pin0, pin1, pin2, pin8, pin12, pin16 = Pin(0), Pin(1), Pin(2), Pin(8), Pin(12), Pin(16)
uart, display, button_a, i2c, sleep = Uart(), Display(), Button(), MotorChip(), time.sleep_ms
