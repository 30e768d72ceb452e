"""The hand-written brain of Robot Race: pure pursuit of a point ahead on the fastest line.

The point is shifted sideways where another robot is in the way (see `overtaking`). Speed is as high as the curvature
allows, with turbo on straights. A stuck robot backs out; one that has missed a line returns to before it.

The strengths differ in speed, in how closely and steadily they keep the fastest line, in turbo (hand1 never uses it),
in reaction time and in mistakes: a missed braking point, after which the robot runs wide, often into the mud. Those
below hand3 stay nearer to the middle of the course, which leaves room inside to overtake them. No two races of a driver
are alike: its reaction at the start, its line and how early it brakes vary with the seed. Levels also have a form, of
the day and of spells, so that half a race does not decide it.

In `party` it uses its item when that pays (see `wants_item`). FIRE also asks for the way back when it is lost for good.
"""

from dataclasses import dataclass
from math import atan2, cos, pi, sin, sqrt

from pigaming_app.ai.brain.kind import BrainKind, NoWeights, Traits
from pigaming_app.ai.brain.unstick import STUCK_DISTANCE, choose_escape, escape, ticks_stuck
from pigaming_app.ai.race.overtaking import CLEAR, EDGE, LEEWAY, choose_lane, leader_speed
from pigaming_app.games.race.observation import OTHERS, RaceObservation, RaceSenses, observe
from pigaming_app.games.race.state import OFF_COURSE, SHIELD, TURBO, Race
from pigaming_app.sim.action import set_action
from pigaming_app.sim.angles import turn_to
from pigaming_app.sim.kernel import kernel
from pigaming_app.sim.record import record
from pigaming_app.sim.rng import bell, seeded, uniform
from pigaming_app.sim.world import HZ, RADIUS, ROBOTS, Action

PERIOD = 5  # ticks between decisions: 10 Hz, one seat after the other
LOOK = 115.0  # lookahead along the course, px
LATE = 0.05  # latency of the motors, s
GRIP = 1.8  # commanded turn rate, as a share of the highest, above which it slows down
SHIFT = 20.0  # px of lane change within one lookahead
OUT = 30.0  # px inside the edge at which it aims when off the course
SLACK = 25.0  # px past a line before it counts as missed: the rules may not have registered the crossing yet
SAVE = 80.0  # px to a robot ahead within which it saves its turbo
NEW_ERROR = 30  # ticks between draws of the line error
SPELL = 25 * HZ  # ticks of a spell of form, on average; from half of it to one and a half
EASE = 0.03  # of the way from one spell's form to the next, with each decision
BEND = 0.3  # sine of the turn ahead, from which a bend may cause a mistake
BLUNDER = 35  # ticks of a mistake
WIDE, OVER = 60.0, 45.0  # px of lane change within one lookahead then, and px off the course that it heads for
CHASE = 60.0, 260.0  # px to a robot behind, for which it drops oil
SEEN_OIL = 300.0  # px to oil ahead, for which it raises its shield
NEXT_BOX = 220.0  # px to an item box, before which it uses up its item
POINT = 100.0  # px of progress that count as a point where strength follows people
STUCK_TICKS = 40  # ticks of driving without moving that count as stuck

RACE, GO_BACK, BREAK_FREE = range(3)


@record
class RacerMind:
    """Memory of the driver; the fields without a comment are as in Driver."""

    senses: RaceSenses
    obs: RaceObservation
    speed: float
    day: float  # share of its speed that it lacks today
    spell: float
    low: float  # how much of `spell` it lacks on top at present, 0 to 1
    next_low: float  # where `low` goes in this spell
    spell_left: int  # ticks
    line: float
    spread: float
    boost: float
    random: int  # state of the generator
    state: int  # one of the three above
    since: int  # ticks in this state
    reaction: float  # ticks from GO to its first action
    care: float
    mistakes: float
    foresight: float
    alert: float
    stray: float  # present line error, px
    caution: float  # share of the speed in bends that it gives away at present
    blunder: int  # ticks left of a mistake
    stray_left: int  # ticks until the next draw
    lane: float  # present lane, px right of the middle
    anchor_x: float  # position at the last progress, px
    anchor_y: float  # px
    stuck_ticks: int  # ticks since then
    escape: float  # forward stick while backing out
    escape_turn: float  # turn stick then
    clear: float = 2.0 * RADIUS + CLEAR  # px between the centres of two passing robots


