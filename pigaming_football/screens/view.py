"""View of Robot Football: pitch, goals, the rolling ball, its trail and charge, and the celebration of a goal."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from pigaming_app.api.look import STYLE, Batch, SimpleView, put

from ..rules import side_of
from ..start import start_indices
from ..state import Football
from . import sprites

FAST, TAIL = 260.0, 0.016  # px/s from which the ball has a trail; s between its spots
JUMP = 120.0  # px in a tick: the ball was placed, not rolled
KICK = 140.0  # px/s: a change of velocity that is heard
CHEER, NETTED = 1.7, 0.5  # s for which a goal is cheered, and in which the ball comes to rest in the net
CHARGES = 16  # steps of the ring of the charge
JINGLES = ("delivered_ice", "delivered_fire")
Cue = tuple[str, int | None, float]  # sound, player for the pitch, x in the arena, px


class FootballView(SimpleView):
    """The ball and its pitch, besides walls, robots and goals."""

    shocks = (STYLE.ice, *STYLE.teams, STYLE.focus)  # of the kick-off, of goals, of a golden ball
    glows = STYLE.teams
    wears_teams = True

    def begin(self, state: Football) -> None:
        ball = state.ball
        self.was = self.now = (ball.x, ball.y)
        self.velocity = (ball.vx, ball.vy)
        self.rolled, self.direction = 0.0, 0.0
        self.tail: list[tuple[float, float, float]] = []  # x, y, time
        self.goals, self.holder, self.out = state.goals, ball.holder, ball.out
        self.goal_at, self.goal_from, self.scorer = -9.0, (0.0, 0.0), 0

    def start_order(self, state: Football) -> Sequence[int]:
        return start_indices([robot.team for robot in state.robots], [bool(robot.present) for robot in state.robots])

    def floor_marks(self, state: Football) -> tuple[Any, ...]:
        return sprites.draw_pitch, state.mouth

    def clock_words(self, state: Football) -> str:
        return self.word("football.golden_goal") if state.golden_goal else ""

    def samples(self) -> Iterator[Callable[[], object]]:
        for color in STYLE.teams:
            yield partial(self.announcement, self.word("football.goal"), color)
        yield sprites.shadow
        for level in range(1, sprites.TRAIL + 1):
            yield partial(sprites.trail, level, False)
        for right in (False, True):
            yield partial(sprites.kick_off_arrow, right)
        for turn in range(sprites.DIRECTIONS):
            for phase in range(sprites.PHASES):
                yield partial(sprites.ball, turn * math.tau / sprites.DIRECTIONS, phase, False)
        for seat in self.seats:
            for charge in range(1, CHARGES + 1):
                yield partial(sprites.ring, STYLE.players[seat], 48 * charge // CHARGES)
            for level in range(1, 5):
                yield partial(sprites.aim, level, seat)
        for left in range(0, 49, 4):
            yield partial(sprites.ring, STYLE.ice, left)

    # ---- the ball

    def marks(self, under: Batch, over: Batch, state: Football, blend: float) -> None:
        ball, now, gold = state.ball, self.particles.clock, state.ball.worth > 1
        if ball.out:
            self.draw_waiting(under, state, gold)
            return
        x, y = self.ball_at(blend)
        for tx, ty, at in self.tail:
            level = math.ceil(sprites.TRAIL * (1.0 - (now - at) / 0.22))
            if level > 0:
                put(under, sprites.trail(min(level, sprites.TRAIL), gold), *self.on_canvas(tx, ty))
        put(under, sprites.shadow(), *self.on_canvas(x, y))
        if ball.holder:
            self.draw_charge(under, state, ball.holder - 1, x, y)

    def above(self, light: Batch, top: Batch, state: Football, blend: float) -> None:
        """The ball, which lies over the robots' barrels."""
        ball, since = state.ball, self.particles.clock - self.goal_at
        if since < CHEER:
            self.draw_netted(top, since)
        if not ball.out:
            phase = sprites.phase_of(self.rolled)
            put(top, sprites.ball(self.direction, phase, ball.worth > 1), *self.on_canvas(*self.ball_at(blend)))
        elif ball.out < waiting(state) - 25:
            put(top, sprites.ball(0, 0, ball.worth > 1), *self.on_canvas(ball.x, ball.y))

    def ball_at(self, blend: float) -> tuple[float, float]:
        """Where the ball is between the last two ticks, px in the arena."""
        (x, y), (to_x, to_y) = self.was, self.now
        return x + (to_x - x) * blend, y + (to_y - y) * blend

    def draw_charge(self, under: Batch, state: Football, seat: int, x: float, y: float) -> None:
        """The ring that fills with the charge, and the line of the shot."""
        share = min(1.0, state.ball.charge / state.rules.charge)
        ring = 48 * math.ceil(CHARGES * share) // CHARGES
        put(under, sprites.ring(STYLE.players[seat], max(3, ring)), *self.on_canvas(x, y))
        heading = state.robots[seat].heading + state.ball.grip
        reach = 2 + round(4 * share)
        for i in range(reach):
            far = 52 + 34 * i
            at = self.on_canvas(x + far * math.cos(heading), y + far * math.sin(heading))
            put(under, sprites.aim(max(1, 4 - i), seat), *at)

    def draw_waiting(self, under: Batch, state: Football, gold: bool) -> None:
        """The ball before it is dropped, in a ring that empties, with the way that it will roll."""
        ball = state.ball
        left = 4 * math.ceil(12 * min(1.0, ball.out / waiting(state)))
        at = self.on_canvas(ball.x, ball.y)
        put(under, sprites.ring(STYLE.focus if gold else STYLE.ice, left), *at)
        if ball.roll:
            right = ball.roll > 0.0
            pulse = 0.5 - 0.5 * math.cos(math.tau * self.particles.clock)
            far = (58 + 10 * pulse) * (1 if right else -1)
            put(under, sprites.kick_off_arrow(right), at[0] + far, at[1])

    def draw_netted(self, top: Batch, since: float) -> None:
        """The ball of the last goal, which comes to rest in the net."""
        share = 1.0 - (1.0 - min(1.0, since / NETTED)) ** 2
        x, y = self.goal_from
        x += (-1 if x < 800 else 1) * 34 * share
        put(top, sprites.ball(0, sprites.phase_of(share * 3.0), False), *self.on_canvas(x, y))

    # ---- events

    def events(self, state: Football) -> list[Cue]:
        ball, cues = state.ball, super().events(state)
        cues = [cue for cue in cues if cue[0] != "pickup"]
        self.follow_ball(state)
        if state.goals > self.goals:
            cues += self.cheer(state)
        elif self.out and not ball.out:
            cues.append(("drop", None, ball.x))
            self.particles.shock(*self.on_canvas(ball.x, ball.y), STYLE.focus if ball.worth > 1 else STYLE.ice)
        elif ball.holder and not self.holder:
            cues.append(("lift", ball.holder - 1, ball.x))
        elif self.holder and not ball.holder and not ball.out:
            cues.append(self.kicked(state, self.holder - 1))
        elif not ball.out and not ball.holder and not self.out:
            change = math.hypot(ball.vx - self.velocity[0], ball.vy - self.velocity[1])
            if change > KICK:
                cues.append(("set_down", None, ball.x))
                x, y = self.on_canvas(ball.x, ball.y)
                self.particles.burst(x, y, STYLE.ice, min(10, round(change / 80)), 22, 30)
        self.goals, self.holder, self.out = state.goals, ball.holder, ball.out
        self.velocity = (ball.vx, ball.vy)
        return cues

    def kicked(self, state: Football, seat: int) -> Cue:
        """Sparks and sound of a shot, or of a ball that was lost."""
        ball = state.ball
        x, y = self.on_canvas(ball.x, ball.y)
        speed = math.hypot(ball.vx, ball.vy)
        if speed > 300.0:
            way = math.atan2(ball.vy, ball.vx)
            self.particles.burst(x, y, STYLE.players[seat], round(speed / 50), 24, 60, (way + math.pi, 0.6))
            return "fire", seat, ball.x
        return "hit", None, ball.x

    def follow_ball(self, state: Football) -> None:
        """Record where the ball is, how far it has rolled, and its trail."""
        ball = state.ball
        self.was, self.now = self.now, (ball.x, ball.y)
        dx, dy = self.now[0] - self.was[0], self.now[1] - self.was[1]
        way = math.hypot(dx, dy)
        if way > JUMP or ball.out or self.out:
            self.was, self.tail = self.now, []
            return
        if way > 0.3:
            self.direction = math.atan2(dy, dx)
            self.rolled += way / sprites.RADIUS
        now = self.particles.clock
        if way > FAST * 0.02 and not ball.holder and (not self.tail or now - self.tail[-1][2] >= TAIL):
            self.tail.append((ball.x, ball.y, now))
        self.tail = [spot for spot in self.tail if now - spot[2] < 0.22]

    def cheer(self, state: Football) -> list[Cue]:
        """Light, sparks and sounds of a goal."""
        self.scorer = 1 - state.goal_side
        self.goal_at = self.particles.clock
        self.announce(self.word("football.goal"), STYLE.teams[self.scorer])
        self.goal_from = (0.0 if state.goal_side == 0 else 1600.0, state.goal_y)
        x, y = self.on_canvas(*self.goal_from)
        color, inwards = STYLE.teams[self.scorer], 0.0 if state.goal_side == 0 else math.pi
        self.particles.burst(x, y, color, 70, 20, 320, (inwards, 1.3))
        self.particles.burst(x, y, STYLE.focus, 24, 20, 200, (inwards, 1.0))
        if self.options.flashes != "off":
            self.particles.shock(x, y, color)
        if self.options.flashes == "full":
            self.particles.glow(x, y, color, 0.9)
        if self.options.shake:
            self.particles.shake()
        for seat in self.seats:
            if side_of(state.robots[seat]) == self.scorer:
                self.rumble(seat)
        return [(JINGLES[self.scorer], None, self.goal_from[0]), ("rush", None, self.goal_from[0])]


def waiting(state: Football) -> int:
    """Ticks for which the ball is out before it is dropped."""
    return int(state.rules.celebration if state.ball.roll else state.rules.warning)
