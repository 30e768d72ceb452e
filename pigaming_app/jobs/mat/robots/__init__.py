"""Status of robots, radios and cameras; on request pairing (each robot spins in turn), latency, set-up of radios.

`robots check DRIVER` tries every promise of a driver on its emulated robots; `robots setup` makes the board on USB a
robot; `robots update` gives robots on Wi-Fi the program of this version.
"""

import json
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.radio.packets import DEADMAN, EMPTY, PARKED, RESTARTED
from pigaming_app.hardware.robot_kinds import set_up_command
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable, camera_warning
from pigaming_app.jobs.mat.robots import conformance, radio_setup, usb_setup, wifi_setup
from pigaming_app.jobs.mat.sessions import robots_of
from pigaming_app.jobs.terminal.options import argument, flag, require_unused
from pigaming_app.jobs.terminal.refusal import Refusal, require, sentence
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.settings import Settings, folders
from pigaming_app.ui.i18n import english

if TYPE_CHECKING:
    from pigaming_app.hardware.control.rig import Rig

LISTEN = 2.5  # s
HZ = 50
CASES = {
    "fits": "drives marker {marker}, as expected",
    "swapped": "drives marker {marker}: swap the markers, or keep this pairing",
    "none": "no marker turned: it is covered or off the mat, or the battery is empty",
    "wired": "the robot with marker {marker} turned the wrong way or drove off: check its motor wires",
    "several": "more than one robot turned: two radios have the same number",
    "twice": "two robots wear the same marker",
    "absent": "no answer",
}
MISFITS = {
    "old": "old firmware",
    "no_arena": "no arena number",
    "foreign": "no signal, only from another arena's robot",
    "key": "another key",
}
STATES = {  # flags of a robot's reports
    "parked": "stopped by its button",
    "empty": "battery empty, motors off",
    "deaf": "receives no commands",
    "restarted": "restarted by its watchdog",
}
STATUS = {
    **MISFITS,
    "ours": "ready",
    "foreign": "of another arena",
    "taken": "another robot has its number",
    "number": "its number is not 1 to 4",
}


@dataclass(frozen=True, kw_only=True)
class RobotsOptions(wifi_setup.WifiSetupOptions, radio_setup.RadioSetupOptions, usb_setup.UsbSetupOptions):
    """What to do with the robots."""

    check: tuple[str, ...] = argument(
        "check and a driver, such as udp: its promises, tried on emulated robots; setup, and a port if there are "
        "several: the board on USB becomes a robot; update, and a robot if not all: its program, over the air",
        default=(),
        nargs="*",
        metavar="check DRIVER | setup PORT | update ROBOT",
    )
    pair: bool = flag("spin each robot in turn to find its marker")
    latency: bool = flag("wiggle each robot to measure the end-to-end latency")
    drive: bool = flag(
        "drive all robots at full speed on the empty mat; who responds too late, is held slower from then on"
    )

    @property
    def moves(self) -> bool:
        """True if robots are to move in view of the camera."""
        return self.pair or self.latency or self.drive


def run(options: RobotsOptions) -> int:
    """Print the status. Raises Refusal."""
    if options.check[:1] == ("setup",):
        return usb_setup.set_up(options, options.check)
    require_unused(options, usb_setup.OPTIONS, "setup: main.py robots setup")
    if options.check[:1] == ("update",):
        return wifi_setup.update(options.check)
    if options.check:
        return conformance.check(options, options.check)
    options.mat_settings()
    settings = radio_setup.save_arena(options)
    if wifi_setup.supply_file(options, settings):
        return 0
    if options.wheels is not None:
        with robots_of(options, options.radio) as session:
            wifi_setup.turn_wheels(session, options.wheels)
        return 0
    if options.radio_setup is not None:
        return radio_setup.set_up(options, options.radio_setup, settings)
    if options.emulate is not None or options.moves:
        require("hardware")
    status = look(options)
    if options.json:
        print(json.dumps(status))
    else:
        _print(status)
    return 0


