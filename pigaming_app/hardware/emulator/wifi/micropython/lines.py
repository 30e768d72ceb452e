"""Lines of an emulated micro:bit over its one socket: a datagram begins with the name of its line."""

import js

waiting = {"usb": [], "radio": []}
_other = None  # whoever wrote last: the emulated surroundings


def poll():
    """Sort what has arrived into `waiting`."""
    global _other
    while found := js.bridge.receive():
        data, host, port = found.split(" ")
        _other = host, int(port)
        line, data = bytes.fromhex(data).split(b":", 1)
        waiting[line.decode()].append(data)


def send(line, data):
    poll()
    if _other:
        js.bridge.send((line.encode() + b":" + data).hex(), *_other)
