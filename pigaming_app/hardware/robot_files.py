"""Files for robots that run MicroPython, with the numbers of their arena, and the commands that set up robots."""

from pathlib import Path

PROGRAM = Path(__file__).parent / "firmware" / "micropython"
RELAY = 0  # number of the micro:bit on USB


def robot_config(robot: int, arena: int, key: bytes) -> str:
    """`config.py` of a Wi-Fi robot (1 to 4): the example with the values of this arena."""
    text = (PROGRAM / "config_example.py").read_text("utf-8")
    text = text.replace("ROBOT = 1", f"ROBOT = {robot}").replace("Robot 1", f"Robot {robot}")
    return text.replace("ARENA = 0", f"ARENA = {arena}").replace("0" * 32, key.hex())


def microbit_program(number: int, arena: int) -> str:
    """The program of a micro:bit: of robot 1 to 4, or of the RELAY."""
    text = (PROGRAM / "microbit" / ("robot.py" if number else "relay.py")).read_text("utf-8")
    return text.replace("ROBOT, ARENA = 1, 0", f"ROBOT, ARENA = {number}, {arena}").replace(
        "ARENA = 0  #", f"ARENA = {arena}  #"
    )


def set_up_command(robot: int, arena: int, radio: str, kind: str = "") -> str:
    """The command that gives a robot (1 to 4) its numbers. `radio`: of the settings; `kind`: see robot_kinds."""
    if radio == "udp":
        return f"python3 main.py robots --wifi-config {robot} --out config.py"
    if kind == "microbit":
        return f"python3 main.py robots --microbit {robot} --out robot{robot}.py"
    return f"make flash ADDRESS={robot} ARENA={arena}"
