"""The prompt of a micro:bit V2: what its MicroPython lacks is taken away, as its source has it (src/codal_port).

There are no hashlib, network and os.rename (mpconfigport.h, modos.c); the disk has 20 KB, of which one page of 4 KB is
spare, in chunks of 126 bytes, and an open file has replaced the one before (microbitfs.c, filesystem.ld).
"""

import builtins
import os

MISSING = "hashlib", "network", "binascii", "_thread"
CHUNKS, CHUNK = 128, 126  # bytes
found, opened, listdir = __import__, builtins.open, os.listdir
sizes = {}  # of files, bytes


def chunks():
    return sum((size + 2 + len(name)) // CHUNK + 1 for name, size in sizes.items())


class Sys:
    """The module `sys`."""

    platform, implementation = "microbit", ("micropython", (1, 18, 0))


class Os:
    """The module `os`."""

    listdir = staticmethod(lambda: [name for name in listdir("/") if "." in name])

    @staticmethod
    def remove(name):
        removed(name)
        sizes.pop(name, None)


removed = os.remove


class Written:
    def __init__(self, name):
        self.name, self.file = name, opened("/" + name, "wb")
        sizes[name] = 0

    def write(self, data):
        sizes[self.name] += len(data)
        if chunks() > CHUNKS:
            self.close()
            Os.remove(self.name)
            raise OSError(28)
        return self.file.write(data)

    def close(self):
        self.file.close()


def open_file(name, mode="r"):
    return Written(name) if "w" in mode else opened(name, mode)


def imported(name, *others):
    if name in MISSING:
        raise ImportError("no module named '" + name + "'")
    return MODULES[name] if name in MODULES else found(name, *others)


MODULES = {"sys": Sys, "os": Os}
builtins.open, builtins.__import__ = open_file, imported