@kernel
def think(match: Race, seat: int, mind: RacerMind, weights: NoWeights) -> None:
    """Observe and decide every PERIOD ticks; the action holds in between."""
    if (match.tick + seat) % PERIOD or match.tick < mind.reaction:
        return
    mind.clear = 2.0 * match.radius + CLEAR
    observe(match, seat, mind.senses, mind.obs)
    act(mind.obs, mind, match.actions[seat])


@kernel
def act(obs: RaceObservation, mind: RacerMind, action: Action) -> None:
    """One step of the state machine: update memory, run the state, change state if it returns another one."""
    mind.since += PERIOD
    fired = action.fire
    draw_error(obs, mind)
    mind.senses.look = look_ahead(obs)
    detect_stuck(obs, mind, action)
    if mind.state == BREAK_FREE:
        after = break_free(obs, mind, action)
    elif mind.state == GO_BACK:
        after = go_back(obs, action)
    else:
        after = race(obs, mind, action)
    if after != mind.state:
        mind.state, mind.since = after, 0
    if not fired:  # FIRE counts as it goes down
        action.fire = wants_way_back(obs, mind) if obs.lost else wants_item(obs, mind)


# ------------------------------------------------------------------------------------------------------------- states


@kernel
def race(obs: RaceObservation, mind: RacerMind, action: Action) -> int:
    """Follow the line, overtaking robots in the way."""
    if obs.past > SLACK:
        return go_back(obs, action)
    mark = obs.ahead
    choose_lane(obs, mind)
    room = mark.half - (EDGE if obs.on else OUT)
    lane = aimed_lane(mind)
    if mind.blunder > 0:
        room += OVER
        lane = -room if obs.turn > 0.0 else room
    shift = WIDE if mind.blunder > 0 else SHIFT
    keep = obs.aside - obs.ideal + mark.ideal  # the lane that keeps the present distance to the fastest line
    lane = keep + shift if lane > keep + shift else keep - shift if lane < keep - shift else lane
    lane = room if lane > room else -room if lane < -room else lane
    if mark.narrow:
        lane = mark.high if lane > mark.high else mark.low if lane < mark.low else lane
    x, y = mark.x + (lane - mark.ideal) * mark.right_x, mark.y + (lane - mark.ideal) * mark.right_y
    pursue(obs, mind, action, x, y)
    return RACE


@kernel
def go_back(obs: RaceObservation, action: Action) -> int:
    """Drive back to before a missed line, in reverse where that saves a long turn."""
    bearing, ahead = turn_to(atan2(obs.return_y - obs.y, obs.return_x - obs.x) - obs.heading), 1.0
    if abs(bearing) > 0.6 * pi and obs.past < 200.0:
        bearing, ahead = turn_to(bearing + pi), -1.0
    if abs(bearing) > 0.9:
        ahead = 0.0
    set_action(action, ahead, 2.0 * bearing, 0, 0)
    return GO_BACK if obs.past > -SLACK else RACE


@kernel
def break_free(obs: RaceObservation, mind: RacerMind, action: Action) -> int:
    """Back out with a turn until the robot is free."""
    if not escape(mind, obs.x, obs.y, action):
        return BREAK_FREE
    return RACE


# ------------------------------------------------------------------------------------------------------------- helpers


@kernel
def aimed_lane(mind: RacerMind) -> float:
    """Its lane with the present line error, which is always towards the middle, px right of it."""
    lane: float = mind.lane + mind.stray if mind.lane * mind.stray < 0.0 else mind.lane - mind.stray
    return lane


@kernel
def draw_error(obs: RaceObservation, mind: RacerMind) -> None:
    """Draw a new line error and how early it brakes, every NEW_ERROR ticks; in a bend perhaps a mistake."""
    if mind.spell > 0.0:
        update_form(mind)
    mind.blunder -= PERIOD
    mind.stray_left -= PERIOD
    if mind.stray_left <= 0:
        mind.stray_left = NEW_ERROR
        mind.stray = 2.0 * mind.spread * bell(mind)
        mind.caution = mind.care * uniform(mind)
        if abs(obs.turn) > BEND and obs.on and uniform(mind) < mind.mistakes:
            mind.blunder = BLUNDER


