"""PiTanks: the light on a robot that stays where it is."""

from pigaming_app.games.pitanks.state import PiTanks
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import ROBOTS


@kernel
def update_spotlights(match: PiTanks) -> None:
    """One tick: a robot is lit once it has been in a circle for `PiTanksRules.camping`, until it leaves that circle.

    The circle is centred where the robot left the previous one. A knock-out does not count as staying.
    """
    rules = match.rules
    for k in range(ROBOTS):
        robot, tank = match.robots[k], match.tanks[k]
        if not robot.present:
            continue
        dx, dy = robot.x - tank.camp_x, robot.y - tank.camp_y
        if match.tick == 0 or dx * dx + dy * dy > rules.camp_radius * rules.camp_radius:
            tank.camp_x, tank.camp_y = robot.x, robot.y
            tank.camped = tank.lit = 0
        elif not tank.knocked_out:
            tank.camped += 1
            if tank.camped >= rules.camping:
                tank.lit = 1
