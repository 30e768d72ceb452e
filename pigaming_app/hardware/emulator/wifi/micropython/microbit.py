"""Stand-in of the micro:bit's module `microbit`: pins, button A, display, USB serial line, scheduled functions."""

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
uart, display, button_a, sleep = Uart(), Display(), Button(), time.sleep_ms
