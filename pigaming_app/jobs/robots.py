"""Status of robots, radios and cameras; on request pairing (each robot spins in turn) and latency."""

import json
import time
from argparse import ArgumentParser, Namespace
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.jobs.sessions import new_session
from pigaming_app.jobs.terminal.options import mat_settings, shared
from pigaming_app.jobs.terminal.refusal import Refusal, refused, require, sentence
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


def options(parser: ArgumentParser) -> None:
    parser.add_argument("--pair", action="store_true", help="spin each robot in turn to find its marker")
    parser.add_argument("--latency", action="store_true", help="wiggle each robot to measure the end-to-end latency")
    shared(parser, "--emulate", "--camera", "--port", "--json")


def run(arguments: Namespace) -> int:
    """Print the status. Raises Refusal."""
    mat_settings(arguments)
    if arguments.emulate is not None or arguments.pair or arguments.latency:
        require("hardware")
    told = look(arguments)
    if arguments.json:
        print(json.dumps(told))
    else:
        _print(told)
    return 0


def look(arguments: Namespace) -> dict[str, Any]:
    """The status by name; a fault is a sentence. Raises Refusal."""
    from pigaming_app.hardware.radio.serial_line import ports
    from pigaming_app.hardware.vision.discovery import cameras

    told: dict[str, Any] = {
        "ports": [found._asdict() for found in ports()],
        "cameras": [known._asdict() for known in cameras()],
    }
    with refused(RobotsUnavailable):
        session = new_session(arguments.emulate, arguments.camera, arguments.port)
    try:
        return {**told, **_looked(session, arguments)}
    except RobotsUnavailable as trouble:
        if arguments.pair or arguments.latency:
            raise Refusal(f"Robots move only in view of the camera. {sentence(trouble)}") from None
        return {**told, **_heard(session), "eyes": sentence(trouble)}
    finally:
        session.end()


def _heard(session: RobotSession) -> dict[str, Any]:
    """The status by radio alone."""
    link = session.listen()
    time.sleep(LISTEN)
    return {"radio": _sentence(session.trouble), "robots": [_robot(link, i, i, None) for i in range(4)]}


def _looked(session: RobotSession, arguments: Namespace) -> dict[str, Any]:
    """The status by radio and camera; then pairing and latency on request. Raises RobotsUnavailable or Refusal."""
    rig, told = session.open(), dict[str, Any]()
    for _ in range(round(LISTEN * HZ)):
        session.tick()
        rig.pump()
    seen = rig.sense()
    told["radio"], told["eyes"] = _sentence(rig.link.trouble), _sentence(rig.camera.trouble)
    told["robots"] = [_robot(rig.link, i, rig.channels[i], seen[i]) for i in range(4)]
    movable = [i for i in range(4) if told["robots"][i]["heard"]]
    if (arguments.pair or arguments.latency) and not movable:
        raise Refusal(told["radio"] or "No robot answers: are they switched on?")
    if arguments.pair:
        told["pairing"] = _paired(session, rig, kept=arguments.emulate is None)
    if arguments.latency:
        told["latency"] = [_late(session, rig, i) for i in movable if told["robots"][i]["seen"]]
    return told


def _sentence(message: OperatorMessage | None) -> str | None:
    return english().explained(message) if message else None


def _robot(link: Any, robot: int, channel: int, seen: Any) -> dict[str, Any]:
    """One robot: its radio, battery (V), share of reports received, and pose (px, px, rad) if it is seen."""
    report, quality = link.telemetry.get(channel), link.quality(channel)
    there = seen is not None and seen.age < 1.0
    return {
        "robot": robot + 1,
        "radio": channel + 1,
        "heard": report is not None and quality.share > 0.0,
        "battery": round(report.battery, 2) if report else None,
        "share": round(quality.share, 2),
        "strength": quality.strength,
        "echo_ms": None if quality.echo is None else round(1000 * quality.echo),
        "seen": there,
        "at": [round(float(one), 2) for one in seen[:3]] if there else None,
    }


def _paired(session: RobotSession, rig: "Rig", kept: bool) -> list[dict[str, Any]]:
    """Spin each robot in turn; the pairing is saved if it is unambiguous. Raises Refusal."""
    from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
    from pigaming_app.hardware.session.store import save_radios

    pairing = Pairing(rig)
    while not pairing.tick():
        session.tick()
    rig.channels = pairing.channels
    if kept and {one.case for one in pairing.findings} <= {PairingCase.FITS, PairingCase.SWAPPED, PairingCase.ABSENT}:
        save_radios(pairing.channels)
    return [
        {"radio": one.channel + 1, "marker": None if one.marker is None else one.marker + 1, "case": str(one.case)}
        for one in sorted(pairing.findings)
    ]


def _late(session: RobotSession, rig: "Rig", robot: int) -> dict[str, Any]:
    """The latency of one robot, in ms; None where it did not move or was hardly seen."""
    from pigaming_app.hardware.commissioning.latency import LatencyTest

    shake = LatencyTest(rig, robot)
    while not shake.tick():
        session.tick()
    found = shake.result()
    names = ("acts", "picture", "total", "lag")
    return {"robot": robot + 1, **{f"{name}_ms": found and round(1000 * getattr(found, name)) for name in names}}


def _print(told: dict[str, Any]) -> None:
    for name in ("ports", "cameras"):
        there = ", ".join(" ".join(str(part) for part in one.values()) for one in told[name])
        print(f"{name:9} {there or 'none'}")
    for name in ("radio", "eyes"):
        print(f"{name:9} {told.get(name) or 'well'}")
    for one in told["robots"]:
        print(f"robot {one['robot']}   {_described(one)}")
    for one in told.get("pairing", ()):
        print(f"radio {one['radio']}   {CASES[one['case']].format(marker=one['marker'])}")
    for one in told.get("latency", ()):
        late = "it did not move, or was hardly seen"
        if one["total_ms"] is not None:
            late = f"{one['total_ms']} ms: {one['acts_ms']} to the motors, {one['picture_ms']} for the picture"
        print(f"latency {one['robot']} {late}")


def _described(one: dict[str, Any]) -> str:
    if not one["heard"]:
        return "not heard" + (", seen" if one["seen"] else "")
    strength = "" if one["strength"] is None else f" at {one['strength']} dBm"
    echo = "" if one["echo_ms"] is None else f", answers in {one['echo_ms']} ms"
    where = f", seen at {one['at'][0]:.0f}, {one['at'][1]:.0f}" if one["seen"] else ", not seen"
    return f"{one['battery']:.2f} V, {one['share']:.0%} of its reports{strength}{echo}{where}"
