"""Everything on the course in `party` and `draft`: boost pads, item boxes, oil, and air in slipstreams."""

import math
from collections.abc import Sequence

from pigaming_app.games.race.party import is_last
from pigaming_app.games.race.state import OWN_OILS, Race
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.race.lines import START, LineFrame
from pigaming_app.scenes.views.race.party import sprites as things
from pigaming_app.scenes.views.view import Pose
from pigaming_app.sim.world import HZ, ROBOTS
from pigaming_app.ui.draw import FOCUS, PLAYERS, STEEL
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, put, step

PAD_SPEED = 1.4  # waves of light over a boost pad, per second
BOX_SPEED = 0.35  # sixths of a turn of an item box, per second
PULSE_SPEED = 1.6  # pulses of the finish line, per second
DRYING = 2 * HZ  # ticks for which oil fades before it is gone
ROWS = (-34.0, -20.0, 20.0, 34.0)  # px right of the way between two robots
STREAK, FLOW = 58.0, 460.0  # px between streaks of air, px/s of their motion
CLEAR = 50.0  # px between a robot's centre and the air


def draw_floor(under: Batch, over: Batch, state: Race, clock: float) -> None:
    """Draw pads, boxes and oil; pads that only the last can use in its colour, or grey for who drives alone."""
    color = FOCUS
    if state.rules.draft:
        color = next((PLAYERS[seat] for seat in range(ROBOTS) if is_last(state, seat)), STEEL)
    for pad in state.pads:
        phase = int(clock * PAD_SPEED * things.PAD_PHASES) % things.PAD_PHASES
        put(under, things.pad(step(pad.heading, HEADINGS), phase, color), LEFT + pad.x, TOP + pad.y)
    if not state.rules.party:
        return
    for i, oil in enumerate(state.oils):
        if oil.alive:
            level = min(things.OIL_LEVELS, 1 + oil.alive * things.OIL_LEVELS // DRYING)
            put(over, things.oil((i % OWN_OILS + i // OWN_OILS) % things.OIL_SHAPES, level), LEFT + oil.x, TOP + oil.y)
    for i, box in enumerate(state.boxes):
        turn = int((clock * BOX_SPEED + 0.5 * (i % 2)) * things.BOX_TURNS) % things.BOX_TURNS
        put(over, things.box_gone() if box.pause else things.item_box(turn), LEFT + box.x, TOP + box.y)


def draw_finish(under: Batch, line: LineFrame, clock: float) -> None:
    """Light the rails of the finish line in pulses."""
    level = round(things.PULSE_LEVELS * (0.5 - 0.5 * math.cos(math.tau * clock * PULSE_SPEED)))
    if level:
        put(under, things.finish_pulse(line, level), LEFT + line.x, TOP + line.y)


def finish_line(signs: Sequence[int]) -> int:
    """Index of the common finish line."""
    return signs.index(START)


def draw_air(under: Batch, state: Race, seat: int, poses: Sequence[Pose], clock: float) -> None:
    """Draw air that flows from the robot ahead along both sides of one in its slipstream."""
    ahead = robot_ahead(state, seat)
    if ahead is None:
        return
    (x, y, _), (ax, ay, _) = poses[seat], poses[ahead]
    length, turn = math.dist((x, y), (ax, ay)), math.atan2(ay - y, ax - x)
    c, s = math.cos(turn), math.sin(turn)
    for k, row in enumerate(ROWS):
        at = -CLEAR + (-clock * FLOW + 0.37 * k * STREAK) % STREAK
        while at < length - CLEAR:
            level = things.AIR_LEVELS if at > CLEAR else 1 + int(at > 0.0)
            sprite = things.air(step(turn + math.pi, things.AIR_TURNS), level)
            put(under, sprite, x + at * c - row * s, y + at * s + row * c)
            at += STREAK


def robot_ahead(state: Race, seat: int) -> int | None:
    """The nearest robot in front of one, within reach of its slipstream."""
    robot, rules = state.robots[seat], state.rules
    c, s = math.cos(robot.heading), math.sin(robot.heading)
    nearest, found = rules.slip_reach, None
    for other, ahead in enumerate(state.robots):
        dx, dy = ahead.x - robot.x, ahead.y - robot.y
        way = c * dx + s * dy
        if other != seat and ahead.present and 0.0 < way < nearest and abs(c * dy - s * dx) < rules.slip_width:
            nearest, found = way, other
    return found
