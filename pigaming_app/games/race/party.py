"""Robot Race, `party`: slipstream, boost pads, item boxes and oil. In `draft` the last robot has the first two.

- Slipstream: behind another robot the turbo meter refills, also while turbo is on; the farther back in the race, the
  faster.
- Boost pads give a surge of speed.
- A box holds an item, which FIRE uses: `turbo` fills the meter and gives a surge, `shield` resists oil, `oil` is
  dropped behind the robot. The leader mostly gets oil and shields, the last mostly turbo.
- A robot on oil spins. That uses the slick up; a shield does so without a spin.
"""

from math import cos, sin

from pigaming_app.games.race.state import BOXES, NO_ITEM, OIL, OWN_OILS, PAD_HALF, SHIELD, TURBO, Box, Race
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.rng import uniform
from pigaming_app.sim.world import ROBOTS

BOX = 20.0  # px, half the width of an item box
DROP = 90.0  # px from the robot's centre to the oil that it drops
PARALLEL = 0.7  # least cosine between the headings of two robots in a slipstream
SLIP_SPEED = 100.0  # px/s, least speed of both
BEHIND_TURBO, STEP_TURBO = 0.3, 0.2  # chance that a box holds `turbo`: less for the leader, more for each place behind
OIL_SHARE = 0.4  # of the other items
CREEP = 0.2  # share of full speed in a spin


@kernel
def update_course(match: Race) -> None:
    """One tick of everything on the course."""
    party = match.rules.party
    if party:
        for i in range(BOXES):
            update_box(match, match.boxes[i])
        for oil in match.oils:
            if oil.alive:
                oil.alive -= 1
    for k in range(ROBOTS):
        racer = match.racers[k]
        racer.slip = 0
        if match.robots[k].present and not racer.finished:
            if racer.shield:
                racer.shield -= 1
            if party or is_last(match, k):
                draft(match, k)
                drive_over_pads(match, k)
            if party:
                drive_over_oil(match, k)


@kernel
def is_last(match: Race, k: int) -> bool:
    """True if robot k is the last of several."""
    robots = 0
    for robot in match.robots:
        robots += robot.present
    return bool(robots > 1 and match.racers[k].rank == robots)


@kernel
def update_box(match: Race, box: Box) -> None:
    """One tick of an item box: the nearest robot that touches it and has no item takes it."""
    if box.pause:
        box.pause -= 1
        return
    nearest2, taker = (match.radius + BOX) * (match.radius + BOX), -1
    for k in range(ROBOTS):
        robot, racer = match.robots[k], match.racers[k]
        dx, dy = robot.x - box.x, robot.y - box.y
        gap2 = dx * dx + dy * dy
        if robot.present and not racer.item and not racer.finished and gap2 < nearest2:
            nearest2, taker = gap2, k
    if taker >= 0:
        box.pause = match.rules.box_pause
        match.racers[taker].item = draw_item(match, match.racers[taker].rank)


@kernel
def draw_item(match: Race, rank: int) -> int:
    """A random item for a robot of this rank."""
    drawn = uniform(match)
    turbo = BEHIND_TURBO + STEP_TURBO * (rank - 1) if rank > 1 else 0.0
    if drawn < turbo:
        return TURBO
    return OIL if drawn < turbo + OIL_SHARE * (1.0 - turbo) else SHIELD


@kernel
def use_item(match: Race, k: int) -> None:
    """Use the item of robot k. Oil that finds no place, because both own slicks still lie there, moves the older."""
    robot, racer, rules = match.robots[k], match.racers[k], match.rules
    if racer.item == TURBO:
        robot.turbo = 1.0
        racer.surge = rules.item_surge
    elif racer.item == SHIELD:
        racer.shield = rules.shield_life
    else:
        oldest = k * OWN_OILS
        for i in range(k * OWN_OILS + 1, (k + 1) * OWN_OILS):
            if match.oils[i].alive < match.oils[oldest].alive:
                oldest = i
        oil = match.oils[oldest]
        oil.alive = rules.oil_life
        oil.x, oil.y = robot.x - DROP * cos(robot.heading), robot.y - DROP * sin(robot.heading)
    racer.item = NO_ITEM


@kernel
def draft(match: Race, k: int) -> None:
    """Refill the meter of robot k if it drives in a slipstream."""
    robot, racer, rules = match.robots[k], match.racers[k], match.rules
    c, s = cos(robot.heading), sin(robot.heading)
    for j in range(ROBOTS):
        other = match.robots[j]
        if j == k or not other.present or robot.linear < SLIP_SPEED or other.linear < SLIP_SPEED:
            continue
        dx, dy = other.x - robot.x, other.y - robot.y
        ahead, aside = c * dx + s * dy, c * dy - s * dx
        parallel = c * cos(other.heading) + s * sin(other.heading)
        if 0.0 < ahead < rules.slip_reach and abs(aside) < rules.slip_width and parallel > PARALLEL:
            racer.slip = 1
    if racer.slip:
        robot.turbo += rules.slip_refill * racer.rank
        if robot.turbo > 1.0:
            robot.turbo = 1.0


@kernel
def drive_over_pads(match: Race, k: int) -> None:
    """Start a surge if the centre of robot k is on a boost pad."""
    robot, racer = match.robots[k], match.racers[k]
    for pad in match.pads:
        c, s = cos(pad.heading), sin(pad.heading)
        dx, dy = robot.x - pad.x, robot.y - pad.y
        if abs(c * dx + s * dy) < PAD_HALF and abs(c * dy - s * dx) < PAD_HALF and racer.surge < match.rules.pad_surge:
            racer.surge = match.rules.pad_surge


@kernel
def drive_over_oil(match: Race, k: int) -> None:
    """Start a spin if the centre of robot k is on oil, away from the side on which the slick lies."""
    robot, racer, rules = match.robots[k], match.racers[k], match.rules
    for oil in match.oils:
        dx, dy = robot.x - oil.x, robot.y - oil.y
        if not oil.alive or racer.spin or dx * dx + dy * dy > rules.oil_radius * rules.oil_radius:
            continue
        oil.alive = 0
        if racer.shield:
            racer.shield = 0
        else:
            racer.spin, racer.surge = rules.spin, 0
            racer.spin_way = 1 if cos(robot.heading) * dy - sin(robot.heading) * dx >= 0.0 else -1


@kernel
def spin(match: Race, k: int) -> None:
    """Request the speeds of robot k in a spin on oil."""
    robot, racer, rules = match.robots[k], match.racers[k], match.rules
    racer.spin -= 1
    robot.boosting = 0
    robot.requested_linear = CREEP * rules.speed
    robot.requested_angular = racer.spin_way * rules.spin_rate
