"""Stand-in of the module `network`: a station that is connected soon after `connect`, if there is a network.

A second `connect` while an ESP32 is still at it is an error, as in the real one.
"""

import js
from machine import ESP32

STA_IF = 0


class WLAN:
    PM_NONE = 0

    def __init__(self, interface):
        self.since = None

    def active(self, on):
        pass

    def config(self, pm):
        pass

    def connect(self, name, password):
        if self.since is not None and ESP32:
            raise OSError("Wifi Internal Error")
        self.since = js.bridge.ticks()

    def isconnected(self):
        return self.since is not None and js.bridge.ticks() - self.since > 100 and not js.bridge.offline()
