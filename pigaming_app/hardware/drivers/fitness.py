"""Whether the robots of a driver may play matches: they stop by themselves, as declared and as their stand shows.

The arcade's own drivers are proven by its tests. A plug-in's is tried on its emulated robots, once in the life of a
process: `robots check` without what has nothing to do with silence.
"""

import logging
from functools import cache

from pigaming_app.hardware.drivers.driver import RobotDriver
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.storage.messages import OperatorMessage
from pigaming_app.storage.plugins.time_limit import time_limit

LIMIT = 10.0  # s for the trial; that of the example takes 0.1

log = logging.getLogger("pigaming")


@cache
def match_problem(driver: RobotDriver) -> OperatorMessage | None:
    """Why the robots of a driver cannot play matches, or None."""
    if driver.problem or driver in OURS.values():
        return driver.problem
    about = {"name": driver.title or driver.name, "driver": driver.name}
    if driver.stand is None:
        return OperatorMessage("driver_unproven", **about)
    return None if _stops(driver) else OperatorMessage("driver_untrue", **about)


def _stops(driver: RobotDriver) -> bool:
    """Whether the emulated robots of a plug-in's driver stop in time; false also if its code fails or does not end."""
    from pigaming_app.hardware.drivers.conformance import Conformance  # late: it needs NumPy

    assert driver.stand is not None
    try:
        with time_limit(LIMIT):
            stand = driver.stand(1)
            try:
                return Conformance(driver, stand).falls_silent()
            finally:
                stand.close()
    except Exception:
        log.exception("The emulated robots of the driver %s failed", driver.name)
        return False