def look(options: RobotsOptions) -> dict[str, Any]:
    """The status by name; a fault is a sentence. Raises Refusal."""
    from pigaming_app.hardware.radio.serial_line import ports
    from pigaming_app.hardware.vision.discovery import cameras

    status: dict[str, Any] = {
        "ports": [port._asdict() for port in ports()],
        "cameras": [camera._asdict() for camera in cameras()],
    }
    with robots_of(options, options.radio) as session:
        try:
            status["arena"] = session.arena_id
            return {**status, **_full_status(session, options)}
        except RobotsUnavailable as trouble:
            if options.moves:
                raise Refusal(f"Robots move only in view of the camera. {sentence(trouble)}") from None
            return {**status, **_radio_status(session), "eyes": sentence(trouble)}


def _radio_status(session: RobotSession) -> dict[str, Any]:
    """The status by radio alone."""
    link = session.open_link()
    time.sleep(LISTEN)
    robots = [_robot(link, i, i, None) for i in range(4)]
    return {"radio": _sentence(session.fault), "robots": robots, "network": wifi_setup.network(session)}


def _full_status(session: RobotSession, options: RobotsOptions) -> dict[str, Any]:
    """The status by radio and camera; then pairing and latency on request. Raises RobotsUnavailable or Refusal."""
    rig, status = session.open(), dict[str, Any]()
    for _ in range(round(LISTEN * HZ)):
        session.tick()
        rig.pump()
    seen = rig.sense()
    status["radio"], status["eyes"] = _sentence(rig.link.fault), _sentence(rig.camera.fault)
    status["picture"] = _sentence(camera_warning(session, rig))
    status["robots"] = [_robot(rig.link, i, rig.channels[i], seen[i]) for i in range(4)]
    status["network"] = wifi_setup.network(session)
    movable = [i for i in range(4) if status["robots"][i]["heard"]]
    if options.moves and not movable:
        raise Refusal(status["radio"] or "No robot answers: are they switched on?")
    if options.pair:
        status["pairing"] = _pair(session, rig, save=options.emulate is None)
    if options.latency:
        status["latency"] = [_latency(session, rig, i) for i in movable if status["robots"][i]["seen"]]
    if options.drive:
        seen_robots = [i for i in movable if status["robots"][i]["seen"]]
        status["drive"] = _drive(session, rig, seen_robots, save=options.emulate is None)
    return status


def _sentence(message: OperatorMessage | None) -> str | None:
    return english().long_sentence(message) if message else None


def _robot(link: Any, robot: int, channel: int, seen: Any) -> dict[str, Any]:
    """One robot: its radio, battery (V), share of reports received, and pose (px, px, rad) if it is seen."""
    report, quality, misfit = link.telemetry.get(channel), link.quality(channel), link.misfit(channel)
    visible, flags = seen is not None and seen.age < 1.0, report.flags if report else 0
    return {
        "robot": robot + 1,
        "radio": channel + 1,
        "heard": report is not None and quality.share > 0.0,
        "misfit": misfit.reason if misfit else None,
        "deaf": bool(flags & DEADMAN),
        "parked": bool(flags & PARKED),
        "empty": bool(flags & EMPTY),
        "restarted": bool(flags & RESTARTED),
        "battery": round(report.battery, 2) if report else None,
        "share": round(quality.share, 2),
        "strength": quality.strength,
        "echo_ms": None if quality.echo is None else round(1000 * quality.echo),
        "seen": visible,
        "at": [round(float(value), 2) for value in seen[:3]] if visible else None,
    }


def _pair(session: RobotSession, rig: "Rig", save: bool) -> list[dict[str, Any]]:
    """Spin each robot in turn; the pairing is saved if it is unambiguous. Raises Refusal."""
    from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
    from pigaming_app.hardware.session.store import save_pairing

    pairing = Pairing(rig)
    while not pairing.tick():
        session.tick()
    rig.channels = pairing.channels
    unambiguous = {PairingCase.FITS, PairingCase.SWAPPED, PairingCase.ABSENT}
    if save and {finding.case for finding in pairing.findings} <= unambiguous:
        save_pairing(pairing.channels, rig.camera_delay)
    return [
        {
            "radio": finding.channel + 1,
            "marker": None if finding.marker is None else finding.marker + 1,
            "case": str(finding.case),
        }
        for finding in sorted(pairing.findings)
    ]


