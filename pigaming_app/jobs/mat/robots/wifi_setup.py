"""Robots with MicroPython in the job `robots`: their files, the robots on the network, a first turn of the wheels."""

import time
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.radio.packets import ROBOTS
from pigaming_app.hardware.robot_kinds import CHASSIS, RELAY, microbit_program, robot_config, robot_kind
from pigaming_app.hardware.session.robot_session import RobotSession
from pigaming_app.jobs.terminal.options import integer, option, path
from pigaming_app.jobs.terminal.refusal import Refusal, refused
from pigaming_app.storage.messages import OperatorError
from pigaming_app.storage.safe_files import NotSaved, require_writable, write_with_backup
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english

if TYPE_CHECKING:
    from pigaming_app.hardware.commissioning.air_update import AirUpdate

APPEARS, TURNS = 5.0, 1.5  # s: for a robot to report; for each turn of the wheels
TICK = 0.02  # s
GENTLE = 0.25  # of full speed
WHEELS = {  # commands of left and right wheel
    "left wheel ahead": (GENTLE, 0.0),
    "right wheel ahead": (0.0, GENTLE),
    "both wheels back": (-GENTLE, -GENTLE),
}


@dataclass(frozen=True, kw_only=True)
class WifiSetupOptions:
    """Files of robots with MicroPython, and a turn of their wheels."""

    wifi_config: int | None = option("the config.py of a Wi-Fi robot, 1 to 4", integer(1, ROBOTS), metavar="ROBOT")
    microbit: int | None = option(
        "the program of a micro:bit: 0 for the relay, 1 to 4 for a robot", integer(RELAY, ROBOTS), metavar="NUMBER"
    )
    chassis: str | None = option(
        "with --microbit: what a robot's micro:bit is plugged into, instead of a DRV8833", choices=CHASSIS
    )
    out: Path | None = option("write that file, in UTF-8, instead of printing it", path, metavar="FILE")
    wheels: int | None = option("turn the wheels of a robot that stands on blocks", integer(1, ROBOTS), metavar="ROBOT")


def supply_file(options: WifiSetupOptions, settings: Settings) -> bool:
    """Write or print the file of a robot; false if none is wanted. Raises Refusal, also if settings are not saved."""
    from pigaming_app.hardware.session.store import arena_id, wifi_key

    if options.wifi_config is not None:
        text = robot_config(options.wifi_config, arena_id(settings), wifi_key(settings))
    elif options.microbit is not None:
        if options.chassis and options.microbit == RELAY:
            raise Refusal("--chassis: the relay has none")
        text = microbit_program(options.microbit, arena_id(settings), options.chassis or "")
    elif options.chassis is not None:
        raise Refusal("--chassis goes with --microbit")
    elif options.out is not None:
        raise Refusal("--out is the file of --wifi-config or --microbit")
    else:
        return False
    saved, _ = Settings.load(folders().config)
    if (saved.arena_id, saved.wifi_key) != (settings.arena_id, settings.wifi_key):
        raise Refusal("the settings cannot be saved: the arcade would have another arena number or key the next time")
    if options.out is None:
        print(text, end="")
        return True
    with refused(NotSaved):
        require_writable(options.out)
        write_with_backup(options.out, text)
    print(options.out)
    return True


def update(words: Sequence[str]) -> int:
    """Give robots on Wi-Fi the program of this version, over the air: all that call, or the one in the words.

    Raises Refusal, also while an arcade runs here: it has the port, and may be in a match.
    """
    from pigaming_app.hardware.commissioning.air_update import AirUpdate, program
    from pigaming_app.hardware.radio.wifi import PORT, WifiNetwork
    from pigaming_app.hardware.session.store import arena_id, wifi_key

    if len(words) > 2 or not set(words[1:]) <= {"1", "2", "3", "4"}:
        raise Refusal("robots update: one word more, a robot: robots update 2")
    settings, _ = Settings.load(folders().config)
    network = WifiNetwork(arena_id(settings), wifi_key(settings), time.monotonic)
    with closing(network):
        try:
            network.open()
        except OSError:
            raise Refusal(f"UDP port {PORT} is in use: end the arcade first, nobody is updated in a match") from None
        deadline = time.monotonic() + APPEARS
        while time.monotonic() < deadline and network.in_waiting >= 0:
            time.sleep(TICK)
        wanted = [int(word) for word in words[1:]] or range(1, ROBOTS + 1)
        ours = [one.announced.address for one in network.robots if one.status == "ours"]
        found = [number for number in wanted if number in ours]
        if not found:
            raise Refusal("No robot on Wi-Fi calls: is it switched on, and of this arena?")
        done = [_updated(AirUpdate(network, number, time.sleep, _tell), program()) for number in found]
    return 0 if all(done) else 1


def _updated(update: "AirUpdate", files: Mapping[str, bytes]) -> bool:
    """Update a robot; true unless it failed, which is printed."""
    try:
        new = update.run(files)
    except OperatorError as failed:
        print(english().long_sentence(failed.message))
        return False
    print(f"robot {update.robot}   {'has the new program' if new else 'is up to date'}", flush=True)
    return True


def _tell(step: str) -> None:
    print(f"  {step}", flush=True)


def network(session: RobotSession) -> list[dict[str, Any]] | None:
    """The robots that have announced themselves by Wi-Fi, of this arena or not; None with another radio."""
    if session.network is None:
        return None
    return [
        {
            "robot": robot.announced.address,
            "name": robot.announced.name,
            "kind": robot_kind("", robot.announced.board).name,
            "battery": round(robot.announced.millivolts / 1000, 2) or None,
            "address": robot.address,
            "arena": robot.announced.arena,
            "status": robot.status,
        }
        for robot in session.network.robots
    ]


def turn_wheels(session: RobotSession, robot: int) -> None:
    """Turn the wheels of a robot on blocks one after another. Raises Refusal if it does not report."""
    from pigaming_app.hardware.signals import WheelCommand

    link = session.open_link()
    if link is None:
        raise Refusal("--wheels is for real robots: leave out --emulate")
    deadline = time.monotonic() + APPEARS
    while robot - 1 not in link.telemetry:
        if time.monotonic() > deadline:
            raise Refusal(f"Robot {robot} does not report: is it switched on, and of this arena?")
        time.sleep(TICK)
    for name, command in WHEELS.items():
        print(f"robot {robot}   {name}", flush=True)
        for _ in range(round(TURNS / TICK)):
            link.send([WheelCommand(*command) if i == robot - 1 else None for i in range(ROBOTS)])
            time.sleep(TICK)
    link.send([None] * ROBOTS)
