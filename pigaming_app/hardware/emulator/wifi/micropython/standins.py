"""Completes the WebAssembly build of MicroPython by what boards have: a clock that sleeps, random bytes, Ctrl-C.

A sleep also runs timers and interrupts, and raises the errors that the emulator's owner orders.
"""

import builtins
import os
import sys
import time

import js
import machine

PERIOD = 0x3FFFFFFF  # of ticks_ms, which starts 3 s before it wraps
BEGUN = js.bridge.ticks()


def ticks_ms():
    return machine.ticks() - BEGUN - 3000 & PERIOD


def sleep_ms(ms):
    end = js.bridge.ticks() + ms
    fault = js.bridge.fault()
    if fault:
        raise MemoryError if fault == 1 else KeyboardInterrupt
    while True:
        machine.fire()
        now = js.bridge.ticks()
        if now >= end and not js.bridge.hangs():
            return
        js.bridge.wait(max(now + 1, min(end, machine.next_timer())))


time.ticks_ms, time.sleep_ms = ticks_ms, sleep_ms
os.urandom = lambda size: bytes.fromhex(js.bridge.random(size))


class Written:
    """A file open for writing: the disk has changed when it is closed."""

    def __init__(self, file):
        self.file, self.write = file, file.write

    def close(self):
        self.file.close()
        js.bridge.written()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def noting(change):
    """A function of `os`, after which the disk has changed."""

    def noted(*arguments):
        change(*arguments)
        js.bridge.written()

    return noted


read = open
builtins.open = lambda name, mode="r": Written(read(name, mode)) if "w" in mode else read(name, mode)
os.rename, os.remove, os.mkdir = noting(os.rename), noting(os.remove), noting(os.mkdir)


def prompt():
    """The prompt of the interpreter after the program: timers and interrupts go on."""
    while True:
        sleep_ms(1000)


class Interpreter:
    """The module `micropython` of a micro:bit."""

    interrupt = 3  # byte on the serial line that stops the program; -1: none

    def kbd_intr(self, byte):
        self.interrupt = byte


micropython = sys.modules["micropython"] = Interpreter()
