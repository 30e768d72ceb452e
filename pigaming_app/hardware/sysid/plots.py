"""Plots of the simulator's fidelity. They need the extra `plots` (matplotlib), which is imported only here."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from pigaming_app.hardware.recordings import Recording
from pigaming_app.hardware.sysid.evaluate import HELD_OUT, HORIZONS, Identification, nominal_train, predictions
from pigaming_app.storage.messages import OperatorError, OperatorMessage
from pigaming_app.storage.safe_files import write_atomic

SHOWN = 6  # predictions drawn per robot


def draw(run: Recording, verdicts: Sequence[Identification], folder: Path) -> list[Path]:
    """Write horizon.png and paths.png into the folder; returns their paths. Raises OperatorError, NotSaved."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise OperatorError(OperatorMessage("no_plots")) from None
    files = []
    for name, paint in (("horizon.png", _horizons), ("paths.png", _paths)):
        figure = Figure(figsize=(10, 6), layout="constrained")
        paint(figure, run, verdicts)
        picture = BytesIO()
        figure.savefig(picture, dpi=120, format="png")
        write_atomic(folder / name, picture.getvalue())
        files.append(folder / name)
    return files


def _horizons(figure: Any, run: Recording, verdicts: Sequence[Identification]) -> None:
    """Prediction errors before and after identification, by horizon."""
    axes = figure.add_subplot()
    for verdict in verdicts:
        colour = f"C{verdict.robot}"
        axes.plot(HORIZONS, verdict.before.mm, "o--", color=colour, label=f"robot {verdict.robot + 1}, nominal")
        axes.plot(HORIZONS, verdict.after.mm, "o-", color=colour, label=f"robot {verdict.robot + 1}, identified")
    axes.set_yscale("log")
    axes.set_xticks(HORIZONS)
    axes.set_xlabel("s ahead")
    axes.set_ylabel("root mean square error, mm")
    axes.set_title("Prediction error on the held-out part of the recording")
    axes.grid(alpha=0.3)
    axes.legend()


def _paths(figure: Any, run: Recording, verdicts: Sequence[Identification]) -> None:
    """Some predictions over five seconds against the observed paths."""
    grid = figure.subplots(2, 2, squeeze=True).ravel()
    for axes, verdict in zip(grid, verdicts, strict=False):
        course = run.courses[verdict.robot]
        begin, end = course.pose_times[0], course.pose_times[-1]
        rest = course.between(end - HELD_OUT * (end - begin), end + 1.0)
        nominal = nominal_train(run)
        for model, style, label in ((nominal, "C3:", "nominal"), (verdict.drivetrain, "C0-", "identified")):
            ahead = predictions(rest, model, HORIZONS[-1])
            for i, path in enumerate(ahead[:: max(1, len(ahead) // SHOWN)]):
                if model is nominal:
                    axes.plot(path.seen[:, 0], path.seen[:, 1], "k.", markersize=2, label="seen" if not i else None)
                axes.plot(path.predicted[:, 0], path.predicted[:, 1], style, label=label if not i else None)
        axes.set_title(f"robot {verdict.robot + 1}")
        axes.set_aspect("equal")
        axes.invert_yaxis()
    grid[0].legend()
