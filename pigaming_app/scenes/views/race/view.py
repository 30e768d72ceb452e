"""View of a race: track, robots, ghost, mud, signs and announcements."""

import math
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import pygame

from pigaming_app.games.race.state import LINES, MISSED_LINE, OFF_COURSE, Race, Racer
from pigaming_app.scenes.views.background import LEFT, TOP
from pigaming_app.scenes.views.hud.parts import H, Y, pulse
from pigaming_app.scenes.views.particles import reel
from pigaming_app.scenes.views.race import sprites as race_signs
from pigaming_app.scenes.views.race.background import RaceBackground
from pigaming_app.scenes.views.race.effects import RaceAnnouncements, RaceEffects, sound_cues, spray
from pigaming_app.scenes.views.race.events import RaceEvent, RaceEventDetector, drives_wrong
from pigaming_app.scenes.views.race.ghost import GhostRecorder
from pigaming_app.scenes.views.race.hud import RaceHud
from pigaming_app.scenes.views.race.hud_cards import FLASH, W
from pigaming_app.scenes.views.race.lines import LineFrame, frame
from pigaming_app.scenes.views.race.party.events import PartyEventDetector
from pigaming_app.scenes.views.race.party.floor import draw_air, draw_finish, draw_floor, finish_line
from pigaming_app.scenes.views.race.party.sprites import SHIELD_SWAY, SWIRL_TURNS, swirl
from pigaming_app.scenes.views.race.prewarm import jobs, party_jobs, void_words
from pigaming_app.scenes.views.race.recovery import draw_way_back, target_of
from pigaming_app.scenes.views.rumble import BEST, BLOCKED, FINISH, GIVEN, LAP, PICKED, TAKEN, rumbles
from pigaming_app.scenes.views.sprites import effects
from pigaming_app.scenes.views.sprites.robot import ghost as blank
from pigaming_app.scenes.views.things.styles import ROAD
from pigaming_app.scenes.views.view import MatchView, Pose, SoundCue, ViewOptions, decimal
from pigaming_app.sim.arena import Arena
from pigaming_app.sim.world import HZ, WIDTH
from pigaming_app.ui.draw import FOCUS, PLAYERS, THIN
from pigaming_app.ui.draw.sprites import HEADINGS, Batch, Sprite, put, step
from pigaming_app.ui.i18n import Words
from pigaming_app.ui.widgets.caption import caption

VOID_LASTS = 3.5  # s, display of an invalid lap
PLACE_LASTS = 6 * HZ  # ticks for which the place of a finished robot is shown
HINT_AFTER = round(1.5 * HZ)  # ticks off the course, or after a missed line, until a hint
TROUBLE_LASTS = 6.0  # s, notice of a dropped ghost
DASH, MARCH = 34.0, 70.0  # px between dashes, px/s of their motion
ENTRY, STOP = 170.0, 52.0  # px before a line: target of the path to it, and its end
SPRAYED = 60.0  # px/s, minimum speed for mud spray
BLINK, BLINKS = 0.08, 0.6  # s: one blink, and all of a robot that was put back on the track

RUMBLES = {
    "lap": LAP,
    "best": BEST,
    "finish": FINISH,
    "item": PICKED,
    "boost": GIVEN,
    "spin": TAKEN,
    "resisted": BLOCKED,
}  # by kind of event


