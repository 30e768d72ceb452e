"""The file of the calibration: config/calibration.toml, or one of its own for the emulated arena."""

from pathlib import Path

from pigaming_app.hardware.calibration.ground_plane import Ground, NoGround, read, written
from pigaming_app.hardware.calibration.site import Site
from pigaming_app.hardware.messages import Said
from pigaming_app.storage.parsing import ParseError, describe_error, read_text
from pigaming_app.storage.safe_files import write_with_backup
from pigaming_app.storage.settings import folders

NONE = Said("There is no calibration yet: calibrate the camera.", "none")


def path(site: Site) -> Path:
    """Where the calibration of a site is kept."""
    return folders().config / ("calibration.toml" if site.name == "real" else f"calibration-{site.name}.toml")


def load(projection: str, site: Site, camera: tuple[int, int]) -> Ground:
    """The calibration for this `Canvas.projection` and a camera with pictures of so many px. Raises NoGround."""
    try:
        text = read_text(path(site))
    except FileNotFoundError:
        raise NoGround(NONE) from None
    except (OSError, ParseError) as error:
        raise NoGround(
            Said(f"{path(site)} cannot be read ({describe_error(error)}): calibrate again.", "damaged")
        ) from error
    return read(text, projection, camera)


def save(ground: Ground, site: Site) -> None:
    """Keep a calibration; the one before stays beside it as `.bak`. Raises NotSaved."""
    write_with_backup(path(site), written(ground))
