"""The user's robot files: calibration and things by site, identified drivetrains, mapping of radios to robots.

Files of the emulated arena have separate names, so they never overwrite those of the real one.
"""

import logging
import secrets
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from pigaming_app.hardware.calibration.ground_plane import CalibrationError, GroundPlane, read, to_toml
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.radio.packets import LAST_ARENA
from pigaming_app.hardware.scan.things import LayoutError, ThingLayout
from pigaming_app.hardware.scan.things import read as read_layout
from pigaming_app.hardware.scan.things import to_toml as layout_to_toml
from pigaming_app.sim.drivetrain import MM, Drivetrain, DrivetrainError, parse
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.parsing import ParseError, describe_error, read_text
from pigaming_app.storage.safe_files import NotSaved, write_with_backup
from pigaming_app.storage.settings import Settings, folders

log = logging.getLogger("pigaming")


def calibration_file(site: str) -> Path:
    """Calibration file of a site, `real` or `emulated`."""
    return folders().config / ("calibration.toml" if site == "real" else f"calibration-{site}.toml")


def load(path: Path, projection: str | None = None, camera: tuple[int, int] | None = None) -> GroundPlane:
    """Load a calibration. Raises CalibrationError.

    A calibration made with another `projection` (`Canvas.projection`) or another frame size `camera` (px) is rejected.
    """
    try:
        text = read_text(path)
    except FileNotFoundError:
        raise CalibrationError(OperatorMessage("none")) from None
    except (OSError, ParseError) as error:
        raise CalibrationError(OperatorMessage("damaged", detail=describe_error(error))) from error
    return read(text, projection, camera)


def save(ground: GroundPlane, path: Path) -> None:
    """Save a calibration, keeping the previous one as `.bak`. Raises NotSaved."""
    write_with_backup(path, to_toml(ground))


def things_file(site: str) -> Path:
    """File of the things on the mat of a site, `real` or `emulated`."""
    return folders().config / ("things.toml" if site == "real" else f"things-{site}.toml")


def load_things(path: Path) -> ThingLayout:
    """Load the things on a mat; an empty layout if nothing was saved. Raises LayoutError."""
    try:
        return read_layout(read_text(path))
    except FileNotFoundError:
        return ThingLayout()
    except (OSError, ParseError) as error:
        raise LayoutError(OperatorMessage("damaged_things", detail=describe_error(error))) from error


def save_things(layout: ThingLayout, path: Path) -> None:
    """Save the things on a mat, keeping the previous ones as `.bak`. Raises NotSaved."""
    write_with_backup(path, layout_to_toml(layout))


def robots_file(emulated: bool) -> Path:
    """File of the drivetrains identified by `fidelity`."""
    return folders().config / ("robots-emulated.toml" if emulated else "robots.toml")


def load_robots(
    path: Path, mm: float = MM, others: Sequence[Drivetrain] = (UNMEASURED,) * ROBOTS
) -> tuple[Drivetrain, ...]:
    """Drivetrains of all robots on a mat of `mm` per arena px, those of `others` where the file has none.

    Raises DrivetrainError.
    """
    try:
        measured = parse(read_text(path), path.name, mm)
    except FileNotFoundError:
        measured = ()
    except (OSError, ParseError) as error:
        raise DrivetrainError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    return (*measured, *others[len(measured) :])


def save_pairing(channels: Sequence[int], camera_delay: float) -> None:
    """Save the radio of each robot, counted from 0, and the camera's delay, s, in the settings. Raises NotSaved."""
    config = folders().config
    settings, _ = Settings.load(config)
    settings.radios = [channel + 1 for channel in channels]
    settings.camera_delay = round(1000.0 * camera_delay)
    settings.save(config)


def tops_by_radio(tops_mm: Mapping[int, int], channels: Sequence[int], before: Sequence[int]) -> list[int]:
    """Top speeds, mm/s, by radio, from those by robot; robots that did not drive keep what was found before."""
    tops = [*(before or [0] * ROBOTS)]
    for robot, top in tops_mm.items():
        tops[channels[robot]] = top
    return tops


def save_tops(tops_mm: Mapping[int, int], channels: Sequence[int]) -> None:
    """Save the top speeds that a test drive has found, mm/s by robot, in the settings. Raises NotSaved."""
    config = folders().config
    settings, _ = Settings.load(config)
    settings.tops = tops_by_radio(tops_mm, channels, settings.tops)
    settings.save(config)


def arena_id(settings: Settings) -> int:
    """The arena id of these settings; on first use it is drawn at random and saved."""
    _draw(settings, "arena_id", lambda: 1 + secrets.randbelow(LAST_ARENA))
    return settings.arena_id


def wifi_key(settings: Settings) -> bytes:
    """The key of the Wi-Fi robots of these settings, 16 bytes; on first use it is drawn at random and saved."""
    _draw(settings, "wifi_key", lambda: secrets.token_hex(16))
    return bytes.fromhex(settings.wifi_key)


def _draw(settings: Settings, name: str, draw: Callable[[], object]) -> None:
    """Set a setting that is still empty, to the saved value or to a drawn one, which is saved."""
    if getattr(settings, name):
        return
    config = folders().config
    saved, _ = Settings.load(config)
    if not getattr(saved, name):
        saved.choose(name, draw())
        try:
            saved.save(config)
        except NotSaved as error:
            log.warning("%s", error)
    settings.choose(name, getattr(saved, name))