class RaceView(MatchView):
    """The view of one race."""

    style = ROAD

    def __init__(
        self, arena: Arena, state: Race, players: list[str], options: ViewOptions, words: Words | None = None
    ) -> None:
        self.floor = RaceBackground(arena.plan, state)
        super().__init__(state, players, options, words, self.floor, arena.things)
        self.arena = arena
        self.cards = RaceHud(self.background, state, players, words)
        self.detector = RaceEventDetector(state)
        self.party = PartyEventDetector(state) if state.rules.party or state.rules.draft else None
        self.signs = self.floor.signs
        self.notes = RaceAnnouncements()
        self.event_effects = RaceEffects(self.particles, self.notes, options, words, self.signs)
        self.recorder: GhostRecorder | None = None
        self.frames = [frame(arena.plan.course, along) for along in arena.plan.lines]
        self.void = void_words(words)
        self.endings = [words(f"race.place_{i + 1}") if words else "" for i in range(LINES)]
        self.lost_ticks = [0] * len(state.robots)  # since when each robot has been lost
        self.void_at = [-VOID_LASTS] * len(state.robots)
        self.add_prewarm_jobs(self.cards.jobs(state))
        self.add_prewarm_jobs(jobs(self.seats, words, self.signs))
        if self.party:
            line = self.frames[finish_line(self.signs)] if state.rules.party else None
            self.add_prewarm_jobs(party_jobs(state, self.seats, line))

    def enable_persistence(self, folder: Path) -> None:
        """Load the track's ghost, and save people's best laps; not where pads and items help."""
        if not self.party:
            self.recorder = GhostRecorder(folder, self.arena, self.players)

    def show_names(self, names: Sequence[str]) -> None:
        self.cards.names = names

    def watch(self, state: Race) -> list[SoundCue]:
        self.record_poses(state)
        self.cards.follow(state)
        self.event_effects.real = self.real
        events = self.detector.detect(state) + (self.party.detect(state) if self.party else [])
        records = self.recorder.watch(state, events) if self.recorder else []
        ghost_deltas = self.recorder.ghost_deltas if self.recorder else {}
        self._hint(state)
        for event in events:
            fresh = ghost_deltas.get(event.seat)
            self.event_effects.show(event, state, fresh if fresh and fresh[1] == state.tick else None)
            self._note(event, state)
        for seat in records:
            self.event_effects.record(LEFT + state.robots[seat].x, TOP + state.robots[seat].y)
        for seat in self.seats:
            robot = state.robots[seat]
            if not state.racers[seat].place.on and abs(robot.linear) > SPRAYED:
                back = robot.heading + (math.pi if robot.linear > 0.0 else 0.0)
                spray(self.particles, LEFT + robot.x, TOP + robot.y, back, 1 + state.tick % 2, 0.8)
        self.rumbles = rumbles(RUMBLES, ((event.kind, event.seat) for event in events))
        return sound_cues(events, state)

    def draw(self, screen: pygame.Surface, state: Race, blend: float, seconds: float) -> None:
        self.particles.advance(seconds)
        self.cards.show(state, self.detector.order)
        under: Batch = []
        over: Batch = []
        light: Batch = []
        top: Batch = []
        poses = [self.pose(seat, blend) for seat in range(len(state.robots))]
        if self.party:
            self._party(under, over, state, poses)
        for seat in self.seats:
            if state.robots[seat].recover:
                draw_way_back(over, seat, poses[seat], target_of(state, seat), self.particles.clock)
            elif state.racers[seat].missed and not state.racers[seat].finished:
                self._draw_path_back(over, seat, poses[seat], self.frames[state.racers[seat].missed - 1])
        self._ghost(light, state, blend)
        for seat in self.seats:
            self._robot(under, over, light, state, seat, poses[seat])
        signed = {seat for seat in self.seats if self._sign(top, state, seat, poses[seat])}
        self.particles.draw_light(light)
        self.notes.draw(light, top, poses, self.particles.clock, signed)
        self.paint(screen, under, over, light, top)
        self._draw_notice(screen)

    # ---- inside

    def _hint(self, state: Race) -> None:
        """Hint at the way back to those who have been off the course for a while, or go the wrong way."""
        for seat in self.seats:
            lost = state.racers[seat].lost
            self.lost_ticks[seat] = self.lost_ticks[seat] + 1 if lost and not state.robots[seat].recover else 0
        patience = {OFF_COURSE: HINT_AFTER, MISSED_LINE: HINT_AFTER}
        late = [seat for seat in self.seats if self.lost_ticks[seat] > patience.get(state.racers[seat].lost, 0)]
        self.hints = {} if state.over else dict.fromkeys(late, "race.back_hint")

    def _note(self, event: RaceEvent, state: Race) -> None:
        """Update cards and signs after an event."""
        if event.kind in ("up", "down"):
            self.cards.moved(event.seat, event.kind == "up", state.tick)
            if self.options.flashes != "off":
                x = self.cards.xs[int(event.number) - 1]
                self.particles.bloom(x, Y, 0.4, reel(pulse, PLAYERS[event.seat], W, H, FLASH))
        elif event.kind == "void":
            self.void_at[event.seat] = self.particles.clock
        elif event.kind == "final_lap" and self.words:
            self.cards.announce(self.words("race.last_lap"), state.tick)
        elif event.kind == "close" and self.words and state.racers[event.seat].rank == 2:
            number = decimal(self.words, f"{event.number:.2f}")
            self.cards.announce(self.words("race.close_finish", seconds=number), state.tick)

    def _party(self, under: Batch, over: Batch, state: Race, poses: Sequence[Pose]) -> None:
        """Draw what lies on the course, slipstreams, and in party the finish line of the last lap."""
        clock = self.particles.clock
        draw_floor(under, over, state, clock)
        if state.rules.party and self.party and self.party.final and not state.over:
            draw_finish(under, self.frames[finish_line(self.signs)], clock)
        for seat in self.seats:
            if state.racers[seat].slip:
                draw_air(under, state, seat, poses, clock)

    def _robot(self, under: Batch, over: Batch, light: Batch, state: Race, seat: int, pose: Pose) -> None:
        x, y, heading = pose
        robot, racer = state.robots[seat], state.racers[seat]
        self.light_up(under, seat, pose, bool(robot.boosting or racer.surge))
        if not racer.place.on:
            put(under, race_signs.splash(state.tick // 6 % 3 if abs(robot.linear) > SPRAYED else seat % 3), x, y)
        since = self.particles.clock - self.event_effects.back_at[seat]
        hidden = since < BLINKS and int(since / BLINK) % 2 and self.options.flashes != "off"
        put(over, blank(seat) if hidden else self.body(seat, step(heading, HEADINGS)), x, y)
        if racer.shield:
            sway = abs(int(self.particles.clock * 10) % (2 * SHIELD_SWAY) - SHIELD_SWAY)
            put(light, effects.shield(seat, sway, self.reach(seat, 72)), x, y)
        if racer.spin:
            turn = int(self.particles.clock * 30) * racer.spin_way % SWIRL_TURNS
            put(light, swirl(turn, self.reach(seat, 52)), x, y)
        if robot.turbo < 1.0 and not racer.finished:
            put(light, effects.timer_ring(FOCUS, math.ceil(48 * robot.turbo), self.reach(seat, 52), THIN), x, y)

    def _ghost(self, light: Batch, state: Race, blend: float) -> None:
        pose = self.recorder.pose(state, blend) if self.recorder else None
        if pose:
            sprite = race_signs.ghost(step(pose[2], race_signs.GHOST_TURNS))
            put(light, sprite, LEFT + pose[0], TOP + pose[1])

    def _sign(self, top: Batch, state: Race, seat: int, pose: Pose) -> bool:
        """Draw a robot's sign above it or, near the upper edge, below; False if it has none."""
        racer = state.racers[seat]
        said = bool(racer.missed) and self.particles.clock - self.void_at[seat] < VOID_LASTS
        below = pose[1] - TOP < (260.0 if said else 165.0)
        sprite = self._sign_of(racer, seat, said, below)
        if sprite is None or (racer.finished and not self._shows_place(state, racer)):
            return False
        half = sprite.image.get_width() / 2
        x = min(max(pose[0], LEFT + half), LEFT + WIDTH - half)
        put(top, sprite, x, pose[1] + (race_signs.SIGN_AT if below else -race_signs.SIGN_AT))
        return True

    def _sign_of(self, racer: Racer, seat: int, said: bool, below: bool) -> Sprite | None:
        if racer.finished:
            place = 1 + self.detector.order.index(seat)
            return race_signs.place(seat, place, self.endings[place - 1], below)
        if racer.missed:
            return race_signs.missed(self.signs[racer.missed - 1], below, self.void if said else ())
        return race_signs.wrong_way(below) if drives_wrong(racer) else None

    def _shows_place(self, state: Race, racer: Racer) -> bool:
        """True while a place is shown: briefly after the finish and again at the end, as it would cover robots still
        racing.
        """
        return bool(state.over) or state.tick - racer.finish < PLACE_LASTS

    def _draw_path_back(self, over: Batch, seat: int, pose: Pose, line: LineFrame) -> None:
        """Draw moving dashes from a robot to the entry side of a line."""
        x, y, _ = pose
        entry, stop = (LEFT + line.x - ENTRY * line.c, TOP + line.y - ENTRY * line.s), self._stop(line)
        way = [(x, y), entry, stop]
        if math.dist((x, y), entry) < 120.0 or math.dist((x, y), stop) < 120.0:
            way = [(x, y), stop]
        gone, at = 0.0, 66.0 + self.particles.clock * MARCH % DASH
        for a, b in pairwise(way):
            length = math.dist(a, b)
            turn = math.atan2(b[1] - a[1], b[0] - a[0])
            last = length - 26.0 if b == stop else length
            while at - gone < last:
                share = (at - gone) / length
                put(over, race_signs.dash(seat, step(turn, HEADINGS)), *_between(a, b, share))
                at += DASH
            gone += length
        put(over, race_signs.tip(seat, step(math.atan2(line.s, line.c), HEADINGS)), *stop)

    def _stop(self, line: LineFrame) -> tuple[float, float]:
        return LEFT + line.x - STOP * line.c, TOP + line.y - STOP * line.s

    def _draw_notice(self, screen: pygame.Surface) -> None:
        """Briefly show that the ghost was dropped."""
        if self.recorder and self.recorder.drop_reason and self.words and self.particles.clock < TROUBLE_LASTS:
            caption(self.words(f"race.ghost_{self.recorder.drop_reason}"), FOCUS).draw(screen, 960, 1034)


def _between(a: tuple[float, float], b: tuple[float, float], share: float) -> tuple[float, float]:
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])
