"""Our program for Thymios, firmware/thymio/robot.aesl, as Aseba's compiler translates it, and its linker.

Firmware versions differ in the places of their variables, so these are names here: `3:NAME+1` loads the word after the
start of a variable, `4:NAME` stores, `:NAME` is its place; `@NAME` is the number of an event of the robot itself.
"""

from collections.abc import Mapping, Sequence

DRIVE, REPORT = 0, 1  # numbers of our events
STATUS = 4  # words of a report: arena, robot, number of the last command, parked
FIRST_EVENT = 0xFFFE  # number of the first event of the robot itself; the others count down
NEEDED = ("event.args", "button.center", "motor.left.target", "motor.right.target", "timer.period")
NEEDED_EVENTS = ("timer0", "button.center")
WORDS = """
0009  0000 0009  @timer0 0026  @button.center 0035  ffff 0042
3:event.args 2000 ARENA 800a 3:event.args+1 3:status+2 800b a011 0015 3:event.args+1 4:status+2 1000 4:silence
3:status+3 1000 a00a 0006 3:LEFT 4:motor.left.target 3:RIGHT 4:motor.right.target
3:event.args+2 ROBOT a00a 0005 b001 :status 0004 0000
3:silence 1001 8002 4:silence 3:silence 1007 a00c 0008 1007 4:silence 1000 4:motor.left.target 1000 4:motor.right.target
0000
3:button.center 1001 a00a 000a 1001 3:status+3 8003 4:status+3 1000 4:motor.left.target 1000 4:motor.right.target
0000
2000 ARENA 4:status ROBOT 4:status+1 1fff 4:status+2 1000 4:status+3 1000 4:silence
1000 4:motor.left.target 1000 4:motor.right.target 1014 4:timer.period 0000
"""


def linked(places: Mapping[str, int], end: int, events: Sequence[str], arena: int, robot: int) -> list[int]:
    """The words of the program for one robot, 0 to 3.

    `places`: of its variables; `end`: the first place behind them; `events`: names of its own, in their order. Raises
    KeyError and ValueError if something NEEDED is missing.
    """
    spaces = {
        **places,
        "status": end,
        "silence": end + STATUS,
        "LEFT": places["event.args"] + 3 + 2 * robot,
        "RIGHT": places["event.args"] + 4 + 2 * robot,
    }

    def word(text: str) -> int:
        if text.startswith("@"):
            return FIRST_EVENT - events.index(text[1:])
        if text in ("ARENA", "ROBOT"):
            return arena if text == "ARENA" else 0x1000 + robot
        code, colon, name = text.rpartition(":")
        if not colon:
            return int(text, 16)
        name, _, more = name.partition("+")
        return int(code or "0", 16) << 12 | spaces[name] + int(more or "0")

    return [word(text) for text in WORDS.split()]