@kernel
def update_form(mind: RacerMind) -> None:
    """Approach the form of this spell; draw the next one when it is over."""
    mind.spell_left -= PERIOD
    if mind.spell_left <= 0:
        draw_spell(mind)
    mind.low += EASE * (mind.next_low - mind.low)


@kernel
def draw_spell(mind: RacerMind) -> None:
    """Draw form and length of a spell."""
    mind.next_low = uniform(mind)
    mind.spell_left = int(SPELL * (0.5 + uniform(mind)))


@kernel
def wants_way_back(obs: RaceObservation, mind: RacerMind) -> int:
    """1 if it asks for the way back: after a missed line, facing the wrong way, or stuck; not for a bit of mud."""
    return 0 if obs.lost == OFF_COURSE and mind.state != BREAK_FREE else 1


@kernel
def wants_item(obs: RaceObservation, mind: RacerMind) -> int:
    """1 if its item pays now, or room is needed for the next one, and it notices."""
    if not obs.item or obs.finished or obs.spin or uniform(mind) >= mind.alert:
        return 0
    if obs.box.present and obs.box.ahead < NEXT_BOX:
        return 1
    if obs.item == TURBO:
        return 1 if obs.on and obs.pace >= 1.0 and abs(obs.turn) < BEND else 0
    if obs.item == SHIELD:
        return 1 if obs.oils[0].present and obs.oils[0].ahead < SEEN_OIL else 0
    low, high = CHASE
    for i in range(OTHERS):
        other = obs.others[i]
        if other.present and low < -other.ahead < high and abs(other.aside - obs.aside) < mind.clear:
            return 1
    return 0


@kernel
def look_ahead(obs: RaceObservation) -> float:
    """Lookahead for the next observation, px; off the course not past the next line, to cross and not bypass it."""
    look = LOOK if obs.on else 0.5 * LOOK
    if not obs.on and -obs.past - SLACK < look:
        look = -obs.past - SLACK
    return 20.0 if look < 20.0 else look


@kernel
def detect_stuck(obs: RaceObservation, mind: RacerMind, action: Action) -> None:
    """Enter BREAK_FREE if the robot drives without moving for STUCK_TICKS."""
    if mind.state == BREAK_FREE:
        return
    idle = action.linear == 0.0 and action.angular == 0.0
    if ticks_stuck(mind, obs.x, obs.y, idle, STUCK_DISTANCE, PERIOD) > STUCK_TICKS:
        mind.state, mind.since = BREAK_FREE, 0
        choose_escape(mind, -1.0 if action.linear >= 0.0 else 1.0, 0.75)


@kernel
def pursue(obs: RaceObservation, mind: RacerMind, action: Action, x: float, y: float) -> None:
    """Drive the arc to the point (x, y), as fast as its curvature allows.

    To compensate for the latency of the motors the arc begins at the pose predicted LATE s ahead. Source of pure
    pursuit: Coulter, CMU-RI-TR-92-01, 1992.
    """
    heading = obs.heading + LATE * obs.angular
    middle = obs.heading + 0.5 * LATE * obs.angular
    dx = x - obs.x - LATE * obs.linear * cos(middle)
    dy = y - obs.y - LATE * obs.linear * sin(middle)
    bearing = turn_to(atan2(dy, dx) - heading)
    if abs(bearing) > 1.2:
        set_action(action, 0.0, 3.0 * bearing, 0, 0)
        return
    bend = 2.0 * sin(bearing) / (sqrt(dx * dx + dy * dy) + 1.0)  # curvature, rad/px
    held = leader_speed(obs, mind)
    dash = wants_turbo(obs, mind, bend) if held > 1.0 else 0
    full = obs.speed * (obs.turbo_factor if dash else 1.0)
    form = 1.0 - mind.day - mind.spell * mind.low
    speed, limit = mind.speed * form, GRIP * obs.turn_rate / (abs(bend) * full + 1e-9)
    if mind.blunder <= 0:
        early = 1.0 if obs.pace >= 1.0 else 1.0 - mind.caution
        speed *= obs.pace * early
        speed = speed if speed < limit else limit
        speed = speed if speed < held else held
    set_action(action, speed, bend * speed * full / obs.turn_rate, 0, dash)


