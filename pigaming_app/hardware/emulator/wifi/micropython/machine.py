"""Stand-in of the module `machine`: pins, PWM, ADC, timers and watchdog of an emulated board.

Timers and interrupts of an RP2040 may be hard: their callbacks must not allocate memory. An ESP32 refuses that.
"""

import adc
import js
from micropython import heap_lock, heap_unlock

ESP32 = js.bridge.board().startswith("board_esp32")
PWRON_RESET, WDT_RESET = 1, 3
ADC = adc.Esp32 if ESP32 else adc.Rp2
timers = []
interrupts = []
_locked = False  # in a hard callback


def outside(function):
    """The function, of the emulator itself, may allocate memory in a hard callback; it has at most two arguments."""

    def free(one=None, two=None):
        if _locked:
            heap_unlock()
        try:
            return function() if one is None else function(one, two)
        finally:
            if _locked:
                heap_lock()

    return free


@outside
def put(name, value):
    """Set a pin."""
    js.bridge.pin(name, int(value))


@outside
def ticks():
    return js.bridge.ticks()


def call(function, argument, hard):
    """Call back, without memory if `hard`."""
    global _locked
    if hard:
        _locked = True
        heap_lock()
    try:
        function(argument)
    finally:
        if hard:
            _locked = False
            heap_unlock()


class Pin:
    IN, OUT, PULL_UP, IRQ_RISING = 0, 1, 2, 4

    def __init__(self, name, mode=-1, pull=-1):
        self.name = str(name)

    def value(self, value=None):
        if value is None:
            return int(not js.bridge.button())  # to ground, with a pull-up
        put(self.name, value)

    def analog(self):
        """The voltage here behind the divider of the battery, and the reference of the chip's ADC, mV."""
        return js.bridge.battery() / js.bridge.divider(), js.bridge.reference()

    def irq(self, handler, trigger, **hard):
        if hard and ESP32:
            raise TypeError("extra keyword arguments given")
        interrupts.append([self, handler, hard.get("hard"), 0])


class PWM:
    def __init__(self, pin, freq):
        self.name = pin.name
        put("hertz" + self.name, freq)

    def duty_u16(self, duty):
        if not 0 <= duty <= 65535:
            raise ValueError(duty)
        put(self.name, duty)


class UART:
    """A line to whoever wrote last, a datagram a packet."""

    def __init__(self, number, baudrate, tx, rx, rxbuf):
        self.buffer, self.other = b"", None

    def any(self):
        while found := js.bridge.receive():
            data, host, port = found.split(" ")
            self.buffer, self.other = self.buffer + bytes.fromhex(data), (host, int(port))
        return len(self.buffer)

    def read(self, size):
        data, self.buffer = self.buffer[:size], self.buffer[size:]
        return data

    def write(self, data):
        if self.other:
            js.bridge.send(data.hex(), *self.other)


class WDT:
    def __init__(self, timeout):
        js.bridge.watch(timeout)
        self.feed()

    def feed(self):
        js.bridge.feed()


class Registers:
    """Registers of an nRF52833: its watchdog and the reason of the last reset."""

    def __init__(self):
        self.timeout = 2000  # ms

    def __getitem__(self, address):
        return {0x40000400: 2 if js.bridge.cause() == WDT_RESET else 1}[address]

    def __setitem__(self, address, value):
        if address == 0x40010504:
            self.timeout = value * 1000 // 32768
        elif address == 0x40010000 and value == 1:
            js.bridge.watch(self.timeout)
        elif address == 0x40010600 and value == 0x6E524635:
            js.bridge.feed()
        elif address != 0x40000400:
            raise ValueError(address)


mem32 = Registers()


class Timer:
    PERIODIC = 1

    def __init__(self, number):
        pass

    def init(self, mode, period, callback, hard=False):
        if hard and ESP32:
            raise ValueError("hard Timers are not implemented")
        self.period, self.callback, self.hard = period, callback, hard
        self.due = js.bridge.ticks() + period
        timers.append(self)


def fire():
    """Call back the timers that are due, and the interrupts of encoders' pulses."""
    for place, (pin, handler, hard, counted) in enumerate(interrupts):
        pulses = js.bridge.pulses(place)
        for _ in range(pulses - counted):
            call(handler, pin, hard)
        interrupts[place][3] = pulses
    for timer in timers:
        if js.bridge.ticks() >= timer.due:
            timer.due += timer.period * ((js.bridge.ticks() - timer.due) // timer.period + 1)
            call(timer.callback, timer, timer.hard)


def next_timer():
    return min([timer.due for timer in timers] or [1 << 29])


def reset_cause():
    return js.bridge.cause()


def reset():
    js.bridge.reset()
