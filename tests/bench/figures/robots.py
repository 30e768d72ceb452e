"""Tables of robots on the emulated mat, and of their markers."""

from functools import cache
from typing import Any

from pigaming_app.hardware.vision.markers import ROBOT_IDS
from pigaming_app.jobs.bench.robots import BY_DRIVER, SHOWING, TARGETS, measure
from tests.bench import detection, marker_ids

PROOF = {  # figures of `bench robots`: name, unit, and the factor that leads to it
    "pose_rmse_mm": ("position at 0.35 m/s, 80 ms dead time, RMSE", "mm", 1),
    "pose_rmse_deg": ("heading, RMSE", "°", 1),
    "tracker_ms": ("tracker, one 1080p picture", "ms", 1),
    "frames_complete": ("pictures in which all four robots are found", "%", 100),
    "calibration_mean_mm": ("calibration on the second board, mean", "mm", 1),
    "calibration_max_mm": ("calibration on the second board, at most", "mm", 1),
    "wall_entry_mm": ("deepest entry into a virtual wall, 20 minutes", "mm", 1),
    "worst_stop_ms": ("slowest stop of all emergencies", "ms", 1),
    "wifi_worst_stop_ms": ("slowest stop of Wi-Fi robots", "ms", 1),
    "arcade_worst_stop_ms": ("slowest stop after failures of the whole arcade", "ms", 1),
    "false_alarms": ("false alarms in ten matches", "", 1),
    "things_missed": ("things missed", "", 1),
    "things_false": ("things that are none", "", 1),
    "things_mean_mm": ("outline, mean of the worst thing", "mm", 1),
    "things_worst_mm": ("outline, worst point", "mm", 1),
    "things_tilted_mean_mm": ("the same at 720p, tilted by 25°: mean", "mm", 1),
    "things_tilted_worst_mm": ("720p, tilted: worst point", "mm", 1),
}
SHOWN = {  # figures of each way of showing, and of each driver: heads of columns, and the factor that leads to them
    "pose_rmse_mm": ("position, RMSE, mm", 1),
    "pose_rmse_deg": ("heading, °", 1),
    "frames_complete": ("robots found, %", 100),
    "calibration_mean_mm": ("calibration, mean, mm", 1),
    "false_robots": ("false robots in 5,000 hostile pictures", 1),
}
DRIVEN = {
    "pose_rmse_mm": ("position, RMSE, mm", 1),
    "pose_rmse_deg": ("heading, °", 1),
    "worst_stop_ms": ("slowest stop, electrical, ms", 1),
    "breakdown_ms": ("mechanical, ms", 1),
    "breakdown_mm": ("off its way by then, mm", 1),
    "outside_mm": ("out of the arena, miswired, mm", 1),
}
WIDTHS = (1920, 1280, 1120, 960)  # px, of the picture
LOOKS = {  # defocus, px, and exposure, s
    "focused": (0.0, 1 / 60),
    "blur 1.4 px": (1.1, 1 / 60),
    "blur 1.7 px": (1.5, 1 / 60),
    "blur 2.1 px": (1.9, 1 / 60),
    "focused, 1/40 s": (0.0, 1 / 40),
    "focused, 1/30 s": (0.0, 1 / 30),
}


def proof(share: float) -> list[list[str]]:
    """The proof of the robot loop; it has no smaller form."""
    assert share > 0.0
    found, rows = measured(), [["", "measured", "limit"]]
    for name, (title, unit, factor) in PROOF.items():
        sign = "≥" if name == "frames_complete" else "≤"
        value = f"{factor * found[name]:.3g} {unit}" if name in found else "not measured"
        rows.append([title, value.strip(), f"{sign} {factor * TARGETS[name]:g} {unit}".strip()])
    return rows


@cache
def measured() -> dict[str, Any]:
    """All figures of `bench robots`, measured once."""
    return measure()


def showings(share: float) -> list[list[str]]:
    """Figures of each way of showing; it has no smaller form."""
    assert share > 0.0
    return grouped(measured()[SHOWING], SHOWN)


def drivers(share: float) -> list[list[str]]:
    """Figures of each driver; it has no smaller form."""
    assert share > 0.0
    return grouped(measured()[BY_DRIVER], DRIVEN)


def grouped(found: dict[str, dict[str, float]], columns: dict[str, tuple[str, int]]) -> list[list[str]]:
    """A row for each name, and one of the limits."""
    rows = [["", *(title for title, _ in columns.values())]]
    for name, figures in found.items():
        cells = (f"{factor * figures[key]:.3g}" if key in figures else "–" for key, (_, factor) in columns.items())
        rows.append([f"`{name}`", *cells])
    signs = {key: "≥" if key == "frames_complete" else "≤" for key in columns}
    rows.append(["limit", *(f"{signs[key]} {factor * TARGETS[key]:g}" for key, (_, factor) in columns.items())])
    return rows


def markers(share: float) -> list[list[str]]:
    """Share of the pictures in which robots' markers are found, %."""
    worn = {id_: f"robot {i + 1}" for i, id_ in enumerate(ROBOT_IDS)}
    rows = [["number", *map(named, marker_ids.VIEWS), "worn by"]]
    for number, wearer in worn.items():
        found = (marker_ids.share(number, view, max(1, round(100 * share))) for view in marker_ids.VIEWS)
        rows.append([str(number), *(f"{100 * one:.0f}" for one in found), wearer])
    return rows


def named(view: marker_ids.View) -> str:
    """A view, as far as it differs from 0.35 m/s and 1/60 s."""
    fast = f", {view.speed / 1000:g} m/s" if view.speed != 350.0 else ""
    long = f", 1/{round(1 / view.exposure)} s" if view.exposure != 1 / 60 else ""
    return f"{view.edge:g} px, blur {view.blur:g} px{fast}{long}"


def detected(share: float) -> list[list[str]]:
    """Markers found, and predicted by the wizard, by edge, blur and exposure, %."""
    rows = [["edge", *LOOKS]]
    for width in WIDTHS:
        cells = [found(width, *look, max(1, round(detection.PICTURES * share))) for look in LOOKS.values()]
        edge = sum(sample.edge for sample in cells[0]) / len(cells[0])
        rows.append([f"{edge:.0f} px", *map(detection.cell, cells)])
    return rows


def found(width: int, defocus: float, exposure: float, pictures: int) -> list[detection.Sample]:
    """Markers in pictures."""
    return [*detection.samples(width, defocus, exposure, pictures)]
