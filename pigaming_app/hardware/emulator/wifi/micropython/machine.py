"""Stand-in of the module `machine`: pins, PWM, ADC, timers and watchdog of an emulated board."""

import js

PWRON_RESET, WDT_RESET = 1, 3
FULL_MV = {"34": 9300, "26": 9900}  # of the battery at the end of the ADC: divider by 3 on an ESP32, a Pico W
timers = []


class Pin:
    IN, OUT, PULL_UP, IRQ_RISING = 0, 1, 2, 4

    def __init__(self, name, mode=-1, pull=-1):
        self.name = str(name)

    def value(self, value=None):
        if value is None:
            return int(not js.bridge.button())  # to ground, with a pull-up
        js.bridge.pin(self.name, int(value))


class PWM:
    def __init__(self, pin, freq):
        self.name = pin.name

    def duty_u16(self, duty):
        if not 0 <= duty <= 65535:
            raise ValueError(duty)
        js.bridge.pin(self.name, duty)


class ADC:
    def __init__(self, pin):
        self.full = FULL_MV[pin.name]

    def read_u16(self):
        return min(65535, js.bridge.battery() * 65536 // self.full)


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

    def init(self, mode, period, callback):
        self.period, self.callback = period, callback
        self.due = js.bridge.ticks() + period
        timers.append(self)


def fire():
    """Call back the timers that are due."""
    for timer in timers:
        if js.bridge.ticks() >= timer.due:
            timer.due += timer.period * ((js.bridge.ticks() - timer.due) // timer.period + 1)
            timer.callback(timer)


def next_timer():
    return min([timer.due for timer in timers] or [1 << 29])


def reset_cause():
    return js.bridge.cause()
