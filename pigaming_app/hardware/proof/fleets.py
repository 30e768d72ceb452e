"""Robots of every driver in closed loops on the emulated arena, each with its own size, speed, delay and program."""

from dataclasses import replace
from functools import partial

from pigaming_app.hardware.calibration.ground_plane import GroundPlane
from pigaming_app.hardware.drivers.ours import OURS, RELAY, THYMIO, UDP
from pigaming_app.hardware.emulator.radio import MODERATE, RadioChannel
from pigaming_app.hardware.emulator.thymio import ThymioRadio
from pigaming_app.hardware.emulator.wifi.air import WifiChannel
from pigaming_app.hardware.emulator.wifi.radio import MicrobitRadio, XBeeBoardRadio
from pigaming_app.hardware.proof.stands import MODES
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.robot_kinds import CHASSIS, robot_kind
from pigaming_app.hardware.session.emulated import EmulatedFleet

FPS = 30.0
FASTEST = 0.75  # share of its wheels' speed at which a slow robot is followed
FLEETS = {  # by driver, and by board or chassis where a driver has several programs
    **{name: EmulatedFleet(OURS[name]) for name in MODES},
    "pololu_2040": EmulatedFleet(
        OURS["api2"],
        robot_kind("3pi_2040"),
        partial(XBeeBoardRadio, channel=MODERATE, board="board_pololu_2040"),
    ),
    RELAY: EmulatedFleet(OURS[RELAY], OURS[RELAY].kind, MicrobitRadio),
    **{one: EmulatedFleet(OURS[RELAY], robot_kind(one), partial(MicrobitRadio, board=one)) for one in CHASSIS},
    UDP: EmulatedFleet(OURS[UDP], OURS[UDP].kind),
    THYMIO: EmulatedFleet(OURS[THYMIO], OURS[THYMIO].kind, ThymioRadio),
}


def bed_of(
    name: str,
    seed: int,
    ground: GroundPlane | None = None,
    fps: float = FPS,
    drops: float = 0.0,
    channel: RadioChannel = MODERATE,
) -> Testbed:
    """A testbed with one of FLEETS; `channel`: of XBees without boards. Raises NoMicroPython."""
    fleet = FLEETS[name]
    if name in MODES:
        channel = replace(channel, mode=MODES[name])
    wifi = WifiChannel() if name == UDP else None
    return Testbed(seed, fps, drops, channel, ground, wifi, fleet)


def pace_of(name: str, bed: Testbed) -> float:
    """The speed at which robots of one of FLEETS are followed, mm/s."""
    return min(bed.showing.speed, FASTEST * FLEETS[name].kind.wheel_mm)
