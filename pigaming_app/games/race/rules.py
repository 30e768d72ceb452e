"""Rules of Robot Race: the first to complete all laps wins.

Each robot has its own start and finish line, dealt by the match's seed; the lines of the others are checkpoints. Cross
all four in order and in the right direction, beginning with your own, or the lap does not count: if you miss a line,
you must go back to it. Driving back over a line gains and costs nothing. Off the course is mud: a third of the speed.
Turbo makes you faster while its meter lasts. After the first has finished, the others have half a minute left; those
who do not finish are ranked by distance. A robot that has lost its way may ask for the way back (recovery.py). In
`party` all start behind the same line, and there is more on the course (party.py), of which `draft` gives a part to the
last.
"""

from math import cos, sin

from pigaming_app.games.race.course import locate
from pigaming_app.games.race.laps import cross_backward, cross_forward, crossing, progress
from pigaming_app.games.race.party import spin, update_course, use_item
from pigaming_app.games.race.recovery import detect_lost, update_request
from pigaming_app.games.race.state import LINES, Race, Racer
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.robot import stop, stop_all, use_turbo
from pigaming_app.sim.things.mud import in_mud
from pigaming_app.sim.world import ROBOTS

AGAINST = 40.0  # px/s above which driving against the direction of the course counts


@kernel
def judge(match: Race) -> None:
    """One tick of the rules: positions, crossings, ranks, then the requested speeds."""
    if match.over:
        stop_all(match)
        return
    for k in range(ROBOTS):
        if match.robots[k].present:
            track_progress(match, k)
    for k in range(ROBOTS):
        if match.robots[k].present:
            match.racers[k].rank = rank(match, k)
    if match.rules.party or match.rules.draft:
        update_course(match)
    for k in range(ROBOTS):
        if match.robots[k].present:
            press_fire(match, k)
            steer(match, k)
    match.tick += 1
    if is_over(match):
        match.over = 1


@kernel
def track_progress(match: Race, k: int) -> None:
    """Locate robot k, and process the lines it has crossed since the previous tick."""
    robot, racer = match.robots[k], match.racers[k]
    locate(match.course, robot.x, robot.y, racer.place)
    if not racer.finished:
        dx, dy = robot.x - racer.last_x, robot.y - racer.last_y
        if dx * dx + dy * dy <= match.rules.carried * match.rules.carried:
            for i in range(LINES):
                share = crossing(match.lines[i], racer.last_x, racer.last_y, robot.x, robot.y)
                if share > 0.0:
                    cross_forward(match, k, i, match.tick - 1 + share)
                elif share < 0.0:
                    cross_backward(racer, i)
    racer.last_x, racer.last_y = robot.x, robot.y
    racer.progress = progress(match, k)
    if racer.place.on:
        with_way = cos(robot.heading) * racer.place.tangent_x + sin(robot.heading) * racer.place.tangent_y
        against = robot.linear * with_way < 0.0 and abs(robot.linear) > AGAINST
        racer.wrong = racer.wrong + 1 if against and not racer.missed else 0
    detect_lost(match, k)


# -------------------------------------------------------------------------------------------------------------- order


@kernel
def rank(match: Race, k: int) -> int:
    """Rank of robot k, from 1; ties go to the lower seat."""
    place = 1
    for j in range(ROBOTS):
        if match.robots[j].present and j != k and is_ahead(match.racers[j], match.racers[k], j < k):
            place += 1
    return place


@kernel
def is_ahead(racer: Racer, other: Racer, if_equal: bool) -> bool:
    """True if a racer ranks ahead of the other: by finish time, then by progress."""
    if racer.finished != other.finished:
        return bool(racer.finished > other.finished)
    if racer.finished and racer.finish != other.finish:
        return bool(racer.finish < other.finish)
    if racer.progress != other.progress:
        return bool(racer.progress > other.progress)
    return if_equal


# ------------------------------------------------------------------------------------------------------------ driving


@kernel
def press_fire(match: Race, k: int) -> None:
    """Robot k's button FIRE, on the tick it goes down: the way back if it is lost, else its item."""
    robot, racer, fire = match.robots[k], match.racers[k], match.actions[k].fire
    if fire and not racer.fire_held and not racer.finished:
        if racer.lost:
            robot.recover = 1
        elif racer.item:
            use_item(match, k)
    racer.fire_held = fire
    if robot.recover:
        update_request(match, k)


@kernel
def steer(match: Race, k: int) -> None:
    """Request the speeds that result from robot k's stick, turbo, the ground, boost pads and oil."""
    rules, robot, action, racer = match.rules, match.robots[k], match.actions[k], match.racers[k]
    if racer.finished and match.tick - racer.finish > rules.roll_on:
        stop(robot)
        return
    if racer.spin:
        spin(match, k)
        return
    speed = rules.speed
    use_turbo(robot, action.turbo, rules.turbo_drain, rules.turbo_refill)
    if robot.boosting:
        speed *= rules.turbo_factor
    if racer.surge:
        racer.surge -= 1
        speed *= rules.surge_factor
    if not racer.place.on or (match.mud_count and in_mud(match, robot.x, robot.y)):
        speed *= rules.mud
    robot.requested_linear = action.linear * speed
    robot.requested_angular = action.angular * rules.turn_rate


@kernel
def is_over(match: Race) -> bool:
    """True if everybody has finished, or a time limit has passed."""
    late = match.first and match.tick - match.first >= match.rules.patience
    racing = 0
    for k in range(ROBOTS):
        if match.robots[k].present and not match.racers[k].finished:
            racing += 1
    return bool(late or not racing or match.tick >= match.rules.ticks)
