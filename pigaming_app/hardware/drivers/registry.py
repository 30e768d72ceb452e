"""All drivers by name: those of the arcade, then those of plug-ins, whose part `driver` holds a `DRIVER`."""

from pigaming_app.hardware.drivers.driver import RobotDriver
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.storage.plugins.parts import DRIVER, Registry


def _fits(name: str, driver: RobotDriver) -> str:
    """The reason why a plug-in's driver is unusable, or ""."""
    if driver.name != name:
        return f"its driver is named {driver.name}"
    return "the arcade has a driver of this name" if name in OURS else ""


DRIVERS: Registry[RobotDriver] = Registry(OURS, DRIVER, "DRIVER", RobotDriver, _fits)
