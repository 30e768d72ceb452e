"""Proof of the Wi-Fi robots: their own program, in MicroPython, stops the motors in every emergency.

Pairing and the faults of `emergencies`, in the emulated arena's time. For the ends of whole arcades see `outside`.
"""

from pigaming_app.hardware.commissioning.pairing import Pairing, PairingCase
from pigaming_app.hardware.emulator.wifi.air import WifiChannel
from pigaming_app.hardware.proof import emergencies
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import FigureEight
from pigaming_app.sim.world import HZ, ROBOTS

LOSSY = WifiChannel(0.002, 0.040, loss=0.05, duplicates=0.02)  # overtaking included
FAULTS = ("radio dead", "robot mute", "robot off", "battery empty", "all-stop")  # of emergencies.EMERGENCIES
LISTEN = 3  # s, within which robots announce themselves and report


def faults(seed: int, channel: WifiChannel = LOSSY) -> dict[str, float]:
    """Stopping times, s, of paired robots in the emulated arena. Raises RuntimeError if a fault is not reported."""
    bed = Testbed(seed, 30.0, wifi=channel)
    try:
        bed.session.find()
        pair(bed)
        trail = FigureEight(bed)
        stops = {}
        for i, name in enumerate(FAULTS):
            result = emergencies.stop(trail, name, i % ROBOTS)
            if not result.reported:
                raise RuntimeError(f"{name}: the fault was not reported")
            stops[name] = result.seconds
        return stops | {"program hangs": emergencies.hang(trail), "program ends": emergencies.leave(trail)}
    finally:
        bed.session.end()


def pair(bed: Testbed) -> None:
    """Spin each robot in turn, once all report. Raises RuntimeError unless each turns the marker of its number."""
    for _ in range(LISTEN * HZ):
        bed.tick()
    pairing = Pairing(bed.rig)
    while not pairing.tick():
        bed.tick()
    cases = [finding.case for finding in pairing.findings]
    bed.rig.channels = pairing.channels
    if cases != [PairingCase.FITS] * ROBOTS:
        raise RuntimeError(f"pairing: {', '.join(cases)}")
