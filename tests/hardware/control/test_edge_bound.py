"""How far a robot that drives the wrong way can come out of the arena: an integral of declared times and speeds.

It knows nothing of poses, windows and predictions of the loop: a robot that is commanded inward drives outward from the
line at which virtual walls stop it; the check may begin once it is 3 px (NUDGE) off, and all delays that are declared
come on top.
"""

import pytest

from pigaming_app.hardware.control.motion_check import NUDGE
from pigaming_app.hardware.control.real_plant import MAX_ACCELERATION, UNPROVEN
from pigaming_app.hardware.control.rig import UNMEASURED
from pigaming_app.hardware.control.virtual_walls import SPARE
from pigaming_app.hardware.drivers.ours import OURS
from pigaming_app.hardware.proof.testbed import DELAY
from pigaming_app.sim.drivetrain import MM
from pigaming_app.sim.world import DT

STEP = 0.001  # s
FPS = 30.0
TURBO = 422.5 * MM  # mm/s, of Robot Race
OUTSIDE = 60.0  # mm, of the issue on the mat


def out(speed: float, dead_time: float) -> float:
    """mm beyond the edge at which a robot of this top speed, mm/s, comes to rest."""
    seen = DELAY + 1.0 / FPS + DT  # s from the light to a decision, at worst
    way = pace = command = 0.0
    stops_at = float("inf")
    time = 0.0
    while time < stops_at or pace > 1.0:
        time += STEP
        command = min(speed, command + MM * MAX_ACCELERATION * STEP) if time < stops_at else 0.0
        pace += (command - pace) * STEP / UNMEASURED.lag
        way += pace * STEP
        if way > NUDGE * MM and stops_at == float("inf"):
            stops_at = time + seen + dead_time
    return way - SPARE * MM


@pytest.mark.parametrize(
    "driver", [driver for driver in OURS.values() if driver.silence], ids=lambda driver: driver.name
)
def test_a_robot_that_is_not_yet_proven_stays_within_the_limit(driver):
    assert out(min(UNPROVEN, driver.kind.wheel_mm), driver.dead_time) <= OUTSIDE


def test_no_check_of_its_motion_would_stop_it_in_time_at_full_speed():
    """So its speed is held down until it has moved as commanded."""
    assert out(TURBO, OURS["api2"].dead_time) > OUTSIDE
