"""The user's files about real robots: the calibration of each site, the measured robots, and which radio drives which.

Those of the emulated arena have names of their own, so that they never replace those of the real one.
"""

from collections.abc import Sequence
from pathlib import Path

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, read, written
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.messages import OperatorMessage
from pigaming_app.sim.drivetrain import Drivetrain, DrivetrainError, parse
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.parsing import ParseError, describe_error, read_text
from pigaming_app.storage.safe_files import write_with_backup
from pigaming_app.storage.settings import Settings, folders


def calibration_file(site: str) -> Path:
    """The calibration of the site with this name: `real` or `emulated`."""
    return folders().config / ("calibration.toml" if site == "real" else f"calibration-{site}.toml")


def load(path: Path, projection: str | None = None, camera: tuple[int, int] | None = None) -> GroundPlane:
    """The calibration in a file.

    With a `projection` (`Canvas.projection`) or the size of a `camera`'s pictures (px), one made with another is
    refused. Raises CalibrationError.
    """
    try:
        text = read_text(path)
    except FileNotFoundError:
        raise CalibrationError(OperatorMessage("none")) from None
    except (OSError, ParseError) as error:
        raise CalibrationError(OperatorMessage("damaged", detail=describe_error(error))) from error
    return read(text, projection, camera)


def save(ground: GroundPlane, path: Path) -> None:
    """Keep a calibration; the one before stays beside it as `.bak`. Raises NotSaved."""
    write_with_backup(path, written(ground))


def robots_file(emulated: bool) -> Path:
    """The drivetrains that `fidelity` has identified."""
    return folders().config / ("robots-emulated.toml" if emulated else "robots.toml")


def load_robots(path: Path) -> tuple[Drivetrain, ...]:
    """The drivetrains in a file, and unmeasured ones for the other robots. Raises DrivetrainError."""
    try:
        found = parse(read_text(path), path.name)
    except FileNotFoundError:
        found = ()
    except (OSError, ParseError) as error:
        raise DrivetrainError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    return (*found, *(UNMEASURED,) * (ROBOTS - len(found)))


def save_radios(channels: Sequence[int]) -> None:
    """Keep in the settings which radio, counted from 0, drives each robot. Raises NotSaved."""
    config = folders().config
    settings, _ = Settings.load(config)
    settings.radios = [channel + 1 for channel in channels]
    settings.save(config)
