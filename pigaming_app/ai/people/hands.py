"""The hands of a person: what becomes of a wish on the way to the keys or the stick.

A person decides a few times a second, holds what was decided in between, meets the moment of a press or release with an
error of timing, and now and then does not attend. On keys a turn is a tap as long as the turn needs, and a direction is
one of eight; a stick is proportional, with noise.

Own motion is foreseen, so only what others do is late: for that the brain that wishes sees others late
(`Traits.reaction`). Source of intermittent control: P. Gawthrop et al., "Intermittent control: a computational theory
of human control", Biological Cybernetics 104, 2011.
"""

from math import cos, floor, pi, sin

from pigaming_app.ai.brain.driving import TURN_GAIN, pointed
from pigaming_app.games.simple import MatchState
from pigaming_app.sim.action import set_action
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, uniform
from pigaming_app.sim.world import HZ, Action, Robot

TAP = 0.16 * HZ  # ticks of a tap that turns as much as a full stick in a decision of the brain that wishes
SHORTEST = 3  # ticks for which a key is down at least
PRESSED = 0.35  # stick of a wish from which a drive key is down
STILL = 0.1  # stick of a wish below which nothing is pressed
EIGHTH = pi / 4.0  # rad between neighbouring directions of the keys
OPEN = -1  # of `turn_left`: held until the wish is nearly fulfilled


@record
class Hands:
    """A person's traits, in ticks, and what the hands do."""

    random: int
    stick: float  # as in Traits
    point: int  # 1: drives by pointing
    period: float  # mean ticks between decisions
    timing: float  # ticks
    odds: float  # of a lapse, per tick
    lapse: float  # mean ticks of one
    turbo: int
    wish: Action  # last action of the brain that wishes
    wait: int  # ticks until the next decision
    away: int  # ticks left of a lapse
    linear: float  # the drive keys or stick; pointing: the direction on the screen, y up
    angular: float  # the turn keys or stick; pointing: x
    turn_left: int  # ticks until the turn key is released, or OPEN
    fire: int  # 1: held
    boost: int
    press_in: int  # ticks until FIRE goes down; 0: it is not about to
    release_in: int  # ticks until it comes up


@kernel
def move(match: MatchState, seat: int, hands: Hands) -> None:
    """Set the action of a tick from the wish."""
    robot, wish = match.robots[seat], hands.wish
    if hands.away > 0:
        hands.away -= 1
    else:
        if uniform(hands) < hands.odds:
            hands.away = 1 + int(2.0 * hands.lapse * uniform(hands))
        hands.wait -= 1
        if hands.wait <= 0:
            hands.wait = 1 + int(hands.period * (0.7 + 0.6 * uniform(hands)))
            hands.boost = 1 if hands.turbo and wish.turbo else 0
            if hands.point:
                point(hands, robot, match.rules.turn_rate)
            elif hands.stick > 0.0:
                hands.linear = wish.linear + 2.0 * hands.stick * bell(hands)
                hands.angular = wish.angular + 2.0 * hands.stick * bell(hands)
            else:
                hands.linear = sign(wish.linear, PRESSED)
                if hands.turn_left == 0:
                    tap(hands)
        press_or_release(hands, wish.fire)
    if hands.point:
        linear, angular = pointed(hands.angular, -hands.linear, robot.heading, robot.angular, match.rules.turn_rate)
        set_action(match.actions[seat], linear, angular, hands.fire, hands.boost)
        return
    if hands.stick == 0.0:
        hold_turn(hands)
    set_action(match.actions[seat], hands.linear, hands.angular, hands.fire, hands.boost)


@kernel
def sign(value: float, least: float) -> float:
    """1, 0 or -1 for a value above `least`, between, or below `-least`."""
    return 1.0 if value > least else -1.0 if value < -least else 0.0


@kernel
def late(hands: Hands) -> float:
    """An error of timing, ticks; negative: too early."""
    return 2.0 * hands.timing * bell(hands)


@kernel
def tap(hands: Hands) -> None:
    """Press the turn key for a turn, if it is worth one."""
    turn = hands.wish.angular
    hands.angular = sign(turn, 0.0)
    if abs(turn) >= 1.0:
        hands.turn_left = OPEN
        return
    ticks = int(abs(turn) * TAP + late(hands))
    hands.turn_left = ticks if ticks >= SHORTEST else 0
    if hands.turn_left == 0:
        hands.angular = 0.0


@kernel
def hold_turn(hands: Hands) -> None:
    """Release the turn key when its time is over; one held for a long turn gets a time near the end of the turn."""
    turn = hands.wish.angular
    if hands.turn_left == OPEN and (abs(turn) < 1.0 or turn * hands.angular < 0.0):
        rest = abs(turn) * TAP if turn * hands.angular > 0.0 else 0.0
        ticks = int(rest + late(hands))
        hands.turn_left = ticks if ticks > 0 else 1
    if hands.turn_left > 0:
        hands.turn_left -= 1
        if hands.turn_left == 0:
            hands.angular = 0.0


@kernel
def press_or_release(hands: Hands, wished: int) -> None:
    """FIRE follows the wish with an error of timing; a press that has been decided on is made."""
    delay = 1 + int(abs(late(hands)))
    if wished and not hands.fire and hands.press_in == 0:
        hands.press_in = delay
    if not wished and (hands.fire or hands.press_in) and hands.release_in == 0:
        hands.release_in = hands.press_in + (delay if delay > SHORTEST else SHORTEST)
    if hands.press_in > 0:
        hands.press_in -= 1
        if hands.press_in == 0:
            hands.fire = 1
    if hands.release_in > 0:
        hands.release_in -= 1
        if hands.release_in == 0:
            hands.fire = 0


@kernel
def point(hands: Hands, robot: Robot, turn_rate: float) -> None:
    """Push the stick, or keys for one of eight directions, where to go on the screen."""
    wish = hands.wish
    ahead, turn = wish.linear, wish.angular
    if abs(ahead) < STILL and abs(turn) < STILL:
        hands.linear = hands.angular = 0.0
        return
    far = hands.period / HZ
    off = turn * turn_rate * (far if far > 1.0 / TURN_GAIN else 1.0 / TURN_GAIN)
    if abs(ahead) < PRESSED and abs(turn) >= 1.0:
        off = 0.5 * pi * turn
    off = min(max(off, -0.5 * pi), 0.5 * pi)
    way = robot.heading + (pi - off if ahead < -PRESSED else off)
    reach = max(abs(ahead), abs(turn))
    if hands.stick > 0.0:
        way += 2.0 * hands.stick * bell(hands)
    else:
        way, reach = EIGHTH * floor(way / EIGHTH + 0.5), 1.0
    hands.angular, hands.linear = reach * cos(way), -reach * sin(way)