@kernel
def wants_turbo(obs: RaceObservation, mind: RacerMind, bend: float) -> int:
    """1 if the way is straight enough, the meter full enough to start, and no robot is close ahead."""
    if not obs.on or abs(bend) * obs.turbo_factor * obs.speed > 0.8 * obs.turn_rate or obs.pace < 1.0:
        return 0
    for i in range(OTHERS):
        other = obs.others[i]
        beside = obs.boosts and abs(other.aside - mind.lane) > mind.clear - LEEWAY
        if other.present and other.ahead > 0.0 and other.distance < SAVE and not beside:
            return 0
    return 1 if obs.boosting or obs.turbo > mind.boost else 0


@kernel
def lead(match: Race, seat: int) -> float:
    """Progress ahead of the mean of the others, in units of POINT."""
    progress, others = 0.0, 0
    for i in range(ROBOTS):
        if i != seat and match.robots[i].present:
            progress += match.racers[i].progress
            others += 1
    return (match.racers[seat].progress - progress / others) / POINT if others else 0.0


@dataclass(frozen=True)
class Driver:
    """In what drivers differ."""

    form: float  # share of its speed that it may lack on a bad day
    line: float  # 0: middle of the course, 1: fastest line
    spread: float  # standard deviation of the line error, px
    boost: float  # share of the turbo meter needed to start turbo; above 1: never
    delay: float  # reaction time to others, s
    reaction: tuple[int, int]  # fewest ticks to its start, and how many more are possible
    care: float  # share of the speed in bends that it may give away, braking early
    mistakes: float  # probability of a mistake, per draw of the line error in a bend
    foresight: float  # px ahead, within which it reacts to pads, boxes and oil
    alert: float  # probability, per decision, of noticing that it should use its item
    speed: float = 1.0  # share of full speed, on a good day
    spell: float = 0.0  # share of its speed that it may lack on top, for some time

    def reset(self, mind: RacerMind, seed: int) -> None:
        """Initialise a fresh mind. The range of reactions is a multiple of PERIOD: no seat has an advantage."""
        mind.senses.delay, mind.senses.look = self.delay, LOOK
        mind.speed, mind.line, mind.spread, mind.boost = self.speed, self.line, self.spread, self.boost
        mind.care, mind.mistakes, mind.foresight, mind.alert = self.care, self.mistakes, self.foresight, self.alert
        mind.random = seeded(seed)
        fewest, more = self.reaction
        mind.reaction = fewest + int(more * uniform(mind))
        mind.day, mind.spell = self.form * uniform(mind), self.spell
        if self.spell:
            draw_spell(mind)
            mind.low = mind.next_low


def racer(name: str, driver: Driver) -> BrainKind:
    """The brain of a driver."""
    return BrainKind(name, RacerMind, think, driver.reset)


def person(traits: Traits) -> BrainKind:
    """What a person sees and wants: who knows the game keeps to the fastest line and looks farther ahead."""
    novice, reaction = 1.0 - traits.tactics, round(traits.reaction * HZ)
    driver = Driver(
        form=0.0,
        line=traits.tactics,
        spread=100.0 * traits.aim,
        boost=0.15 if traits.turbo else 2.0,
        delay=traits.reaction,
        reaction=(reaction // 2, reaction),
        care=0.2 * novice,
        mistakes=0.15 * novice,
        foresight=160.0 + 220.0 * traits.tactics,
        alert=0.03 + 0.97 * traits.tactics**2,
    )
    return racer("person", driver)


HAND1 = racer(
    "hand1",
    Driver(
        form=0.03, line=0.2, spread=10.0, boost=2.0, delay=0.35, reaction=(10, 30), care=0.2, mistakes=0.15,
        foresight=160.0, alert=0.03, speed=0.93,
    ),
)  # fmt: skip
HAND2 = racer(
    "hand2",
    Driver(
        form=0.02, line=0.35, spread=6.0, boost=0.5, delay=0.2, reaction=(5, 25), care=0.1, mistakes=0.03,
        foresight=240.0, alert=0.1,
    ),
)  # fmt: skip
HAND3 = racer(
    "hand3",
    Driver(
        form=0.012, line=1.0, spread=2.0, boost=0.12, delay=0.05, reaction=(2, 20), care=0.02, mistakes=0.0,
        foresight=320.0, alert=0.5,
    ),
)  # fmt: skip
