"""Driving of the factory planner: reach a slot without stops, and use the fork in passing.

It turns while it drives, backwards first if the way begins behind it, and slows down only to turn. A slot that is not
ready yet is approached so as to arrive in time.
"""

from math import pi, sin

from pigaming_app.ai.brain.steering import turn_stick
from pigaming_app.ai.factory.driving import LEAN, LOOK, LOOKS, ROBOT_ROOM, free_distance
from pigaming_app.ai.factory.job_choice import PlannerMind
from pigaming_app.ai.factory.mind import PERIOD
from pigaming_app.games.factory.observation import FactoryObservation
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.world import Action

NEAR = 150.0  # px from the slot within which it steers to the slot itself
WITHIN = 36.0  # px between fork and slot within which it presses fire
HOLD = 18.0  # px between fork and slot at which it waits for a pallet
ASIDE_ERROR = 26.0  # px by which the way may miss the slot without slowing down
FAN = 17  # directions that it looks in when the first LOOKS are blocked
ESCAPE = 40.0  # px that must be free in a direction to get out of the way
BACK = 90.0  # px that must be free behind it before it backs out of a turn
DASH = 110.0  # px to the waypoint for turbo


@kernel
def reach(obs: FactoryObservation, mind: PlannerMind, action: Action, ready: int) -> None:
    """Drive to the target slot and use the fork there; `ready`: 1 if it can be used now, else in `mind.wait` s."""
    slot = obs.slots[mind.target]
    dx, dy = obs.fork_x - slot.x, obs.fork_y - slot.y
    gap2 = dx * dx + dy * dy
    if ready and gap2 < WITHIN * WITHIN:
        set_action(action, 0.0, 0.0, 0 if action.fire else 1, 0)
        mind.pressed = action.fire
        return
    if obs.straight and obs.goal_distance < NEAR:
        dock(obs, mind, action, ready)
    else:
        cruise(obs, mind, action, ready)


@kernel
def dock(obs: FactoryObservation, mind: PlannerMind, action: Action, ready: int) -> None:
    """Steer straight to the slot; slow down only as far as the bearing asks for, or to wait."""
    bearing, distance = obs.goal_bearing, obs.goal_distance
    short = distance - obs.fork - (0.0 if ready else HOLD)
    aside = distance * sin(bearing)
    if bearing > 1.2 or bearing < -1.2:
        speed = 0.0
    elif -ASIDE_ERROR < aside < ASIDE_ERROR:
        speed = 1.0
    else:
        speed = max(0.0, min(1.0, (distance - 100.0) / 60.0))
    if not ready or short < 10.0:
        limit = short / 40.0
        speed = min(speed, limit)
        if not ready and limit > 0.0:
            speed = min(speed, pace(obs, mind.wait))
        if limit < 0.0:
            speed = limit
    if speed > 0.0 and free_distance(obs, 0.0, 60.0) < 20.0:
        speed = 0.0
    if speed < 0.0 and free_distance(obs, pi, ROBOT_ROOM) < 30.0:
        speed = 0.0
    set_action(action, mind.speed * speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), 0, 0)


@kernel
def pace(obs: FactoryObservation, wait: float) -> float:
    """Share of full speed at which it arrives in `wait` s."""
    return max(0.12, (obs.goal_distance - obs.fork) / (260.0 * max(0.2, wait - 0.4)))


@kernel
def cruise(obs: FactoryObservation, mind: PlannerMind, action: Action, ready: int) -> None:
    """Follow the route, or the free direction nearest to it if people or robots block it."""
    bearing, free, widest = obs.waypoint_bearing, False, ESCAPE
    for i in range(FAN):
        lean = LEAN * ((i + 1) // 2)
        turn = obs.waypoint_bearing + (lean if i % 2 else -lean)  # right first, so robots that meet both keep right
        gap = free_distance(obs, turn, ROBOT_ROOM)
        if i < LOOKS and gap >= min(LOOK, obs.waypoint_distance):
            bearing, free = turn, True
            break
        if gap > widest + 20.0:
            bearing, widest = turn, gap
    bearing = turn_to(bearing)
    ahead = free_distance(obs, 0.0, ROBOT_ROOM)
    size = abs(bearing)
    if size < 0.35:
        speed = 1.0
    elif size < 1.45:
        speed = 1.0 - 0.9 * (size - 0.35)
    elif size > 1.8 and obs.waypoint_distance > 80.0 and free_distance(obs, pi, ROBOT_ROOM) > BACK:
        speed = -1.0 if size > 2.2 else -0.4
    else:
        speed = 0.0
    if speed > 0.0:
        if ahead < 40.0 or (not free and ahead < 80.0):
            speed = 0.0
        elif ahead < LOOK:
            speed *= 0.5
    speed *= mind.speed
    if not ready and speed > 0.0 and obs.straight:
        speed = min(speed, pace(obs, mind.wait))
    dash = mind.dash and ready and obs.waypoint_distance > DASH and obs.turbo > 0.02 and size < 0.3 and ahead > LOOK
    set_action(action, speed, turn_stick(bearing, obs.angular, obs.turn_rate, PERIOD), 0, 1 if dash else 0)
