"""The job `robots`: what is plugged in, which robots are there and how well; on request who is who, and how late."""

import json
import time
from argparse import Namespace
from typing import TYPE_CHECKING, Any

from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.hardware.session.robot_session import RobotSession, RobotsUnavailable
from pigaming_app.jobs.sessions import new_session
from pigaming_app.ui.i18n import english

if TYPE_CHECKING:
    from pigaming_app.hardware.control.rig import Rig

LISTEN = 2.5  # s
HZ = 50
CASES = {
    "fits": "drives marker {marker}, as it should",
    "swapped": "drives marker {marker}: swap the markers, or go on like this",
    "none": "no marker turned: is it covered, off the mat, or the battery empty?",
    "wired": "the robot with marker {marker} turned the wrong way or drove off: check the wires of its motors",
    "several": "more than one robot turned: two radios have the same number",
    "twice": "two robots wear the same marker",
    "absent": "nobody answers there",
}


class NotThere(Exception):
    """What was asked for cannot be done; the text is one sentence."""


def run(arguments: Namespace) -> int:
    """Do the job. Raises NotThere."""
    told = look(arguments)
    if arguments.json:
        print(json.dumps(told))
    else:
        _print(told)
    return 0


def look(arguments: Namespace) -> dict[str, Any]:
    """All that is known, by name; faults as sentences. Raises NotThere."""
    from pigaming_app.hardware.radio.serial_line import ports
    from pigaming_app.hardware.vision.discovery import cameras

    told: dict[str, Any] = {
        "ports": [found._asdict() for found in ports()],
        "cameras": [known._asdict() for known in cameras()],
    }
    try:
        session = new_session(arguments.emulate, arguments.camera, arguments.port)
    except RobotsUnavailable as trouble:
        raise NotThere(english().explained(trouble.message)) from None
    try:
        return {**told, **_looked(session, arguments)}
    except RobotsUnavailable as trouble:
        reason = english().explained(trouble.message)
        if arguments.pair or arguments.latency:
            raise NotThere(f"Robots can only be moved where they are seen. {reason}") from None
        return {**told, **_heard(session), "eyes": reason}
    finally:
        session.end()


def _heard(session: RobotSession) -> dict[str, Any]:
    """What the radio alone tells."""
    link = session.listen()
    time.sleep(LISTEN)
    return {"radio": _sentence(session.trouble), "robots": [_robot(link, i, i, None) for i in range(4)]}


def _looked(session: RobotSession, arguments: Namespace) -> dict[str, Any]:
    """What is heard and seen; then the robots move, if that was asked for. Raises RobotsUnavailable, NotThere."""
    rig, told = session.open(), dict[str, Any]()
    for _ in range(round(LISTEN * HZ)):
        session.tick()
        rig.pump()
    seen = rig.sense()
    told["radio"], told["eyes"] = _sentence(rig.link.trouble), _sentence(rig.camera.trouble)
    told["robots"] = [_robot(rig.link, i, rig.channels[i], seen[i]) for i in range(4)]
    movable = [i for i in range(4) if told["robots"][i]["heard"]]
    if (arguments.pair or arguments.latency) and not movable:
        raise NotThere(told["radio"] or "No robot answers: are they switched on?")
    if arguments.pair:
        told["pairing"] = _paired(session, rig, kept=arguments.emulate is None)
    if arguments.latency:
        told["latency"] = [_late(session, rig, i) for i in movable if told["robots"][i]["seen"]]
    return told


def _sentence(message: OperatorMessage | None) -> str | None:
    return english().explained(message) if message else None


def _robot(link: Any, robot: int, channel: int, seen: Any) -> dict[str, Any]:
    """One robot: its radio, battery (V), how well it is heard, where it is seen (px, px, rad)."""
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
    """Spin each robot in turn; remember who is who unless it is unclear."""
    from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
    from pigaming_app.hardware.session.store import save_radios
    from pigaming_app.storage.safe_files import NotSaved

    pairing = Pairing(rig)
    while not pairing.tick():
        session.tick()
    rig.channels = pairing.channels
    if kept and {one.case for one in pairing.findings} <= {PairingCase.FITS, PairingCase.SWAPPED, PairingCase.ABSENT}:
        try:
            save_radios(pairing.channels)
        except NotSaved as trouble:
            raise NotThere(str(trouble)) from None
    return [
        {"radio": one.channel + 1, "marker": None if one.marker is None else one.marker + 1, "case": str(one.case)}
        for one in sorted(pairing.findings)
    ]


def _late(session: RobotSession, rig: "Rig", robot: int) -> dict[str, Any]:
    """Shake one robot."""
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
