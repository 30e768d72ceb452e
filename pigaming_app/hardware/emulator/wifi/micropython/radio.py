"""Stand-in of the micro:bit's module `radio`: messages reach all micro:bits on the same channel and group."""

import lines

_settings = {"channel": 7, "group": 0, "length": 32, "queue": 3, "power": 6}
LIMITS = {"channel": 83, "group": 255, "length": 251, "queue": 254, "power": 7}
_on = False
_queue = []


def config(**settings):
    for name, value in settings.items():
        if not 0 <= value <= LIMITS[name]:
            raise ValueError(name)
        _settings[name] = value


def on():
    global _on
    _on = True


def _address():
    return bytes([_settings["channel"], _settings["group"]])


def send_bytes(message):
    if not _on:
        raise ValueError("radio is not enabled")
    lines.send("radio", _address() + message[: _settings["length"]])


def receive_bytes():
    if not _on:
        raise ValueError("radio is not enabled")
    lines.poll()
    arrived, lines.waiting["radio"] = lines.waiting["radio"], []
    for data in arrived:
        if data[:2] == _address() and len(_queue) < _settings["queue"]:
            _queue.append(data[2 : 2 + _settings["length"]])
    return _queue.pop(0) if _queue else None
