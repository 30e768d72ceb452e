"""Updates over the air: messages write a new program into the folder that is not in use, and put it on trial.

`answer` carries out a message, whose code wifi.py has checked, unless the robot was driven within IDLE_MS. Its letter:
N name, begin a file; D place (4 bytes) and data, in order; E hash, the file is complete; T, put the complete program on
trial and restart; K, keep the program on trial and restart; Q, which program is this? The answer is the letter and 1,
or 0 if refused; after D the length of the file, after Q the folder, whether it is kept, and the hash. T and K are
answered by the restart. A cut of the power at any moment leaves a program that starts.
"""

import os
import sys
import time
from hashlib import sha256

from machine import reset

FILES = "robot.py", "motors.py", "wifi.py", "update.py"
IDLE_MS = 3000
HERE = sys.path[0] if sys.path[0] in ("a", "b") else ""
THERE = "b" if HERE == "a" else "a"


class Draft:
    """The file that is being written, and the names of those that are complete."""

    name, file, length, done = "", None, 0, ()


def answer(body, robot):
    """The answer to a message."""
    word = body[:1]
    idle = robot.seq < 0 or time.ticks_diff(time.ticks_ms(), robot.driven) >= IDLE_MS
    try:
        return word + (WORDS[word](body[1:]) if idle and robot.stopped else b"\0")
    except (KeyError, OSError, ValueError):
        return word + b"\0"


def begin(body):
    name = body.decode()
    if name not in FILES:
        raise ValueError(name)
    if THERE not in os.listdir():
        os.mkdir(THERE)
    if Draft.file:
        Draft.file.close()
    Draft.name, Draft.length, Draft.done = name, 0, [one for one in Draft.done if one != name]
    Draft.file = open(THERE + "/part", "wb")  # noqa: SIM115
    return b"\1"


def add(body):
    if Draft.file and int.from_bytes(body[:4], "big") == Draft.length:
        Draft.length += Draft.file.write(body[4:])
    return b"\1" + Draft.length.to_bytes(4, "big")


def end(body):
    if Draft.file:
        Draft.file.close()
        Draft.file = None
        if digest([THERE + "/part"]) != body:
            return b"\0"
        put(THERE + "/part", THERE + "/" + Draft.name)
        Draft.done.append(Draft.name)
    return b"\1" if Draft.name in Draft.done else b"\0"


def put_on_trial(_):
    if len(Draft.done) == len(FILES):
        point("trial", THERE)
        reset()
    return b"\0"


def keep(_):
    if HERE and not is_kept():
        point("kept", HERE)
        reset()
    return b"\0"


def tell(_):
    files = [HERE + "/" + name if HERE else name for name in FILES]
    return b"\1" + (HERE or "-").encode() + bytes([is_kept()]) + digest(files)


def is_kept():
    """True if this program starts the next time, too."""
    try:
        with open("kept") as text:
            return text.read() == HERE
    except OSError:
        return not HERE


def point(name, folder):
    """Let a file name a folder, at once or not at all."""
    with open("part", "w") as text:
        text.write(folder)
    put("part", name)


def put(old, new):
    """Rename a file; FAT wants the one before removed."""
    try:
        os.rename(old, new)
    except OSError:
        os.remove(new)
        os.rename(old, new)


def digest(names):
    """SHA-256 of these files, one after the other."""
    total = sha256()
    for name in names:
        with open(name, "rb") as file:
            part = file.read(256)
            while part:
                total.update(part)
                part = file.read(256)
    return total.digest()


WORDS = {b"N": begin, b"D": add, b"E": end, b"T": put_on_trial, b"K": keep, b"Q": tell}
