"""The real thing, put together from what the operator chose: camera, radio, calibration, measured robots.

What is missing or broken at first may be plugged in later: camera and link say what is wrong and try again.
"""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from pigaming_app.hardware.calibration.ground_plane import Ground, NoGround, read
from pigaming_app.hardware.control.rig import UNMEASURED, Rig
from pigaming_app.hardware.messages import Said
from pigaming_app.hardware.radio.link import Link
from pigaming_app.hardware.radio.serial_line import ports, serial_port
from pigaming_app.hardware.radio.stock_protocol import BAUD as STOCK_BAUD
from pigaming_app.hardware.radio.stock_protocol import Stock
from pigaming_app.hardware.radio.xbee_protocol import Air, Mode
from pigaming_app.hardware.session.fitting import Fitting
from pigaming_app.hardware.tracking.tracker import Tracker
from pigaming_app.hardware.vision.camera import Camera
from pigaming_app.sim.drivetrain import Drivetrain, DrivetrainError, parse
from pigaming_app.sim.world import ROBOTS
from pigaming_app.storage.parsing import ParseError, describe_error, parse_toml, read_text

STOCK = "stock"  # one robot as it is sold, on a cable
NO_PORT = "no serial port"


class Wiring(NamedTuple):
    """What is plugged in where. `radio`: api2, api1, transparent or stock."""

    camera: int = 0
    port: str = ""  # empty: the first there is
    baud: int = 57600
    radio: str = "api2"


def connect(wiring: Wiring, ground: Ground, drivetrains: Sequence[Drivetrain] = (UNMEASURED,) * ROBOTS) -> Rig:
    """Camera, tracker and link, at work in their threads until close(). Raises NoVision where OpenCV is missing."""
    clock = time.monotonic
    tracker = Tracker(ground, clock, drivetrains)
    eye = Fitting(Camera(wiring.camera), ground)
    return Rig(eye, tracker, linked(wiring), clock, drivetrains).start()


def linked(wiring: Wiring) -> Link:
    """The link alone, not yet started. It says itself what is wrong with the port."""
    name = wiring.port or next((port.device for port in ports()), NO_PORT)
    if wiring.radio == STOCK:
        return Link(serial_port(name, STOCK_BAUD), time.monotonic, Stock(0), name)
    return Link(serial_port(name, wiring.baud), time.monotonic, Air(Mode(wiring.radio)), name)


def measured(path: Path) -> tuple[Drivetrain, ...]:
    """The robots that `fidelity` measured, and unmeasured ones for the rest. Raises DrivetrainError."""
    try:
        found = parse(read_text(path), path.name)
    except FileNotFoundError:
        found = ()
    except (OSError, ParseError) as error:
        raise DrivetrainError(f"{path.name}: cannot be read ({describe_error(error)})") from None
    return (*found, *(UNMEASURED,) * (ROBOTS - len(found)))


def ground_of(path: Path) -> Ground:
    """The calibration in a file, whichever display it was made on. Raises NoGround."""
    try:
        text = read_text(path)
        entries = parse_toml(text)
        wide, high = entries["lens"]["size"]
        return read(text, str(entries["display"]), (int(wide), int(high)))
    except FileNotFoundError:
        raise NoGround(Said("There is no calibration yet: calibrate first.", "none")) from None
    except (OSError, KeyError, TypeError, ValueError, OverflowError) as error:
        if isinstance(error, NoGround):
            raise
        raise NoGround(Said(f"The calibration {path.name} cannot be read: calibrate again.", "damaged")) from None
