"""Figures of `bench robots` for each way of showing and for each driver."""

from collections.abc import Callable, Mapping

from pigaming_app.hardware.drivers.ours import RELAY, THYMIO
from pigaming_app.hardware.proof import emergencies
from pigaming_app.hardware.proof.emergencies import GAPS, HEADINGS, MISWIRED
from pigaming_app.hardware.proof.fleets import FLEETS, bed_of, pace_of
from pigaming_app.hardware.proof.hostile import false_robots
from pigaming_app.hardware.proof.showings import SHOWINGS
from pigaming_app.hardware.proof.testbed import Testbed
from pigaming_app.hardware.proof.trials import FigureEight, follow
from pigaming_app.sim.world import ROBOTS

Figures = Mapping[str, float]
FPS = 30.0
PICTURES = 5_000  # hostile ones, of each way of showing
FOLLOWED = 20.0, 6.0  # s of tracking, for a way of showing and for a driver
ELECTRICAL = ("radio dead", "robot off", "all-stop", "battery empty")  # of EMERGENCIES
UNMEASURED = (RELAY, THYMIO)  # robots whose battery is not measured, or only once in four seconds
FAST = 260.0  # px/s, of a robot without turbo
CLOSED = (THYMIO,)  # robots whose motors nobody wires
DRIVERS = tuple(name for name in FLEETS if name not in ("cutebot", "maqueen"))  # their program is that of `relay`


def of_showing(name: str, seed: int = 1, pictures: int = PICTURES, seconds: float = FOLLOWED[0]) -> Figures:
    """Pose errors, the share of complete pictures (from below), errors of the calibration, and robots that are none."""
    bed = Testbed(seed, FPS, showing=SHOWINGS[name])
    run = follow(FigureEight(bed), seconds)
    return {
        "pose_rmse_mm": run.rmse_mm,
        "pose_rmse_deg": run.rmse_deg,
        "frames_complete": run.complete,
        "calibration_mean_mm": bed.ground.mean_mm,
        "calibration_max_mm": bed.ground.max_mm,
        "false_robots": float(false_robots(bed, pictures, seed)),
    }


def of_driver(name: str, seed: int = 1, seconds: float = FOLLOWED[1]) -> Figures:
    """Pose errors; times until motors are off after electrical and mechanical faults; how far a broken robot came off
    its way; how far a miswired one came out of the arena. Raises RuntimeError, NoMicroPython.
    """
    bed = bed_of(name, seed)
    try:
        bed.session.find()
        if bed.session.network is not None:
            emergencies.pair(bed)
        trail = FigureEight(bed, pace_of(name, bed))
        emergencies.settle(trail)
        run = follow(trail, seconds)
        faults = ELECTRICAL[: 3 + (name not in UNMEASURED)]
        stops = [_stop(trail, fault, robot) for robot, fault in enumerate(faults)]
        wired = emergencies.BREAKDOWNS if name not in CLOSED else emergencies.BREAKDOWNS[:2]
        broken = [emergencies.break_down(trail, fault, robot % ROBOTS) for robot, fault in enumerate(wired)]
        stops.append(emergencies.hang(trail))
        outside = [] if name in CLOSED else [edge(bed) for edge in _edges()]
        emergencies.settle(trail)
        stops.append(emergencies.leave(trail))
    finally:
        bed.session.end()
    return {
        "pose_rmse_mm": run.rmse_mm,
        "pose_rmse_deg": run.rmse_deg,
        "worst_stop_ms": 1e3 * max(stops),
        "breakdown_ms": 1e3 * max(one.seconds for one in broken),
        "breakdown_mm": max(one.mm for one in broken),
        **({"outside_mm": max(0.0, *outside)} if outside else {}),
    }


def _stop(trail: FigureEight, fault: str, robot: int) -> float:
    result = emergencies.stop(trail, fault, robot)
    if not result.reported:
        raise RuntimeError(f"{fault}: the fault was not reported")
    return result.seconds


def _edges() -> list[Callable[[Testbed], float]]:
    """Each miswiring near the edge and towards it, and once each further off at another heading."""

    def edge(fault: str, gap: float, heading: float) -> Callable[[Testbed], float]:
        return lambda bed: emergencies.gone_over_edge(bed, fault, gap, heading, FAST)

    near = [edge(fault, GAPS[0], HEADINGS[fault == "lids_swapped"]) for fault in MISWIRED]
    return near + [edge(fault, GAPS[1 + i % 2], HEADINGS[i % 4]) for i, fault in enumerate(MISWIRED)]
