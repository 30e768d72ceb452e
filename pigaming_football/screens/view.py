"""View of Robot Football: pitch, goals, the rolling ball, its trail and charge, kick-off and goals."""

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from pigaming_app.api.look import STYLE, Batch, SimpleView, put

from ..rules import charge_of, side_of, worth_for
from ..state import Football
from . import ceremony, sprites
from .ball_track import FADES, BallTrack

KICK = 140.0  # px/s: a change of velocity that is heard
CHEER, NETTED = 1.7, 0.5  # s for which the ball of a goal lies in the net, and in which it comes to rest there
CHARGES = 16  # steps of the ring of the charge
JINGLES = ("delivered_ice", "delivered_fire")
Cue = tuple[str, int | None, float]  # sound, player for the pitch, x in the arena, px


class FootballView(SimpleView):
    """The ball and its pitch, besides walls, robots and goals."""

    shocks = (STYLE.ice, *STYLE.teams, STYLE.focus)  # of the kick-off, of goals, of a golden ball
    glows = STYLE.teams
    wears_teams = True
    opening = ceremony.SECONDS
    memory = ceremony.TICKS + 2  # and the goal itself

    def begin(self, state: Football) -> None:
        ball = state.ball
        self.track, self.velocity = BallTrack(ball), (ball.vx, ball.vy)
        self.goals, self.holder, self.out = state.goals, ball.holder, ball.out
        self.goal_at, self.goal_from, self.scorer = -9.0, (0.0, 0.0), 0
        self.replay: ceremony.GoalReplay | None = None  # of the last goal, until its ceremony is over

    def open(self) -> None:
        self.present(ceremony.SECONDS)
        self.announce(self.word("football.kick_off"), STYLE.ice)

    def floor_marks(self, state: Football) -> tuple[Any, ...]:
        return sprites.draw_pitch, state.mouth

    def clock_words(self, state: Football) -> str:
        if self.replays:
            return self.word("football.replay")
        return self.word("football.golden_goal") if state.golden_goal else ""

    def samples(self) -> Iterator[Callable[[], object]]:
        for color in STYLE.teams:
            for goal in ("football.goal", "football.double_goal", "football.own_goal"):
                yield partial(self.announcement, self.word(goal), color)
        yield from ceremony.samples(self)
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
        for team in (0, 1):
            yield partial(sprites.rays, team)
        for left in range(0, 49, 4):
            yield partial(sprites.ring, STYLE.ice, left)

    # ---- the ball

    @property
    def replays(self) -> bool:
        """True while the last goal is shown once more."""
        return self.replay is not None and self.replay.place(self.since)[0] >= 0

    @property
    def shown_track(self) -> BallTrack:
        """The ball that is shown: of the match, or of the replay."""
        return self.replay.track if self.replay and self.replays else self.track

    def moment(self, state: Football, blend: float) -> tuple[Football, float]:
        if self.replay and not self.presenting:
            self.replay = None
            self.show_between(state, state)
        if not self.replay or not self.replays:
            return state, blend
        i, blend = self.replay.place(self.since)
        self.replay.follow(i, self.particles.clock)
        self.show_between(self.replay.clip[i], self.replay.clip[i + 1])
        return self.replay.clip[i + 1], blend

    def marks(self, under: Batch, over: Batch, state: Football, blend: float) -> None:
        ball, now, gold, track = state.ball, self.particles.clock, state.ball.worth > 1, self.shown_track
        if ball.out:
            self.draw_waiting(under, state, gold)
            return
        x, y = track.at(blend)
        for tx, ty, at in track.tail:
            level = math.ceil(sprites.TRAIL * (1.0 - (now - at) / FADES))
            if level > 0:
                put(under, sprites.trail(min(level, sprites.TRAIL), gold), *self.on_canvas(tx, ty))
        put(under, sprites.shadow(), *self.on_canvas(x, y))
        if ball.holder:
            self.draw_charge(under, state, ball.holder - 1, x, y)

    def above(self, light: Batch, top: Batch, state: Football, blend: float) -> None:
        """The ball, which lies over the robots' barrels; ceremonies."""
        ball, track, since = state.ball, self.shown_track, self.particles.clock - self.goal_at
        if state.tick == 0 and self.presenting:
            ceremony.draw_teams(self, light, top)
            return
        if self.replays:
            ceremony.draw_brackets(self, light)
        elif since < CHEER or self.replay:
            self.draw_netted(top, since)
        if not ball.out:
            put(top, sprites.ball(track.direction, track.phase(), ball.worth > 1), *self.on_canvas(*track.at(blend)))
        elif ball.out < waiting(state) - 25:
            put(top, sprites.ball(0, 0, ball.worth > 1), *self.on_canvas(ball.x, ball.y))

    def draw_charge(self, under: Batch, state: Football, seat: int, x: float, y: float) -> None:
        """The ring that fills with the charge, the line of the shot, and rays if a goal counts two."""
        if worth_for(state, seat) > 1:
            put(under, sprites.rays(side_of(state.robots[seat])), *self.on_canvas(x, y))
        share = min(1.0, charge_of(state))
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
        self.track.follow(ball, self.particles.clock)
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

    def name_scorer(self, before: Football, conceded: int) -> None:
        """Announce a goal with its scorer, an own goal with the team for which it counts."""
        seat, color = scorer_of(before, conceded), STYLE.teams[1 - conceded]
        if seat >= 0:
            word = "football.double_goal" if worth_for(before, seat) > 1 else "football.goal"
            self.announce(self.word(word), color, self.name(seat))
        else:
            self.announce(self.word("football.own_goal"), color, self.word(f"lobby.side_{2 - conceded}"))

    def cheer(self, state: Football) -> list[Cue]:
        """Light, sparks and sounds of a goal, and its replay."""
        self.scorer, self.goal_at = 1 - state.goal_side, self.particles.clock
        clip = self.film.before(state)
        self.name_scorer(clip[-1] if len(clip) else state, state.goal_side)
        self.present(ceremony.SECONDS)
        if self.presenting and len(clip) > 1:
            self.replay = ceremony.GoalReplay(clip)
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


def scorer_of(before: Football, conceded: int) -> int:
    """The seat that scored, by the state before the goal: of the two last to touch the ball, the later one of the team
    that did not concede; -1: neither, an own goal.
    """
    touched = (before.ball.touched - 1, before.ball.before - 1)
    return next((seat for seat in touched if seat >= 0 and side_of(before.robots[seat]) != conceded), -1)


def waiting(state: Football) -> int:
    """Ticks for which the ball is out before it is dropped."""
    return int(state.rules.celebration if state.ball.roll else state.rules.warning)