def _latency(session: RobotSession, rig: "Rig", robot: int) -> dict[str, Any]:
    """The latency of one robot, in ms; None where it did not move or was hardly seen."""
    from pigaming_app.hardware.commissioning.latency import LatencyTest

    test = LatencyTest(rig, robot)
    while not test.tick():
        session.tick()
    result = test.result()
    names = ("acts", "picture", "total", "lag")
    return {"robot": robot + 1, **{f"{name}_ms": result and round(1000 * getattr(result, name)) for name in names}}


def _drive(session: RobotSession, rig: "Rig", robots: list[int], save: bool) -> list[dict[str, Any]]:
    """The test drive of these robots; their top speeds are saved. Raises Refusal."""
    from pigaming_app.hardware.commissioning.speed_trial import SpeedTrial
    from pigaming_app.hardware.session.store import save_tops

    drive = SpeedTrial(rig, robots)
    while not drive.tick():
        session.tick()
    if drive.held_up or not robots:
        raise Refusal("The test drive has ended: robots were out of sight, or did not answer.")
    if save:
        save_tops(drive.tops_mm, rig.channels)
    return [{"robot": i + 1, "top_mm_s": top or None, "late": i in drive.late} for i, top in drive.tops_mm.items()]


def _print(status: dict[str, Any]) -> None:
    for name in ("ports", "cameras"):
        devices = ", ".join(" ".join(str(part) for part in device.values()) for device in status[name])
        print(f"{name:9} {devices or 'none'}")
    print(f"arena     {status['arena']} ({_set_up(1, status)})")
    for name in ("radio", "eyes"):
        print(f"{name:9} {status.get(name) or 'ok'}")
    if status.get("picture"):
        print(f"picture   {status['picture']}")
    for robot in status["network"] or ():
        volts = f", {robot['battery']:.2f} V" if robot["battery"] else ""
        about = f"{robot['name']}, {robot['kind']}, at {robot['address']}{volts}, arena {robot['arena']}"
        print(f"Wi-Fi {robot['robot']}   {about}: {STATUS[robot['status']]}")
    for robot in status["robots"]:
        print(f"robot {robot['robot']}   {_described(robot, status)}")
    for pair in status.get("pairing", ()):
        print(f"radio {pair['radio']}   {CASES[pair['case']].format(marker=pair['marker'])}")
    for entry in status.get("latency", ()):
        text = "it did not move, or was hardly seen"
        if entry["total_ms"] is not None:
            text = f"{entry['total_ms']} ms: {entry['acts_ms']} to the motors, {entry['picture_ms']} for the picture"
        print(f"latency {entry['robot']} {text}")
    for entry in status.get("drive", ()):
        top = (
            f"held to {entry['top_mm_s']} mm/s, as all are in a match with it" if entry["top_mm_s"] else "at full speed"
        )
        print(f"robot {entry['robot']}   {'too late to play: use another radio' if entry['late'] else top}")


def _set_up(robot: int, status: dict[str, Any]) -> str:
    """The command that sets up a robot."""
    radio, kinds = "udp" if status["network"] is not None else "", Settings.load(folders().config)[0].kinds
    return set_up_command(robot, status["arena"], radio, kinds[robot - 1])


def _described(robot: dict[str, Any], status: dict[str, Any]) -> str:
    if robot["misfit"]:
        return f"{MISFITS[robot['misfit']]}: {_set_up(robot['radio'], status)}"
    if not robot["heard"]:
        return "no reports" + (", seen" if robot["seen"] else "")
    strength = "" if robot["strength"] is None else f" at {robot['strength']} dBm"
    echo = "" if robot["echo_ms"] is None else f", answers in {robot['echo_ms']} ms"
    where = f", seen at {robot['at'][0]:.0f}, {robot['at'][1]:.0f}" if robot["seen"] else ", not seen"
    states = "".join(f", {state}" for name, state in STATES.items() if robot[name])
    return f"{robot['battery']:.2f} V, {robot['share']:.0%} of its reports{strength}{echo}{where}{states}"
